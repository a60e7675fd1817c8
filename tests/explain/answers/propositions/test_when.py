"""When something came or comes, or was so first; asked at 20 s."""

from typing import Any

import pytest

from planner.record.events import Event as Told
from tests.explain.answers.stated import (
    belief,
    decision,
    did,
    look,
    result,
    scene,
    they,
)
from xavi_dialogue.domain.answers import (
    Activity,
    DidNotHappen,
    Measures,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import When, Whither
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Between,
    Compares,
    Destination,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Next,
    Not,
    Quantity,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import happenings as room
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.causes.vehicles.course import Expected

IT, US = Vehicle(1), Ego()
LATER = Expected(0.8, 24.0, 22.0, 26.0)
SEEN = {1: look(1), 2: look(2)}


@pytest.fixture
def ahead(monkeypatch: pytest.MonkeyPatch) -> dict[str, Expected]:
    """What our plan comes to, by action."""
    plan: dict[str, Expected] = {}
    monkeypatch.setattr(room, "foreseen", lambda _, event: plan.get(event.action))
    return plan


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """What other modules tell is told by their names."""
    for name in ("plan_ahead", "whither", "summary", "since_when", "announced", "time_to_go"):
        monkeypatch.setattr(
            room, name, lambda *args, name=name, **more: (name, *_plain(args), *more.values())
        )
    return monkeypatch


def _plain(args: Any) -> Any:
    return [a for a in args if isinstance(a, float | int | Event | Window | Whither | Episode)]


def when(of: Any, *, edge: Any = "begin", **more: Any) -> Any:
    of = Happens(of) if isinstance(of, Event) else of
    return result(room.when, When(of, edge), scene(**more))


def test_an_event_is_told_with_whoever_took_part(ahead: Any) -> None:
    gave = did("give-way", 5.0, 8.0, object=IT)
    event = Event("give-way", object=IT)
    found = when(event, episodes=(gave,), looks=SEEN)
    assert (found.form, found.episodes, found.actor) == ("when", (gave,), US)
    assert [(x.vehicle, x.time) for x in found.looks] == [(1, 5.0)]
    assert (found.asked, found.measures) == (event, ())
    assert when(Not(Happens(event)), episodes=(gave,), looks=SEEN) == found


@pytest.mark.parametrize(("end", "seconds"), [(8.456, 3.46), (None, 15.0)])
def test_the_end_of_an_event_is_told_by_how_long_it_lasted(
    ahead: Any, end: Any, seconds: float
) -> None:
    found = when(Event("stop"), edge="end", episodes=(did("stop", 5.0, end),))
    assert found.form == "how-long"
    assert found.measures == (
        Measure("duration", US, 5.0, value=seconds, until=end, at_least=end is None),
    )


@pytest.mark.parametrize(
    ("event", "begin"),
    [
        (Event("enter"), 9.0),
        (Event("enter", time=Between(0.0, 8.0)), 3.0),
        (Event("enter", time=Between(0.0, 2.0)), None),
        (Event("enter", tense="future"), None),
        (Event("enter", IT), None),
        (Event("merge"), None),
    ],
)
def test_who_entered_a_junction_took_a_way_through_it(
    ahead: Any, event: Event, begin: float | None
) -> None:
    ways = (did("exit-left", 3.0, 5.0), did("exit-straight", 9.0, 11.0), they(1, "exit-left", 9.5))
    found = room._entered(scene(episodes=ways), event)
    assert (None if found is None else found.begin) == begin
    if begin is not None:
        assert when(event, episodes=ways).episodes == (found,)


@pytest.mark.parametrize(
    ("found", "span", "planned"),
    [
        (LATER, None, 24.0),
        (Expected(0.5, 18.0, 17.0, 19.0), None, 20.0),
        (Expected(0.4, 24.0, 22.0, 26.0), None, None),
        (None, None, None),
        (LATER, Span(2.0, 4.0, said=True), None),
    ],
)
def test_what_did_not_come_may_be_planned(ahead: Any, found: Any, span: Any, planned: Any) -> None:
    ahead.update({} if found is None else {"stop": found})
    refused = when(Event("stop"), span=span)
    assert isinstance(refused, DidNotHappen)
    assert refused.planned == planned


def test_nothing_is_planned_of_others(ahead: Any) -> None:
    ahead["stop"] = LATER
    assert when(Event("stop", IT), looks=SEEN).planned is None


@pytest.mark.parametrize("tense", ["past", "future"])
def test_the_arrival_is_told_until_we_are_there(ahead: Any, told: Any, tense: Any) -> None:
    event = Event("arrive", tense=tense)
    due = when(event, values={("arrival-time", 0): 95.0})
    assert isinstance(due, Measures)
    assert [m.value for m in due.measures] == [95.0]
    assert when(event).measures == (("time_to_go", 20.0),)
    theirs = when(Event("arrive", IT), looks=SEEN, values={("arrival-time", 0): 95.0})
    assert isinstance(theirs, DidNotHappen)


def test_an_arrival_that_came_is_an_event(ahead: Any) -> None:
    there = did("arrive", 19.0, 19.0)
    found = when(Event("arrive"), episodes=(there,), events=(Told("arrived", 19.0),))
    assert found.episodes == (there,)


def test_what_we_reach_or_leave_is_told_by_the_road(
    ahead: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(room, "reaching", lambda _, event: event.tense)
    stops = did("stop", 5.0, 6.0)
    assert when(Event("stop", tense="future"), episodes=(stops,)) == "future"
    assert when(Event("stop"), episodes=(stops,)).episodes == (stops,)
    monkeypatch.setattr(room, "reaching", lambda *_: None)
    monkeypatch.setattr(room, "leaves_when", lambda _, event: event.action)
    assert when(Event("leave")) == "leave"


def verdict(of: Any, found: Expected, value: float, low: float, high: float) -> Verdict:
    time = Measure("time", US, 20.0, value=value, low=low, high=high)
    return Verdict(Happens(of), True, (time,), probability=found.share, either=True)


@pytest.mark.parametrize(
    ("found", "times"),
    [
        (LATER, (24.0, 22.0, 26.0)),
        (Expected(0.5, 23.0, 18.0, 26.0), (23.0, 20.0, 26.0)),
        (Expected(0.9, 18.0, 17.0, 19.0), (20.0, 20.0, 20.0)),
    ],
)
def test_what_is_to_come_is_told_by_our_plan(
    ahead: Any, found: Expected, times: tuple[float, float, float]
) -> None:
    ahead["stop"] = found
    event = Event("stop", tense="future")
    assert when(event) == verdict(event, found, *times)


@pytest.mark.parametrize("found", [None, Expected(0.4, 24.0, 22.0, 26.0)])
def test_what_is_not_planned_is_denied(ahead: Any, found: Any) -> None:
    ahead.update({} if found is None else {"stop": found})
    event = Event("stop", tense="future", time=Next())
    assert when(event) == DidNotHappen(event)
    earlier = when(event, episodes=(did("stop", 5.0, 6.0),))
    assert (earlier.asked, earlier.elsewhen) == (event, 5.0)


def test_moving_off_is_going_and_what_goes_on_is_told(ahead: Any) -> None:
    ahead["go"] = LATER
    move = Event("move", tense="future")
    assert when(move) == verdict(Event("go", tense="future"), LATER, 24.0, 22.0, 26.0)
    to = Event("move", object=Destination(), tense="future")
    assert when(to) == DidNotHappen(to)
    stops = did("stop", 18.0)
    assert when(Event("stop", tense="future"), episodes=(stops,)).episodes == (stops,)


def test_who_rolls_and_plans_no_start_is_told_what_it_does(ahead: Any) -> None:
    told = when(Event("go", tense="future"))
    assert isinstance(told, Activity)
    assert told.actor == Ego()


def test_of_others_there_is_only_how_probable_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "chance", lambda _, event, at: (event.action, at))
    event = Event("exit-left", IT, tense="future")
    thought = belief(1, 19.0, ("exit-left", 0.7), ("continue", 0.2), ("exit-right", 0.1))
    found = when(event, looks=SEEN, beliefs=(thought,))
    assert (found.holds, found.gap, found.probability) == (None, "in-future", ("exit-left", 20.0))
    assert found.believed == (belief(1, 19.0, ("continue", 0.2), ("exit-right", 0.1)),)
    assert when(event, looks=SEEN).believed == ()


# When a state held first ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("span", "first"),
    [
        (None, 6.0),
        (Span(9.5, 16.0, said=True), 8.0),
        (Span(10.5, 16.0, said=True), 10.0),
        (Span(0.0, 5.9, said=True), None),
        (Span(0.0, 6.0, said=True), 6.0),
    ],
)
def test_a_state_held_first_at_a_decision(span: Any, first: float | None) -> None:
    speeds = {("speed", 1): lambda t: 5.0 if t >= 5.0 else 0.0}
    traces = tuple(decision(2.0 * k) for k in range(11))
    asked = scene(span, looks=SEEN, values=speeds, traces=traces)
    found = room.when(When(Is("moving", IT)), asked)
    assert isinstance(found, Verdict)
    assert found.holds is (first is not None)
    assert found.that == (Is("moving", IT) if first is None else Is("moving", IT, time=At(first)))
    assert bool(found.facts) is (first is not None)


def test_what_has_no_time_is_asked_as_it_is() -> None:
    faster = Compares(Measured("speed"), "more", Quantity(5.0, "m/s"))
    asked = scene(values={("speed", 0): 9.0}, traces=(decision(2.0),))
    found = room.when(When(faster), asked)
    assert isinstance(found, Verdict)
    assert (found.that, found.holds) == (faster, True)


def test_we_could_see_somebody_from_when_it_came_into_view(told: Any) -> None:
    sees = Related("can-see", US, IT)
    found = when(sees, looks=SEEN)
    assert found.episodes == (Episode(US, "see", 0.0, 0.0, IT),)
    assert (found.form, found.actor, [x.vehicle for x in found.looks]) == ("when", US, [1])
    assert when(sees, looks={1: lambda _: None}) == Verdict(sees, False)
    assert when(Related("can-see", Vehicle(2), IT), looks=SEEN) == Verdict(
        Related("can-see", Vehicle(2), IT), False
    )
    event = Event("stop", IT)
    assert when(Believed(Happens(event)), looks=SEEN) == ("since_when", event)
