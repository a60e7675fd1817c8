"""Fragments: what takes its frame from the turn before: "and the bus?", "why not?"."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Doing,
    Elliptic,
    Feel,
    HowMuch,
    Repair,
    Request,
    Social,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Back,
    Ego,
    Event,
    Happens,
    Measured,
    Next,
    Nobody,
    Not,
    Pronoun,
    Proposition,
    Quantity,
    That,
    Thing,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.compose.adoption import adopted
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.nominal import asked_each, asked_of
from xavi_dialogue.nlu.compose.sem import Measure, Moment, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.suppositions import Suppositions, suppose
from xavi_dialogue.nlu.compose.tree import leaves_of
from xavi_dialogue.nlu.compose.wh import Wh, is_that
from xavi_dialogue.nlu.compose.whys import pace_asked, reason_for, sided
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

Found = list[tuple[tuple[Act, ...], float]]
_FORMS = {"why": "why", "which": "which", "when": "when", "where": "where", "how": "how",
          "what": "same", "who": "which"}  # fmt: skip
_STYLE = {
    "simpl": "simpler",
    "short": "shorter",
    "brief": "shorter",
    "long": "longer",
    "more": "longer",
    "less": "shorter",
}
_BARE = 0.3


class Fragments(Suppositions):
    """Reads fragments."""

    def __init__(self, composer: Any) -> None:
        self.composer = composer
        self.phrases = composer.phrases

    # --- question words with little behind them ----------------------

    def bare_question(self, unit: Node) -> Found:
        """Read "why not?", "how fast?", "which one?", "why not the first one?"."""
        wh_node, parts = self.composer.split(unit)
        wh = self.composer.questions.wh_of(wh_node)
        clause = self.phrases.slots.fill(tuple(parts))
        if wh.kind == "why":
            return self._bare_why(clause, parts)
        if wh.kind in ("grade", "count", "evidence"):
            return self._bare_grade(wh, clause)
        thing, event = self._contents(clause)
        if wh.kind == "which":
            return self._bare_which(wh, clause, thing)
        if wh.besides or clause.else_:
            return [((Elliptic(besides=True),), 0.0)]
        if wh.kind == "what":
            if _onward(unit, clause) and thing is None and event is None:
                return [((_next(unit),), 0.0)]
            if clause.verb is None and thing is None and isinstance(clause.time, Unsaid):
                return [((Repair("repeat"),), 0.1)]
            if not isinstance(clause.time, Unsaid) and thing is None and event is None:
                tense: Any = (
                    "future" if type(clause.time).__name__ in ("Next", "Within", "Back") else "past"
                )
                return [((Ask(Doing(Ego(), clause.time, tense)),), _BARE)]
        if wh.key == "whither" and thing is None and event is None:
            return [((Ask(Whither()),), 0.0)]
        form: Any = _FORMS.get(wh.kind, "same")
        if thing is not None and event is None and wh.kind in ("what", "who", "where"):
            found = self.composer.questions.of(wh, clause)
            return [((Ask(q),), cost + _BARE) for q, cost in found]
        if event is not None:
            found = self.composer.questions.of(wh, clause)
            return [((Ask(q),), cost + _BARE) for q, cost in found]
        return [((Elliptic(thing, event, clause.time, clause.negated, form),), 0.0)]

    def _bare_why(self, clause: Clause, parts: list[Part]) -> Found:
        pace = pace_asked(self.composer, clause)
        if pace is not None:
            return pace
        thing, event = self._contents(clause)
        negated = clause.negated or (event is not None and _denied(parts))
        if (
            thing is None
            and event is None
            and isinstance(clause.time, Unsaid)
            and clause.side is None
        ):
            if isinstance(clause.contrast, Clause):
                inner = self.composer.propositions.plain(clause.contrast)
                return [((Ask(Why(Not(inner or That()))),), 0.0)]
            if {leaf.key for leaf in clause.particles} & {"back", "over", "out", "in"}:
                going: Proposition = Happens(Event("go", tense="present"))
                return [((Ask(Why(Not(going) if negated else going)),), 0.05)]
            other = as_thing(clause.contrast) if not isinstance(clause.contrast, str) else None
            side = clause.contrast if isinstance(clause.contrast, str) else None
            event = sided(side) if side in ("left", "right", "straight") else None
            form: Any = "why-not" if negated else "why"
            if isinstance(clause.contrast, Event):
                return [((Ask(Why(Not(Happens(clause.contrast)))),), 0.0)]
            return [((Elliptic(other, event, negated=negated, form=form),), 0.0)]
        if event is None and clause.side is not None and not clause.skipped:
            event = sided(clause.side)
        if event is not None:
            happens: Proposition = Happens(event)
            return [((Ask(self.composer.questions.framed(
                Why(Not(happens) if negated else happens), clause, None)),), 0.05)]  # fmt: skip
        form = "why-not" if negated else "why"
        return [((Elliptic(thing, None, clause.time, negated, form),), 0.05)]

    def _bare_grade(self, wh: Wh, clause: Clause) -> Found:
        if clause.subject is None:
            things = [as_thing(sem) for sem, _ in clause.objects]
            clause.subject = things[0] if things and things[0] is not None else None
            clause.objects = clause.objects[1:] if clause.subject is not None else clause.objects
        found = self.composer.questions.of(wh, clause)
        return [((Ask(q),), cost + 0.1) for q, cost in found]

    def _bare_which(self, wh: Wh, clause: Clause, thing: Thing | None) -> Found:
        sem = wh.sem
        if wh.words[-1:] in (("way",), ("direction",)) and thing is None:
            return [((Ask(self.composer.questions.asking.which(wh, clause, None)),), 0.0)]
        if isinstance(sem, (Measure, Noun, Moment)) or (thing is not None and sem is not None):
            found = self.composer.questions.of(wh, clause)
            return [((Ask(q),), cost + 0.1) for q, cost in found]
        return [((Elliptic(as_thing(sem) or thing, form="which", besides=wh.besides),), 0.0)]

    # --- noun phrases, times, gerunds --------------------------------

    def _contents(self, clause: Clause) -> tuple[Thing | None, Event | None]:
        """Find the thing or the event that a fragment names."""
        if clause.verb is not None or clause.gerund is not None or clause.bare is not None:
            inner = clause if clause.verb is not None else clause.gerund or clause.bare
            if inner is not None:
                if inner.subject is None or is_that(inner.subject):
                    inner.subject = Ego()  # "all this weaving"
                found = self.composer.propositions.as_event(inner)
                if isinstance(found, Event):
                    return None, found
        sem: Sem | None = clause.objects[0][0] if clause.objects else None
        if sem is None and clause.complements:
            sem = clause.complements[0].sem
        if isinstance(sem, Event):
            return None, sem
        return as_thing(sem), None

    def fragment(self, unit: Node) -> Found:
        """Read a unit that is no clause."""
        clause = self.phrases.slots.fill(unit.parts)
        style = _style(unit)
        if style is not None and not clause.objects:
            return [((Repair(cast(Any, style)),), 0.0)]
        if any(key == "rude" for key, _ in clause.adjectives) and not clause.objects:
            return [((Social("insult"),), 0.1)]
        if clause.comparisons and not clause.objects:
            return self._compared(clause)
        if clause.feelings:
            return [((Feel(cast(Any, clause.feelings[0])),), 0.2)]
        if clause.question is not None:
            return self._embedded(clause)
        if clause.focus & {"really", "seriously", "truly", "honestly"} and not clause.objects:
            return [((Elliptic(form="sure"),), 0.0)]
        sem: Sem | None = clause.objects[0][0] if clause.objects else None
        if isinstance(sem, Quantity) and sem.unit == "count" and len(clause.objects) == 1:
            joined = any(isinstance(p, Leaf) and p.category == "AND" for p in unit.parts)
            if joined:  # "and 4?"
                return [((Elliptic(Vehicle(int(sem.value))),), 0.0)]
            return [((Repair("pick", pick=int(sem.value)),), 0.0)]
        if clause.side is not None and clause.chained and clause.chained[0][1].side is not None:
            self.composer.notes.taken.update(id(other) for _, other in clause.chained)
            return [((Ask(HowMuch(Measured("turn", time=clause.time))),), 0.0)]
        asked = self.noun_asked(sem, clause)
        found = asked if asked is not None else self.elliptic(unit, clause)
        return [(acts, cost + _unused(clause)) for acts, cost in found]

    def _compared(self, clause: Clause) -> Found:
        """Read "any less risky?", "safer?" as a comparison of what was spoken of."""
        clause.subject = Pronoun("that")
        compare = self.composer.questions.comparison(clause)
        return [((Ask(compare),), 0.2)] if compare is not None else []

    def _embedded(self, clause: Clause) -> Found:
        acts = self.composer.orders.embedded(clause)
        return [(acts, 0.4)] if acts else []

    def noun_asked(self, sem: Sem | None, clause: Clause) -> Found | None:
        """Read "speed?", "the reason for that?" as a question for it."""
        each = asked_each(sem, clause.time)
        if each:
            return [(tuple(Ask(question) for question in each), 0.1)]
        for phrase in clause.complements if isinstance(sem, Noun) else ():
            sem = cast(Noun, adopted(sem, phrase) or sem)
        if isinstance(sem, (Measure, Noun)):
            if clause.else_ or (isinstance(sem, Noun) and sem.other):
                return [((Elliptic(besides=True),), 0.1)]
            reason = reason_for(sem, clause)
            if reason is not None:
                return [((Ask(reason),), 0.1)]
            question = asked_of(_towards(sem, clause), clause.time)
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
        thing, event = self._contents(clause)
        if event is None and clause.side is not None and not clause.skipped:
            event = sided(clause.side)
        if thing is None and event is None and clause.bearings:
            thing = _at(clause.bearings[0][0])
        supposed = self.composer.questions.supposition(clause)
        if supposed is not None and thing is None and event is None:
            return [((suppose(supposed),), 0.0)]
        if clause.because is not None and thing is None:
            thing = as_thing(clause.because) if not isinstance(clause.because, Clause) else None
            return [((Elliptic(thing, form="why"),), 0.0)]
        if clause.else_:
            return [((Elliptic(besides=True),), 0.1)]
        if thing is None and event is None and isinstance(clause.time, Unsaid):
            return []
        if isinstance(thing, Nobody) and thing.described is not None:
            denied = thing.described
            if denied.kind == "vehicle" and (denied.colour or denied.bearing or denied.other):
                return [((Repair("meant", structs.replace(denied, definite=True)),), 0.0)]
        no = any(isinstance(p, Leaf) and p.category == "NO" for p in unit.parts)
        if no and thing is not None:
            return [((Repair("meant", thing),), 0.0)]
        if event is not None and _is_deed(unit):
            return [((Elliptic(thing, event, clause.time, negated),), 0.1),
                    ((Request(event),), 0.4)]  # fmt: skip
        return [((Elliptic(thing, event, clause.time, negated),), 0.1)]

    def short(self, clause: Clause) -> Found:
        """Read "is it?", "did he?", "are you?": whether what was said is so."""
        if clause.adjectives or clause.verb is not None:
            return []
        that: Proposition = That()
        if isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that"):
            return [((Ask(Whether(that)),), 0.3)]
        return [((Elliptic(as_thing(clause.subject), negated=clause.negated),), 0.4)]

    # --- "what about", "what if" -------------------------------------


def _unused(clause: Clause) -> float:
    """Say what costs that stands in a fragment beside the thing that it names."""
    that = 0.5 if clause.that is not None and clause.objects else 0.0
    return that + 0.9 * max(0, len(clause.objects) - 1) + 0.4 * len(clause.adjectives)


def _towards(sem: Measure | Noun, clause: Clause) -> Measure | Noun:
    """Add to a measure the thing that it is to: "minimum gap to vehicle 2"."""
    if not isinstance(sem, Measure) or sem.of.to is not None:
        return sem
    things = [as_thing(c.sem) for c in clause.complements if c.key in ("into", "with", "from")]
    to = next((thing for thing in things if thing is not None), None)
    return sem if to is None else replace(sem, of=structs.replace(sem.of, to=to))


_ONWARD = frozenset({"now", "next", "then", "after-that"})


def _onward(unit: Node, clause: Clause) -> bool:
    """Say whether it is asked what comes: "what now?", "what next?", "and then what?"."""
    words = {word for part in unit.parts for leaf in leaves_of(part) for word in leaf.words}
    return clause.verb is None and bool(words & _ONWARD) and "how" not in words


def _next(unit: Node) -> Act:
    """Ask what comes next, or after what was spoken of."""
    words = {word for part in unit.parts for leaf in leaves_of(part) for word in leaf.words}
    if "then" in words or "after" in words:
        return Elliptic(time=Back("after"))
    return Ask(Doing(Ego(), Next(), "future"))


def _at(bearing: str) -> Thing | None:
    from xavi_dialogue.domain.terms import Described

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


def _denied(parts: list[Part]) -> bool:
    """Say whether an event is denied by its article: "why no left turn"."""
    leaves = [leaf for part in parts for leaf in leaves_of(part)]
    return any(leaf.category in ("DET", "NO") and leaf.key == "no" for leaf in leaves)
