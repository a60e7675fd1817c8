"""What was not done, as a question names it, and the decision at which it could have been."""

from typing import Any

import pytest

from tests.explain.answers.chosen import (
    EVENTS,
    STAY,
    STOP,
    TRACES,
    TURN,
    chosen,
    deeds,
)
from tests.explain.answers.stated import US, decision, result
from tests.traces import End
from xavi_dialogue.domain.answers import CannotSay, DidNotHappen, NotApplicable
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Event, Exit, Vehicle
from xavi_dialogue.explain.answers.reference.foils import (
    check_undone,
    earlier_exit,
    foil_at,
    named_foil,
    settled,
)
from xavi_dialogue.explain.causes.plans.premise import Premise

CHANGE = Event("change-lane", side="left")


def at(event: Event, deed: Event | None = None, span: Any = None, **facts: Any) -> Any:
    """When the decision was taken, what it led to, and the foil."""
    found = result(foil_at, event, chosen(span, **facts), deed)
    if not isinstance(found, tuple):
        return found
    premise, foil = found
    return premise.trace.sim_time, premise.deed and premise.deed.action, foil


@pytest.mark.parametrize(
    ("event", "deed", "found"),
    [
        (Event("stop"), None, (12.0, None, ("stop",))),
        (Event("give-way", tense="present"), None, (12.0, None, ("stop",))),
        (Event("brake", tense="present"), None, (12.0, None, ("stop",))),
        (Event("wait"), CHANGE, (6.0, "change-left", ("stop",))),
        (Event("keep-lane"), None, (6.0, "change-left", ("continue",))),
        (Event("keep-lane"), CHANGE, (6.0, "change-left", ("continue",))),
        (Event("change-lane", side="right"), None, (12.0, None, ("change-right",))),
        (Event("change-left", tense="present"), None, (12.0, None, ("change-left",))),
        (Event("stop", then=Event("turn", side="right")), None,
         (12.0, None, ("stop", "exit-right"))),
        (Event("change-lane", tense="present"), None, (12.0, None, ("change-left",))),
        (Event("stop", then=Event("speed-up")), None, (12.0, None, ("stop",))),
    ],
)  # fmt: skip
def test_where_a_foil_could_have_been_done(event: Event, deed: Any, found: Any) -> None:
    assert at(event, deed) == found


def test_speed_is_no_foil_and_what_no_car_does_is_none() -> None:
    found = at(Event("speed-up", tense="present"))
    assert isinstance(found, NotApplicable)
    assert found.reason.startswith("speed is no choice of its own")
    assert at(Event("honk")) == CannotSay("capability", "honk", "not-an-action")


def test_a_foil_of_a_time_is_of_the_decision_then() -> None:
    assert at(Event("stop"), span=Span(2.0, 3.0, said=True))[0] == 2.0
    assert at(Event("change-right"), span=Span(12.5, 14.0, said=True))[0] == 12.0


# --- what was done after all --------------------------------------------------------------------


def test_what_was_done_is_no_foil() -> None:
    done = DidNotHappen(Event("change-left"), (Episode(US, "change-left", 6.5, 9.0),))
    assert at(Event("change-left")) == done
    stopped = deeds(("stop", 6.0, 6.5, 9.0))
    for action in ("stop", "give-way"):
        found = at(Event(action), events=stopped)
        assert isinstance(found, DidNotHappen)
        assert [e.action for e in found.instead] == ["stop"]


@pytest.mark.parametrize(
    ("event", "names", "events"),
    [
        (Event("change-left", then=Event("stop")), ("change-left",), EVENTS),
        (Event("change-left", object=Vehicle(1)), ("change-left",), EVENTS),
        (Event("change-left", tense="present"), ("change-left",), EVENTS),
        (Event("change-right"), ("change-right",), EVENTS),
        (Event("exit-straight"), ("exit-straight",), EVENTS),  # driving on is not held against it
        (Event("continue"), ("continue",), EVENTS),
    ],
)
def test_what_was_not_done_may_be_asked_about(event: Event, names: Any, events: Any) -> None:
    assert result(check_undone, chosen(events=events), event, names) is None


def test_it_has_to_have_been_done_at_the_time_that_is_said() -> None:
    event = Event("change-left")
    early = chosen(Span(2.0, 3.0, said=True))
    assert result(check_undone, early, event, ("change-left",)) is None
    then = chosen(Span(7.0, 8.0, said=True))
    assert isinstance(result(check_undone, then, event, ("change-left",)), DidNotHappen)


# --- names --------------------------------------------------------------------------------------


def test_the_side_is_the_one_that_was_possible() -> None:
    side = Event("change-lane", tense="present")
    assert settled(chosen(), side) == ("change-left", "change-right")
    assert settled(chosen(Span(2.0, 3.0, said=True)), side) == ("change-left",)
    assert settled(chosen(now=13.0, traces=TRACES[:2]), side) == ("change-left",)
    assert settled(chosen(Span(7.0, 8.0, said=True)), side) == ("change-left", "change-right")
    assert settled(chosen(Span(1.0, 1.0, said=True)), side) == ("change-left", "change-right")
    assert settled(chosen(), Event("turn", tense="present")) == ("exit-left", "exit-right")
    turning = [decision(12.0, STAY, ends={TURN: End("dead")})]
    assert settled(chosen(traces=turning), Event("turn")) == ("exit-right",)
    assert settled(chosen(), Event("change-lane", side="right")) == ("change-right",)
    assert settled(chosen(), Event("brake")) == ("slow-down",)


