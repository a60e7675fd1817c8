"""Whether we see, saw or shall see somebody, and whether somebody sees us or comes."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, look, plan, their
from xavi_dialogue.domain.answers import Located
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Is,
    Vehicle,
)
from xavi_dialogue.explain.answers.sight import sight

LOST = look(1, in_view=False, seen=12.0)


def from_five_on(time: float) -> Any:
    return None if time < 5.0 else look(1, time=time, in_view=time <= 12.0)


def sees(event: Event, span: Span | None = None, **more: Any) -> Any:
    given = Given(**({"looks": {1: from_five_on}} | more))
    return sight.sees(given.asked(span), event)


def test_we_saw_whom_we_had_in_view_by_then() -> None:
    seen = Event("see", object=Vehicle(1))
    decisions = tuple(plan(float(t)) for t in range(0, 20, 5))
    found = sees(seen, traces=decisions)
    assert (found.holds, found.facts) == (True, (look(1, time=NOW, in_view=False),))
    early = sees(seen, Span(3.0, 3.0, said=True), traces=decisions)
    assert (early.holds, early.facts) == (False, ())
    at_once = sees(seen, Span(5.0, 5.0, said=True), traces=decisions)
    assert at_once.holds is True


def test_whether_we_see_somebody_now_is_told_with_where_it_is() -> None:
    event = Event("see", object=Vehicle(1), tense="present")
    here = sees(event, looks={1: look(1)})
    assert (here.holds, here.facts, here.answer) == (True, (look(1),), None)
    lost = sees(event, looks={1: LOST})
    assert (lost.holds, lost.facts) == (False, (LOST,))
    assert lost.answer == Located(Vehicle(1), (LOST,), gap="out-of-view")


def test_seeing_nobody_in_particular_is_not_sensed_but_for_those_there() -> None:
    everybody = Event("see", object=Everyone(), tense="present")
    assert sees(everybody, looks={1: look(1)}).holds is True
    none = sees(everybody, looks={})
    assert (none.holds, none.gap) == (None, "not-sensed")


def test_whether_we_shall_see_somebody_is_answered_by_which_way_it_went(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turn = their(1, "exit-right", 10.0, 11.0)
    monkeypatch.setattr(sight, "came_of", lambda asked, vehicle, since: (turn, since)[0])
    event = Event("see", object=Vehicle(1), tense="future")
    found = sees(event, looks={1: LOST})
    assert (found.holds, found.gap, found.facts) == (None, "in-future", (turn, LOST))
    assert sees(event, looks={}).facts == ()


def test_of_others_it_is_told_what_they_did_for_us() -> None:
    braked = their(1, "brake", 3.0, 4.0)
    yielded = their(1, "give-way", 6.0, 8.0, to=Ego())
    other = their(1, "give-way", 9.0, 10.0, to=2)
    event = Event("see", Vehicle(1), Ego())
    found = sees(event, looks={1: look(1)}, deeds=(braked, yielded, other))
    assert (found.holds, found.gap, found.facts) == (None, "others-thoughts", (yielded, look(1)))
    assert sees(event, looks={}, deeds=(braked, other)).facts == (braked,)
    assert sees(event, looks={}, deeds=(other,)).facts == ()
    assert sees(Event("see", Everyone(), Ego())).gap == "others-thoughts"


def test_how_a_driver_feels_is_told_by_what_he_did_last() -> None:
    stopped = their(1, "stop", 6.0, 8.0)
    asked = Given(looks={1: look(1)}, deeds=(stopped,)).asked()
    found = sight.minded(Is("upset", Vehicle(1)), asked)
    assert (found.holds, found.gap, found.facts) == (None, "others-thoughts", (stopped,))
    nobody = sight.minded(Is("upset", Ego()), asked)
    assert (nobody.gap, nobody.facts) == ("others-thoughts", ())


@pytest.mark.parametrize(("count", "busy"), [(5, False), (6, True), (7, True)])
def test_it_is_busy_from_six_vehicles_on(count: int, busy: bool) -> None:
    found = sight.busy(Is("busy"), Given(looks={v: look(v) for v in range(1, count + 1)}).asked())
    assert (found.holds, len(found.facts)) == (busy, count)


@pytest.mark.parametrize(
    ("to", "how", "comes"),
    [
        (None, {"oncoming": True}, True),
        (Ego(), {"oncoming": True}, True),
        (Ego(), {"bearing": "crossing-left"}, True),
        (Ego(), {}, False),
        (Vehicle(2), {"oncoming": True}, None),
        (Ego(), {"oncoming": True, "in_view": False}, None),
    ],
)
def test_who_comes_towards_us_drives_against_us_or_across(to: Any, how: Any, comes: Any) -> None:
    asked = Given(looks={1: look(1, **how)}).asked()
    found = sight.comes(asked, Event("come", Vehicle(1), to, tense="present"))
    assert (None if found is None else found.holds) is comes


def test_who_came_at_another_time_is_not_told_as_coming() -> None:
    given = Given(looks={1: look(1, oncoming=True)})
    event = Event("come", Vehicle(1), Ego())
    assert sight.comes(given.asked(Span(3.0, 5.0, said=True)), event) is None
    assert sight.comes(given.asked(), Event("come", Everyone(), Ego())) is None
