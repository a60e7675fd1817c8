"""Options: questions which of several things or actions it is, and which of them is better."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import Compare, Question, Which
from xavi_dialogue.domain.terms import (
    Caused,
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Next,
    Passenger,
    Pronoun,
    Related,
    That,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.compose.alternatives.choosing import (
    by_of,
    in_line,
    least_of,
    ranked_by,
    superlative_of,
)
from xavi_dialogue.nlu.compose.alternatives.comparing import BY
from xavi_dialogue.nlu.compose.alternatives.effects import Effects
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Noun, Sem, as_thing, is_thing
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh, fact

WEAK = 1.0  # cost of a comparison of things by nothing in particular
_YIELDS = frozenset({"give-way", "let-go", "wait"})
_MATTERING = frozenset({"matter", "influence", "cause"})

#: Things that are no alternatives, since they identify nobody: "a man", "somebody".
_SORTS = (Described(definite=False), Described(kind="pedestrian", definite=False))


class Options(Effects):
    """Builds questions that choose between things or actions."""

    def one_of(self, wh: Wh, clause: Clause, options: tuple[Any, ...]) -> tuple[Question, float]:
        """Return the question which of some things or actions it is, and what it costs."""
        things = all(is_thing(option) for option in options)
        if things and (behind := in_line(clause)) is not None:
            return Compare(options, "place", behind), 0.1
        first = self._first_of(wh, clause, options)
        if first is not None:
            return first, 0.1
        if things and (most := superlative_of(clause)) is not None:
            return Compare(options, cast(Any, most[0]), most[1]), 0.1
        by = "time" if "first" in clause.manner else "best"
        if clause.comparisons:
            by = by_of(clause) if things else BY.get(clause.comparisons[0][0], "best")
        least = things and least_of(clause)
        return Compare(options, cast(Any, by), least), 0.1 + WEAK * (things and by == "best")

    def _first_of(self, wh: Wh, clause: Clause, options: tuple[Any, ...]) -> Question | None:
        """Read "who goes first, we or the bus": the question who has to let the other go."""
        other = next((one for one in options if not isinstance(one, Ego)), None)
        bare = clause.verb is None and not (clause.comparisons or clause.adjectives)
        if isinstance(clause.time, Next) and bare:
            going = Event("go", Wanted(), other, None, ("first",), tense="present", modal="should")
            return Which(Wanted(), Happens(going))
        found = self.propositions.readings(clause)
        said = fact(found[0].value) if found and clause.verb is not None else None
        open_to = getattr(getattr(said, "event", None), "object", None)
        others = all(is_thing(one) and not isinstance(one, Ego) for one in options)
        if (others or open_to == Wanted()) and said is not None and not clause.comparisons:
            return Which(Wanted(), said, options)
        match fact(found[0].value) if found else None:
            case Related(relation="has-priority-over") as related if several(options):
                return Which(Wanted(), with_fields(related, to=Everyone()), rivals(options))
            case Related(relation="has-priority-over" | "must-yield-to") as related:
                return Which(Wanted(), with_fields(related, to=other))
            case Happens(event=event) as order if "first" in event.manner and several(options):
                return Which(Wanted(), order, rivals(options))
            case Happens(event=event) if event.action in _YIELDS or "first" in event.manner:
                return Which(Wanted(), Happens(with_fields(event, object=other)))
        if wh.kind == "who" and Ego() in options and other is not None and not clause.comparisons:
            going = Event("go", Wanted(), other, None, ("first",), tense="present", modal="should")
            return Which(Wanted(), Happens(going))
        return None

    def compared(self, wh: Wh, clause: Clause, value: Any) -> Question | None:
        """Read "which is faster, left or right"."""
        if wh.kind == "why":
            return self.outdone(clause)
        most = superlative_of(clause)
        if most is None and several_of(wh.of) == Pronoun("them-all"):
            most = ranked_by(clause)
        if wh.kind not in ("which", "what", "who") or not (clause.comparisons or most):
            return None
        if most is not None:
            those = several_of(wh.of) or several_of(wh.sem)
            return None if those is None else Compare((those,), cast(Any, most[0]), most[1])
        deeds = self.deeds(clause)
        if deeds:
            return Compare(deeds, cast(Any, BY.get(clause.comparisons[0][0], "best")))
        options = [sem for sem, _ in clause.objects if isinstance(sem, Group)]
        if options:
            return Compare(tuple(_option(s) for s in options[0].members),
                           cast(Any, BY.get(clause.comparisons[0][0], "best")))  # fmt: skip
        those = _those(wh, clause)
        if those is None or clause.than is not None:
            return None
        return Compare((those,), cast(Any, by_of(clause)), least_of(clause))

    def mattering(self, wh: Wh, clause: Clause, options: tuple[Any, ...] | None) -> Question | None:
        """Read "which of the two mattered more", "who was the main reason, he or the bus"."""
        nouns = [sem for sem, _ in clause.objects if isinstance(sem, Noun)]
        reasons = any(sem.key in ("reason", "factor") for sem in nouns)
        verb = clause.verb is not None and clause.verb.key in _MATTERING
        weighty = bool(clause.comparisons) and clause.comparisons[0][0] == "important"
        if wh.kind not in ("which", "what", "who") or not (verb or reasons or weighty):
            return None
        things = options is not None and all(is_thing(option) for option in options)
        those = _those(wh, clause) if options is None else None
        among = options if things and options is not None else () if those is None else (those,)
        return Which(Wanted(), Caused(Wanted(), That()), among) if among else None


def _those(wh: Wh, clause: Clause) -> Thing | None:
    """Return the things to choose from, if the question names several; None otherwise."""
    among = [wh.of, wh.sem, *(c.sem for c in clause.complements if c.key == "of")]
    those = next((thing for sem in among if (thing := several_of(sem)) is not None), None)
    bare = wh.kind == "which" and wh.sem is None and wh.of is None and clause.gap is None
    if those is None and (bare or {"them", "those", "these", "both"} & set(wh.words)):
        return Pronoun("them-all")
    return those


def rivals(options: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the options other than the ego."""
    return tuple(one for one in options if not isinstance(one, Ego))


