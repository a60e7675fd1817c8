"""Choosing: questions that name alternatives, such as "is the red or the blue one faster".

"Or" between definite things ("the bus or the van") asks which of them it is; between indefinite
ones ("a man or a lady") it asks whether there is any.
"""

import dataclasses
from collections.abc import Iterator
from typing import Any, TypeVar, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Compare, Question, Whether, Which
from xavi_dialogue.domain.rewriting import substitute
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Junction,
    Measured,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.alternatives.comparing import BY
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of, words_of
from xavi_dialogue.nlu.compose.wh_questions.wh import fact

T = TypeVar("T")
_REVERSED = frozenset({"slow", "small", "far", "late"})
_EXTREMES = {"fastest": ("speed", False), "quickest": ("speed", False), "slowest": ("speed", True),
             "biggest": ("size", False), "largest": ("size", False), "smallest": ("size", True),
             "nearest": ("distance", False), "closest": ("distance", False),
             "farthest": ("distance", True), "furthest": ("distance", True)}  # fmt: skip
#: The same of deeds and options: "which of them was the riskiest".
_RANKS = {"difficult": ("comfort", True), "dangerous": ("safety", True), "biggest": ("size", False),
          "smallest": ("size", True), "highest": ("best", True), "lowest": ("best", True),
          "best": ("best", False), "uncomfortable": ("comfort", True)}  # fmt: skip
_POINTED = frozenset({"one", "the", "this", "that"})
_FIRST = frozenset({"before", "bearing-ahead"})
_LATER = frozenset({"behind", "bearing-behind", "after"})
_IN_LINE = {"ahead": False, "behind": True}
#: By word of comparison: the attribute of road users that it compares.
_OF_THINGS = {"fast": "speed", "slow": "speed", "high": "speed", "low": "speed", "long": "size"}


def least_of(clause: Clause) -> bool:
    """Check whether a clause asks who is slower, smaller or farther, not faster and so on."""
    return bool(clause.comparisons) and clause.comparisons[0][0] in _REVERSED


def by_of(clause: Clause) -> str:
    """Return the attribute by which a clause compares things."""
    key = clause.comparisons[0][0]
    return _OF_THINGS.get(key) or BY.get(key, "best")


def in_line(clause: Clause) -> bool | None:
    """Check whether a clause asks who is ahead (False) or who is behind (True); None: neither."""
    bare = clause.verb is None and not (clause.comparisons or clause.adjectives)
    if not bare or len(clause.bearings) != 1 or clause.complements:
        return None
    return _IN_LINE.get(clause.bearings[0][0])


def options_of(sem: Sem | None) -> tuple[Thing, ...] | None:
    """Return the alternatives that are joined by "or"; None unless all of them are definite."""
    if not isinstance(sem, Group) or sem.join != "or":
        return None
    numbered = any(isinstance(member, Vehicle) for member in sem.members)
    things = [as_thing(m) for m in sem.members if numbered or not isinstance(m, Quantity)]
    named = [thing for thing in things if is_pointed_at(thing)]
    return tuple(cast(Any, named)) if len(named) == len(sem.members) else None


def is_pointed_at(thing: object) -> bool:
    """Check whether a thing is one specific road user: "the bus", "vehicle 7", "we"."""
    return isinstance(thing, Ego | Vehicle) or (isinstance(thing, Described) and thing.definite)


def superlative_of(clause: Clause) -> tuple[str, bool] | None:
    """Return the attribute of a superlative, and whether it is the least: "the slowest"."""
    named = [*(getattr(sem, "extreme", None) for sem, _ in clause.objects), *sorted(clause.focus)]
    return next((_EXTREMES[one] for one in named if one in _EXTREMES), None)


def ranked_by(clause: Clause) -> tuple[str, bool] | None:
    """Return by what one of several deeds or options is ranked, and whether it is the least."""
    nodes = (leaf for _, node in clause.objects for leaf in leaves_of(node))
    keys = (leaf.key for leaf in (*nodes, *clause.skipped) if leaf.category == "SUPER")
    return next((_RANKS[key] for key in keys if key in _RANKS), None)


