"""Severally: several measures in one question: "the gap to vehicle 2 and the speed difference"."""

from dataclasses import replace
from typing import cast

from xavi_dialogue.domain.meaning import Ask, HowMuch, Question, WhatIf, Whether, Which
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Ego,
    Event,
    Happens,
    Lane,
    Measured,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Tense,
    Thing,
    Time,
    Unknown,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Extreme
from xavi_dialogue.nlu.compose.clauses.adoption import next_to_us, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.nominal import asked_of
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Sem, as_thing, is_thing

_EXTREMES = frozenset({"highest", "lowest", "mean", "total"})
_TOWARDS = frozenset({"into", "with", "from", "over", "between"})


def asked_each(sem: Sem | None, clause: Clause, tense: str = "present") -> tuple[Question, ...]:
    """Ask for each of several measures: "the speed and the gap to him"; () for all else."""
    known = {m.of.attribute for m in _members(sem) if isinstance(m, Measure)}
    if known and _is_measured(sem):
        more = (m for other, _ in clause.objects if _is_measured(other) for m in _members(other))
        new = (m for m in more if isinstance(m, Measure) and m.of.attribute not in known)
        sem = Group((*_members(sem), *new))
    measures = _measures(sem, clause.complements)
    if len(measures) < 2:
        return ()
    found = (asked_of(measure, clause.time, tense) for measure in measures)
    return tuple(question for question in found if question is not None)


def each_seen(seer: Thing, sem: Sem | None, time: Time, tense: Tense) -> Proposition | None:
    """Read "can you see the bus and the lorry" of each of them; None for all else."""
    if not isinstance(sem, Group) or sem.join != "and":
        return None
    seen = [thing for one in sem.members if (thing := as_thing(one)) is not None]
    each = tuple(Related("can-see", seer, thing, time, tense) for thing in seen)
    return Both(each) if len(each) > 1 else None


def towards(sem: Sem, complements: list[Complement]) -> Sem:
    """Add to a measure the thing that it is to: "minimum gap to vehicle 2"."""
    found = _measures(sem, complements)
    return found[0] if isinstance(sem, Measure) and found else sem


def _members(sem: Sem | None) -> tuple[Sem, ...]:
    if sem is None:
        return ()
    members = _of_one_measure(sem.members) if isinstance(sem, Group) else (sem,)
    if not any(isinstance(member, Measure) for member in members):
        return members
    return tuple(_lane(member) if isinstance(member, Lane) else member for member in members)


def _of_one_measure(members: tuple[Sem, ...]) -> tuple[Sem, ...]:
    """Read "the average speed and the maximum", "our average and top speed" of one measure."""
    named = next((m for m in members if isinstance(m, Measure)), None)
    if named is None:
        return members
    return tuple(
        replace(named, extreme=cast(Extreme, m.words))
        if isinstance(m, Unknown) and m.words in _EXTREMES
        else m
        for m in members
    )


def _lane(lane: Lane) -> Measure:
    """Take "lane of vehicle 2" beside measures for which one it is in."""
    return Measure(Measured("lane", lane.of or Ego()))


def _is_measured(sem: Sem | None) -> bool:
    """Say whether nothing but measures is named: "speed", "the gap and the lane"."""
    members = _members(sem)
    return bool(members) and all(isinstance(member, Measure) for member in members)


def _measures(sem: Sem | None, complements: list[Complement]) -> tuple[Measure, ...]:
    """Give the measures that are named, each with the thing that they are to."""
    if not _is_measured(sem):
        return ()
    found = [cast(Measure, member) for member in _members(sem)]
    to: Thing | None = next((m.of.to for m in found if _is_named(m.of.to)), None)
    for phrase in complements:
        if phrase.key not in _TOWARDS:
            continue
        behind = _members(phrase.sem)
        thing = next((as_thing(one) for one in behind if _reaches(one)), None)
        to = to or thing
        found += [one for one in behind if isinstance(one, Measure)]
    owner = found[-1].of.thing if found else Ego()  # "speed and distance of the red car"
    if not isinstance(owner, (Ego, Pronoun)):
        found = [_owned(measure, owner) for measure in found]
    return tuple(_filled(measure, to) for measure in found)