def several_of(sem: Sem | None) -> Thing | None:
    """Return the things to choose from in "which of them", "which of the two trucks"."""
    if isinstance(sem, Pronoun) and sem.form in ("they", "them-all"):
        return Pronoun("them-all")
    many = isinstance(sem, Described) and sem.definite and sem.plural
    return sem if many and isinstance(sem, Described) and sem.number else None


def several(options: tuple[Any, ...]) -> bool:
    """Check whether there is more than one option besides the ego."""
    return len(rivals(options)) > 1


def alternatives(clause: Clause) -> tuple[Any, ...] | None:
    """Take alternatives such as "we or the blue one" out of a clause; None: it has none."""
    named = _named(clause)
    if named is not None and all(option in _SORTS for option in named):
        return None  # "a man or a lady?"
    return named


def _named(clause: Clause) -> tuple[Any, ...] | None:
    for index, (sem, part) in enumerate(clause.objects):
        if isinstance(sem, Group) and sem.join == "or":
            del clause.objects[index]
            owned, *others = sem.members
            if isinstance(owned, Measure) and len(others) > 1:  # "priority, the lorry or us"
                clause.objects.insert(index, (owned, part))
                return tuple(_option(member) for member in others)
            named = tuple(_option(member) for member in sem.members)
            if others and all(option in _SORTS for option in named[1:]):
                clause.objects.insert(index, (owned, part))
                return None  # "who is driving the black one, a man or a lady?"
            return named
    for index, (join, other) in enumerate(clause.chained):
        if join == "or" and clause.objects and _is_option(other):
            del clause.chained[index]
            first, _ = clause.objects.pop()
            return _option(first), _option(other.objects[0][0])
    done = clause.bare  # "what made you slow down, the bend or the bus?"
    return None if done is None or done.comma < 0 else _named(done)


def _is_option(other: Clause) -> bool:
    """Check whether there is nothing but a thing after "or"."""
    more = (other.complements, other.adjectives, other.bearings, other.manner, other.particles)
    return len(other.objects) == 1 and is_thing(other.objects[0][0]) and not any(more)


def _option(sem: Sem) -> Any:
    if isinstance(sem, Event):
        return Happens(sem)
    thing = as_thing(sem) or Pronoun("that")
    return Ego() if isinstance(thing, Passenger) else thing  # "me or the one on the right"
