"""Ride files that are spoilt, forged or too large: refused with a clear error."""

import gzip
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RideFileError, load

RIDES = Path(__file__).parents[2] / "transcripts" / "rides"
RIDE = RIDES / "s2-2.ride.jsonl.gz"
EVIL = "\x1b[31mRED"
REVERSED = "car\u202efdp"

Lines = list[dict[str, Any]]


@pytest.fixture(scope="module")
def lines() -> Lines:
    return [json.loads(line) for line in gzip.decompress(RIDE.read_bytes()).splitlines()]


def packed(lines: Lines) -> bytes:
    return gzip.compress("\n".join(map(json.dumps, lines)).encode(), mtime=0)


def header(**change: Any) -> Callable[[Lines], Lines]:
    return lambda lines: [{**lines[0], **change}, *lines[1:]]


def first_trace(change: Callable[[dict[str, Any]], object]) -> Callable[[Lines], Lines]:
    def changed(lines: Lines) -> Lines:
        copy: Lines = json.loads(json.dumps(lines))
        change(copy[1]["trace"])
        return copy

    return changed


@pytest.mark.parametrize("path", sorted(RIDES.glob("*.gz")), ids=lambda path: path.name)
def test_the_recorded_rides_are_read(path: Path) -> None:
    assert load(path.read_bytes()).traces


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "the file is empty"),
        (gzip.compress(b"", mtime=0), "it holds no line"),
        (b"hello", "not a recorded ride: it cannot be unpacked"),
        (gzip.compress(b"[1, 2]", mtime=0), "line 1: Expected `object`, got `array`"),
        (gzip.compress(b"[" * 100_000, mtime=0), "line 1"),
        (gzip.compress(b'{"event": ' * 100_000, mtime=0), "line 1"),
        (
            gzip.compress(b'{"x": "\\n", "y": ' + b"[" * 100_000, mtime=0),
            "line 1: it is nested too deeply",
        ),
        (gzip.compress(b'{"scenario": "\xff"}', mtime=0), "line 1"),
        (RIDE.read_bytes()[:20_000], "it is cut off"),
        (RIDE.read_bytes() + b"garbage", "7 bytes follow its end"),
    ],
)
def test_what_is_no_ride_file_is_refused(data: bytes, problem: str) -> None:
    with pytest.raises(RideFileError, match=problem):
        load(data)


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda lines: lines[1:], "line 1: it names no scenario, seed, halt"),
        (lambda lines: lines + lines[1:], "decisions are not in order of time, or come twice"),
        (lambda lines: [lines[0], *lines[:0:-1]], "are not in order of time"),
        (lambda lines: [*lines[:2], *lines[1:]], "line 3: decisions are not in order"),
        (lambda lines: [*lines, {}], "it tells nothing"),
        (header(seed=-2), "line 1: `seed` is not a number from 0"),
        (header(seed=10**400), "line 1: `seed` is not a number from 0"),
        (header(halt=-8.0), "line 1: `halt` is -8"),
        (header(halt=1e308), r"line 1: `halt` is 1e\+308"),
        (header(scenario=""), "line 1: `scenario` has no letter"),
        (header(scenario=EVIL), r"line 1: `scenario` holds the character U\+001B"),
    ],
)
def test_lines_that_tell_no_ride_are_named(
    lines: Lines, change: Callable[[Lines], Lines], problem: str
) -> None:
    with pytest.raises(RideFileError, match=problem):
        load(packed(change(lines)))


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda t: t.update(schema="foo/9"), "line 2: trace schema is 'foo/9'"),
        (lambda t: t.update(vehicle=EVIL), r"line 2: `trace.vehicle` holds the character U\+001B"),
        (lambda t: t["scene"]["1"].update(colour=REVERSED), r"`trace.scene.1.colour` .* U\+202E"),
        (lambda t: t["scene"].pop("0"), "the ego, 0, is missing in `scene`"),
        (lambda t: t["scene"].update({"-3": t["scene"]["0"]}), "has a number that is not from 0"),
        (lambda t: t["scene"]["0"].update(length=-5.0), r"`float` >= 0.0 - at .*scene.*length`"),
        (lambda t: t["scene"]["0"].update(speed=1e308), r"`float` <= 1000.0 - at .*scene.*speed`"),
        (lambda t: t["scene"]["0"].update(position=[1e308, 0]), r"<= 100000000.0 - at .*position"),
        (lambda t: t.update(sim_time=-1.0), "sim_time is -1"),
        (lambda t: t.update(sim_time=1e300), r"sim_time is 1e\+300"),
        (
            lambda t: t["predictions"][0]["goals"][0].update(probability=1e300),
            r"probability of goal 0 of vehicle 1 in `predictions` is 1e\+300; give 0 to 1",
        ),
        (
            lambda t: t["predictions"][0]["goals"][0].update(probability=-0.5),
            "probability of goal 0 of vehicle 1 in `predictions` is -0.5; give 0 to 1",
        ),
        (lambda t: t["rollouts"][0].update(weight=-1.0), "rollouts.weight of rollout 0 is -1"),
        (lambda t: t["rollouts"][0].update(same_as=9999), "has the line of rollout 9999"),
        (lambda t: t["rollouts"][0]["speed"].pop(), "rollout 0 has a path and speeds"),
        (lambda t: t["rollouts"][1].update(index=0), "two rollouts have the same index"),
    ],
)
def test_a_trace_that_is_none_is_refused_with_its_line(
    lines: Lines, change: Callable[[dict[str, Any]], object], problem: str
) -> None:
    with pytest.raises(RideFileError, match=problem):
        load(packed(first_trace(change)(lines)))


def test_no_more_than_the_limit_is_unpacked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ride_file, "MAX_BYTES", 1000)
    bomb = gzip.compress(b" " * 1_000_000, mtime=0)
    with pytest.raises(RideFileError, match="unpacks to more than 1000 bytes"):
        load(bomb)


def test_letters_of_other_languages_are_read(lines: Lines) -> None:
    named = first_trace(lambda t: t["goal"].update(edge="Stra\u00dfe nach K\u00f6ln"))
    assert load(packed(named(lines))).traces[0].goal.edge == "Stra\u00dfe nach K\u00f6ln"
