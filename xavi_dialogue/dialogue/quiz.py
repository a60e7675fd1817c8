"""Quiz: questions of ours to the passenger, their answers, and what replies to them come to.

`candidates` lists what might be asked, `filled` puts in the answer once it is explained, or says
that there is none to ask for, and `judged` compares a reply with it. All are pure.
"""

from collections import Counter
from collections.abc import Iterable, Iterator

import msgspec

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.referents import PREFIX, Scope
from xavi_dialogue.dialogue.referents import candidates as fitting
from xavi_dialogue.dialogue.turn import Judgement, Quiz
from xavi_dialogue.explain.bearings import Vehicles
from xavi_dialogue.explain.explanation import Cause, Explanation
from xavi_dialogue.explain.query import Query, QueryAction, Tense
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.content import select
from xavi_dialogue.language.doings import LANE_CHANGES, vehicle_of
from xavi_dialogue.language.points import Budget, Constraint, Contrast, Supposition
from xavi_dialogue.language.retorts import Named, Retort, retort

CLEAR = 1.0  # [s] a difference in time that is fit to be asked for
LIKELY = 0.5  # a cause that is less probable is no answer
MANY = 8  # candidates worth trying
_HELD_UP: tuple[QueryAction, ...] = ("slow-down", "stop", "give-way")
_REASONED = frozenset({"why", "why_not", "what_if", "compare"})
_BARELY = Budget(1, 1)


def candidates(
    asked: tuple[Query, ...],
    explained: tuple[Query, ...],
    quizzed: tuple[Quiz, ...],
    record: Record,
) -> tuple[Quiz, ...]:
    """Questions worth trying, best first, their answers not yet filled in.

    First about what was talked about last, then about the last manoeuvre, the last slowing, and
    the plan. What was asked before is left out; what the last answer told comes last.

    Args:
        asked: what the passenger asked so far, oldest first.
        explained: those of them that were answered with an explanation, oldest first.
        quizzed: questions put to the passenger so far.
        record: the ride so far.
    """
    if not record.traces:
        return ()
    known = {(quiz.kind, quiz.about) for quiz in quizzed}
    pool = dict.fromkeys((*_talked_about(explained, record), *_of_ride(explained, record)))
    fresh = [quiz for quiz in pool if (quiz.kind, quiz.about) not in known]
    last = explained[-1] if explained and asked[-1:] == explained[-1:] else None
    fresh.sort(key=lambda quiz: last is not None and _told(quiz, last))
    return tuple(fresh[:MANY])


def filled(quiz: Quiz, found: Explanation) -> Quiz | None:
    """The question with its answer; None where there is none that is sure enough to be asked for.

    Args:
        quiz: the question.
        found: the explanation of `quiz.about`.
    """
    content = select(quiz.about, found, _BARELY, found.sim_time)
    match quiz.kind:
        case "vehicle":
            who = _blamed(content, found)
            return None if who is None else msgspec.structs.replace(quiz, vehicle=who)
        case "deed":
            if not isinstance(content, Supposition) or not found.factual:
                return None
            mine = (found.counterfactual or found.factual)[:1]
            return msgspec.structs.replace(
                quiz, actions=mine, same=content.same, sooner=_sooner(found)
            )
        case "sooner":
            outcome, sooner = found.outcome, _sooner(found)
            if outcome is None or outcome.name != "done" or not found.counterfactual:
                return None
            return None if sooner is None else msgspec.structs.replace(quiz, sooner=sooner)


def judged(quiz: Quiz, text: str, scenes: tuple[Vehicles, ...]) -> Judgement | None:
    """What a reply to a question of ours comes to; None where it is no reply to it.

    It is "passed" where the passenger does not know, or does not settle on one answer.

    Args:
        quiz: the question, with its answer.
        text: what was typed.
        scenes: where the vehicles are that it may describe; one is meant where a description
            fits it alone in any of them. Best: the decision that was asked about, and now.
    """
    said = retort(text)
    if said is None:
        return None
    verdict = {"vehicle": _vehicle, "deed": _deed, "sooner": _time}[quiz.kind](quiz, said, scenes)
    return "passed" if verdict is None and said.passed else verdict


