"""Bare questions: question words with little after them: "why not?", "how fast?"."""

from typing import Any

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Doing,
    Elliptic,
    HowLong,
    HowMany,
    HowMuch,
    Question,
    Repair,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Back,
    Described,
    Ego,
    Event,
    Happens,
    Measured,
    Next,
    Not,
    Pronoun,
    Proposition,
    Relative,
    That,
    Thing,
    Unsaid,
)
from xavi_dialogue.nlu.compose.alternatives.blames import blaming, causes_taken
from xavi_dialogue.nlu.compose.clauses.adoption import adopted, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import PASSED_OVER, Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Moment, Noun, Sem, as_lane, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.compose.refining.setting_off import set_off_late
from xavi_dialogue.nlu.compose.suppositions import Suppositions
from xavi_dialogue.nlu.compose.wh_questions.wh import NEXT, Wh, is_that
from xavi_dialogue.nlu.compose.wh_questions.whys import pace_asked, sided
from xavi_dialogue.nlu.grammar.chart import Node, Part

Found = list[tuple[tuple[Act, ...], float]]
_FORMS = {"why": "why", "which": "which", "when": "when", "where": "where", "how": "how",
          "what": "same", "who": "which"}  # fmt: skip
_BARE = 0.3
_YET = frozenset({"still", "yet"})
_AMOUNT = frozenset(
    ["and", "but", "so", "by", "how", "much", "more", "less", "exactly", "roughly", "about", "then"]
)
_ONWARD = frozenset({"now", "next", "then", "after-that"})


class BareQuestions(Suppositions):
    """Reads question words with little after them."""

    def bare_question(self, unit: Node) -> Found:
        """Read "why not?", "how fast?", "which one?", "why not the first one?"."""
        wh_node, parts = self.composer.split(unit)
        wh = self.composer.questions.wh_of(wh_node)
        clause = self.phrases.slots.fill(tuple(parts))
        if wh.kind == "why":
            causes = causes_taken(clause.bare or clause, self.composer.notes)
            found = self._bare_why(clause, parts)
            return [(tuple(_blaming(act, causes) for act in acts), cost) for acts, cost in found]
        if wh.key == "much" and _words(unit) <= _AMOUNT:
            return [((Elliptic(form="how-much"),), 0.05)]
        if wh.kind in ("grade", "count", "evidence"):
            return self._bare_grade(wh, clause)
        thing, event = self._contents(clause)
        if wh.kind == "which":
            return self._bare_which(wh, clause, thing)
        if wh.besides or clause.else_:
            who = Elliptic(SOMEBODY_ELSE) if wh.kind == "who" and event is None else None
            return [((who or Elliptic(besides=True),), 0.0)]
        free = wh.kind in ("what", "where") and thing in (None, NEXT) and event is None
        if free and _onward(unit, clause):
            return [((_next(unit),), 0.0)]
        if wh.kind == "what" and _words(unit) & {"like", "such"} and clause.verb is None:
            return [((Elliptic(form="which"),), 0.0)]  # "like what?", "such as what?"
        if wh.kind == "what":
            if clause.verb is None and thing is None and isinstance(clause.time, Unsaid):
                return [((Repair("repeat"),), 0.1)]
            if not isinstance(clause.time, Unsaid) and thing is None and event is None:
                tense: Any = (
                    "future" if type(clause.time).__name__ in ("Next", "Within", "Back") else "past"
                )
                return [((Ask(Doing(Ego(), clause.time, tense)),), _BARE)]
        if wh.key == "whither" and thing in (None, NEXT) and event is None:
            return [((Ask(Whither()),), 0.0)]
        form: Any = _FORMS.get(wh.kind, "same")
        if thing is not None and event is None and wh.kind in ("what", "who", "where"):
            found = self.composer.questions.of(wh, clause)
            return [((Ask(q),), cost + _BARE) for q, cost in found]
        if event is not None:
            found = self.composer.questions.of(wh, clause)
            return [((Ask(q),), cost + _BARE) for q, cost in found]
        if form == "when" and _words(unit) & {"until", "till"}:
            form = "until"
        past = 0.0 if clause.that is None else PASSED_OVER
        return [((Elliptic(thing, event, clause.time, clause.negated, form),), past)]

    def _bare_why(self, clause: Clause, parts: list[Part]) -> Found:
        pace = pace_asked(self.composer, clause)
        if pace is not None:
            return [(tuple(self._set_off(act, clause) for act in acts), c) for acts, c in pace]
        told = None if clause.that is None else self.composer.propositions.plain(clause.that)
        if told is not None:
            return [((Ask(Why(told)),), _BARE)]  # "now you tuck in behind him, what for?"
        thing, event = self._contents(clause)
        if clause.contrast is not None and thing == Pronoun("that") and event is None:
            other = self.composer.questions.contrast(clause, That())
            if other is not None:  # "why that and not continue?"
                return [((Ask(Why(That(), other)),), 0.0)]
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
            why = self.composer.questions.framed(
                Why(Not(happens) if negated else happens), clause, None)  # fmt: skip
            return [((self._set_off(Ask(why), clause.bare or clause),), 0.05)]
        form = "why-not" if negated else "why"
        return [((Elliptic(thing, None, clause.time, negated, form),), 0.05)]

    def _set_off(self, act: Act, clause: Clause) -> Act:
        """Read "why so slow off the line?" as why we did not go at once."""
        propose = self.composer.propositions.plain
        late = set_off_late(clause, act.question, propose) if isinstance(act, Ask) else None
        return act if late is None else Ask(late)

    def _bare_grade(self, wh: Wh, clause: Clause) -> Found:
        if clause.subject is None:
            things = [as_thing(sem) for sem, _ in clause.objects]
            clause.subject = things[0] if things and things[0] is not None else None
            clause.objects = clause.objects[1:] if clause.subject is not None else clause.objects
        if clause.bare is not None or clause.gerund is not None:
            clause = clause.bare or clause.gerund or clause
        if wh.key == "long" and _empty(clause) and _still(wh, clause):
            return [((Ask(HowMuch(Measured("time-to-go"))),), 0.05)]
        longer = "now" in clause.focus or not {"longer", "more"}.isdisjoint(wh.words)
        if wh.key == "long" and _empty(clause) and longer:  # "how long now?"
            going_on = Measured("duration", Pronoun("this"), tense="future")
            return [((Ask(HowMuch(going_on)),), 0.05)]
        if wh.key == "long" and _empty(clause):
            return [((Ask(HowLong(That())),), 0.05)]
        onward = not {"further", "farther"}.isdisjoint(wh.words)
        onward |= wh.key == "far" and _still(wh, clause)
        if wh.key in ("far", "close") and _empty(clause) and not onward:
            return [((Ask(HowMuch(Measured("distance", Pronoun("it")))),), 0.05)]
        if wh.key == "fast" and _empty(clause):
            return [((Ask(HowMuch(Measured("speed", Pronoun("one")))),), 0.05)]
        found = self.composer.questions.of(wh, clause)
        return [((Ask(_still_to_come(q, clause)),), cost + 0.1) for q, cost in found]

    def _bare_which(self, wh: Wh, clause: Clause, thing: Thing | None) -> Found:
        sem = wh.sem
        if wh.words[-1:] in (("way",), ("direction",)) and thing is None:
            return [((Ask(self.composer.questions.asking.which(wh, clause, None)),), 0.0)]
        if isinstance(sem, Measure) and thing is not None and clause.subject is None:
            clause.subject = thing  # "the first one, which colour?"
        if isinstance(sem, (Measure, Noun, Moment)) or (thing is not None and sem is not None):
            found = self.composer.questions.of(wh, clause)
            return [((Ask(q),), cost + 0.1) for q, cost in found]
        return [((Elliptic(as_thing(sem) or thing, form="which", besides=wh.besides),), 0.0)]

    def _contents(self, clause: Clause) -> tuple[Thing | None, Event | None]:
        """Find the thing or the event in a fragment; return (thing, event), one of them None."""
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
            place = clause.complements[0]
            sem = place.sem
            if place.key.startswith("bearing-") and (other := as_thing(sem)) is not None:
                bearing: Any = place.key.removeprefix("bearing-")  # "and behind us?"
                return Described(bearing=bearing, of=None if other == Ego() else other), None
        if isinstance(sem, Event):
            return None, sem
        for phrase in clause.complements if isinstance(sem, Described) else ():
            sem = adopted(sem, phrase) or sem  # "the one in the left lane"
        return as_thing(sem) or as_lane(sem), None


