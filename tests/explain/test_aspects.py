"""What is asked beyond the type: what is seen, what else could be done, the lane we are in."""

import math

import msgspec
import pytest

from planner.events import Event
from sim.scene import VehicleState
from tests.explain.asking import told
from tests.traces import Ride, s1_ride, s2_ride
from xavi_dialogue.explain.explanation import Explanation, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record

S1, S2 = s1_ride(), s2_ride()
SEEN = {"type": "out_of_scope", "reason": "perception", "tense": "present"}


def ask(ride: Ride, now: float | None = None, **query):
    return told(Query(**query), Record(now or ride.now, ride.traces, ride.events))


def with_vehicle(ride: Ride, state: VehicleState, vehicle: int = 1) -> Ride:
    """The ride with a vehicle elsewhere in its last scene."""
    last = ride.traces[-1]
    moved = msgspec.structs.replace(last, scene={**last.scene, vehicle: state})
    return Ride(ride.now, (*ride.traces[:-1], moved), ride.events)


def placed(ahead: float, left: float, turn: float = 0.0, **changes) -> VehicleState:
    """A vehicle of our length, its centre so far ahead and to the left of ours."""
    ego = S1.traces[-1].scene[0]
    (x, y), half = ego.position, ego.length / 2.0
    cos, sin = math.cos(ego.heading), math.sin(ego.heading)
    heading = ego.heading + turn
    cx, cy = x - half * cos + ahead * cos - left * sin, y - half * sin + ahead * sin + left * cos
    front = (cx + half * math.cos(heading), cy + half * math.sin(heading))
    return VehicleState(front, heading, 10.0, 0.0, ego.length, ego.width, **changes)


# What is seen --------------------------------------------------------------------------------


def test_speeds_are_those_of_the_latest_scene():
    scene = S1.traces[-1].scene
    mine = ask(S1, **SEEN, event="speed")
    other = ask(S1, **SEEN, event="speed", actor="vehicle:1")
    assert (mine.sight.vehicle, mine.sight.speed) == (0, scene[0].speed)
    assert (other.sight.vehicle, other.sight.speed) == (1, scene[1].speed)


@pytest.mark.parametrize(
    ("ahead", "left", "place"),
    [
        (30.0, 0.5, "ahead"),
        (-30.0, -0.5, "behind"),
        (30.0, 10.0, "ahead-left"),
        (30.0, -10.0, "ahead-right"),
        (0.5, 3.5, "left"),
        (1.0, -3.5, "right"),
        (2.0, 20.0, "left"),
        (-30.0, 5.0, "behind-left"),
        (-30.0, -5.0, "behind-right"),
    ],
)
def test_where_a_vehicle_is_does_not_hang_on_where_it_heads(ahead, left, place):
    for turn in (0.0, math.pi / 2.0, math.pi):
        ride = with_vehicle(S1, placed(ahead, left, turn))
        seen = ask(ride, **SEEN, event="place", actor="vehicle:1").sight
        assert seen.place == place
        assert seen.oncoming == (turn == math.pi and ahead > 0.0)


def test_on_our_line_the_gap_counts_and_elsewhere_the_centres():
    ego = S1.traces[-1].scene[0]
    ahead = ask(with_vehicle(S1, placed(30.0, 0.0)), **SEEN, event="distance", actor="vehicle:1")
    aside = ask(with_vehicle(S1, placed(30.0, 40.0)), **SEEN, event="distance", actor="vehicle:1")
    assert ahead.sight.distance == pytest.approx(30.0 - ego.length)
    assert aside.sight.distance == pytest.approx(50.0)


def test_who_is_out_of_view_is_where_it_was_seen_last():
    last = S1.traces[-1]
    gone = msgspec.structs.replace(last, scene={k: v for k, v in last.scene.items() if k != 1})
    ride = Ride(S1.now, (*S1.traces[:-1], gone), S1.events)
    found = ask(ride, **SEEN, event="place", actor="vehicle:1")
    assert found.seen == S1.traces[-2].sim_time
    assert found.sight.speed == S1.traces[-2].scene[1].speed
    assert 1 not in ask(ride, **SEEN, event="count").sight.others


def test_a_colour_that_cannot_be_told_is_declined():
    blue = with_vehicle(S1, placed(20.0, 0.0, colour="blue"))
    assert ask(blue, **SEEN, event="colour", actor="vehicle:1").sight.colour == "blue"
    refused = ask(S1, **SEEN, event="colour", actor="vehicle:1")
    assert (refused.reason, refused.facts) == ("out-of-scope", {"what": "perception"})


def test_other_things_that_might_be_seen_are_declined_as_ever():
    refused = ask(S1, **SEEN)
    assert (refused.reason, refused.facts) == ("out-of-scope", {"what": "perception"})
    assert ask(S1, **SEEN, event="speed", actor="vehicle:9").reason == "unknown-vehicle"


# What else -----------------------------------------------------------------------------------


