"""What is listed of a ride: vehicles, beliefs, decisions, stops and events."""

from typing import Any

from tests.explain.answers.events.test_accounts import ONE, TWO
from tests.explain.answers.events.test_summaries import actions
from tests.explain.answers.stated import US, belief, decision, did, look, result, scene, they
from xavi_dialogue.domain.answers import (
    Beliefs,
    Decided,
    Happenings,
    Helpful,
    Identified,
    Located,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Listing
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Everyone,
    Junction,
    Vehicles,
)
from xavi_dialogue.explain.answers.events.accounts import (
    listing,
)

# --- lists --------------------------------------------------------------------------------------


def listed(of: Any, span: Any = None, *, more: Any = None, **facts: Any) -> Any:
    return result(listing, Listing(of, **(more or {})), scene(span, **facts))


def seen_until(time: float, vehicle: int = 3, **more: Any) -> Any:
    return lambda t: look(vehicle, in_view=t <= time, **more)


def test_vehicles_are_listed_from_the_nearest_on() -> None:
    found = listed("vehicles", looks={1: look(1, 30.0), 2: look(2, 10.0), 3: seen_until(4.0)})
    assert [one.vehicle for one in found.looks] == [2, 1]
    assert not found.none
    assert listed("vehicles", looks={3: seen_until(4.0)}) == Identified((), none=True)


def test_vehicles_of_a_stretch_are_all_that_were_seen_in_it() -> None:
    def late(t: float) -> Any:
        return look(3, 5.0, in_view=True) if t >= 12.0 else None

    facts = {
        "looks": {1: seen_until(4.0, 1, ahead=30.0), 2: look(2, 10.0), 3: late},
        "traces": [decision(float(t)) for t in (3, 8, 14)],
    }
    found = listed("vehicles", Span(3.0, 10.0, said=True), **facts)
    assert [one.vehicle for one in found.looks] == [2, 1]
    found = listed("vehicles", Span(8.0, 14.0, said=True), **facts)
    assert [one.vehicle for one in found.looks] == [3, 2]
    found = listed("vehicles", Span(3.0, 4.5, said=True), **facts)  # a moment: 3.75 s
    assert [one.vehicle for one in found.looks] == [2, 1]
    found = listed("vehicles", Span(4.0, 5.5, said=True), **facts)
    assert [one.vehicle for one in found.looks] == [2]


def test_beliefs_are_those_of_everybody_in_view() -> None:
    facts: dict[str, Any] = {
        "looks": {1: look(1), 2: look(2), 3: seen_until(4.0)},
        "beliefs": (belief(1, 3.0, ("exit-left", 0.9)), belief(1, 9.0, ("continue", 0.8))),
    }
    found = listed("beliefs", **facts)
    assert ([one.vehicle for one in found.looks], found.facts) == ([1, 2], facts["beliefs"][1:])
    found = listed("beliefs", Span(3.5, 4.0, said=True), **facts)
    assert [one.vehicle for one in found.looks] == [1, 2, 3]
    assert found.facts == facts["beliefs"][:1]
    assert listed("beliefs").none


def test_beliefs_of_one_vehicle_are_told_as_they_moved() -> None:
    known = (belief(1, 3.0, ("exit-left", 0.9)), belief(1, 9.0, ("continue", 0.8)))
    found = listed("beliefs", more={"about": ONE}, looks={1: look(1)}, beliefs=known)
    assert isinstance(found, Beliefs)
    assert (found.vehicle, found.time, found.history) == (1, 9.0, known)
    found = listed("beliefs", more={"about": ONE, "time": At(1.0)}, looks={1: look(1)},
                   beliefs=known)  # fmt: skip
    assert found.time == 3.0  # nothing was believed before


def test_what_was_expected_wrongly_is_listed_with_what_came() -> None:
    facts: dict[str, Any] = {
        "looks": {1: look(1), 2: look(2)},
        "beliefs": (belief(1, 3.0, ("exit-right", 0.9)), belief(2, 3.0, ("exit-left", 0.9))),
        "episodes": (they(1, "exit-left", 6.0, 8.0), they(2, "exit-left", 7.0, 9.0)),
    }
    found = listed("wrong-predictions", **facts)
    assert isinstance(found, Verdict)
    assert (found.holds, found.mistaken, found.that.thing) == (True, True, Ego())  # type: ignore[union-attr]
    assert (found.facts, found.believed) == (facts["episodes"][:1], facts["beliefs"][:1])
    found = listed("wrong-predictions", more={"about": TWO}, **facts)
    assert (found.holds, found.mistaken, found.that.thing) == (False, False, TWO)


def test_what_can_be_asked_is_help() -> None:
    assert listed("capabilities") == Helpful()


