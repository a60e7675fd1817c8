"""Propositions: any proposition of the domain as a clause, affirmed or denied."""

import dataclasses
from typing import assert_never, cast, get_args

import msgspec
from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Believed,
    Both,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Nobody,
    Not,
    Proposition,
    Quantity,
    Related,
    That,
    Thing,
    Unknown,
    Vehicle,
)
from xavi_dialogue.nlg.content.clauses.clauses import event_clause, relative_clause, state_word
from xavi_dialogue.nlg.content.clauses.tenses import moment_of, tense_of
from xavi_dialogue.nlg.surface import values
from xavi_dialogue.nlg.surface.tables import table, word
from xavi_dialogue.nlg.surface.values import Clause, Owned, Tense, Who

PLACES = frozenset(("ahead-of", "behind", "left-of", "right-of", "beside", "near", "oncoming-to",
                     "between", "in-the-way-of"))  # fmt: skip
_WE = frozenset(("present", "safe", "stationary", "moving", "fast", "slow", "close", "lost",
                 "astray", "stuck", "late", "first", "last", "far"))  # fmt: skip


def clause_of(
    that: Proposition, now: float, *, negated: bool = False, tense: Tense | None = None
) -> Clause:
    """Return a proposition as a clause, by default in its own tense."""
    match that:
        case Happens(event=event):
            return event_clause(event, now, tense=tense, negated=negated)
        case Related():
            return _related(that, now, negated, tense)
        case Is():
            return _is(that, now, negated, tense)
        case Has():
            return _has(that, now, negated, tense)
        case Compares():
            return _compares(that, now, negated, tense)
        case Exists():
            return _exists(that, now, negated, tense)
        case Caused():
            return _caused(that, now, negated, tense)
        case Believed():
            told = tense or tense_of(that.tense, that.time, now)
            if isinstance(that.content, Happens) and isinstance(that.content.event.actor, Ego):
                meant = clause_of(that.content, now, tense="future")
                return Clause(Who(), "plan to", (values.Bare(meant),), told, negated=negated)
            content = clause_of(that.content, now)
            if told != "present" and content.tense == "future":
                content = dataclasses.replace(content, tense="conditional")
            return Clause(Who(), "expect", ("that", content), told, False, negated)
        case Not(content=content):
            return clause_of(content, now, negated=not negated, tense=tense)
        case Both(contents=contents, join=join):
            first, *others = (clause_of(c, now, negated=negated, tense=tense) for c in contents)
            link = {"and": "or", "or": "and"}[join] if negated else join
            tail = tuple(part for one in others for part in (link, one))
            return _extended(first, tail)
        case That():
            return Clause("that", "be", ("so",), tense or "present", negated=negated)
    assert_never(that)


def _extended(clause: Clause, tail: tuple[object, ...]) -> Clause:
    return dataclasses.replace(clause, rest=(*clause.rest, *tail))


def _related(that: Related, now: float, negated: bool, tense: Tense | None) -> Clause:
    told = tense or tense_of(that.tense, that.time, now)
    at = moment_of(that.time)
    if that.relation == "same-as" and that.thing == that.to and not negated:
        return Clause("that", "be", (Who(that.to, at),), told)
    phrase = word("doings", "relation", that.relation)
    placed = that.relation not in PLACES
    modal = None
    if phrase.startswith("!") and told == "future":
        seeing = Who(that.thing, at, ride=True)
        return Clause(seeing, phrase[1:], (Who(that.to, at), "again"), told, False, negated)
    if phrase.startswith("!"):
        modal, told = ("could", "present") if told == "past" else ("can", "present")
        phrase = phrase[1:]
    progressive = phrase.startswith("+") and told in ("present", "past")
    ride = that.relation != "can-see"
    subject = Who(that.thing, at, placed=placed, ride=ride)
    there = isinstance(that.to, Junction) and told != "future"
    to = replace(that.to, rank=None) if there else that.to
    other: object = Who(to, at, placed=placed or not isinstance(that.thing, Ego))
    if that.relation == "in-the-way-of":
        phrase, other = "be in", Owned(Who(that.to, at, ride=True), "way")
    return Clause(subject, phrase.lstrip("+"), (other,), told, progressive, negated, modal)


