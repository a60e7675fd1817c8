"""The messages of one ride in a recording, at the times of the ride."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import msgspec

from xavi_dialogue.bus.interface import vehicle_in
from xavi_dialogue.bus.messages import SceneReport, TurnReport
from xavi_dialogue.storage.mcap_file import read
from xavi_dialogue.storage.recording_format import AttachedFile, Entry, kind_of
from xavi_dialogue.viewers.messages import stamp


class _Told(msgspec.Struct):
    """What every message says of itself."""

    sim_time: float
    ride: str | None = None


def pieces(source: Path, vehicle: str) -> Iterator[Entry | AttachedFile]:
    """Yield the messages of the latest ride of a car, and its roads.

    Args:
        source: the recording.
        vehicle: the name of the car.
    """
    rides: dict[str, None] = {}
    for entry, told in _messages(source, vehicle):
        if told.ride is not None and kind_of(entry.key) is SceneReport:
            rides[told.ride] = None
    latest = list(rides)[-1]
    for entry, told in _messages(source, vehicle):
        if told.ride == latest or kind_of(entry.key) is TurnReport:
            yield replace(entry, logged=stamp(told.sim_time))
    for piece in read(source):
        if isinstance(piece, AttachedFile) and piece.name.partition("/")[0] == vehicle:
            yield piece


def _messages(source: Path, vehicle: str) -> Iterator[tuple[Entry, _Told]]:
    for piece in read(source):
        if isinstance(piece, Entry) and vehicle_in(piece.key) == vehicle and kind_of(piece.key):
            yield piece, msgspec.json.decode(piece.payload, type=_Told)