def _vehicle(quiz: Quiz, said: Retort, scenes: tuple[Vehicles, ...]) -> Judgement | None:
    meant = [_matches(named, quiz.vehicle, scenes) for named in said.vehicles if not named.denied]
    if not meant:
        if any(_matches(n, quiz.vehicle, scenes) is True for n in said.vehicles) or said.nobody:
            return "wrong"
        return "passed" if said.vehicles else None
    if False in meant:
        return "wrong"
    return "right" if True in meant else "passed"


def _matches(named: Named, vehicle: int | None, scenes: tuple[Vehicles, ...]) -> bool | None:
    """Whether it is that vehicle that is spoken of; None where it may be one of several."""
    numbers = [int(word) for word in named.descriptions if word.isdecimal()]
    if numbers:
        return numbers[0] == vehicle
    fits = [_fits(named.descriptions, scene) for scene in scenes]
    if any(found == {vehicle} for found in fits):
        return True
    return None if any(found is None or vehicle in found for found in fits) else False


def _fits(descriptions: tuple[str, ...], scene: Vehicles) -> set[int] | None:
    """The vehicles that all descriptions fit; None where none of them tells vehicles apart."""
    scope = Scope((scene,), None)
    found = [set(known) for d in descriptions if (known := fitting(d, scope)) is not None]
    return set.intersection(*found) if found else None


def _deed(quiz: Quiz, said: Retort, _: tuple[Vehicles, ...]) -> Judgement | None:
    ours = set(quiz.actions)
    unclear = bool(quiz.same) and quiz.sooner is None
    if said.torn:
        return "passed"
    if said.deeds:
        first = said.deeds[0]
        if "speed-up" in first or "slow-down" in first:
            quicker = bool(quiz.same) and quiz.sooner is ("speed-up" in first)
            return "passed" if unclear else _right(quicker)
        if said.sooner is not None and unclear:
            return "passed"
        quicker = said.sooner is not None and bool(quiz.same) and said.sooner is quiz.sooner
        return _right(quicker or bool(ours & set(first)))  # "gone faster"
    if said.same is not None:
        if said.same or quiz.same:
            return _right(said.same is quiz.same)
        return "passed"  # something else, but not what
    if said.denied:
        denied = set(said.denied[0])
        stays = "continue" in ours and not denied.isdisjoint(LANE_CHANGES)
        return "wrong" if ours & denied else "right" if stays else "passed"
    if said.sooner is not None:
        return "passed" if unclear else _right(bool(quiz.same) and quiz.sooner is said.sooner)
    return None


def _time(quiz: Quiz, said: Retort, _: tuple[Vehicles, ...]) -> Judgement | None:
    if said.torn:
        return "passed"
    if said.sooner is not None:
        return _right(said.sooner is quiz.sooner)
    if said.same is not None:
        return "wrong" if said.same else "passed"
    return None if said.yes is None else _right(said.yes is quiz.sooner)


def _right(holds: bool) -> Judgement:
    return "right" if holds else "wrong"


def _talked_about(explained: tuple[Query, ...], record: Record) -> Iterator[Quiz]:
    """About what was explained, the latest first."""
    for query in reversed(explained):
        vehicle = vehicle_of(query.actor)
        if vehicle is not None:
            yield _without(vehicle, _tense(record))
        elif query.type in _REASONED:
            yield from _of_contrast(query, record)


def _of_contrast(query: Query, record: Record) -> Iterator[Quiz]:
    """About what we did and did not do: who goes with it, then when we would have been there."""
    suspect = vehicle_of(query.hypothesised_cause or "")
    others = (suspect,) if suspect is not None else _in_our_way(record)[:1]
    yield from (_without(vehicle, _tense(record)) for vehicle in others)
    deed, foil = query.factual, query.counterfactual
    if foil:
        yield _sooner_with(foil, deed, query.tense)
    if deed and query.type == "why":
        yield _who(deed, query.tense)