def _is(that: Is, now: float, negated: bool, tense: Tense | None) -> Clause:
    if that.state == "roomy" and isinstance(that.thing, Lane):
        that = msgspec.structs.replace(that, state="free")
    told = tense or tense_of(that.tense, that.time, now)
    adjective = state_word(that.state, that.too)
    subject: Who | Clause | str
    if isinstance(that.thing, Vehicle) and that.state in ("wrong", "right"):
        about = Who(that.thing, moment_of(that.time))
        return Clause(Who(), "be", (adjective, "about", about), told, negated=negated)
    if that.event is not None:
        subject = event_clause(that.event, now)
    elif that.thing is not None:
        subject = Who(that.thing, moment_of(that.time), ride=that.state in _WE)
    else:
        subject = "that"
    return Clause(subject, "be", (adjective,), told, negated=negated)


def _has(that: Has, now: float, negated: bool, tense: Tense | None) -> Clause:
    told = tense or tense_of(that.tense, that.time, now)
    at = moment_of(that.time)
    owner = Who(that.thing, at, ride=True)
    match that.attribute:
        case "colour":
            return Clause(Who(that.thing, at, coloured=False), "be", (that.value,), told,
                          negated=negated)  # fmt: skip
        case "kind":
            kind = table("vehicles")["kind"].get(that.value, that.value)
            article = "an" if kind[:1] in "aeiou" else "a"
            return Clause(Who(that.thing, at, kinded=False), "be", (f"{article} {kind}",), told,
                          negated=negated)  # fmt: skip
        case "indicator":
            verb = "indicate" if that.value in ("on", "flashing") else f"indicate {that.value}"
            return Clause(owner, verb, (), told, told in ("present", "past"), negated)
        case "brake-lights":
            return Clause(owner, "brake", (), told, told in ("present", "past"), negated)
        case "lane":
            return Clause(owner, "be", (f"in the {that.value} lane",), told, negated=negated)
        case "place":
            return Clause(Who(that.thing, at, placed=False, ride=True), "be", (that.value,), told,
                          negated=negated)  # fmt: skip
    noun = word("doings", "attribute", that.attribute)
    return Clause(Owned(owner, noun), "be", (that.value,), told, negated=negated)


_DEGREES = {"more": "higher than", "less": "lower than", "same": "the same as",
            "at-least": "at least", "at-most": "at most", "too-much": "too high",
            "enough": "enough"}  # fmt: skip
_LIMITS = {"more": "over the speed limit", "less": "under the speed limit",
           "too-much": "over the speed limit", "at-most": "within the speed limit"}  # fmt: skip
_FAST = {"more": "faster than", "less": "slower than", "same": "as fast as",
         "at-least": "at least as fast as", "at-most": "at most as fast as",
         "too-much": "too fast", "enough": "fast enough"}  # fmt: skip
_FAR = {"more": "further away than", "less": "closer than", "same": "as far away as",
        "at-least": "at least", "at-most": "at most", "too-much": "too far away",
        "enough": "far enough away"}  # fmt: skip


_FASTER = {"more": "faster", "less": "slower", "same": "just as fast"}
_CLOSER = {"more": "further away", "less": "closer", "same": "just as far away"}
_BIGGER = {"more": "bigger", "less": "smaller", "same": "the same"}


def two_times(that: Proposition) -> bool:
    """Check whether a measure is compared with itself at another time."""
    if not isinstance(that, Compares) or not isinstance(that.right, Measured):
        return False
    left, right = that.left, that.right
    return (left.attribute, left.thing, left.to) == (right.attribute, right.thing, right.to)


