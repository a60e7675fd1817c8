"""Who has right of way, who went first, and what a question of fault turns on."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import LightAhead, PriorityFact, RoadFacts
from tests.explain.answers.given import NOW, Given, deed, look, place, plan, refused, step, their
from xavi_dialogue.domain.answers import NoSuchVehicle, NotRecorded, Priority
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Vehicle, Wanted
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride import priority

ONE = Vehicle(1)
PRESENT, EARLIER = Window(NOW, NOW), Window(8.0, 12.0, True)


def road(*who: Any, rule: Any = "give-way", kind: Any = "junction", inside: bool = False) -> Any:
    """A road on which vehicles 1, 2, ... stand to us as given."""
    facts = tuple(PriorityFact(v, one) for v, one in enumerate(who, 1))
    own = place(in_junction=inside)
    return RoadFacts({0: own}, (step(rule=rule, kind=kind),), priority=facts)


def decided(*moments: tuple[float, Any]) -> tuple[Any, ...]:
    return tuple(plan(time, road=known) for time, known in moments)


def right(vehicle: int | None, about: Window = PRESENT, **more: Any) -> Any:
    blame = more.pop("blame", False)
    given = {"looks": {1: look(1), 2: look(2, distance=40.0)}} | more
    return priority.priority_at(Given(**given).asked(), vehicle, about, blame=blame)


# --- the rule -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("facts", "vehicle", "gave_way", "rule"),
    [
        (None, 1, True, "give-way"),
        (None, 1, False, None),
        (road("ego"), 1, True, "priority"),
        (road("vehicle"), 1, False, "give-way"),
        (road("depends"), 1, False, "depends"),
        (road("ego", "vehicle"), 2, False, "give-way"),
        (road("ego"), 2, True, "give-way"),
        (road("ego"), 2, False, "none"),
        (road("ego", rule="equal"), None, False, "equal"),
        (RoadFacts({}), None, True, "none"),
    ],
)
def test_the_rule_is_between_us_and_a_vehicle_or_at_the_next_junction(
    facts: Any, vehicle: Any, gave_way: bool, rule: Any
) -> None:
    assert priority.rule_for(facts, vehicle, gave_way) == rule


def between(*moments: tuple[float, str], about: Window = EARLIER) -> Any:
    traces = decided(*((time, road(who)) for time, who in moments))
    return priority.rule_between(Given(traces=traces).asked(), 1, about)


def test_a_rule_counts_at_the_decision_closest_to_the_end_of_a_stretch() -> None:
    assert between((9.0, "ego"), (11.0, "vehicle"), (15.0, "ego")) == (11.0, "give-way")
    assert between((8.0, "ego")) == (8.0, "priority")
    assert between((12.0, "ego")) == (12.0, "priority")
    assert between((7.0, "ego"), (13.0, "ego")) is None
    assert between() is None
    assert between((9.0, "ego"), (11.0, "depends")) == (9.0, "priority")
    assert between((9.0, "depends"), (11.0, "depends")) == (11.0, "depends")
    moment = Window(10.0, 10.0)
    assert between((4.0, "ego"), about=moment) == (4.0, "priority")
    assert between((3.9, "ego"), (16.1, "ego"), about=moment) is None
    assert between((9.0, "ego"), (11.0, "vehicle"), about=moment) == (11.0, "give-way")


def test_a_rule_with_another_vehicle_or_of_no_road_does_not_count() -> None:
    traces = (plan(9.0), *decided((10.0, road("ego", "vehicle"))))
    asked = Given(traces=traces).asked()
    assert priority.rule_between(asked, 2, EARLIER) == (10.0, "give-way")
    assert priority.rule_between(asked, 3, EARLIER) is None


# --- who changes lanes --------------------------------------------------------------------------


def changing(about: Window = EARLIER, **more: Any) -> Any:
    return priority._changing(Given(**more).asked(), 1, about)


def test_who_changes_lanes_has_to_leave_the_other_one_room() -> None:
    for action in ("change-left", "change-right"):
        assert changing(deeds=(deed(action, 9.0, 11.0),)) == "we-change"
        assert changing(deeds=(their(1, action, 9.0, 11.0),)) == "it-changes"
    assert changing(deeds=(deed("change-left", 1.0, 2.0),)) == "we-change"  # 6 s before
    assert changing(deeds=(deed("change-left", 1.0, 1.9),)) is None
    assert changing(deeds=(deed("change-left", 18.1, 19.0),)) is None
    assert changing(deeds=(their(2, "change-left", 9.0, 11.0),)) is None
    assert changing(traces=(plan(5.0, "change-left"),)) == "we-change"
    assert changing(traces=(plan(5.0, "continue", "change-left"),)) is None
    assert changing() is None


@pytest.mark.parametrize(
    ("side", "left", "edge", "changes"),
    [
        ("right", 3.5, "main", True),
        ("left", -3.5, "main", True),
        ("left", 3.5, "main", False),
        ("right", -3.5, "main", False),
        ("right", 1.4, "main", False),
        ("right", 1.6, "main", True),
        ("right", 3.5, "other", False),
        (None, 3.5, "main", False),
    ],
)
def test_who_indicates_towards_our_lane_is_about_to_change(
    side: Any, left: float, edge: str, changes: bool
) -> None:
    lit = their(1, "signal", 11.0, 13.0, side=side)
    facts = RoadFacts({0: place(lane=0), 1: place(edge, lane=1)})
    given: dict[str, Any] = {
        "deeds": (lit,) if side else (),
        "road": facts,
        "looks": {1: look(1, left=left)},
    }
    assert changing(**given) == ("it-changes" if changes else None)


def test_an_indicator_of_another_time_or_of_nowhere_is_no_sign() -> None:
    facts = RoadFacts({0: place(lane=0), 1: place(lane=1)})
    beside = {1: look(1, left=3.5)}
    for begin, end, rule in ((13.0, 14.0, None), (5.0, 11.0, None), (12.0, None, "it-changes")):
        lit = their(1, "signal", begin, end, side="right")
        assert changing(deeds=(lit,), road=facts, looks=beside) == rule
    lit = their(1, "signal", 11.0, side="right")
    assert changing(deeds=(lit,), road=None, looks=beside) is None
    assert changing(deeds=(lit,), road=RoadFacts({0: place()}), looks=beside) is None
    assert changing(deeds=(lit,), road=RoadFacts({1: place()}), looks=beside) is None
    assert changing(deeds=(lit,), road=facts) is None


# --- who went first -----------------------------------------------------------------------------


def test_who_is_asked_about_now_is_whose_way_crosses_ours_next() -> None:
    facts = road("vehicle", "vehicle")
    found = right(None, road=facts, traces=decided((NOW, facts)))
    assert (found.time, found.rule, found.vehicle) == (NOW, "give-way", 1)
    assert (found.blame, found.conflict, found.deeds, found.stood) == (False, None, (), False)
    named = right(2, road=facts, traces=decided((NOW, facts)))
    assert (named.vehicle, named.ring) == (2, False)
    early = right(None, EARLIER, road=facts, traces=decided((10.0, road("depends", "ego"))))
    assert (early.vehicle, early.rule, early.time) == (2, "priority", 10.0)


def test_an_unknown_vehicle_is_refused() -> None:
    found = refused(right, 7)
    assert isinstance(found, NoSuchVehicle)
    assert (found.thing, found.time) == (Vehicle(7), NOW)


def test_what_no_record_holds_is_refused_unless_it_is_asked_for_blame() -> None:
    assert refused(right, 1) == NotRecorded("not-recorded", about="right-of-way", since=NOW)
    blamed = right(1, blame=True)
    assert (blamed.rule, blamed.blame, blamed.first) == ("none", True, None)


@pytest.mark.parametrize("kind", ["junction", "roundabout"])
def test_a_ring_is_told_of_where_nobody_is_named(kind: Any) -> None:
    facts = road("ego", kind=kind)
    assert right(None, road=facts).ring is (kind == "roundabout")
    assert right(1, road=facts).ring is False
    on = RoadFacts({0: place(roundabout=True)})
    assert right(None, road=on).ring is True
    assert right(None, road=RoadFacts({0: place()})).ring is False
    assert right(None, road=RoadFacts({1: place()})).ring is False


def test_whom_we_gave_way_to_is_told_with_who_went_first() -> None:
    facts = road("vehicle")
    waited = deed("give-way", 9.0, 13.0, to=1, standing=True)
    given = {"road": facts, "traces": decided((10.0, facts)), "deeds": (waited,)}
    found = right(1, EARLIER, **given)
    assert (found.waited, found.first, found.rule) == (waited, ONE, "give-way")
    assert right(None, EARLIER, **given).vehicle == 1
    assert right(2, EARLIER, **given).waited is None
    rolled = replace(waited, standing=False)
    assert right(1, EARLIER, **given | {"deeds": (rolled,)}).first is None


@pytest.mark.parametrize(
    ("begin", "end", "how", "to", "told"),
    [
        (9.0, 13.0, None, 1, True),
        (9.0, 13.0, "right-of-way", 1, True),
        (9.0, 13.0, "leader", 1, False),
        (1.0, 3.9, None, 1, False),  # more than 6 s before
        (18.1, 19.0, None, 1, False),
        (9.0, 13.0, None, None, False),
    ],
)
def test_only_giving_way_near_the_crossing_counts(
    begin: float, end: float, how: Any, to: Any, told: bool
) -> None:
    facts = road("vehicle")
    waited = deed("give-way", begin, end, to=to, how=how)
    traces = decided((10.0, facts))
    found = right(1, EARLIER, road=facts, traces=traces, deeds=(waited,))
    assert found.waited == (waited if told else None)


def test_a_wait_that_is_over_is_not_told_of_now() -> None:
    facts = road("vehicle")
    over, on = deed("give-way", 15.0, 17.0, to=1), deed("give-way", 15.0, to=1)
    traces = decided((NOW, facts))
    assert right(None, road=facts, traces=traces, deeds=(over,)).waited is None
    assert right(None, road=facts, traces=traces, deeds=(on,)).waited == on
    assert right(1, road=facts, traces=traces, deeds=(over,)).waited == over
    past = Window(16.0, 16.0)
    assert right(None, past, road=facts, traces=traces, deeds=(over,)).waited == over
    alone = right(None, Window(13.0, 17.0), road=RoadFacts({}), deeds=(over,))
    assert (alone.vehicle, alone.rule) == (1, "give-way")


def test_of_two_who_change_lanes_nobody_goes_first_at_a_junction() -> None:
    move = deed("change-left", 9.0, 11.0)
    found = right(1, EARLIER, road=RoadFacts({}), deeds=(move,))
    assert (found.rule, found.first) == ("we-change", None)
    general = right(None, EARLIER, road=RoadFacts({}), deeds=(move,))
    assert general.rule == "none"


SLOW, FAST = 0.4, 0.6


@pytest.mark.parametrize(
    ("theirs", "ours", "stood"),
    [
        (SLOW, 2.0, True),
        (FAST, 2.0, False),
        (SLOW, 0.9, False),
        (None, 2.0, False),
        (SLOW, None, False),
    ],
)
def test_who_stands_now_that_we_go_lets_us_by(theirs: Any, ours: Any, stood: bool) -> None:
    speeds = {("speed", ONE): theirs, ("speed", Ego()): ours}
    assert right(1, road=road("ego"), measures=speeds).stood is stood
    assert right(1, EARLIER, road=road("ego"), measures=speeds).stood is False


def test_rules_answer_claims_of_who_has_to_yield() -> None:
    cases = {"priority": False, "give-way": True, "we-change": True, "it-changes": False}
    for rule, ours in cases.items():
        found = Priority(NOW, rule, 1)  # type: ignore[arg-type]
        assert priority.owed(found, ours_yield=True).holds is ours
        told = priority.owed(found, ours_yield=False)
        assert (told.holds, told.answer) == (not ours, replace(found, holds=not ours))
    none = priority.owed(Priority(NOW, "none", 1), ours_yield=True)
    assert (none.holds, none.answer) == (None, Priority(NOW, "none", 1, holds=False))
    equal = priority.owed(Priority(NOW, "equal", 1), ours_yield=True)
    assert (equal.holds, equal.answer) == (None, Priority(NOW, "equal", 1))


def test_of_two_the_vehicle_among_them_is_asked_about() -> None:
    facts = road("vehicle", "ego")
    asked = Given(looks={1: look(1), 2: look(2)}, road=facts).asked()
    for thing, to, vehicle in ((ONE, Ego(), 1), (Ego(), ONE, 1), (Vehicle(2), ONE, 2)):
        assert priority.right_of_way(asked, thing, to, PRESENT).vehicle == vehicle


def test_going_first_is_asked_of_the_time_of_the_event() -> None:
    facts = road("vehicle")
    given = Given(looks={1: look(1)}, road=facts, traces=decided((10.0, facts)))
    now = Event("go", ONE, manner=("first",), tense="present")
    assert priority.goes_first(Why(Happens(now)), given.asked()).time == NOW  # type: ignore[union-attr]
    past = given.asked(Span(8.0, 12.0, said=True))
    for tense in ("past", "perfect"):
        why = Why(Happens(replace(now, tense=tense)))
        assert priority.goes_first(why, past).time == 10.0  # type: ignore[union-attr]
    anybody = Why(Happens(replace(now, actor=Wanted())))
    assert priority.goes_first(anybody, given.asked()).vehicle == 1  # type: ignore[union-attr]


def test_who_is_on_a_ring_goes_first_though_somebody_is_ahead_of_him_there() -> None:
    facts = (PriorityFact(1, "vehicle"),)
    ring = RoadFacts({0: place(roundabout=True)}, (step(rule="priority", kind="roundabout"),),
                     priority=facts)  # fmt: skip
    told = right(None, traces=decided((NOW, ring)), road=ring)
    assert (told.rule, told.vehicle, told.ring) == ("priority", None, True)


@pytest.mark.parametrize(
    ("state", "distance", "holds"), [("r", 60.0, True), ("G", 60.0, False), ("r", 90.0, False)]
)
def test_a_red_light_at_the_next_junction_holds_us(
    state: str, distance: float, holds: bool
) -> None:
    light = LightAhead(distance, "lights", 0, state, 0.0, False)
    here = RoadFacts({0: place()}, (step(),), lights=(light,))
    assert right(None, traces=decided((NOW, here)), road=here).light is holds


@pytest.mark.parametrize(
    ("state", "distance", "rule", "green"),
    [
        ("G", 60.0, "priority", True),
        ("g", 60.0, "give-way", False),  # others may go first
        ("O", 60.0, "give-way", False),
        ("G", 90.0, "give-way", False),  # that of the junction after it
    ],
)
def test_at_a_light_by_which_others_stop_we_go_first(
    state: str, distance: float, rule: str, green: bool
) -> None:
    light = LightAhead(distance, "lights", 0, state, 0.0, False)
    here = RoadFacts({0: place()}, (step(rule="give-way"),), lights=(light,))
    told = right(None, traces=decided((NOW, here)), road=here)
    assert (told.rule, told.green) == (rule, green)
