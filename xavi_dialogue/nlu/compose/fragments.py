"""Fragments: what takes its frame from the turn before: "and the bus?", "why not?"."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Ask,
    Elliptic,
    Feel,
    HowMuch,
    Repair,
    Request,
    Social,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Measured,
    Nobody,
    Pronoun,
    Proposition,
    Quantity,
    That,
    Thing,
    Together,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.compose.alternatives.blames import causes_named, whom_of
from xavi_dialogue.nlu.compose.bare import BareQuestions, Found
from xavi_dialogue.nlu.compose.clauses.adoption import adopted
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import asked_of, propose
from xavi_dialogue.nlu.compose.clauses.sem import (
    Group,
    Measure,
    Noun,
    Sem,
    as_thing,
    is_thing,
    members_of,
)
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of, words_of
from xavi_dialogue.nlu.compose.propositions.severally import asked_each, towards
from xavi_dialogue.nlu.compose.refining.turns import TURNS, turns_to_come
from xavi_dialogue.nlu.compose.states.states import state_of
from xavi_dialogue.nlu.compose.suppositions import suppose
from xavi_dialogue.nlu.compose.talk import bodily
from xavi_dialogue.nlu.compose.wh_questions.whys import reason_for, sided
from xavi_dialogue.nlu.compose.wishes import bare_wish
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_ANY = frozenset({"any", "anybody", "anyone", "anything"})
_THINGS = frozenset({"something", "anything", "another"})
_CAUSES = 0.4  # cost of naming causes alone: "for the bus or for the turn?"
_TURNING = frozenset({"turn", "exit-left", "exit-right"})
_STYLE = {
    "simpl": "simpler",
    "short": "shorter",
    "brief": "shorter",
    "long": "longer",
    "more": "longer",
    "less": "shorter",
}


class Fragments(BareQuestions):
    """Reads fragments."""

    def __init__(self, composer: Any) -> None:
        self.composer = composer
        self.phrases = composer.phrases

    # --- noun phrases, times, gerunds --------------------------------

    def fragment(self, unit: Node) -> Found:
        """Read a unit that is no clause."""
        clause = self.phrases.slots.fill(unit.parts)
        style = _style(unit)
        if style is not None and not clause.objects:
            return [((Repair(cast(Any, style)),), 0.0)]
        if any(key == "rude" for key, _ in clause.adjectives) and not clause.objects:
            return [((Social("insult"),), 0.1)]
        if self.composer.asks and clause.still and not clause.objects:
            clause.subject, clause.aux = Ego(), ["be-present"]  # "still behind that van?"
            return [((Ask(q),), cost) for q, cost in self.composer.questions.whether(clause)]
        felt = bodily(clause)
        if felt is not None:
            return [((felt,), 0.0)]
        polite = any("please" in leaf.words for leaf in leaves_of(unit))
        wish = bare_wish(clause, polite=polite)
        if wish is not None:
            return [((wish,), 0.0)]
        if clause.comparisons and not clause.objects:
            return self._compared(clause)
        if clause.feelings:
            return [((Feel(cast(Any, clause.feelings[0])),), 0.2)]
        if clause.question is not None:
            return self._embedded(clause)
        if clause.focus & {"really", "seriously", "truly", "honestly"} and not clause.objects:
            return [((Elliptic(form="sure"),), 0.0)]
        sem: Sem | None = clause.objects[0][0] if clause.objects else None
        counted = isinstance(sem, Quantity) and sem.unit == "count" and clause.condition is None
        if counted and isinstance(sem, Quantity) and len(clause.objects) == 1:
            joined = any(isinstance(p, Leaf) and p.category == "AND" for p in unit.parts)
            if joined:  # "and 4?"
                return [((Elliptic(Vehicle(int(sem.value))),), 0.0)]
            return [((Repair("pick", pick=int(sem.value)),), 0.0)]
        if clause.side is not None and clause.chained and clause.chained[0][1].side is not None:
            self.composer.notes.taken.update(id(other) for _, other in clause.chained)
            return [((Ask(HowMuch(Measured("turn", time=clause.time))),), 0.0)]
        judged = self._judged(sem, clause) or self._past(unit, clause)
        if judged is not None:
            return judged
        found = self.noun_asked(sem, clause)
        if found is None:  # what is stated behind a name or a time has no place in what is elliptic
            found = self.elliptic(unit, clause) if clause.that is None else []
        return [(acts, cost + _unused(clause)) for acts, cost in found]

    def _compared(self, clause: Clause) -> Found:
        """Read "any less risky?", "safer?" as a comparison of what was spoken of."""
        clause.subject = Pronoun("that")
        compare = self.composer.questions.comparison(clause)
        return [((Ask(compare),), 0.2)] if compare is not None else []

    def _judged(self, sem: Sem | None, clause: Clause) -> Found | None:
        """Read "that black car, dangerous?" as whether it is."""
        if not is_thing(sem) or not clause.adjectives or len(clause.objects) != 1:
            return None
        states = state_of(Clause(subject=sem, adjectives=clause.adjectives, time=clause.time))
        return [((Ask(Whether(found)),), cost + 0.2) for found, cost in states[:1]] or None

    def _past(self, unit: Node, clause: Clause) -> Found | None:
        """Read "straight past the bus from here, yes?" as whether we overtake it."""
        asks = self.composer.asks or any(leaf.category == "TAGWORD" for leaf in leaves_of(unit))
        for phrase in clause.complements if asks and clause.subject is None else ():
            words = set(words_of(phrase.node).split()[:2])
            thing = as_thing(phrase.sem)
            if words & {"past", "round", "around"} and isinstance(thing, Described | Vehicle):
                event = Event("overtake", object=thing, tense="future")
                return [((Ask(Whether(Happens(event))),), 0.1)]
        return None

    def _embedded(self, clause: Clause) -> Found:
        acts = self.composer.orders.embedded(clause)
        return [(acts, 0.4)] if acts else []

    def noun_asked(self, sem: Sem | None, clause: Clause) -> Found | None:
        """Read "speed?", "the reason for that?" as a question for it."""
        each = asked_each(sem, clause)
        if each:
            return [(tuple(Ask(question) for question in each), 0.1)]
        if isinstance(sem, Noun) and sem.key == "time" and isinstance(sem.of, Measure):
            sem = sem.of  # "time of the closest approach to vehicle 3"
        for phrase in clause.complements if isinstance(sem, Noun) else ():
            sem = cast(Noun, adopted(sem, phrase) or sem)
        if isinstance(sem, (Measure, Noun)):
            if clause.else_ or (isinstance(sem, Noun) and sem.other):
                return [((Elliptic(besides=True),), 0.1)]
            reason = reason_for(sem, clause)
            if reason is not None:
                return [((Ask(reason),), 0.1)]
            question = asked_of(towards(sem, clause.complements), clause.time)
            if question is None:
                return None
            return [((Ask(self.composer.questions.framed(question, clause, None)),), 0.1)]
        return None

    def elliptic(self, unit: Node, clause: Clause) -> Found:
        negated = clause.negated or clause.contrast is not None
        if clause.contrast is not None and not clause.objects:
            other = clause.contrast
            if isinstance(other, Clause):
                clause.bare = other
            elif isinstance(other, str):
                clause.side = other
            else:
                clause.objects.append((other, unit))
        if clause.verb is None and (causes := causes_named(clause)) is not None:
            self.composer.notes.taken.update(id(other) for _, other in clause.chained)
            return [((Elliptic(Together(causes), form="which"),), _CAUSES)]
        thing, event = self._contents(clause)
        if event is None and clause.side is not None and not clause.skipped:
            event = sided(clause.side)
        if thing is None and event is None and clause.bearings:
            thing = _at(clause.bearings[0][0])
        if thing is None and event is None and clause.origin is not None:
            thing = Described(origin=cast(Any, clause.origin), definite=False)
        if thing is None and event is None and _there_yet(clause):
            return [((Ask(Whether(Happens(Event("arrive", tense="perfect")))),), 0.0)]
        if clause.without is not None and thing is not None and event is None:
            clause.without, thing = Group((*members_of(clause.without), thing)), None
        supposed = self.composer.questions.supposition(clause)
        if supposed is not None and thing is None and event is None:
            return [((suppose(supposed),), 0.0)]
        deed = None if isinstance(clause.because, Clause) else propose(clause.because)
        if isinstance(deed, Happens) and words_of(unit).startswith("cause of"):
            return [((Ask(Why(deed)),), 0.0)]  # "cause of deceleration?"
        if clause.because is not None and thing is None:
            thing = self._cause(clause.because)
            if thing is None or thing == Pronoun("who"):
                return [((Elliptic(thing, form="why"),), 0.0)]
            return [((Ask(Why(That(), suspect=thing)),), 0.0)]
        if clause.else_:
            return [((Elliptic(besides=True),), 0.1)]
        if thing is None and event is None and isinstance(clause.time, Unsaid):
            return []
        if event is None and isinstance(thing, Described) and _is_any(unit, thing):
            return [((Ask(Whether(Exists(thing, clause.time))),), 0.0)]
        if thing in (SOMEBODY_ELSE, Nobody(SOMEBODY_ELSE)) and event is None:
            # "Or something else?" may be of no vehicle.
            cost = 0.0 if _THINGS.isdisjoint(words_of(unit).split()) else 0.1
            return [((Elliptic(SOMEBODY_ELSE, time=clause.time),), cost)]
        if isinstance(thing, Nobody) and thing.described is not None:
            denied = thing.described
            if denied.kind == "vehicle" and (denied.colour or denied.bearing or denied.other):
                return [((Repair("meant", structs.replace(denied, definite=True)),), 0.0)]
        no = any(isinstance(p, Leaf) and p.category == "NO" for p in unit.parts)
        if no and thing is not None:
            return [((Repair("meant", thing),), 0.0)]
        if event is not None and event.action in TURNS and _is_more(unit):
            return [((Ask(turns_to_come(event.action)),), 0.0)]  # "any more turns?"
        if event is not None and _is_deed(unit):
            return [((Elliptic(thing, event, clause.time, negated),), 0.1),
                    ((Request(event),), 0.4)]  # fmt: skip
        return [((Elliptic(thing, event, clause.time, negated),), 0.1)]

    def _cause(self, because: Sem | Clause) -> Thing | None:
        """Give whom a cause is of: "(or) because he was too close?"."""
        if not isinstance(because, Clause):
            return as_thing(because)
        found = self.composer.propositions.plain(because)
        return None if found is None else whom_of(found)

    def short(self, clause: Clause) -> Found:
        """Read "is it?", "did he?", "are you?": whether what was said is so."""
        if clause.adjectives or clause.verb is not None:
            return []
        that: Proposition = That()
        if clause.has("semi-must") or clause.has("semi-allowed"):
            modal: Any = "must" if clause.has("semi-must") else "can"
            deed = Event("do", as_thing(clause.subject) or Ego(), Pronoun("that"), modal=modal,
                         tense=cast(Any, clause.tense))  # fmt: skip
            return [((Ask(Whether(Happens(deed))),), 0.1)]  # "did you have to?"
        if isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that"):
            return [((Ask(Whether(that)),), 0.3)]
        return [((Elliptic(as_thing(clause.subject), negated=clause.negated),), 0.4)]


def _unused(clause: Clause) -> float:
    """Say what costs that stands in a fragment beside the thing that it names."""
    that = 0.5 if clause.that is not None else 0.0
    return that + 0.9 * max(0, len(clause.objects) - 1) + 0.4 * len(clause.adjectives)


def _is_more(unit: Node) -> bool:
    return any(leaf.category == "DET" and leaf.key == "many" for leaf in leaves_of(unit))


def _there_yet(clause: Clause) -> bool:
    """Say whether a fragment asks if we have arrived: "nearly there?", "there yet?"."""
    there = [bearing for bearing, _ in clause.bearings] == ["there"]
    return there and bool(clause.focus & {"nearly", "almost", "yet", "already", "finally"})


def _at(bearing: str) -> Thing | None:
    if bearing in ("here", "there", "around"):
        return None
    return Described(bearing=cast(Any, bearing))


def _style(unit: Node) -> str | None:
    words = [w for part in unit.parts for leaf in _words(part) for w in leaf.words]
    compar = [leaf for part in unit.parts for leaf in _words(part) if leaf.category == "COMPAR"]
    if not compar or len(words) > 4:
        return None
    for stem, kind in _STYLE.items():
        if compar[0].words[-1].startswith(stem):
            return kind
    return None


def _words(part: Part) -> list[Leaf]:
    return list(leaves_of(part))


def _is_deed(unit: Node) -> bool:
    return any(isinstance(p, Node) and p.name == "bare" for p in unit.parts)


def _is_any(unit: Node, thing: Described) -> bool:
    """Check whether it is asked if there is any such: "anything I should fear?", "any on foot?"."""
    told = thing.such is not None or thing.bearing is not None
    return not thing.definite and told and not _ANY.isdisjoint(words_of(unit).split())