def chosen(clause: Clause, propositions: Any) -> list[tuple[Question, float]]:
    """Return the question which of the things joined by "or" is meant; empty if there are none."""
    if clause.negated or clause.because is not None or clause.contrast is not None:
        return []
    if (turn := _cleft(clause) or _before_or_after(clause, propositions)) is not None:
        return [(turn, 0.0)]
    if (values := _values(clause)) is not None:
        return [(Whether(values), 0.0)]
    options = options_of(clause.subject)
    if options is None:
        return _any_of(clause, propositions) or _done_to(clause, propositions)
    if clause.comparisons and clause.comparisons[0][1] != "as" and clause.than is None:
        return [(Compare(options, cast(Any, by_of(clause)), least_of(clause)), 0.0)]
    if (most := superlative_of(clause)) is not None:
        return [(Compare(options, cast(Any, most[0]), most[1]), 0.0)]
    if (behind := in_line(clause)) is not None:
        return [(Compare(options, "place", behind), 0.0)]
    open_ = dataclasses.replace(clause, subject=Wanted())
    found = [(fact(c.value), c.cost) for c in propositions.readings(open_)]
    return [(Which(Wanted(), of, options), cost) for of, cost in found if _is_open(of)]


def _values(clause: Clause) -> Both | None:
    """Read "was the light red or green", "is that a car or a van" as which value it has."""
    sem = clause.objects[0][0] if len(clause.objects) == 1 else None
    thing = as_thing(clause.subject)
    if clause.verb is not None or thing is None or not isinstance(sem, Group) or sem.join != "or":
        return None
    named = [one for one in sem.members if isinstance(one, Described)]
    if not _POINTED.isdisjoint(words_of(clause.objects[0][1]).split()):
        return None  # "the red one or the blue one"
    hues = [one.colour for one in named if one == Described(colour=one.colour)]
    kinds = [one.kind for one in named if one == Described(one.kind, definite=False)]
    tense: Any = clause.tense
    for attribute, values in (("colour", hues), ("kind", kinds)):
        if len(values) == len(sem.members):
            of = Has(cast(Any, attribute), "", thing, clause.time, tense)
            return Both(tuple(replace(of, value=str(value)) for value in values), "or")
    return None


def _any_of(clause: Clause, propositions: Any) -> list[tuple[Question, float]]:
    """Read "is a bus or a lorry coming" as whether it holds for any of them."""
    sem = clause.subject
    if not isinstance(sem, Group) or sem.join != "or":
        return []
    each = [propositions.readings(_copy(clause, subject=one))[:1] for one in sem.members]
    said = [(fact(one.value), one.cost) for found in each for one in found]
    if len(said) < len(sem.members):
        return []
    return [(Whether(Both(tuple(of for of, _ in said), "or")), said[0][1])]


def _cleft(clause: Clause) -> Question | None:
    """Read "is it the bus or the van that we are waiting for"."""
    pronoun = isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that")
    sem = clause.objects[0][0] if pronoun and clause.objects else None
    if clause.verb is not None or not isinstance(sem, Group) or sem.join != "or":
        return None
    things = [as_thing(member) for member in sem.members]
    places = [one for one in things if isinstance(one, Feature | Junction)]
    named = [one for one in things if one in places or isinstance(one, Described | Ego | Vehicle)]
    if not places and not any(map(is_pointed_at, named)):
        return None
    told = [one for one in named if isinstance(one, Described) and (one.doing or one.such)]
    if len(told) != 1 or len(named) < len(things):
        return None
    such = told[0].such if told[0].doing is None else Happens(told[0].doing)
    plain = [replace(told[0], doing=None, such=None) if one is told[0] else one for one in named]
    options = cast("tuple[Thing, ...]", tuple(plain))
    return None if such is None else Which(Wanted(), such, options)


def _before_or_after(clause: Clause, propositions: Any) -> Question | None:
    """Read "will you merge in front of him or behind" as a question who goes first, we or he."""
    whom = next((p.sem for p in clause.complements if p.key in _FIRST), None)
    thing = as_thing(whom)
    behind = [
        other for join, other in clause.chained
        if join == "or" and _LATER & {key for key, _ in other.bearings} | _LATER & {
            phrase.key for phrase in other.complements
        }
    ]  # fmt: skip
    ours = isinstance(clause.subject, Ego) and clause.verb is not None
    if not ours or not behind or clause.tense not in ("present", "future") or thing is None:
        return None
    propositions.notes.taken.update(map(id, behind))
    we = Event("go", Ego(), thing, manner=("first",), tense="future")
    he = Event("let-go", Ego(), thing, tense="future")
    return Whether(Both((Happens(we), Happens(he)), "or"))


