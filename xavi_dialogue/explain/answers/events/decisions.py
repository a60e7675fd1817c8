"""Decisions: what was decided at a time, and what was different at another decision."""

from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.domain.answers import (
    Altered,
    Answer,
    ChoiceReason,
    Decided,
    NeedRollout,
    NotRecorded,
)
from xavi_dialogue.domain.facts import Belief, Episode, Look
from xavi_dialogue.domain.meaning import Changed
from xavi_dialogue.domain.terms import Ego, Feature
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import was_said, window
from xavi_dialogue.explain.causes.plans.contrast import contrast
from xavi_dialogue.explain.causes.plans.natural import natural
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, TURNS
from xavi_dialogue.explain.facts.traffic_lights import shown_at
from xavi_dialogue.explain.history.ride import planned

MOVED = 0.15  # minimum change of a probability that is stated
EVEN = 0.5  # minimum probability of an expectation that is stated
TOLD = 2  # maximum number of beliefs that are stated
BEFORE = 0.01  # [s] before a decision, when the one before was in force
NEAR = 60.0  # [m] ahead of us within which a new road user is stated
LEAD = 4.0  # [s] before a decision in which changes around us may matter to it
BACK = 20.0  # [s] before now in which a change of plan may be asked about
AFTER = 0.5  # [s] after a decision in which what we do belongs to it


def decided_at(asked: Asked, at: float) -> Decided:
    """Return what the last decision up to a time [s] chose.

    Raises:
        Unanswered: there was none.
    """
    trace = _trace(asked, at)
    before = asked.ride.at(trace.sim_time - BEFORE)
    kept = before is not None and before is not trace and _rest(before, trace)
    return Decided(trace.sim_time, _told(planned(trace)), kept, _driving(asked, trace.sim_time))


def _told(plan: tuple[Action, ...]) -> tuple[Action, ...]:
    """Return what matters of a plan: its first step, and the first turn or lane change."""
    moves = [a for a in plan if a not in ("continue", "stop")]
    if plan and plan[0] == "continue" and moves:
        return tuple(moves[:1])
    return plan[:1] if not moves or moves[0] == plan[0] else (plan[0], moves[0])


def _driving(asked: Asked, at: float) -> tuple[Episode, ...]:
    """Return our slowing down or waiting for somebody at a time [s], if there was any."""
    found = asked.world.episodes(Ego(), ("give-way", "wait", "brake"), at, at + AFTER)
    known = sorted(found, key=lambda e: (e.action == "brake", -e.begin))
    return tuple(known[:1])


def _trace(asked: Asked, at: float) -> PlanTrace:
    trace = asked.ride.at(at)
    if trace is None:
        raise Unanswered(NotRecorded("before-record", about="decision", since=at))
    return trace


def _rest(before: PlanTrace, after: PlanTrace) -> bool:
    """Check whether a plan is the earlier one, or what remains or a beginning of it."""
    old, new = planned(before), planned(after)
    return old == new or old[1:] == new or old[: len(new)] == new


def changed(question: Changed, asked: Asked) -> Answer:
    """Return what was different at the end of a stretch of the ride from its beginning.

    If no stretch is named, it is that of the last change of plan, else the last seconds.

    Raises:
        Unanswered: there was no decision at one of them.
    """
    if not was_said(asked, question.time):
        found = last_change(asked, max(asked.world.begin, asked.now - BACK))
        if found is None:
            return altered(asked, max(asked.world.begin, asked.now - LEAD), asked.now)
        if found.appeared or found.beliefs or found.did or found.light is not None:
            return found
        return replace(found, reason=why_changed(asked, found))
    about = window(asked, question.time)
    return altered(asked, about.begin, about.end)


