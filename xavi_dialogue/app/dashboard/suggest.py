"""What could well be asked now: questions that come from what has just happened.

They are made of queries, as those are that replies suggest, so that the parser understands them.
"""

from collections.abc import Iterator, Sequence
from itertools import chain

from planner.events import Event
from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.explain.motion import join
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.language.doings import LANE_CHANGES
from xavi_dialogue.language.questions import questions

MOST = 5  # questions
RECENT = 12.0  # [s] up to which something has just happened
FALLEN = 2.0  # [m/s] that a vehicle has lost within its history, to be slowing down
STANDING = 0.5  # [m/s] slower than this counts as standing
ROUNDING = 1e-6  # [s]

_DOING = Query(type="what", tense="present")
_NEXT = Query(type="what", tense="future")
_GOAL = Query(type="where_goal", tense="present")
_SURE = Query(type="confidence", tense="present")


def suggestions(trace: PlanTrace | None, events: Sequence[Event], at: float) -> tuple[str, ...]:
    """Questions that suggest themselves at a moment, the most interesting first.

    Args:
        trace: the decision in force then; None: there is none.
        events: of the ride, in order of time; those after the moment do not count.
        at: the moment [s].
    """
    if trace is None:
        return ()
    happened = [event for event in events if event.sim_time <= at + ROUNDING]
    asked = chain(
        _crash(happened), _deeds(happened, at), _pace(trace), _others(trace), _calm(trace)
    )
    return questions(tuple(asked), MOST)


def _crash(events: Sequence[Event]) -> Iterator[Query]:
    """After a collision, nothing matters as much."""
    if any(event.kind == "collided" for event in events):
        yield Query(type="how_avoid")


def _deeds(events: Sequence[Event], at: float) -> Iterator[Query]:
    """About what was done last, if that was not long ago."""
    begun = [event for event in events if event.kind == "action-committed"]
    moves = [*begun, *carried_out(events)]
    last = max(moves, key=lambda event: event.sim_time, default=None)
    if last is not None and last.action is not None and last.sim_time >= at - RECENT:
        yield Query(type="why", factual=(last.action,))
        if last.action in LANE_CHANGES:
            yield Query(type="what_if", counterfactual=("continue",))
    if any(e.kind == "gave-way" and e.sim_time >= at - RECENT for e in events):
        yield Query(type="why", factual=("give-way",))


def _pace(trace: PlanTrace) -> Iterator[Query]:
    """Why we have stopped, or slowed down."""
    track = trace.history.get(EGO)
    if track is not None and max(track.speed) - track.speed[-1] >= FALLEN:
        deed: QueryAction = "stop" if track.speed[-1] < STANDING else "slow-down"
        yield Query(type="why", factual=(deed,))


def _others(trace: PlanTrace) -> Iterator[Query]:
    """About those who slow down, then about whoever holds us up, then about anybody."""
    known = [one.vehicle for one in trace.predictions]
    tracks = {vehicle: trace.history[vehicle] for vehicle in known if vehicle in trace.history}
    for vehicle, track in tracks.items():
        if vehicle not in trace.unseen and join([track]).trend == "slowing":
            actor = f"vehicle:{vehicle}"
            yield Query(type="why", actor=actor, factual=("slow-down",), tense="present")
    for vehicle in _in_the_way(trace):
        actor = f"vehicle:{vehicle}"
        yield Query(type="where_goal", actor=actor, tense="present")
        yield Query(
            type="what_if", actor=actor, negated=True, intervention="remove", tense="present"
        )
    for vehicle in known[:1]:
        yield Query(type="where_goal", actor=f"vehicle:{vehicle}", tense="present")


def _in_the_way(trace: PlanTrace) -> list[int]:
    """Who holds us up in most of the rollouts that begin as planned, if anybody."""
    first = trace.plan[0].action if trace.plan else None
    rollouts = [r for r in trace.rollouts if r.actions and r.actions[0].action == first]
    met = [vehicle for r in rollouts for vehicle in {stretch.vehicle for stretch in r.held_up}]
    known = {one.vehicle for one in trace.predictions}
    most = max(sorted(set(met) & known), key=met.count, default=None)
    return [] if most is None or 2 * met.count(most) < len(rollouts) else [most]


def _calm(trace: PlanTrace) -> Iterator[Query]:
    """What can be asked at any time."""
    yield _DOING
    if any(planned.action != "continue" for planned in trace.plan):
        yield _NEXT
    yield _GOAL
    yield _SURE
