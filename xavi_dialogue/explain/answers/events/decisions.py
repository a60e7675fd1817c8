"""Decisions: what was decided at a time, and what was different at another decision."""

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.domain.answers import Altered, Answer, Decided, NotRecorded
from xavi_dialogue.domain.facts import Belief, Episode, Look
from xavi_dialogue.domain.meaning import Changed
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import window
from xavi_dialogue.explain.history.ride import planned

MOVED = 0.15  # by which a probability has to move to be stated
TOLD = 2  # beliefs that are stated
BEFORE = 0.01  # [s]
AFTER = 0.5  # [s] after a decision in which what we do is still of it


def decided_at(asked: Asked, at: float) -> Decided:
    """Tell what the last decision up to a time [s] came to.

    Raises:
        Unanswered: there was none.
    """
    trace = _trace(asked, at)
    before = asked.ride.at(trace.sim_time - BEFORE)
    kept = before is not None and before is not trace and _rest(before, trace)
    return Decided(trace.sim_time, _told(planned(trace)), kept, _driving(asked, trace.sim_time))


def _told(plan: tuple[Action, ...]) -> tuple[Action, ...]:
    """Keep what matters of a plan: its first step, and the first turn or lane change."""
    moves = [a for a in plan if a not in ("continue", "stop")]
    if plan and plan[0] == "continue" and moves:
        return tuple(moves[:1])
    return plan[:1] if not moves or moves[0] == plan[0] else (plan[0], moves[0])


def _driving(asked: Asked, at: float) -> tuple[Episode, ...]:
    """Tell for whom we slowed down at a time, if for anybody."""
    found = asked.world.episodes(Ego(), ("give-way", "wait", "brake"), at, at + AFTER)
    known = sorted(found, key=lambda e: (e.action == "brake", -e.begin))
    return tuple(known[:1])


def _trace(asked: Asked, at: float) -> PlanTrace:
    trace = asked.ride.at(at)
    if trace is None:
        raise Unanswered(NotRecorded("before-record", about="decision", since=at))
    return trace


def _rest(before: PlanTrace, after: PlanTrace) -> bool:
    """Tell whether a plan is the one of before, as far as that is not carried out yet."""
    old, new = planned(before), planned(after)
    return old == new or old[1:] == new or old[: len(new)] == new


def changed(question: Changed, asked: Asked) -> Answer:
    """Tell what was different at the end of a stretch of the ride from its beginning.

    Raises:
        Unanswered: there was no decision at one of them.
    """
    about = window(asked, question.time)
    first, last = _trace(asked, about.begin), _trace(asked, about.end)
    if first is last:
        place = asked.ride.traces.index(last)
        first = asked.ride.traces[max(place - 1, 0)]
    begin, end = first.sim_time, last.sim_time
    before, after = decided_at(asked, begin), decided_at(asked, end)
    new = set(asked.world.in_view(end)) - set(asked.world.in_view(begin))
    looks = (asked.world.look(v, end) for v in sorted(new))
    appeared: tuple[Look, ...] = tuple(x for x in looks if x is not None)
    did = [e for e in asked.world.account(begin, end) if begin < e.begin <= end]
    ours = tuple(e for e in did if Ego() in (e.actor, e.object))
    return Altered(before, after, appeared, _moved(asked, begin, end), ours)


def _moved(asked: Asked, begin: float, end: float) -> tuple[tuple[Belief, Belief], ...]:
    """List what was believed before and after, where it moved, the most first."""
    found: list[tuple[float, Belief, Belief]] = []
    for vehicle in asked.world.in_view(end):
        old, new = asked.world.belief(vehicle, begin), asked.world.belief(vehicle, end)
        if old is None or new is None or not new.expectations:
            continue
        first = new.expectations[0]
        was = next((e.probability for e in old.expectations if e.actions == first.actions), 0.0)
        if abs(first.probability - was) >= MOVED:
            found.append((abs(first.probability - was), old, new))
    ranked = sorted(found, key=lambda one: (-one[0], one[2].vehicle))
    return tuple((old, new) for _, old, new in ranked[:TOLD])