def _of_ride(explained: tuple[Query, ...], record: Record) -> Iterator[Quiz]:
    """About the last manoeuvre, whoever held us up, and the plan."""
    tense = _tense(record)
    done = [event.action for event in carried_out(record.events) if event.action is not None]
    named = (vehicle_of(query.actor) for query in reversed(explained))
    near = tuple(dict.fromkeys([*(n for n in named if n is not None), *_in_our_way(record)]))
    for action in done[-1:]:
        if action in LANE_CHANGES:
            yield _sooner_with(("continue",), (action,), "past")
        yield from (_without(vehicle, tense) for vehicle in near[:1])
        yield _who((action,), "past")
    for deed in _HELD_UP:
        yield _who((deed,), "past")
    yield from (_without(vehicle, tense) for vehicle in near[:2])
    yield from (_going_on(vehicle, tense) for vehicle in near[:1])


def _without(vehicle: int, tense: Tense) -> Quiz:
    about = Query(
        type="what_if",
        actor=f"{PREFIX}{vehicle}",
        negated=True,
        tense=tense,
        intervention="remove",
    )
    return Quiz(kind="deed", about=about)


def _going_on(vehicle: int, tense: Tense) -> Quiz:
    actor = f"{PREFIX}{vehicle}"
    about = Query(type="what_if", actor=actor, counterfactual=("exit-straight",), tense=tense)
    return Quiz(kind="deed", about=about)


def _sooner_with(
    foil: tuple[QueryAction, ...], deed: tuple[QueryAction, ...] | None, tense: Tense
) -> Quiz:
    about = Query(type="what_if", factual=deed, counterfactual=foil, tense=tense)
    return Quiz(kind="sooner", about=about)


def _who(deed: tuple[QueryAction, ...], tense: Tense) -> Quiz:
    return Quiz(kind="vehicle", about=Query(type="why", factual=deed, tense=tense))


def _tense(record: Record) -> Tense:
    """Of the last manoeuvre, where there was one."""
    return "past" if carried_out(record.events) else "present"


def _in_our_way(record: Record) -> tuple[int, ...]:
    """The others, those first that were in our way in most drives simulated for the manoeuvre."""
    decisions = [event.decision for event in carried_out(record.events)][-1:]
    behind = [trace for trace in record.traces if trace.decision in decisions]
    return _ranked((*behind, *record.traces)[0] if behind else record.traces[-1])


def _ranked(trace: PlanTrace) -> tuple[int, ...]:
    held = Counter(
        vehicle
        for rollout in trace.rollouts
        for vehicle in sorted({hold.vehicle for hold in rollout.held_up})
    )
    others = [vehicle for vehicle in trace.scene if vehicle != EGO]
    return tuple(sorted(others, key=lambda vehicle: (-held[vehicle], vehicle)))


def _told(quiz: Quiz, last: Query) -> bool:
    """Whether the answer to the last question gives the answer to this one."""
    about = quiz.about
    if quiz.kind == "deed":
        same = about.actor == last.actor and last.type == "what_if"
        return same and about.counterfactual == last.counterfactual
    if last.type not in _REASONED or vehicle_of(last.actor) is not None:
        return False
    return last.factual is None or about.factual is None or last.factual == about.factual


def _blamed(content: object, found: Explanation) -> int | None:
    """The one vehicle that made us do it; None where there is doubt, or more than one."""
    if not isinstance(content, Contrast | Constraint) or content.because is None:
        return None
    if isinstance(content, Constraint) and (content.cleared or content.denied):
        return None
    first, *others = found.causes
    doubted = first.necessary is False or first.probability <= LIKELY
    if first.vehicle == EGO or doubted or _rival(first, others):
        return None
    return first.vehicle


def _rival(first: Cause, others: Iterable[Cause]) -> bool:
    """Whether another vehicle may be blamed as well."""
    return any(not (first.necessary and other.necessary is False) for other in others)


def _sooner(found: Explanation) -> bool | None:
    """Whether the foil gets us there sooner, where that is clear."""
    time = next((effect for effect in found.effects if effect.component == "time"), None)
    if time is None or abs(time.delta) < CLEAR or time.low * time.high <= 0.0:
        return None
    return time.delta < 0.0