def _compares(that: Compares, now: float, negated: bool, tense: Tense | None) -> Clause:
    left = that.left
    told = tense or tense_of(left.tense, left.time, now)
    at = moment_of(left.time)
    if two_times(that):
        compared: Who | str = Who(left.thing, at, placed=False, ride=True)
        if left.attribute not in ("speed", "distance"):
            compared = f"the {word('doings', 'attribute', left.attribute)}"
        table = {"speed": _FASTER, "distance": _CLOSER}.get(left.attribute, _BIGGER)
        return Clause(compared, "be", (table.get(that.comparator, "the same"),), told,
                      negated=negated)  # fmt: skip
    right = _right(that.right, at)
    owner = Who(left.thing, at, ride=True)
    by = (values.Quantity(that.by.value, that.by.unit),) if that.by is not None else ()
    if left.attribute == "speed" and _limit(that.right):
        words = _LIMITS.get(that.comparator, "at the speed limit")
        return Clause(owner, "be", (*by, words), told, negated=negated)
    beyond = that.comparator in ("more", "less") or not isinstance(that.right, Quantity)
    if left.attribute == "speed" and beyond:
        return Clause(owner, "be", (*by, _FAST[that.comparator], *right), told, negated=negated)
    if left.attribute == "speed" and that.comparator == "same":
        return Clause(owner, "do", right, told, True, negated=negated)
    to_us = isinstance(left.to, Ego) or (left.to is None and not isinstance(left.thing, Ego))
    if left.attribute in ("distance", "gap") and to_us:
        subject = Who(left.thing, at, placed=False, ride=True)
        return Clause(subject, "be", (*by, _FAR[that.comparator], *right), told, negated=negated)
    noun = word("doings", "attribute", left.attribute)
    if left.to is not None and not isinstance(left.to, Ego):
        tail: tuple[object, ...] = ("to", Who(left.to, at))
        return Clause(f"the {noun}", "be", (*by, _DEGREES[that.comparator], *right, *tail), told,
                      negated=negated)  # fmt: skip
    ours = left.attribute == "limit" and isinstance(left.thing, Ego)
    subject_noun: Owned | str = "the speed limit" if ours else Owned(owner, noun)
    return Clause(subject_noun, "be", (*by, _DEGREES[that.comparator], *right), told,
                  negated=negated)  # fmt: skip


def _limit(right: Measured | Quantity | None) -> bool:
    return right is None or (isinstance(right, Measured) and right.attribute == "limit")


def _right(right: Measured | Quantity | None, at: float | None) -> tuple[object, ...]:
    if right is None:
        return ()
    if isinstance(right, Quantity):
        return (values.Quantity(right.value, right.unit),)
    if right.attribute in ("speed", "distance", "gap"):
        return (Who(right.thing, at, placed=False),)
    return (Owned(Who(right.thing, at, ride=True), word("doings", "attribute", right.attribute)),)


def _exists(that: Exists, now: float, negated: bool, tense: Tense | None) -> Clause:
    told = tense or tense_of(that.tense, that.time, now)
    thing = that.thing
    if isinstance(thing, Nobody):
        if thing.described is None:
            negated = not negated
        thing = thing.described or Everyone()
    if isinstance(thing, Described):
        thing = replace(thing, plural=False) if negated else thing
        known = thing.doing is not None and not isinstance(thing.doing.object, Unknown)
        did = (relative_clause(thing.doing, now),) if known and thing.doing is not None else ()
        return Clause("there", "be", (_some(thing, negated), *did), told, plural=thing.plural)
    if isinstance(thing, Everyone):
        return Clause("there", "be", ("nobody" if negated else "somebody",), told)
    return Clause(Who(thing, moment_of(that.time)), "be", ("there",), told, negated=negated)


def _some(thing: Described, negated: bool) -> object:
    """Return somebody who fits a description, or nobody who does."""
    if not negated:
        return Who(replace(thing, definite=False), indefinite=True)
    bare = replace(thing, definite=False, number=None)
    return values.Without(bare)


def _caused(that: Caused, now: float, negated: bool, tense: Tense | None) -> Clause:
    cause = that.cause
    subject: Who | Clause
    if isinstance(cause, get_args(Thing)):
        subject = Who(cast(Thing, cause), ride=True)
    else:
        subject = clause_of(cast(Proposition, cause), now)
    effect: tuple[object, ...] = ()
    if that.effect is not None:
        effect = ("why", clause_of(that.effect, now))
    return Clause(subject, "be", ("the reason", *effect), tense or "present", negated=negated)


def eventful(that: Proposition) -> Event | None:
    """Return the event of a proposition that says that it happens, or not."""
    if isinstance(that, Not):
        return eventful(that.content)
    return that.event if isinstance(that, Happens) else None