def test_decisions_of_a_moment_are_the_one_then() -> None:
    traces = [decision(3.0, ("continue",)), decision(15.0, ("change-left", "continue"))]
    found = listed("decisions", Span(15.0, 16.0, said=True), traces=traces)
    assert isinstance(found, Decided)
    assert (found.time, found.steps) == (15.0, ("change-left",))
    found = listed("decisions", Span(2.0, 4.0, said=True), traces=traces)
    assert isinstance(found, Happenings)


def test_decisions_of_a_ride_are_the_manoeuvres() -> None:
    told = tuple(
        did(name, 2.0 * k, 2.0 * k + 1.0)
        for k, name in enumerate(
            ("change-left", "change-right", "exit-left", "exit-right", "exit-straight",
             "continue-next-exit", "stop", "brake", "give-way")
        )
    )  # fmt: skip
    found = listed("decisions", episodes=(*told, they(1, "exit-left", 3.0, 4.0)))
    assert found.episodes == told[:7]
    assert (found.form, found.since, found.until) == ("list", 0.0, 20.0)


def test_stops_are_ours_unless_somebody_is_named() -> None:
    told = (did("stop", 4.0, 8.0), they(1, "stop", 5.0, 9.0), did("stop", 15.0, 16.0))
    found = listed("stops", episodes=told, looks={1: look(1)})
    assert (found.episodes, found.actor, found.asked) == (
        (told[0], told[2]), US, Event("stop"),
    )  # fmt: skip
    found = listed("stops", more={"about": ONE}, episodes=told, looks={1: look(1)})
    assert (found.episodes, found.actor) == ((told[1],), ONE)
    found = listed("stops", Span(9.0, 19.0, said=True), episodes=told)
    assert (found.episodes, found.since, found.until) == ((told[2],), 9.0, 19.0)


def test_where_we_did_not_brake_it_is_listed_when_we_slowed_down() -> None:
    slowed = did("slow-down", 4.0, 8.0)
    asked = {"event": Event("brake")}
    found = listed("events", more=asked, episodes=(slowed,))
    assert (found.episodes, found.asked) == ((slowed,), Event("slow-down"))
    braked = did("brake", 5.0, 6.0)
    assert listed("events", more=asked, episodes=(slowed, braked)).episodes == (braked,)
    found = listed("events", more={"event": Event("stop")}, episodes=(slowed,))
    assert (found.episodes, found.asked) == ((), Event("stop"))


EVENTS = (
    they(1, "cut-in", 3.0, 4.0, object=US),
    did("stop", 2.0, 8.0),
    they(1, "brake", 9.0, 10.0),
    did("give-way", 11.0, 12.0, object=TWO),
)


def test_events_are_told_in_order_and_cut_to_the_stretch() -> None:
    facts: dict[str, Any] = {"episodes": EVENTS, "looks": {1: look(1), 2: look(2)}}
    assert actions(listed("events", **facts)) == ["stop", "cut-in", "give-way"]
    assert listed("events", **facts).actor is None
    span = Span(8.5, 19.0, said=True)
    assert actions(listed("events", span, **facts)) == ["give-way"]
    mine = listed("events", more={"about": US}, **facts)
    assert (actions(mine), mine.actor) == (["stop", "give-way"], US)
    for all_of in (Everyone(), Vehicles((1, 2))):
        every = listed("events", more={"about": all_of}, **facts)
        assert (actions(every), every.actor) == (["stop", "cut-in", "give-way"], None)
    theirs = listed("events", more={"about": ONE}, **facts)
    assert (actions(theirs), theirs.actor) == (["cut-in", "brake"], ONE)
    place = listed("events", more={"about": Junction()}, **facts)
    assert place.actor is None


def test_a_list_has_forty_events_at_most() -> None:
    many = tuple(did("change-left", 0.4 * k, 0.4 * k + 0.1) for k in range(45))
    assert listed("events", episodes=many).episodes == many[:40]
    theirs = tuple(they(1, "brake", 0.4 * k, 0.4 * k + 0.1) for k in range(45))
    found = listed("events", more={"about": ONE}, episodes=theirs, looks={1: look(1)})
    assert found.episodes == theirs[:40]


def test_nothing_is_located_by_a_list() -> None:
    assert not isinstance(listed("events"), Located)


def test_those_of_a_kind_are_listed() -> None:
    seen = {1: look(1), 2: look(2, kind="bicycle"), 3: look(3, kind="bus")}
    for kind, numbers in (("bicycle", [2]), ("car", [1, 3]), ("vehicle", [1, 2, 3])):
        found = listed("vehicles", more={"about": Everyone(kind)}, looks=seen)  # type: ignore[arg-type]
        assert sorted(one.vehicle for one in found.looks) == numbers
    found = listed("vehicles", more={"about": Vehicles((1, 2))}, looks=seen)
    assert sorted(one.vehicle for one in found.looks) == [1, 2]
