"""What is told of a run: how many faults were noticed, and which were not, with the reason."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping

from tests.mutants import rooms
from tests.mutants.plugin import Trial

ENOUGH = 0.85  # share of the faults that must be noticed
PAGE = rooms.ROOT / "docs" / "mutants.md"
ROW = re.compile(r"^\| `(?P<name>[^`]+)` \| (?P<reason>[^|]+) \|$", re.MULTILINE)


def reasons(page: str) -> dict[str, str]:
    """Read off a page why faults need not be noticed, by their names."""
    return {found["name"]: found["reason"] for found in ROW.finditer(page)}


def share(trials: Iterable[Trial]) -> float:
    """Tell the share of faults that were noticed."""
    noticed = [bool(trial.by) for trial in trials]
    return sum(noticed) / len(noticed) if noticed else 1.0


def table(trials: list[Trial]) -> list[str]:
    """Tell how many faults were planted and noticed, room by room."""
    planted = Counter(trial.fault.room for trial in trials)
    noticed = Counter(trial.fault.room for trial in trials if trial.by)
    reached = Counter(trial.fault.room for trial in trials if trial.tried)
    lines = ["| room | faults | run by a test | noticed | share |", "|---|---|---|---|---|"]
    for room in sorted(planted):
        part = noticed[room] / planted[room]
        lines.append(
            f"| {room} | {planted[room]} | {reached[room]} | {noticed[room]} | {part:.0%} |"
        )
    total = f"| all | {len(trials)} | {reached.total()} | {noticed.total()} | {share(trials):.1%} |"
    return [*lines, total]


def survivors(trials: list[Trial], known: Mapping[str, str]) -> list[str]:
    """Tell the faults that nobody noticed, each with its reason."""
    return [
        f"{trial.fault.path}:{trial.fault.line} {trial.fault.name} "
        f"[{known.get(trial.fault.name, 'no reason given')}]"
        for trial in trials
        if not trial.by
    ]
