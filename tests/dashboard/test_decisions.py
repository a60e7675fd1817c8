"""Decisions as browsers get them: in step with what explanations say of them."""

import gzip
import math
import random
from functools import cache
from itertools import pairwise
from pathlib import Path

import msgspec
import pytest
from msgspec.structs import replace

from planner.record.fitting import fitted
from planner.record.trace import ROOM, PlanTrace, TimedAction, encode
from sim.roads.netfile import read_network
from sim.roads.network import Network
from tests.dialogue.talking import ride
from tests.traces import ragged_trace, random_world, s1_ride, s1_world, trace_of
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.dashboard.views.decision import in_short, whole
from xavi_dialogue.dashboard.views.search_tree import branches
from xavi_dialogue.dashboard.web.http_documents import Branch, DecisionShown

SCENARIOS = Path(__file__).parents[2] / "sim" / "scenarios"
RIDES = ("s1-0", "s2-0", "s3-0", "s4-0", "town-0", "motorway-0", "bend-0")
NETS = ("s1-0", "s2-0", "s3-0", "s4-0", "town-0", "motorway-0")


@cache
def network(name: str) -> Network:
    scenario = name.partition("-")[0]
    return read_network(SCENARIOS / scenario / f"{scenario}.net.xml")


def every(branch: Branch) -> list[Branch]:
    return [branch, *(one for child in branch.children for one in every(child))]


def without_lines(trace: PlanTrace) -> PlanTrace:
    """The trace as it is left where there is no room for any line."""
    known = tuple(
        replace(
            one,
            goals=tuple(
                replace(
                    goal,
                    trajectories=tuple(
                        replace(way, path=(), speed=()) for way in goal.trajectories
                    ),
                )
                for goal in one.goals
            ),
        )
        for one in trace.predictions
    )
    bare = tuple(replace(r, path=None, speed=None, same_as=None) for r in trace.rollouts)
    return replace(trace, predictions=known, rollouts=bare)


@pytest.mark.parametrize("name", RIDES)
def test_every_decision_of_a_ride_can_be_told(name: str) -> None:
    roads = network(name) if name in NETS else None
    for trace in ride(name).traces:
        shown = whole(trace, roads)
        assert msgspec.json.decode(msgspec.json.encode(shown), type=DecisionShown) == shown
        assert shown.id == trace.trace_id
        assert shown.ego is not None
        assert len(shown.ego.path) == 2 * len(shown.ego.speed) > 2
        here = trace.scene[0].position
        assert math.dist(here, shown.ego.path[:2]) < 1.0
        assert (shown.goal is not None) == (roads is not None)
        assert shown.alternatives[0].chosen
        assert [one.chosen for one in shown.alternatives].count(True) == 1
        values = [a.value for a in shown.alternatives[1:] if a.value is not None]
        assert values == sorted(values, reverse=True)
        for one in shown.alternatives:
            assert bool(one.outcomes) == (one.rollouts > 0)
            assert not one.outcomes or sum(one.outcomes.values()) == pytest.approx(1.0, abs=1e-3)
            assert one.reason is None or not one.outcomes
        tried = {a.action for a in shown.alternatives if a.outcomes}
        assert tried == {rollout.actions[0].action for rollout in trace.rollouts}


@pytest.mark.parametrize("name", ["s1-0", "s2-0"])
def test_alternatives_are_those_under_intervention(name: str) -> None:
    for trace in ride(name).traces:
        model = CausalModel(trace)
        shown = whole(trace, None)
        here = model.intervene(tuple(p.action for p in trace.plan))
        assert here is not None
        for one in shown.alternatives[1:]:
            there = model.intervene((one.action,))
            if there is None:
                assert one.outcomes == {}
                continue
            told = {o: p for o, p in there.outcomes.items() if p > 0.0}
            assert one.outcomes == pytest.approx(told, abs=1e-4)
            assert (one.rollouts, one.distinct) == (there.draws, len(there.results))
            time = [e for e in effects(there, here) if e.component == "time"]
            assert (one.time is not None) == bool(time)
            if one.time is not None:
                assert one.time.delta == pytest.approx(time[0].delta, abs=1e-3)
                assert one.time.low <= one.time.delta <= one.time.high


def test_what_could_not_be_done_is_told_with_its_reason() -> None:
    shown = whole(trace_of(s1_world()), None)
    reasons = {a.action: a.reason for a in shown.alternatives if a.reason is not None}
    assert reasons["change-right"] == "there is no lane to the right"
    assert dict(shown.refused) == reasons


def test_a_lane_change_makes_going_on_a_matter_of_lanes() -> None:
    shown = whole(trace_of(s1_world()), None)
    assert {a.action: a.words for a in shown.alternatives}["continue"] == "stay in my lane"
    assert shown.words == "Move to the left lane"


def test_a_decision_with_no_room_for_lines_is_told_without_them() -> None:
    trace = without_lines(ride("s2-0").traces[3])
    shown = whole(trace, network("s2-0"))
    assert shown.ego is None
    assert all(one.line is None for one in shown.alternatives)
    assert all(w.line is None for p in shown.predictions for g in p.goals for w in g.ways)
    assert [a.outcomes for a in shown.alternatives if a.outcomes]
    assert shown.right_of_way is not None  # from where it is and what it plans


