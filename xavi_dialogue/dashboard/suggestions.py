"""Suggestions: questions about what has just happened.

The phrases are those of `grammars/dashboard.toml`, filled with actions and vehicles.
"""

from collections.abc import Iterator, Sequence
from itertools import chain

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.dashboard.views.labels import dashboard_words, deed, has_lane_change
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.explain.history.joining import joined

MOST = 5  # questions
RECENT = 12.0  # [s] for which an event is recent
FALLEN = 2.0  # [m/s] least loss of speed, within its history, of a vehicle that slows down
STANDING = 0.5  # [m/s] slower than this counts as standing
ROUNDING = 1e-6  # [s]


def suggestions(
    trace: PlanTrace | None, events: Sequence[Event], at: float, said: Sequence[str] = ()
) -> tuple[str, ...]:
    """Return suggested questions at a moment, the most interesting first.

    Args:
        trace: the decision in force then; None: none.
        events: of the ride, in order of time; those after the moment do not count.
        at: the moment [s].
        said: suggestions of the latest reply.
    """
    if trace is None:
        return ()
    happened = [event for event in events if event.sim_time <= at + ROUNDING]
    asked = chain(
        _crash(happened), _deeds(happened, at), _pace(trace), said, _others(trace), _calm(trace)
    )
    return tuple(dict.fromkeys(asked))[:MOST]


def _crash(events: Sequence[Event]) -> Iterator[str]:
    """Suggest questions about a collision, if there was one."""
    if any(event.kind == "collided" for event in events):
        yield _ask("avoid")


def _deeds(events: Sequence[Event], at: float) -> Iterator[str]:
    """Suggest questions about the latest action, if it is recent."""
    begun = [event for event in events if event.kind == "action-committed"]
    moves = [*begun, *carried_out(events)]
    last = max(moves, key=lambda event: event.sim_time, default=None)
    if last is not None and last.action is not None and last.sim_time >= at - RECENT:
        yield _ask("why").format(deed(last.action))
        if has_lane_change((last.action,)):
            yield _ask("otherwise").format(deed("continue", "participle"))
    if any(e.kind == "gave-way" and e.sim_time >= at - RECENT for e in events):
        yield _ask("why").format(deed("give-way"))


def _pace(trace: PlanTrace) -> Iterator[str]:
    """Suggest why we have stopped or slowed down."""
    track = trace.history.get(EGO)
    if track is not None and max(track.speed) - track.speed[-1] >= FALLEN:
        yield _ask("why").format(deed("stop" if track.speed[-1] < STANDING else "slow-down"))


def _others(trace: PlanTrace) -> Iterator[str]:
    """Suggest questions about slowing vehicles, then hold-ups, then any vehicle."""
    known = [one.vehicle for one in trace.predictions if one.vehicle in trace.history]
    seen = joined((trace,)).seen
    for vehicle in known:
        if vehicle not in trace.unseen and seen[vehicle].motion.trend == "slowing":
            yield _ask("slowing").format(vehicle)
    for vehicle in _in_the_way(trace):
        yield _ask("whither").format(vehicle)
        yield _ask("without").format(vehicle)
    for vehicle in [one.vehicle for one in trace.predictions][:1]:
        yield _ask("whither").format(vehicle)


def _in_the_way(trace: PlanTrace) -> list[int]:
    """Return the vehicle that holds us up in most rollouts of the plan, if any."""
    first = trace.plan[0].action if trace.plan else None
    rollouts = [r for r in trace.rollouts if r.actions and r.actions[0].action == first]
    met = [vehicle for r in rollouts for vehicle in {stretch.vehicle for stretch in r.held_up}]
    known = {one.vehicle for one in trace.predictions}
    most = max(sorted(set(met) & known), key=met.count, default=None)
    return [] if most is None or 2 * met.count(most) < len(rollouts) else [most]


def _calm(trace: PlanTrace) -> Iterator[str]:
    """Suggest questions that fit at any time."""
    yield _ask("doing")
    if any(planned.action != "continue" for planned in trace.plan):
        yield _ask("next")
    yield _ask("goal")
    yield _ask("sure")


def _ask(name: str) -> str:
    return dashboard_words("ask", name)