def _owned(measure: Measure, owner: Thing) -> Measure:
    """Put the owner that is named last into a measure that lacks one."""
    if measure.ours or not isinstance(measure.of.thing, Ego):
        return measure
    return replace(measure, of=with_fields(measure.of, thing=owner))


def _reaches(sem: Sem | None) -> bool:
    """Say whether it can be measured up to a thing."""
    return sem is not None and (is_thing(sem) or isinstance(as_thing(sem), Vehicle))


def _is_named(thing: Thing | None) -> bool:
    return thing is not None and not isinstance(thing, Pronoun)


def _filled(measure: Measure, to: Thing | None) -> Measure:
    """Put the thing that is named once into a measure that lacks it."""
    of: Measured = measure.of
    if to is None:
        return measure
    if of.thing == Pronoun("it"):  # "the gap to the bus and its speed"
        return replace(measure, of=with_fields(of, thing=to))
    if of.to == Pronoun("it") or (of.to is None and of.attribute in MUTUAL):
        return replace(measure, of=with_fields(of, to=to))
    return measure


MUTUAL = frozenset({"gap", "headway", "distance", "time-to-collision"})


def of_rival(found: list[tuple[Question, float]], clause: Clause) -> Question | None:
    """Ask for the same of whom it is compared to: "what is our speed compared to his"."""
    question, other = found[0][0] if found else None, clause.than
    if not isinstance(question, HowMuch):
        return None
    near = [next_to_us(phrase.key, as_thing(phrase.sem)) for phrase in clause.complements]
    if question.of.to in near and question.of.to is not None:  # "in front of us and behind us"
        rest = [one for one in near if one not in (None, question.of.to)]
        return HowMuch(with_fields(question.of, to=rest[0])) if rest else None
    if question.of.attribute not in _OF_EACH:
        return None
    differs = question.of.to is not None or clause.comparisons
    if differs or isinstance(other, Clause | Quantity | None):
        return None
    thing = as_thing(other)
    if thing in (None, question.of.thing):
        return None
    return HowMuch(with_fields(question.of, thing=thing))


_OF_EACH = frozenset({"speed", "acceleration", "deceleration", "size"})


def apart(question: Question) -> tuple[Ask, ...]:
    """Ask "did you exceed the limit or brake hard?" of each: both may be so, and neither."""
    match question:
        case WhatIf(then=then) if then is not None:
            return tuple(
                Ask(cast(Question, with_fields(question, then=ask.question))) for ask in apart(then)
            )
        case Whether(that=Both(contents=(Compares(left=left), *rest), join="or")) if (
            left.attribute == "delay"
            and all(isinstance(one, Compares) and one.left == left for one in rest)
        ):  # "would that have cost more time or less?"
            return (Ask(HowMuch(left)),)
        case Whether(that=Both(contents=(Compares(left=left), *rest) as each, join="or")) if all(
            _unlike(left, other) for other in rest
        ):
            return tuple(Ask(Whether(one)) for one in each)
        case Whether(
            that=Both(contents=(Happens(event=first), Happens(event=other)), join="or")
        ) if "first" in first.manner and first == with_fields(other, actor=first.actor):
            such = Happens(cast(Event, with_fields(first, actor=Wanted())))
            return (Ask(Which(Wanted(), such, (first.actor, other.actor))),)  # "..., or did we?"
    return (Ask(question),)


def _unlike(left: Measured, other: Proposition) -> bool:
    """Say whether something else than a measure is compared, or another measure."""
    return not isinstance(other, Compares) or other.left.attribute != left.attribute