def test_a_line_that_is_recorded_under_another_rollout_is_found() -> None:
    trace = ride("s1-0").traces[3]
    assert any(rollout.same_as is not None for rollout in trace.rollouts)
    shown = whole(trace, None)
    own = {rollout.path for rollout in trace.rollouts if rollout.path}
    rounded = {tuple(round(v, 2) for point in path for v in point) for path in own}
    assert shown.ego is not None
    assert shown.ego.path in rounded


def test_goals_come_likeliest_first_and_sum_to_one() -> None:
    for trace in ride("s3-0").traces:
        shown = whole(trace, None)
        for known in shown.predictions:
            chances = [goal.probability for goal in known.goals]
            assert chances == sorted(chances, reverse=True)
            assert sum(chances) == pytest.approx(1.0, abs=1e-2)
        for belief in in_short(trace, None).beliefs:
            assert sum(share for _, share in belief.goals) == pytest.approx(1.0, abs=1e-2)
            assert len({said for said, _ in belief.goals}) == len(belief.goals)


@pytest.mark.parametrize("seed", range(20))
def test_ragged_records_are_told_as_far_as_they_go(seed: int) -> None:
    trace = ragged_trace(seed)
    shown, short = whole(trace, None), in_short(trace, None)
    assert msgspec.json.decode(msgspec.json.encode(shown), type=DecisionShown) == shown
    assert msgspec.json.decode(msgspec.json.encode(short), type=type(short)) == short
    assert shown.words == short.words


def test_a_plan_that_is_empty_means_to_stop() -> None:
    trace = replace(trace_of(s1_world()), plan=(), rollouts=(), under_way=None)
    shown = whole(trace, network("s1-0"))
    assert shown.words == "Stop"
    assert shown.ego is None
    assert not any(one.chosen for one in shown.alternatives)


def test_what_came_next_in_the_plan_is_no_change_of_it() -> None:
    onward, change, _, after = s1_ride().traces
    assert in_short(onward, None).changed
    assert in_short(change, onward).changed
    assert not in_short(change, change).changed
    done = replace(change, under_way=TimedAction("change-left", 4.0))
    assert not in_short(after, done).changed
    assert in_short(after, change).changed  # it was given up


def test_a_change_of_plan_in_a_ride() -> None:
    traces = ride("s1-0").traces
    changed = [t.sim_time for b, t in pairwise((None, *traces)) if t and in_short(t, b).changed]
    assert changed == [0.0, 3.0]


def test_right_of_way_is_that_of_the_next_junction_on_the_way() -> None:
    roads = network("s2-0")
    shown = whole(ride("s2-0").traces[0], roads)
    right = shown.right_of_way
    assert right is not None
    link = roads.links[right.ego]
    assert (link.junction, link.direction) == (right.junction, "right")
    first = [roads.links[k] for k in right.goes_first]
    assert tuple(one.index for one in first) == link.yields_to != ()
    assert right.vehicles == (1,)


def test_behind_the_last_junction_there_is_no_right_of_way() -> None:
    assert whole(ride("s2-0").traces[-1], network("s2-0")).right_of_way is None


def test_other_roads_than_those_of_the_decision_are_not_used() -> None:
    shown = whole(ride("s2-0").traces[0], network("s1-0"))
    assert shown.right_of_way is None
    assert shown.goal is None


def test_the_tree_counts_every_rollout_once() -> None:
    for trace in ride("s2-0").traces:
        found = branches(trace)
        assert sum(b.visits + b.forced for b in found) == len(trace.rollouts)
        for one in (deep for branch in found for deep in every(branch)):
            assert sum(one.outcomes.values()) == pytest.approx(1.0, abs=1e-3)
            beneath = sum(child.visits + child.forced for child in one.children)
            assert beneath <= one.visits + one.forced
        path, here = [], found
        while here and here[0].chosen:
            path.append(here[0].action)
            here = here[0].children
        assert path == [planned.action for planned in trace.plan]


def test_rollouts_that_are_no_search_have_no_tree() -> None:
    trace = trace_of(s1_world())
    endless = tuple(TimedAction("continue", 4.0 + k) for k in range(40))
    odd = replace(trace, rollouts=(replace(trace.rollouts[0], actions=endless),))
    assert branches(odd) == ()


def test_the_largest_decision_is_a_document_of_fair_size() -> None:
    worst = max(ride("town-0").traces, key=lambda trace: len(encode(trace)))
    assert len(encode(worst)) > ROOM / 2
    assert len(msgspec.json.encode(whole(worst, network("town-0")))) < 200_000
    assert fitted(worst) == worst


def test_the_same_decision_gives_the_same_document() -> None:
    world = random_world(random.Random(3))
    one, other = trace_of(world, draws=9), trace_of(world, draws=9)
    told = [gzip.compress(msgspec.json.encode(whole(t, None)), mtime=0) for t in (one, other)]
    assert told[0] == told[1]