def test_options_are_ranked_by_what_they_are_worth():
    found = ask(S1, type="how_avoid", event="options")
    assert found.choices.chosen == "change-left"
    assert [o.action for o in found.choices.others] == ["continue", "stop", "exit-right"]
    first, second, last = found.choices.others
    assert 0.0 < first.delta < second.delta
    assert (last.outcome, last.delta) == ("dead", None)
    assert found.counterfactual == ("continue",)
    assert ask(S1, type="compare", event="second").counterfactual == ("continue",)
    assert ask(S1, type="compare", event="worst").counterfactual == ("exit-right",)


def test_whether_we_had_to_is_told_from_the_best_alternative():
    why = ask(S1, type="why", factual=("change-left",))
    found = ask(S1, type="compare", event="necessary")
    assert (found.need.kind, found.need.foil) == ("worse", "continue")
    assert (found.effects, found.causes) == (why.effects, why.causes)
    crash = ask(s1_ride(cut_in_collides=True), type="compare", event="necessary")
    assert crash.need.kind in ("worse", "bad")


def test_what_the_question_before_asked_about_need_not_have_happened():
    wanted = {"type": "compare", "event": "necessary", "counterfactual": ("stop",)}
    assert ask(S1, **wanted, refers_to_previous=True).need.foil == "continue"
    stayed = wanted | {"counterfactual": ("continue",)}
    assert ask(S1, **stayed, refers_to_previous=True).need.foil == "continue"
    assert ask(S1, type="what", event="necessary", factual=("exit-right",)).reason == (
        "did-not-happen"
    )


def test_nothing_else_could_be_done():
    trace = S1.traces[-1]
    only = tuple(r for r in trace.rollouts if r.actions[0].action == trace.plan[0].action)
    ride = Ride(S1.now, (msgspec.structs.replace(trace, rollouts=only),), ())
    assert ask(ride, type="compare", event="necessary", tense="present").need.kind == "only"
    assert ask(ride, type="compare", event="options", tense="present").choices.others == ()


# The lane ------------------------------------------------------------------------------------


def test_a_lane_has_the_reason_of_the_change_that_led_there():
    why = ask(S1, type="why", factual=("change-left",))
    found = ask(S1, type="why", tense="present", event="lane")
    assert (found.staying.deed, found.staying.since) == ("change-left", 4.1)
    assert not found.staying.under_way
    assert (found.counterfactual, found.effects) == (why.counterfactual, why.effects)
    assert ask(S1, 5.0, type="why", tense="present", event="lane").staying.under_way


def test_a_lane_kept_from_the_start_is_set_against_another():
    found = ask(S1, 3.0, type="why", tense="present", event="lane")
    if isinstance(found, Explanation):
        assert found.staying.deed is None
        assert found.staying.since is None


def test_after_a_turn_the_lane_is_that_turns():
    found = ask(S2, type="why", tense="present", event="lane")
    ends = [e for e in S2.events if e.kind == "action-ended" and e.action == "exit-right"]
    assert (found.staying.deed, found.staying.since) == ("exit-right", ends[-1].sim_time)


# Why another vehicle did not -----------------------------------------------------------------


def test_what_a_vehicle_did_not_do_is_explained_by_what_it_is_expected_to_do():
    found = ask(S1, type="why_not", actor="vehicle:1", counterfactual=("stop",))
    assert found.contrary.asked == ("stop",)
    assert found.contrary.deed is None
    assert found.activity.actions == ("exit-right",)


def test_what_is_better_for_others_is_not_known_but_what_it_means_to_us_may_be_asked():
    found = ask(S1, type="compare", actor="vehicle:1", counterfactual=("continue",))
    assert isinstance(found, NoExplanation)
    (offered,) = found.suggestions
    assert (offered.type, offered.actor) == ("what_if", "vehicle:1")
    assert offered.counterfactual == ("continue",)


# Would you still -----------------------------------------------------------------------------


def test_what_was_not_done_would_not_still_have_been_done():
    supposed = {"type": "sensitivity", "condition": "if vehicle 1 had not been there"}
    assert ask(S1, **supposed, factual=("exit-left",)).reason == "did-not-happen"
    assert ask(S1, **supposed, factual=("stop",)).reason == "did-not-happen"
    assert ask(S1, **supposed, factual=("give-way",)).reason == "did-not-happen"


def test_events_before_the_moment_count_alone():
    late = Event("gave-way", S1.now + 5.0, vehicle=1)
    ride = Ride(S1.now, S1.traces, (*S1.events, late))
    supposed = {"type": "sensitivity", "condition": "if vehicle 1 had not been there"}
    assert ask(ride, **supposed, factual=("give-way",)).reason == "did-not-happen"


@pytest.mark.parametrize(
    ("ahead", "turn", "oncoming"),
    [(40.0, math.pi, True), (-20.0, math.pi, False), (40.0, 0.0, False)],
)
def test_who_heads_our_way_from_ahead_comes_towards_us(ahead, turn, oncoming):
    ride = with_vehicle(S1, placed(ahead, 3.5, turn))
    found = ask(ride, type="what", actor="vehicle:1", event="oncoming", tense="present")
    assert (found.sight.about, found.sight.oncoming) == ("place", oncoming)
