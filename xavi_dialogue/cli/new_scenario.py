"""The folder of a new scenario that uses a SUMO configuration."""

import json
from pathlib import Path

from sim.setup.scenario import CONFIG, Scenario, ScenarioInvalid
from sim.setup.source import Added, Departing, FromConfiguration


def write(scenario: Scenario, folder: Path) -> Path:
    """Write the scenario.toml that loads a scenario from its SUMO configuration again.

    Args:
        scenario: as it was loaded from a configuration.
        folder: is created if missing.

    Returns:
        The file written.

    Raises:
        ScenarioInvalid: the scenario comes from no configuration, the folder holds a scenario
            already, or it cannot be written.
    """
    if not isinstance(scenario.source, FromConfiguration):
        raise ScenarioInvalid(f"{scenario.place}: it is not a SUMO configuration; copy its folder")
    target = folder / CONFIG
    if target.exists():
        raise ScenarioInvalid(f"{target}: it is there already; remove it, or name another folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        target.write_text(_text(scenario, scenario.source, folder.resolve()), encoding="utf-8")
    except OSError as error:
        raise ScenarioInvalid(f"{target}: cannot be written: {error.strerror}") from error
    return target


def _text(scenario: Scenario, source: FromConfiguration, folder: Path) -> str:
    file = scenario.routes
    inside = file.is_relative_to(folder)
    lines = [
        f"name = {_quoted(folder.name)}",
        f"description = {_quoted(scenario.description)}",
        f"configuration = {_quoted(str(file.relative_to(folder) if inside else file))}",
        *([f"ego = {_quoted(source.rider.id)}"] if isinstance(source.rider, Departing) else []),
        f"step = {scenario.step!r}  # s",
        f"view_radius = {scenario.view_radius!r}  # m",
        f"seed = {scenario.seed}",
        f"# duration = {scenario.duration!r}  # s; by default to the end of the configuration",
    ]
    if isinstance(source.rider, Added):
        added = source.rider
        ends = (f"from = {_quoted(added.origin)}", f"to = {_quoted(added.destination)}")
        begin = () if added.begin is None else (f"begin = {added.begin!r}  # s of SUMO's clock",)
        lines += ["", "[ego]", *ends, *begin]
    # With another seed the ego may depart later and drive elsewhere, so neither is fixed.
    lines += [
        "",
        "# [goal]  # by default the end of the ego's route, which may depend on the seed",
        f"# edge = {_quoted(scenario.goal.edge)}",
        f"# position = {scenario.goal.position!r}  # m along the edge",
    ]
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    """Format a text as a basic string of TOML, whose escapes are those of JSON."""
    return json.dumps(text, ensure_ascii=False)
