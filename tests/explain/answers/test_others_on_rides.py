"""What others did on recorded rides: on which roads they went, how near, and who overtook whom."""

from pathlib import Path

import pytest

import xavi_dialogue as xavi
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

RIDES = Path(__file__).parents[3] / "transcripts" / "rides"
OPENED: dict[str, xavi.Ride] = {}


def asked(name: str, question: str) -> str:
    if name not in OPENED:
        OPENED[name] = xavi.open(RIDES / f"{name}.ride.jsonl.gz")
    ride = OPENED[name]
    return ride.ask(question, at=ride.end).text


@pytest.mark.parametrize("name", ["junction-0", "town-0", "motorway-0", "s2-2"])
def test_the_nearest_of_all_is_of_the_whole_ride_and_not_of_those_in_view(name: str) -> None:
    how_near = asked(name, "How close did we get to anyone?")
    closest = asked(name, "Who came closest to us?")
    number = how_near.partition("(vehicle ")[2].partition(")")[0]
    assert how_near.startswith("We came as close as ")
    assert f"(vehicle {number})" in closest


@pytest.mark.parametrize("name", ["junction-0", "town-0", "s4-0"])
def test_who_comes_towards_us_overtakes_nobody(name: str) -> None:
    told = asked(name, "Did anyone overtake us?")
    assert told.startswith("No, nobody overtook us")


def test_way_is_given_by_right_of_way_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    record = xavi.open(RIDES / "s3-0.ride.jsonl.gz").record
    end = record.traces[-1].sim_time
    world = World(Ride(Record(end, tuple(record.traces), tuple(record.events))))
    waits = tuple(
        Episode(Ego(), "give-way", 2.0 * k, 2.0 * k + 1.0, how=how)
        for k, how in enumerate(("leader", "right-of-way", None))
    )
    monkeypatch.setattr(World, "episodes", lambda *_args, **_named: waits)
    assert world.holds(Event("wait", Ego()), 0.0, end) == waits
    assert world.holds(Event("give-way", Ego()), 0.0, end) == waits[1:]
    assert world.holds(Event("let-go", Ego()), 0.0, end) == waits[1:]


def test_whom_we_only_stood_behind_we_did_not_give_way_to() -> None:
    told = asked("junction-0", "Did you give way to anyone?")
    assert told.startswith("I gave way to ")
    assert "vehicle 2)" not in told


@pytest.mark.parametrize(
    "question",
    ["How often were you wrong?", "How many times have you been wrong?",
     "How many mistakes did you make?"],
)  # fmt: skip
def test_how_often_we_were_wrong_is_of_what_we_expected(question: str) -> None:
    for name in ("junction-0", "town-0"):
        assert asked(name, question) == asked(name, "What did you get wrong?")


def test_who_was_seen_on_the_ramp_took_the_exit() -> None:
    assert "took the exit at 0:27" in asked("motorway-0", "Did vehicle 2 take the exit?")
    told = asked("motorway-0", "What did you get wrong?")
    assert "to change to the left lane (61 %), but it took the exit at 0:28" in told
    assert asked("motorway-0", "Did vehicle 6 take the exit?").startswith("No, ")
    assert not asked("motorway-0", "Did vehicle 2 take the exit at 0:05?").startswith("Yes")
