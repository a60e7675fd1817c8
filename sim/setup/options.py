"""The options that SUMO is started with."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

from sim.setup.routes import seconds

SEED, STEP = 23423, 1.0  # SUMO's own defaults; STEP in [s]
YES = ("true", "1", "yes", "on", "t", "x")  # as SUMO reads an option
LANE_CHANGE = 3.0  # [s] SUMO's lane changes jump unless they are given a duration

#: Options that override what a configuration says.
ALWAYS = {
    "--route-steps": "0",  # load all routes at once: else SUMO drops vehicles that are out of order
    "--collision.action": "warn",
    "--collision.check-junctions": "true",
    "--collision.mingap-factor": "0",
    "--time-to-teleport": "-1",
    "--xml-validation": "never",
    "--xml-validation.net": "never",
    "--xml-validation.routes": "never",
    "--no-step-log": "true",
    "--verbose": "false",
    "--duration-log.disable": "true",
}


@dataclass(frozen=True, slots=True)
class Stated:
    """What a configuration states of the options that a ride sets, by default SUMO's own."""

    seed: int
    step: float  # [s]
    sublane: bool  # whether SUMO's sublane model moves vehicles sideways
    mesoscopic: bool  # whether vehicles are in queues, without places of their own


def of_ride(step: float, seed: int, *, sublane: bool) -> dict[str, str]:
    """Return the options of a ride, except for its files.

    Args:
        step: [s] of the simulation.
        seed: of SUMO's random numbers.
        sublane: whether SUMO's sublane model moves vehicles sideways; if not, lane changes are
            given a duration.
    """
    lanes = {} if sublane else {"--lanechange.duration": repr(LANE_CHANGE)}
    own = {"--step-length": repr(step), "--seed": str(seed), "--random": "false"}
    return {**own, **lanes, **ALWAYS}


def stated(file: Path) -> Stated:
    """Read the options of a configuration as SUMO saves it."""
    values = {option.tag: option.get("value") for option in ET.parse(file).getroot().iter()}
    step = seconds(values.get("step-length"))
    return Stated(
        seed=int(values.get("seed") or SEED),
        step=STEP if step is None else step,
        sublane=float(values.get("lateral-resolution") or 0.0) > 0.0,
        mesoscopic=(values.get("mesosim") or "").lower() in YES,
    )


def listed(options: dict[str, str]) -> list[str]:
    """Return options as arguments of a command line."""
    return [part for option in options.items() for part in option]
