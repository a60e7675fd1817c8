"""Any query about any record gets an answer, and the answer stays within the record."""

import math
import random
from typing import get_args

import msgspec
from hypothesis import given
from hypothesis import strategies as st

from planner.events import Event
from tests.traces import World, random_world, trace_of
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.query import Query, QueryAction, QueryType, Tense
from xavi_dialogue.explain.record import Record

actions = st.none() | st.lists(st.sampled_from(get_args(QueryAction)), max_size=2).map(tuple)
queries = st.builds(
    Query,
    type=st.sampled_from(get_args(QueryType)),
    actor=st.sampled_from(
        ["ego", "vehicle:0", "vehicle:1", "vehicle:2", "vehicle:7", "vehicle:it"]
    ),
    factual=actions,
    counterfactual=actions,
    negated=st.booleans(),
    tense=st.sampled_from(get_args(Tense)),
    condition=st.none()
    | st.sampled_from(
        ["if vehicle 1 had not been there", "if vehicle 2 had turned left", "if it rained"]
    ),
    hypothesised_cause=st.none() | st.sampled_from(["vehicle:1", "vehicle:3", "vehicle:front"]),
    event=st.none() | st.just("crash"),
)


def record_of(seed: int, draws: int, now: float) -> Record:
    world = random_world(random.Random(seed))
    swapped = World(world.aims, world.plans[::-1], world.simulate)
    traces = (
        trace_of(world, draws=draws, time=2.0, decision=0, seed=seed),
        trace_of(swapped, draws=draws, time=4.0, decision=1, seed=seed),
        trace_of(swapped, draws=draws, time=5.0, decision=2, under_way=swapped.plans[0][0]),
    )
    first, then = world.plans[0][0], swapped.plans[0][0]
    events = (
        Event("action-started", 2.0, first, 0),
        Event("action-ended", 4.0, first, 0),
        Event("action-started", 4.0, then, 1),
        Event("action-committed", 4.5, then, 1),
        Event("gave-way", 4.8, then, 1, vehicle=1),
    )
    return Record(now, traces, events)


def numbers(value) -> list[float]:
    match msgspec.to_builtins(value):
        case dict() as fields:
            return [n for item in fields.values() for n in numbers(item)]
        case list() | tuple() as items:
            return [n for item in items for n in numbers(item)]
        case int() | float() as number:
            return [float(number)]
    return []


@given(queries, st.integers(0, 500), st.sampled_from([4, 16]), st.sampled_from([0.0, 3.0, 6.0]))
def test_every_query_gets_an_answer(query, seed, draws, now):
    record = record_of(seed, draws, now)
    found = explain(query, record)
    assert explain(query, record) == found
    assert isinstance(found, Explanation | NoExplanation | NeedRollout)
    assert all(math.isfinite(number) for number in numbers(found))
    if isinstance(found, Explanation):
        past = {t.trace_id: t for t in record.traces if t.sim_time <= now}
        assert set(found.evidence.traces) <= set(past)
        seen = {vehicle for trace in past.values() for vehicle in trace.scene}
        assert {cause.vehicle for cause in found.causes} <= seen - {0}
        assert len({cause.vehicle for cause in found.causes}) == len(found.causes)
        for cause in found.causes:
            assert 0.0 <= cause.probability <= 1.0
        for effect in found.effects:
            assert effect.low <= effect.delta <= effect.high
    if isinstance(found, NoExplanation):
        msgspec.json.encode(found)
