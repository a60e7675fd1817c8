"""Why another vehicle is parked, slow, or where it is, and what was believed of it; at 20 s."""

from typing import Any

import pytest
from msgspec.structs import replace

from sim.scene import VehicleState
from tests.explain.answers.reasons.test_others_braking import (
    BY,
    IT,
    LEADER,
    SAID,
    SEEN,
    US,
    Ways,
    does,
    why,
)
from tests.explain.answers.stated import (
    decision,
    did,
    driven,
    result,
    scene,
    they,
)
from xavi_dialogue.domain.answers import MotionCause, OtherReason, PlaceReason
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Believed, Event, Happens, Is, Related, Vehicle
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reasons import others as room
from xavi_dialogue.explain.causes.driving.hindrance import Hindrance


@pytest.fixture
def ways(monkeypatch: pytest.MonkeyPatch) -> Ways:
    return Ways(monkeypatch)


def standing(since: float = 0.0, lights: tuple[str, ...] | None = (), now: float = 20.0) -> Any:
    """A vehicle that stands, seen since a time, with what lights it shows."""
    state = VehicleState((0.0, 0.0), 0.0, 0.0, 0.0, 4.5, 1.8, signals=lights or ())
    at = replace(decision(4.0), scene={} if lights is None else {1: state})
    motion = driven((0.0,) * 5, since=since, speed=0.0)
    return {"motions": {1: motion}, "traces": (at,), "now": now}


@pytest.mark.parametrize(
    ("episode", "more", "parked"),
    [
        (they(1, "stop", 0.0), standing(), True),
        (they(1, "stop", 0.0, 9.0), standing(), False),
        (they(1, "stop", 1.0), standing(), False),
        (they(1, "stop", 1.0), standing(since=1.0), True),
        (they(1, "stop", 0.0), standing(lights=("brake",)), False),
        (they(1, "stop", 0.0), standing(lights=None), False),
        (they(1, "stop", 2.0), standing(since=2.0, now=5.0), True),
        (they(1, "stop", 2.0), standing(since=2.0, now=4.9), False),
        (they(1, "stop", 0.0), {"motions": {}, "traces": ()}, False),
    ],
)
def test_who_stood_there_from_the_first_is_parked(
    ways: Ways, episode: Episode, more: Any, parked: bool
) -> None:
    found = why(does("stop"), episode, **more)
    parked_ = OtherReason(1, episode, None, (MotionCause("parked"),))
    assert (found == parked_) is parked
    ways.stood = BY
    assert why(does("stop"), episode, **more).causes == (LEADER,)


# Slowness, beliefs, places ----------------------------------------------------------------------

STARTS = driven((0.0,) * 21, speed=(0.0,) * 17 + (0.0, 2.0, 4.0, 6.0))


@pytest.mark.parametrize(
    ("episodes", "motion", "slows"),
    [
        ((they(1, "brake", 15.0, 18.0),), None, True),
        ((they(1, "wait", 15.0),), None, True),
        ((they(1, "brake", 15.0, 17.9),), None, False),
        ((they(1, "exit-left", 15.0),), None, False),
        ((they(2, "brake", 15.0),), None, False),
        ((they(1, "stop", 5.0, 18.5),), STARTS, False),
    ],
)
def test_who_slows_does_not_drive_slowly(episodes: Any, motion: Any, slows: bool) -> None:
    motions = {} if motion is None else {1: motion}
    assert room.slows(scene(looks=SEEN, episodes=episodes, motions=motions), 1) is slows


def test_who_drives_slowly_has_somebody_in_its_way(ways: Ways) -> None:
    ways.present = Hindrance((LEADER,), ("t4",))
    speeds = {2: driven((0.0,) * 21, speed=7.0)}
    asked = scene(looks=SEEN, values={("speed", 1): 6.0}, motions=speeds)
    deed = Episode(IT, "move", 20.0, speed_to=6.0)
    assert room.slowly(asked, 1) == OtherReason(
        1, deed, None, (replace(LEADER, speed=7.0),), None, ways.present.evidence
    )
    off = scene(looks=SEEN, values={("speed", 1): 6.0}, motions={1: STARTS})
    assert room.slowly(off, 1) == OtherReason(1, deed, None, (MotionCause("starting"),))


def test_what_was_believed_has_its_grounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "grounds", lambda _, vehicle, names, at: (vehicle, names, at))
    monkeypatch.setattr(choices, "why", lambda event, _: ("choice", event))

    def told(content: Any) -> Any:
        return result(room.believed, content, scene(SAID, looks=SEEN))

    assert told(Happens(does("exit-left"))) == (1, ("exit-left",), 5.0)
    assert told(Believed(Happens(does("exit-left")))) == (1, ("exit-left",), 5.0)
    assert told(Happens(Event("stop"))) == ("choice", Event("stop"))
    assert told(Is("slow", IT)) == ("choice", None)


def test_a_place_is_told_by_what_brought_it_there() -> None:
    gave = did("give-way", 3.0, 4.0, object=IT)
    passed = they(1, "overtake", 9.0, 12.0, object=US)
    asked = scene(looks=SEEN, episodes=(gave, passed))
    found = room.placed(Related("ahead-of", IT, US), asked)
    assert found == PlaceReason(1, "ahead-of", passed)
    then = scene(SAID, looks=SEEN, episodes=(gave, passed))
    assert room.placed(Related("ahead-of", IT, US), then) == PlaceReason(1, "ahead-of", gave)
    never = result(room.placed, Related("behind", Vehicle(9), US), asked)
    assert never.thing == Vehicle(9)
