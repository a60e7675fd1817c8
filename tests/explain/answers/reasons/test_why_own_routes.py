"""Which explainer is asked, and for what, where it is asked why we did something."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, Told, look, plan, refused, stand_in
from xavi_dialogue.domain.answers import CannotSay, DidNotHappen, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowAvoid, Why
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Junction,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import choices, refraining
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.ride import onward

ONE = Vehicle(1)
THEN = Span(8.0, 9.0, said=True)
STANDS = (plan(NOW, speed=0.0),)
CROSSED = (
    Recorded("action-started", 6.0, "exit-left", 6),
    Recorded("action-committed", 8.0, "exit-left"),
    Recorded("action-ended", 11.0, "exit-left"),
)


@pytest.fixture(autouse=True)
def explainers(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(
        monkeypatch,
        *(f"choices.{name}" for name in ("why", "why_not", "in_lane", "straight", "needed")),
        *(f"motions.{name}" for name in ("slow", "fast", "motion", "standing_or_slow")),
        *("going.went", "deciding.how_avoid", "signalling.why_signal", "refraining.refrained"),
    )
    monkeypatch.setattr(refraining, "not_passed", lambda event, scene: None)
    monkeypatch.setattr(refraining, "left_lane", lambda event, scene: None)
    monkeypatch.setattr(onward, "stays_on", lambda scene, event: None)


def scene(span: Span | None = None, **more: Any) -> Any:
    return Given(**({"looks": {1: look(1)}, "traces": (plan(NOW),)} | more)).asked(span)


def own(event: Event, span: Span | None = None, question: Any = None, **more: Any) -> Any:
    return reasons.own(event, scene(span, **more), question)


def rest(found: Told) -> tuple[Any, ...]:
    """What was asked, without the scene."""
    return tuple(one for one in found.args if not hasattr(one, "world"))


def raising(result: Any) -> Any:
    def explain(*args: Any, **more: Any) -> Any:
        raise Unanswered(result)

    return explain


BEHIND = Related("behind", Ego(), ONE)
BEFORE = Related("ahead-of", Ego(), ONE)


@pytest.mark.parametrize(
    ("event", "by", "args"),
    [
        (Event("go", manner=("suddenly", "slowly")), "motions.motion", None),
        (Event("go", manner=("slowly",)), "motions.standing_or_slow", None),
        (Event("continue", manner=("slowly",)), "motions.standing_or_slow", None),
        (Event("enter", manner=("fast",)), "motions.fast", ()),
        (Event("continue", manner=("fast",)), "motions.fast", ()),
        (Event("change-left", manner=("fast",)), "choices.why", None),
        (Event("signal", side="left"), "signalling.why_signal", ("left",)),
        (Event("follow", object=ONE), "motions.slow", ("slowly", Event("follow", object=ONE))),
        (Event("approach", manner=("close",)), "motions.slow",
         ("close", Event("approach", manner=("close",)))),
        (Event("keep-distance", manner=("far",)), "motions.slow",
         ("far", Event("keep-distance", manner=("far",)))),
        (Event("continue", tense="present"), "choices.straight", ()),
        (Event("continue"), "choices.why", None),
        (Event("keep-lane"), "choices.in_lane", ()),
        (Event("go", side="left"), "choices.why", (Event("do", side="left"), None)),
        (Event("go", object=Exit(2)), "choices.why", (Event("do", object=Exit(2)), None)),
        (Event("head", object=Junction()), "choices.why", (Event("do", object=Junction()), None)),
        (Event("pass", where=BEHIND), "choices.why", (Event("do", where=BEHIND), None)),
        (Event("turn", manner=("early",)), "going.went", None),
        (Event("turn", manner=("late",)), "going.went", None),
        (Event("exit-left", manner=("suddenly",)), "going.went", None),
        (Event("exit-left"), "choices.why", None),
        (Event("go"), "going.went", None),
        (Event("cross"), "going.went", None),
        (Event("brake"), "motions.motion", (Event("brake"),)),
        (Event("block", object=ONE), "motions.motion", None),
        (Event("avoid", object=ONE), "motions.motion", None),
        (Event("overtake", object=ONE), "choices.why", None),
        (Event("merge"), "choices.why", (Event("merge"), None)),
        (Event("exit-left", where=BEFORE), "choices.why", None),
    ],
)  # fmt: skip
def test_what_we_did_is_asked_of_whom_it_concerns(event: Event, by: str, args: Any) -> None:
    found = own(event)
    assert found.by == by
    if args is not None:
        assert rest(found) == args
    elif by == "choices.why":
        assert rest(found) == (event, None)
    else:
        assert found.events == (event,)


def test_manners_and_times_are_handed_on() -> None:
    assert own(Event("go", manner=("suddenly", "slowly"))).more == {"asked": "slow-down"}
    assert own(Event("signal", side="left")).more == {"past": True}
    assert own(Event("signal", tense="present")).more == {"past": False}
    crash = own(Event("collide", object=ONE))
    assert crash.by == "deciding.how_avoid"
    assert rest(crash) == (HowAvoid(Happens(Event("collide", object=ONE))),)
    assert own(Event("nearly-collide")).by == "deciding.how_avoid"
    assert refused(own, Event("fly")) == CannotSay("capability", "fly", "not-an-action")


def instead(event: Event, other: Event, **more: Any) -> Any:
    of = Happens(event)
    return own(event, question=Why(of, instead=Happens(other), **more))


def test_what_was_not_done_instead_is_asked_where_we_only_went_on() -> None:
    change = Event("change-left", tense="present")
    for going in (Event("follow", object=ONE), Event("keep-lane"), Event("wait"), Event("go")):
        found = instead(going, change)
        assert (found.by, rest(found)) == ("choices.why_not", (replace(change, tense="past"),))
    stops = instead(Event("continue", tense="present"), Event("stop"))
    assert (stops.by, rest(stops)) == ("choices.why_not", (Event("stop", tense="present"),))
    turn = instead(Event("turn"), change)
    assert (turn.by, rest(turn)) == ("choices.why", (Event("turn"), Happens(change)))
    braked = instead(Event("brake"), change)
    assert (braked.by, rest(braked)) == ("choices.why_not", (change,))
    other = instead(Event("brake"), Event("slow-down"))
    assert (other.by, rest(other)) == ("motions.motion", (Event("brake"),))
    way = instead(Event("go", side="left"), Event("exit-right"))
    assert rest(way) == (Event("do", side="left"), Happens(Event("exit-right")))
    odd = Why(Happens(Event("brake")), instead=Exists(ONE))
    assert own(Event("brake"), question=odd).by == "motions.motion"


def test_staying_behind_whom_we_could_pass_is_told_unless_it_is_suspected(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(refraining, "not_passed", lambda event, scene: "stays")
    follow = Event("follow", object=ONE)
    assert own(follow) == "stays"
    assert own(follow, question=Why(Happens(follow))) == "stays"
    assert own(follow, question=Why(Happens(follow), suspect=ONE)).by == "motions.slow"


def test_going_left_is_the_change_of_lanes_that_is_under_way() -> None:
    started = (Recorded("action-started", 15.0, "change-left", 15),)
    found = own(Event("exit-left"), events=started)
    assert rest(found) == (Event("change-left"), None)


# --- coming in among others ---------------------------------------------------------------------


def test_coming_in_ahead_of_somebody_at_a_junction_is_going_there() -> None:
    went = own(Event("pull-out", object=ONE), events=CROSSED)
    assert (went.by, rest(went)) == ("going.went", (Event("go", object=ONE),))
    placed = own(Event("enter", where=BEFORE), events=CROSSED)
    assert (placed.by, rest(placed)) == ("going.went", (Event("go", object=ONE),))
    turned = own(Event("exit-left", object=ONE), events=CROSSED)
    assert (turned.by, rest(turned)) == ("going.went", (Event("go", object=ONE),))
    ahead = own(Event("exit-left", where=BEFORE), events=CROSSED)
    assert (ahead.by, rest(ahead)) == ("going.went", (Event("go", object=ONE),))
    behind = own(Event("exit-left", where=BEHIND), events=CROSSED)
    assert behind.by == "choices.why"
    alone = own(Event("merge"), events=CROSSED)
    assert alone.by == "choices.why"


def test_coming_in_that_was_no_change_of_lanes_is_the_junction(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    never = DidNotHappen(Event("merge"))
    monkeypatch.setattr(choices, "why", raising(never))
    found = own(Event("merge"), events=CROSSED)
    assert (found.by, rest(found)) == ("going.went", (Event("go"),))
    assert refused(own, Event("merge")) == never
    lost = NotRecorded("gap-in-record")
    monkeypatch.setattr(choices, "why", raising(lost))
    assert refused(own, Event("merge"), events=CROSSED) == lost