def test_overtaking_is_changing_lanes_to_the_side_that_was_known() -> None:
    overtake = Event("overtake")
    assert settled(chosen(traces=TRACES[:2]), overtake) == ("change-left",)
    assert settled(chosen(), overtake) == ("change-left", "change-right")
    assert settled(chosen(traces=[decision(2.0, STAY)]), overtake) == (
        "change-left", "change-right",
    )  # fmt: skip


def test_the_contrast_that_is_drawn_is_expressed_in_actions() -> None:
    asked = chosen()
    premise = Premise(TRACES[3], None)
    both = Event("change-lane", side="right", then=Event("turn", side="left"))
    assert named_foil(asked, both, premise) == ("change-right", "exit-left")
    assert named_foil(asked, Event("wait"), premise) == ("stop",)
    assert named_foil(asked, Event("change-lane"), premise) == ("change-left",)
    assert named_foil(asked, None, premise) is None


# --- exits of a roundabout ----------------------------------------------------------------------

#: We go past two exits.
RING = [
    decision(2.0, ("continue-next-exit",), ends={("exit-right",): End("dead"), STOP: End()}),
    decision(6.0, ("continue-next-exit",), ends={("exit-straight",): End("dead"),
                                                 ("exit-left",): End("dead")}),
    decision(12.0, ("exit-right",), ends={("continue-next-exit",): End("dead")}),
]  # fmt: skip
PAST = deeds(
    ("continue-next-exit", 2.0, 2.5, 5.0), ("continue-next-exit", 6.0, 6.5, 10.0),
    ("exit-right", 12.0, 12.5, 15.0),
)  # fmt: skip


@pytest.mark.parametrize(
    ("event", "span", "found"),
    [
        (Event("leave", object=Exit(1)), None, (2.0, ("exit-right",))),
        (Event("leave", object=Exit(2)), None, (6.0, ("exit-straight",))),
        (Event("turn", side="right", object=Exit(1)), None, (2.0, ("exit-right",))),
        (Event("leave", object=Exit(3)), None, (6.0, ("exit-straight",))),
        (Event("leave", object=Exit(0)), None, (6.0, ("exit-straight",))),
        (Event("leave"), None, (6.0, ("exit-straight",))),
        (Event("leave"), Span(3.0, 4.0, said=True), (2.0, ("exit-right",))),
        (Event("leave", side="right"), None, None),
        (Event("turn"), None, None),
        (Event("turn", object=Exit()), None, None),
        (Event("continue-next-exit", object=Exit(1)), None, None),
    ],
)
def test_an_exit_that_we_went_past(event: Event, span: Any, found: Any) -> None:
    told = earlier_exit(event, chosen(span, traces=RING, events=PAST))
    assert (None if told is None else (told[0].trace.sim_time, told[1])) == found
    if told is not None and event.action == "leave" and event.object is not None:
        assert at(event, span=span, traces=RING, events=PAST)[2] == told[1]


def test_where_none_was_passed_there_is_no_earlier_exit() -> None:
    assert earlier_exit(Event("leave", object=Exit(1)), chosen()) is None
    shut = [decision(2.0, ("continue-next-exit",), ends={STOP: End()}), *RING[1:]]
    asked = chosen(traces=shut, events=PAST)
    assert earlier_exit(Event("leave", object=Exit(1)), asked) is None


# --- a turn that is planned after a stop --------------------------------------------------------

HALT: Any = ("stop", "exit-right", "continue")
AHEAD = [decision(12.0, HALT, ends={TURN: End(time=12.0), ("stop", "exit-left"): End(time=30.0)})]


@pytest.mark.parametrize("tense", ["past", "present"])
def test_the_planned_turn_is_asked_about_in_place_of_the_stop_before_it(tense: Any) -> None:
    asked = chosen(traces=AHEAD, events=[])
    premise, foil = foil_at(Event("turn", side="right", tense=tense), asked)
    assert (premise.node, foil) == ((), TURN)


def test_another_way_is_asked_about_after_the_stop() -> None:
    premise, foil = foil_at(Event("turn", side="left"), chosen(traces=AHEAD, events=[]))
    assert (premise.node, foil) == (("stop",), ("exit-left",))


def test_a_turn_that_opens_only_after_the_stop_is_asked_about_there() -> None:
    shut = [decision(12.0, HALT, ends={("continue",): End(time=12.0)})]
    premise, foil = foil_at(Event("turn", side="right"), chosen(traces=shut, events=[]))
    assert (premise.node, foil) == (("stop",), TURN)


def test_sooner_or_later_is_what_was_done() -> None:
    for manner in ("early", "late"):
        assert settled(chosen(), Event("change-lane", manner=(manner,))) == ("change-left",)
        undone = settled(chosen(), Event("turn", manner=(manner,)))
        assert undone == ("exit-left", "exit-right")
    plain = settled(chosen(), Event("change-lane", tense="present", manner=("fast",)))
    assert plain == ("change-left", "change-right")
