"""The rides of an audit: scenarios driven with seeds, or recordings."""

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Final

import msgspec

from sim.errors import SimError
from sim.setup.scenario import Scenario, available, load
from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.program import LENGTH, digest
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.library.sources import RECORDING
from xavi_dialogue.storage.ride_file import ENDING, MAX_SEED
from xavi_dialogue.vehicle.episode import network_of

MOST: Final = 100_000  # rides of one audit
_RANGE: Final = re.compile(r"(\d+)(?:-(\d+))?")


class Source(msgspec.Struct, frozen=True):
    """Where a ride comes from."""

    ride: str  # its name in this audit
    place: str  # a scenario, or the path of a recording
    content: str  # hash of the scenario's files, or of the recording
    seed: int | None = None  # None: a recording
    duration: float | None = None  # [s] after which a ride ends at the latest

    @property
    def key(self) -> bytes:
        """All that decides what the ride is like, wherever it lies."""
        place = None if self.seed is None else self.place  # rides state their scenario
        return msgspec.json.encode((place, self.content, self.seed, self.duration))


def read_seeds(text: str) -> tuple[int, ...]:
    """Read seeds, such as `0-9` or `1,4,7-9`.

    Raises:
        AuditError: they are none.
    """
    found: list[int] = []
    for part in text.split(","):
        one = _RANGE.fullmatch(part.strip())
        first, last = (int(one[1]), int(one[2] or one[1])) if one else (0, -1)
        if not first <= last <= MAX_SEED:
            raise AuditError(
                f"seeds are {text!r}; give numbers from 0 to {MAX_SEED}, such as 0-9 or 1,4,7-9"
            )
        if last - first >= MOST:
            raise AuditError(f"seeds {part!r} are more than {MOST}; give fewer")
        found += range(first, last + 1)
    return tuple(dict.fromkeys(found))


def driven(
    places: Sequence[str], seeds: Sequence[int], duration: float | None
) -> tuple[Source, ...]:
    """Return the rides of scenarios driven with seeds; every scenario with every seed.

    Raises:
        AuditError: a scenario cannot be used, or these are too many rides.
    """
    if len(places) * len(seeds) > MOST:
        raise AuditError(f"{len(places) * len(seeds)} rides; one audit takes at most {MOST}")
    found = []
    for place in dict.fromkeys(places):
        try:
            scenario = load(place)
        except SimError as error:
            raise AuditError(str(error)) from error
        content = content_of(scenario)
        there = place if place in available() else scenario.place
        found += [Source(f"{place}-{seed}", there, content, seed, duration) for seed in seeds]
    return tuple(found)


def content_of(scenario: Scenario) -> str:
    """Return the hash of a scenario's roads and settings, and of the files in its folder."""
    settings = (scenario.ego, scenario.step, scenario.duration, scenario.view_radius)
    parts = [msgspec.json.encode(settings), network_of(scenario).hash.encode()]
    for path in sorted(scenario.folder.iterdir()):
        if path.is_file():
            parts += [path.name.encode(), path.read_bytes()]
    return digest(*parts)[:LENGTH]


def recorded(folder: Path) -> tuple[Source, ...]:
    """Return the rides that are recorded in a folder or below it, in order of their names.

    Raises:
        AuditError: there is no such folder, or it holds no recording.
    """
    if not folder.is_dir():
        raise AuditError(f"{folder} is no folder; give one with recordings")
    found = tuple(
        Source(one_line(path.relative_to(folder).as_posix()), str(path.resolve()), _found(path))
        for path in sorted(_files(folder))
    )
    if not found:
        raise AuditError(f"{folder} holds no recording: no file ends in {ENDING} or {RECORDING}")
    return found


def check_content(source: Source) -> None:
    """Check that a source is what it was when the audit was planned.

    Raises:
        AuditError: it cannot be read here, or it has changed.
    """
    path = Path(source.place)
    found = _hash(path) if source.seed is None else _scenario_here(source.place)
    if found != source.content:
        raise AuditError(f"{source.place} is not the same here; give every worker the same files")


@lru_cache(maxsize=64)
def _scenario_here(place: str) -> str:
    """Return the hash of a scenario; a worker reads each one once."""
    try:
        return content_of(load(place))
    except SimError as error:
        raise AuditError(str(error)) from error


def _files(folder: Path) -> Iterator[Path]:
    return (
        path for path in folder.rglob("*") if path.name.endswith((ENDING, RECORDING))
        if path.is_file()
    )  # fmt: skip


def _found(path: Path) -> str:
    """Return the hash of a recording; nothing of one that cannot be read, which then fails."""
    try:
        return _hash(path)
    except AuditError:
        return ""


def _hash(path: Path) -> str:
    try:
        return digest(path.read_bytes())[:LENGTH]
    except OSError as error:
        raise AuditError(f"cannot read {path}: {error.strerror}") from error