def _blaming(act: Act, causes: tuple[Thing, ...]) -> Act:
    return Ask(blaming(act.question, causes)) if isinstance(act, Ask) else act


def _still(wh: Wh, clause: Clause) -> bool:
    """Check whether a question is about what remains: "how long still?", "how far yet?"."""
    return clause.still or not _YET.isdisjoint((*clause.focus, *wh.words))


def _words(unit: Node) -> set[str]:
    return {word for part in unit.parts for leaf in leaves_of(part) for word in leaf.words}


def _onward(unit: Node, clause: Clause) -> bool:
    """Check whether a question is about what comes next: "what now?", "and then what?"."""
    words = _words(unit)
    return clause.verb is None and bool(words & _ONWARD) and "how" not in words


def _next(unit: Node) -> Act:
    """Return the question what comes next, or what came after the event in question."""
    words = _words(unit)
    if "then" in words or "after" in words:
        return Elliptic(time=Back("after"))
    return Ask(Doing(Ego(), Next(), "future"))


def _denied(parts: list[Part]) -> bool:
    """Check whether an article negates an event: "why no left turn"."""
    leaves = [leaf for part in parts for leaf in leaves_of(part)]
    return any(leaf.category in ("DET", "NO") and leaf.key == "no" for leaf in leaves)


def _empty(clause: Clause) -> bool:
    """Check whether only a preposition follows a question word: "how long for?"."""
    said = (clause.subject, clause.objects, clause.bearings, clause.side, clause.verb,
            clause.infinitive, clause.condition)  # fmt: skip
    stranded = all(phrase.sem is None for phrase in clause.complements)
    return not any(said) and stranded and isinstance(clause.time, Unsaid)


def _still_to_come(question: Question, clause: Clause) -> Question:
    """Put "how many turns till we're there" into the future."""
    match question, clause.time:
        case HowMany(of=Event() as event), Relative(relation="until" | "before"):
            return HowMany(with_fields(event, tense="future", time=Unsaid()))
    return question
