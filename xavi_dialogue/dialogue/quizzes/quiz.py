"""Quiz: questions of ours to the passenger and their solutions. Pure.

`candidates` lists questions that might be asked. `solved` adds the solution from the answer of the
record, or returns None if no solution is certain enough.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace
from sim.scene import EGO
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.state.assertions import event_of
from xavi_dialogue.dialogue.state.turn import Quiz, Turn
from xavi_dialogue.domain.answers import (
    Answer,
    Cause,
    ChoiceReason,
    Contrast,
    MotionCause,
    MotionReason,
    Posed,
    Refusal,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.domain.meaning import Question, WhatIf, Why
from xavi_dialogue.domain.terms import At, Event, Exists, Happens, Not, Tense, Time, Unsaid, Vehicle
from xavi_dialogue.explain.history.record import Record

CLEAR = 1.0  # [s] minimum difference in time that a question may be about
LIKELY = 0.5  # minimum probability of a cause that is a solution, exclusive
MANY = 8  # maximum of candidates that are tried
LANE_CHANGES: tuple[Action, ...] = ("change-left", "change-right")


def candidates(turns: Sequence[Turn], quizzed: Sequence[Quiz], record: Record) -> tuple[Posed, ...]:
    """Return questions worth trying, best first.

    They are about what was discussed last, then about the last manoeuvre, the last slowing, and
    those in our way. Earlier questions are left out. Kinds that the last answer revealed come last.
    """
    if not record.traces:
        return ()
    known = {replace(quiz.posed, again=False) for quiz in quizzed}
    pool = dict.fromkeys((*_talked_about(turns, record), *_of_ride(record)))
    fresh = [posed for posed in pool if posed not in known]
    told = _told(turns[-1].results) if turns else frozenset()
    fresh.sort(key=lambda posed: _gives_away(posed, told))
    return tuple(fresh[:MANY])


def solved(posed: Posed, found: Answer | Refusal, at: float) -> Quiz | None:
    """Return the question with its solution; None if there is no clear one.

    Args:
        posed: the question.
        found: the answer of the record to it.
        at: [s] when it is asked.
    """
    match posed.kind, found:
        case "vehicle", ChoiceReason(contrast=contrast):
            who = _blamed(contrast.causes)
            return None if who is None else Quiz(posed=posed, at=at, vehicle=who)
        case "vehicle", MotionReason(causes=causes):
            who = _blamed(causes)
            return None if who is None else Quiz(posed=posed, at=at, vehicle=who)
        case "deed", SupposedOfOther(plan=plan, then=then, same=same) if plan:
            sooner = None if found.contrast is None else _sooner(found.contrast)
            actions = (plan if same else then)[:1]
            return Quiz(posed=posed, at=at, actions=actions, same=same, sooner=sooner)
        case "sooner", SupposedOfUs(contrast=contrast, done=None):
            sooner = _sooner(contrast)
            arrives = contrast.outcome is not None and contrast.outcome.name == "done"
            return (
                Quiz(posed=posed, at=at, sooner=sooner) if arrives and sooner is not None else None
            )
    return None


def _talked_about(turns: Sequence[Turn], record: Record) -> Iterator[Posed]:
    """Yield questions about what was explained, the latest first."""
    for turn in reversed(turns):
        for result in turn.results:
            match result:
                case ChoiceReason(contrast=contrast, deed=deed):
                    at = contrast.decided if deed is not None else None
                    yield from (_without(c.vehicle, at) for c in contrast.causes[:1])
                    yield from (_sooner_with(a) for a in contrast.foil[:1])
                    if deed is not None:
                        yield _who(Why(Happens(event_of(deed))))
                case MotionReason(causes=causes, deed=slowing):
                    named = [c.vehicle for c in causes[:1] if c.vehicle]
                    yield from (_without(vehicle, slowing.begin) for vehicle in named)
                case SupposedOfUs(contrast=contrast):
                    yield from (_sooner_with(a) for a in contrast.foil[:1])


def _of_ride(record: Record) -> Iterator[Posed]:
    """Yield questions about the last manoeuvre, the last slowing, and those in our way."""
    done = [event.action for event in carried_out(record.events) if event.action is not None]
    near = _in_our_way(record)
    at = _decided(record)
    for action in done[-1:]:
        if action in LANE_CHANGES:
            yield _sooner_with("continue")
        yield from (_without(vehicle, at) for vehicle in near[:1])
        yield _who(Why(Happens(Event(action))))
    for deed in ("slow-down", "stop", "give-way"):
        yield _who(Why(Happens(Event(deed))))
    yield from (_without(vehicle, at) for vehicle in near[:2])
    yield from (_going_on(vehicle, at) for vehicle in near[:1])


def _without(vehicle: int, at: float | None) -> Posed:
    """Return the question what we would do, or would have done at a time [s], without a vehicle."""
    there = Exists(Vehicle(vehicle), time=_time(at), tense=_tense(at))
    return Posed("deed", WhatIf(Not(there)))


def _going_on(vehicle: int, at: float | None) -> Posed:
    event = Event(
        "exit-straight", Vehicle(vehicle), time=_time(at), tense=_tense(at), modal="would"
    )
    return Posed("deed", WhatIf(Happens(event)))


def _sooner_with(foil: Action) -> Posed:
    return Posed("sooner", WhatIf(Happens(Event(foil, modal="would"))))


def _who(question: Question) -> Posed:
    return Posed("vehicle", question)


def _tense(at: float | None) -> Tense:
    return "present" if at is None else "past"


def _time(at: float | None) -> Time:
    return Unsaid() if at is None else At(at)


def _decided(record: Record) -> float | None:
    """Return the time [s] of the decision for the last manoeuvre; None if there is none."""
    decisions = [event.decision for event in carried_out(record.events)][-1:]
    return next((t.sim_time for t in record.traces if t.decision in decisions), None)


def _in_our_way(record: Record) -> tuple[int, ...]:
    """Return the other vehicles, those first that held us up in the most rollouts."""
    decisions = [event.decision for event in carried_out(record.events)][-1:]
    behind = [trace for trace in record.traces if trace.decision in decisions]
    return _ranked(behind[0] if behind else record.traces[-1])


def _ranked(trace: PlanTrace) -> tuple[int, ...]:
    held = Counter(
        vehicle
        for rollout in trace.rollouts
        for vehicle in sorted({hold.vehicle for hold in rollout.held_up})
    )
    others = [vehicle for vehicle in trace.scene if vehicle != EGO]
    return tuple(sorted(others, key=lambda vehicle: (-held[vehicle], vehicle)))


def _told(results: Iterable[Answer | Refusal]) -> frozenset[str]:
    """Return the kinds of questions whose solution the last answer revealed."""
    told: set[str] = set()
    for result in results:
        match result:
            case ChoiceReason() | MotionReason():
                told |= {"vehicle", "sooner"}
            case SupposedOfUs():
                told.add("sooner")
            case SupposedOfOther():
                told.add("deed")
    return frozenset(told)


def _gives_away(posed: Posed, told: frozenset[str]) -> bool:
    return posed.kind in told


def _blamed(causes: Sequence[Cause | MotionCause]) -> int | None:
    """Return the one vehicle that is the cause; None if that is in doubt, or if there are more."""
    if not causes or not causes[0].vehicle:
        return None
    first, *others = causes
    unlikely = first.probability is not None and first.probability <= LIKELY
    if first.necessary is False or unlikely:
        return None
    rivals = (c for c in others if c.vehicle and not (first.necessary and c.necessary is False))
    return None if any(True for _ in rivals) else first.vehicle


def _sooner(contrast: Contrast) -> bool | None:
    """Check whether the foil gets us there sooner; None if that is not clear."""
    time = next((effect for effect in contrast.effects if effect.component == "time"), None)
    if time is None or abs(time.delta) < CLEAR or time.low * time.high <= 0.0:
        return None
    return time.delta < 0.0