def _done_to(clause: Clause, propositions: Any) -> list[tuple[Question, float]]:
    """Read "did you wait for the bus or the van" as for which of them we did it."""
    for options, members in _objects(clause):
        readings = [propositions.readings(member)[:1] for member in members]
        said = [(fact(one.value), one.cost) for found in readings for one in found]
        which = differing(Both(tuple(of for of, _ in said), "or")) if len(said) > 1 else None
        if which is not None and len(said) == len(options):
            return [(replace(which, among=options), said[0][1])]
    return []


def _objects(clause: Clause) -> Iterator[tuple[tuple[Thing, ...], list[Clause]]]:
    """Yield things joined by "or" after the verb, with a clause for each of them."""
    for index, (sem, part) in enumerate(clause.objects):
        if (options := options_of(sem)) is not None:
            yield options, [_copy(clause, objects=_put(clause.objects, index, (one, part)))
                            for one in options]  # fmt: skip
    for index, phrase in enumerate(clause.complements):
        if (options := options_of(phrase.sem)) is not None:
            phrases = [dataclasses.replace(phrase, sem=one) for one in options]
            yield options, [_copy(clause, complements=_put(clause.complements, index, one))
                            for one in phrases]  # fmt: skip


def _put(row: list[T], index: int, one: T) -> list[T]:
    return [*row[:index], one, *row[index + 1 :]]


def _copy(clause: Clause, **fields: Any) -> Clause:
    """Copy a clause, so that reading the copy does not change the original."""
    lists = {
        name: list(value)
        for name in ("objects", "complements", "bearings", "particles", "chained")
        if (value := getattr(clause, name))
    }
    return dataclasses.replace(clause, **{**lists, **fields})


def _is_open(of: Proposition) -> bool:
    return substitute(of, Wanted(), Ego()) != of


def compared_by(such: Proposition | None, options: tuple[Thing, ...]) -> Compare | None:
    """Return a comparison of things by the attribute that is asked about: "which is faster"."""
    match such:
        case Compares(left=Measured(attribute=attribute), comparator=comparator, right=None) if (
            attribute in _MOST
        ):
            least = comparator != _MOST[attribute]
            return Compare(options, cast(Any, attribute), least)
        case Related(relation="ahead-of" | "behind" as relation, thing=Wanted(), to=Ego()):
            return Compare(options, "place", relation == "behind")
    return None


_MOST = {"speed": "more", "size": "more", "distance": "less"}


def differing(of: Proposition) -> Which | None:
    """Read "did you wait for the bus or wait for the van" as a question which of them it was."""
    if not isinstance(of, Both) or of.join != "or":
        return None
    one, other = of.contents[0], of.contents[-1]
    for thing, rival in zip(_things(one), _things(other), strict=False):
        if thing == rival or not (is_pointed_at(thing) and is_pointed_at(rival)):
            continue
        such = substitute(one, thing, Wanted())
        if such == substitute(other, rival, Wanted()):
            return Which(Wanted(), such, (thing, rival))
    return None


def _things(of: object) -> list[Any]:
    """List the road users in a proposition, in the order of its fields."""
    if isinstance(of, Ego | Vehicle | Described):
        return [of]
    fields = getattr(of, "__struct_fields__", ())
    return [thing for name in fields for thing in _things(getattr(of, name))]


def asks_which(question: Question) -> Question:
    """Turn a question whether either of two is so into a question which one, where possible."""
    if not isinstance(question, Whether):
        return question
    question = replace(question, that=of_the_same(question.that))
    return _before_or_behind(question.that) or differing(question.that) or question


def of_the_same(of: Proposition) -> Proposition:
    """Read "do you overtake him or stay behind" as about one and the same vehicle."""
    match of:
        case Both(
            contents=(
                Happens(event=Event(actor=Ego(), object=Described() | Pronoun() as whom)) as one,
                Happens(event=Event(action="follow" | "overtake", object=None) as event),
            ),
            join="or",
        ):
            return replace(of, contents=(one, Happens(replace(event, object=whom))))
    return of


def _before_or_behind(of: Proposition) -> Compare | None:
    """Read "is it ahead of the van or behind it" as a question which of the two is ahead."""
    match of:
        case Both(
            contents=(
                Related("ahead-of" | "behind" as one, thing, to),
                Related("ahead-of" | "behind" as other, again, then),
            ),
            join="or",
        ) if one != other and thing == again:
            named = next((t for t in (to, then) if isinstance(t, Vehicle | Described)), None)
            return None if named is None else Compare((thing, named), "place")
    return None