def last_change(asked: Asked, since: float) -> Altered | None:
    """Return what was different at the last change of plan since a time [s], if there was one."""
    until = asked.now if asked.past is None or not asked.past.said else asked.past.end
    for one in reversed(asked.world.episodes(Ego(), ("change-plan",), since, until)):
        before, after = _trace(asked, one.begin - BEFORE), _trace(asked, one.begin)
        old, new = planned(before), planned(after)
        found = altered(asked, before.sim_time, after.sim_time)
        if _told(old) != _told(new):
            return replace(found, sudden=True)
        turning = set(old[:1]) <= set(TURNS) or set(new[:1]) <= _open(asked, before) & set(TURNS)
        if old[:1] != new[:1] and turning:  # the same turn, at another junction
            ways = (replace(d, steps=p[:1]) for d, p in ((found.before, old), (found.after, new)))
            return replace(found, **dict(zip(("before", "after"), ways, strict=True)), sudden=True)
    return None


def _open(asked: Asked, trace: PlanTrace) -> set[Action]:
    return set(asked.ride.model(trace).options())


def why_changed(asked: Asked, found: Altered) -> ChoiceReason | None:
    """Explain why a new plan was better than the old one; None if that is not known.

    Raises:
        Unanswered: rollouts are needed.
    """
    old, trace = _trace(asked, found.before.time), _trace(asked, found.after.time)
    before, after = planned(old), planned(trace)
    pairs = enumerate(zip(before, after, strict=False))
    node = after[: next((k for k, (was, now) in pairs if was != now), len(before))]
    if len(after) <= len(node):
        return None
    foil, moves = before[len(node) : len(node) + 1], after[len(node)] in CHANGES
    if not moves and not foil:
        return None
    ride = asked.ride
    try:
        against = natural(ride, trace, node) if moves else contrast(ride, trace, foil, node)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    return ChoiceReason("why", None, against)


def altered(asked: Asked, begin: float, end: float) -> Altered:
    """Return what was different at one time [s] from another, also around us a little before.

    Raises:
        Unanswered: there was no decision at one of them.
    """
    first, last = _trace(asked, begin), _trace(asked, end)
    if first is last:
        place = asked.ride.traces.index(last)
        first = asked.ride.traces[max(place - 1, 0)]
    begin, end = first.sim_time, last.sim_time
    before, after = decided_at(asked, begin), decided_at(asked, end)
    since = max(min(begin, end - LEAD), asked.world.begin)
    new = set(asked.world.in_view(end)) - set(asked.world.in_view(since))
    looks = (asked.world.look(v, end) for v in sorted(new))
    appeared = sorted((x for x in looks if x is not None and 0.0 < x.ahead <= NEAR), key=_distance)
    light = shown_at(asked.ride, Feature("light"), end)
    turned = light is not None and light.begun and since < light.begin <= end
    did = [e for e in asked.world.account(since, end) if since < e.begin <= end]
    ours = tuple(e for e in did if Ego() in (e.actor, e.object))
    beliefs = _moved(asked, since, end)
    return Altered(before, after, tuple(appeared), beliefs, ours, light if turned else None)


def _distance(look: Look) -> float:
    return look.distance


def _moved(asked: Asked, begin: float, end: float) -> tuple[tuple[Belief, Belief], ...]:
    """Return the beliefs before and after that changed, the largest change first."""
    found: list[tuple[float, Belief, Belief]] = []
    for vehicle in asked.world.in_view(end):
        old, new = asked.world.belief(vehicle, begin), asked.world.belief(vehicle, end)
        look = asked.world.look(vehicle, end)
        behind = look is None or look.ahead <= 0.0
        if old is None or new is None or not new.expectations or behind:
            continue
        first = new.expectations[0]
        was = next((e.probability for e in old.expectations if e.actions == first.actions), 0.0)
        if first.probability >= EVEN and abs(first.probability - was) >= MOVED:
            found.append((abs(first.probability - was), old, new))
    ranked = sorted(found, key=lambda one: (-one[0], one[2].vehicle))
    return tuple((old, new) for _, old, new in ranked[:TOLD])
