"""Where somebody or something is or was, and where somebody is going."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from planner.record.places import RoadFacts
from tests.explain.answers.given import (
    NOW,
    Given,
    deed,
    expects,
    look,
    place,
    plan,
    refused,
    step,
    their,
)
from xavi_dialogue.domain.answers import (
    Bound,
    CannotSay,
    Identified,
    Located,
    NotRecorded,
    PlanAhead,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Where, Whither
from xavi_dialogue.domain.terms import (
    At,
    Destination,
    Ego,
    Event,
    Everyone,
    Exit,
    Feature,
    Junction,
    Lane,
    Nobody,
    Road,
    Unknown,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.ride import places

ONE = Vehicle(1)
MEASURES = {
    ("lane", Ego()): 1.0,
    ("turn", Ego()): 60.0,
    ("exit-number", Ego()): 2.0,
    ("distance-to-go", Ego(), Destination()): 300.0,
    ("time-to-go", Ego(), Destination()): 30.0,
}
RING = Junction("roundabout", 1)


def asked(**more: Any) -> Any:
    return Given(**({"measures": MEASURES} | more)).asked()


def values(found: Any) -> list[tuple[str, float | None]]:
    return [(m.attribute, m.value) for m in found]


def where(of: Any, time: Any = None, **more: Any) -> Any:
    question = Where(of) if time is None else Where(of, time)
    return places.where(question, asked(**more))


# --- where --------------------------------------------------------------------------------------


def test_vehicles_are_where_they_are_seen() -> None:
    assert where(ONE, looks={1: look(1)}) == Located(ONE, (look(1),))
    gone = look(1, in_view=False, seen=4.0)
    assert where(ONE, looks={1: gone}) == Located(ONE, (gone,), gap="out-of-view")
    both = Vehicles((1, 2))
    one_there = where(both, looks={1: gone, 2: look(2)})
    assert one_there == Located(both, (gone, look(2)))
    assert where(Everyone(), looks={1: look(1)}) == Located(Everyone(), (look(1),))
    assert where(Everyone(), looks={1: gone}) == Identified((), none=True)


def test_who_came_later_is_told_as_first_seen() -> None:
    def later(time: float) -> Any:
        return look(1, time=time) if time >= 10.0 else None

    found = where(ONE, At(4.0), looks={1: later}, traces=(plan(6.0), plan(12.0)))
    assert found == Located(ONE, (look(1, time=12.0),), gap="out-of-view")


def test_places_of_ours_are_told_by_measures() -> None:
    to_go = [("distance-to-go", 300.0), ("time-to-go", 30.0)]
    assert values(where(Destination()).measures) == to_go
    for thing in (Ego(), Lane("own"), Road("own")):
        found = where(thing)
        assert (found.thing, values(found.measures)) == (Ego(), [("lane", 1.0), *to_go])
    assert values(where(Exit(1)).measures) == [("exit-number", 2.0), ("turn", 60.0)]
    assert where(Nobody(), looks={1: look(1)}) == Located(Nobody(), (look(1),))
    assert refused(where, Unknown("the flux")) == CannotSay("perception", "the flux")
    assert refused(where, Feature("queue")) == NotRecorded(
        "not-recorded", thing=Feature("queue"), about="place"
    )


def test_a_junction_is_as_far_as_was_recorded_less_what_was_driven() -> None:
    facts = RoadFacts({0: place()}, (step(60.0), step(150.0, kind="roundabout", exit=2)))
    given: dict[str, Any] = {"road": facts, "traces": (plan(18.0),)}
    found = where(Junction("junction", 1), **given)
    assert values(found.measures) == [("distance", 60.0), ("turn", 60.0), ("exit-number", 2.0)]
    assert found.gap is None
    assert places.junction(asked(**given), RING, 18.0).value == 150.0
    none = where(Junction("roundabout", 2), **given)
    assert none.gap == "not-applicable"
    assert values(none.measures) == [("turn", 60.0), ("exit-number", 2.0)]


@pytest.mark.parametrize(
    ("form", "rank", "distance"),
    [
        ("junction", None, 60.0),
        ("junction", 1, 60.0),
        ("junction", 2, 150.0),
        ("junction", 3, 230.0),
        ("junction", 4, None),
        ("junction", -1, 230.0),
        ("junction", -2, None),
        ("roundabout", 1, 150.0),
        ("roundabout", None, 150.0),
        ("roundabout", -1, 150.0),
        ("roundabout", 2, None),
    ],
)
def test_junctions_ahead_are_counted_from_here(form: Any, rank: Any, distance: Any) -> None:
    facts = RoadFacts({}, (step(60.0), step(150.0, kind="roundabout"), step(230.0)))
    found = places.junction(asked(road=facts), Junction(form, rank), NOW)
    gap = "not-applicable" if distance is None else None
    assert (found.value, found.gap, found.to) == (distance, gap, Junction(form, rank))


def test_without_a_road_no_junction_is_known() -> None:
    found = places.junction(asked(), RING, NOW)
    assert (found.value, found.gap) == (None, "not-recorded")
    empty = places.junction(asked(road=RoadFacts({})), Junction("junction", -1), NOW)
    assert (empty.value, empty.gap) == (None, "not-applicable")


def test_a_junction_that_was_reached_since_is_no_distance_behind() -> None:
    facts = RoadFacts({}, (step(5.0),))
    given = asked(road=facts, traces=(replace(plan(18.0), history={0: plan(NOW).history[0]}),))
    assert places.junction(given, Junction("junction", 1), NOW).value == 0.0


def test_here_is_told_by_the_next_junction_or_the_exit_of_the_ring() -> None:
    facts = RoadFacts({0: place()}, (step(40.0, kind="roundabout", exit=3),))
    at = places.here(asked(road=facts), NOW)
    assert [(m.attribute, m.value, m.to) for m in at[:2]] == [
        ("lane", 1.0, None),
        ("distance", 40.0, Junction("roundabout", 1, NOW)),
    ]
    inside = RoadFacts({0: place(roundabout=True)}, facts.route)
    assert places.here(asked(road=inside), NOW)[1].to == Exit(3)
    elsewhere = RoadFacts({1: place(roundabout=True)}, facts.route)
    assert places.here(asked(road=elsewhere), NOW)[1].to == Junction("roundabout", 1, NOW)
    assert len(places.here(asked(road=RoadFacts({0: place()})), NOW)) == 3


def test_measures_without_a_value_are_told_where_none_has_one() -> None:
    known = Measure("turn", Ego(), NOW, value=1.0)
    lost = Measure("lane", Ego(), NOW, gap="not-recorded")
    assert places.told((known, lost)) == (known,)
    assert places.told((lost,)) == (lost,)


@pytest.mark.parametrize("action", ["go", "leave", "disappear", "turn", "continue"])
def test_who_has_gone_is_told_by_the_way_that_it_took_last(action: Any) -> None:
    ways = (their(1, "exit-left", 2.0, 4.0), their(1, "change-right", 9.0, 11.0))
    braked = their(1, "brake", 12.0, 13.0)
    lost = look(1, in_view=False, seen=14.0)
    found = where(Event(action, ONE), looks={1: lost}, deeds=(*ways, braked))
    assert found == Bound(ONE, None, ways[1], lost)
    assert where(Event(action, ONE), looks={1: lost}, deeds=(braked,)).went is None


def test_all_who_have_gone_are_those_lost_last_or_behind_us() -> None:
    def lost(vehicle: int, seen: float) -> Any:
        return look(vehicle, in_view=False, seen=seen)

    gone = where(Event("go", Everyone()), looks={v: lost(v, t) for v, t in
                 ((1, 5.0), (2, 9.0), (3, 7.0))} | {4: look(4, ahead=-5.0)})  # fmt: skip
    assert [one.vehicle for one in gone.looks] == [2, 3]
    behind = {v: look(v, ahead=-5.0) for v in (1, 2, 3)} | {4: look(4), 5: look(5, ahead=0.0)}
    passed = where(Event("go", Everyone()), looks=behind)
    assert [one.vehicle for one in passed.looks] == [1, 2]


def test_an_event_took_place_where_its_actor_was_as_it_began() -> None:
    braked = their(1, "brake", 6.0, 8.0)
    shown = {1: lambda t: look(1, time=t)}
    found = where(Event("brake", ONE), looks=shown, deeds=(braked,))
    assert (found.thing, found.looks) == (ONE, (look(1, time=6.0),))
    assert [m.time for m in found.measures] == [6.0] * 3
    turned = deed("exit-left", 5.0, 8.0, place=Junction("roundabout", None, 5.0))
    ours = where(Event("turn", side="left"), deeds=(turned,))
    assert (ours.thing, ours.looks) == (turned.place, ())
    stopped = where(Event("stop"), deeds=(deed("stop", 4.0, 6.0),))
    assert stopped.thing == Ego()


# --- whither ------------------------------------------------------------------------------------

BELIEF = expects(1, (("exit-right",), 0.6), (("continue",), 0.4))
UNSURE = expects(1, (("exit-right",), 0.4), (("continue",), 0.3))


def whither(time: Any = None, went: Any = None, **more: Any) -> Any:
    given = {"looks": {1: look(1)}, "beliefs": {1: BELIEF}} | more
    question = Whither(ONE) if time is None else Whither(ONE, time)
    return places.whither(question, asked(**given))


@pytest.fixture
def outcomes(monkeypatch: pytest.MonkeyPatch) -> None:
    turn = their(1, "exit-right", 18.0)
    monkeypatch.setattr(places, "came_of", lambda asked, vehicle, at: turn if at < 15 else None)
    monkeypatch.setattr(places, "announced", lambda *args: ("announced", *args[2:]))


@pytest.mark.usefixtures("outcomes")
def test_where_another_goes_is_what_is_believed_and_what_came_of_it() -> None:
    assert whither() == Bound(ONE, BELIEF)
    turn = their(1, "exit-right", 18.0)
    assert whither(At(10.0)) == Bound(ONE, BELIEF, turn, look(1))
    assert whither(At(18.4)) == Bound(ONE, BELIEF, None, look(1))
    assert whither(At(18.5)) == Bound(ONE, BELIEF)
    lost = look(1, in_view=False, seen=14.0)
    changed = their(1, "change-left", 11.0, 13.0)
    gone = whither(looks={1: lost}, deeds=(changed,))
    assert gone == Bound(ONE, BELIEF, changed, lost)
    assert whither(At(10.0), looks={1: lost}, deeds=(changed,)).went == turn
    assert whither(At(17.0), deeds=(changed,)).went is None


@pytest.mark.usefixtures("outcomes")
def test_where_nothing_is_likely_the_indicator_announces_it() -> None:
    lit = their(1, "signal", 15.0, side="right")
    assert whither(deeds=(lit,), beliefs={1: UNSURE}) == ("announced", 1, lit, NOW)
    assert whither(deeds=(lit,), beliefs={}) == ("announced", 1, lit, NOW)
    assert whither(deeds=(lit,)).belief == BELIEF
    assert whither(beliefs={1: UNSURE}).belief == UNSURE
    over = their(1, "signal", 12.0, 15.0, side="right")
    assert whither(deeds=(over,), beliefs={1: UNSURE}).belief == UNSURE
    both = whither(deeds=(their(1, "signal", 12.0), lit), beliefs={1: UNSURE})
    assert both[2] == lit
    even = expects(1, (("exit-right",), 0.5), (("continue",), 0.5))
    assert whither(deeds=(lit,), beliefs={1: even}).belief == even
    past = whither(At(10.0), deeds=(lit,), beliefs={1: UNSURE})
    assert past.belief == UNSURE
    lost = whither(looks={1: look(1, in_view=False)}, deeds=(lit,), beliefs={1: UNSURE})
    assert lost.belief == UNSURE


def test_our_own_way_is_told_by_what_we_come_to() -> None:
    facts = RoadFacts({}, (step(60.0), step(150.0, kind="roundabout")))
    known = places.whither(Whither(), asked(road=facts))
    assert isinstance(known, Bound)
    assert values(known.measures) == [
        ("turn", 60.0),
        ("exit-number", 2.0),
        ("distance-to-go", 300.0),
        ("time-to-go", 30.0),
        ("distance", 150.0),
    ]
    assert known.measures[-1].to == RING
    no_ring = places.our_way(asked(road=RoadFacts({}, (step(60.0),))), NOW)
    assert "exit-number" not in [m.attribute for m in no_ring.measures]  # type: ignore[union-attr]
    assert len(no_ring.measures) == 3  # type: ignore[union-attr]
    early = places.our_way(asked(road=facts), 18.4)
    assert values(early.measures) == [("distance-to-go", 300.0)]  # type: ignore[union-attr]
    assert len(places.our_way(asked(road=facts), 18.5).measures) == 5  # type: ignore[union-attr]
    nobody = places.whither(Whither(Nobody()), asked(road=facts))
    assert isinstance(nobody, Bound)
    assert nobody.actor == Ego()


def test_who_is_there_goes_nowhere() -> None:
    there = asked(events=(Recorded("arrived", 19.0),))
    assert places.our_way(there, NOW) == PlanAhead((), arrived=True)
    assert places.our_way(there, 18.5) == PlanAhead((), arrived=True)
    assert isinstance(places.our_way(there, 18.4), Bound)


def test_what_comes_next_was_here_at_an_earlier_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(places, "plan_ahead", lambda asked: PlanAhead((("stop", 25.0),)))
    assert places.next_turn(asked(), 18.5) == PlanAhead((("stop", 25.0),))
    early = places.next_turn(asked(), 18.4)
    assert values(early.measures) == [
        ("lane", 1.0), ("distance-to-go", 300.0), ("time-to-go", 30.0),
    ]  # fmt: skip
