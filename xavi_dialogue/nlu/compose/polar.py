"""Polar questions: whether something is so, and which of two deeds is better."""

from dataclasses import replace
from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Compare,
    Fault,
    HowSure,
    Question,
    WhatWouldChange,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Caused,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Pronoun,
    Proposition,
    That,
    Thing,
)
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.frames import Frames
from xavi_dialogue.nlu.compose.nominal import asked_of
from xavi_dialogue.nlu.compose.sem import (
    Noun,
    Sem,
    as_thing,
    is_thing,
)
from xavi_dialogue.nlu.compose.wh import fact, prevented

BY = {
    "fast": "time",
    "soon": "time",
    "safe": "safety",
    "dangerous": "safety",
    "comfortable": "comfort",
    "better": "best",
    "close": "distance",
    "far": "distance",
    "big": "size",
    "small": "size",
    "likely": "probability",
    "slow": "time",
    "long": "time",
    "efficient": "best",
    "late": "time",
    "hard": "comfort",
    "high": "best",
    "low": "best",
    "important": "best",
    "first": "time",
}


class Polar(Frames):
    """Builds yes or no questions."""

    def whether(self, clause: Clause, *, tag: bool = False) -> list[tuple[Question, float]]:
        """Build the yes or no questions of a clause."""
        compare = self.comparison(clause) or self._existing(clause)
        if compare is not None:
            return [(self.framed(compare, clause, None), 0.0)]
        found: list[tuple[Question, float]] = []
        for candidate in self.propositions.readings(clause):
            question = self.polar(clause, candidate.value, tag=tag)
            found.append((self.framed(question, clause, candidate.value), candidate.cost))
        return found

    def _existing(self, clause: Clause) -> Question | None:
        """Ask "is there a reason you are waiting", "do we have another option"."""
        if not clause.there or not clause.objects or clause.negated:
            return None
        sem = clause.objects[0][0]
        if not isinstance(sem, Noun) or sem.key in ("problem", "sight", "side", "truth"):
            return None
        if clause.that is not None and sem.clause is None:
            sem = replace(sem, clause=self.propositions.plain(clause.that))
        return asked_of(sem, clause.time, clause.tense)

    def polar(self, clause: Clause, value: Any, *, tag: bool) -> Question:
        if isinstance(value, Special):
            special = self._whether_special(clause, value)
            if special is not None:
                return special
        of = self.propositions.joined(clause, fact(value))
        match of:
            case Is(state="at-fault", thing=thing, event=event):
                return Fault(Happens(event) if event is not None else None, thing)
            case Is(state="sure", thing=Ego()):
                return HowSure(self._sure_of(clause), clause.time)
            case Caused(cause=cause, effect=effect) if is_thing(cause):
                return Why(effect or That(), suspect=cast(Thing, cause))
        if clause.because is not None:
            if isinstance(clause.because, Clause):
                cause_fact = self.propositions.plain(clause.because)
                return Whether(Caused(cause_fact, of), tag) if cause_fact else Whether(of, tag)
            return Why(of, suspect=as_thing(clause.because))
        return Whether(of, tag)

    def _sure_of(self, clause: Clause) -> Proposition | None:
        governed = clause.that or clause.infinitive
        return self.propositions.plain(governed) if governed is not None else None

    def _whether_special(self, clause: Clause, value: Special) -> Question | None:
        if value.name == "obey":
            return Fault(None, value.subject, legal=True)
        if value.name == "violate":
            return Fault(None, value.subject, legal=True)
        if value.name == "blame":
            return Fault(None, as_thing(value.object))
        if value.name == "prevent" and (denied := prevented(value)) is not None:
            return Why(Not(denied))
        if value.name == "matter":
            return WhatWouldChange(None)
        return None

    def comparison(self, clause: Clause) -> Question | None:
        """Ask "would turning right have been quicker": deeds compared."""
        if not clause.comparisons or clause.comparisons[0][1] == "as":
            return None
        by = cast(Any, BY.get(clause.comparisons[0][0], "best"))
        deed: Any = clause.subject if isinstance(clause.subject, Event) else None
        governed = clause.infinitive or clause.gerund
        if deed is None and governed is not None and isinstance(clause.subject, Pronoun):
            governed.subject = Ego()
            deed = self.propositions.as_event(governed)
        spoken = isinstance(clause.subject, Pronoun) and clause.subject.form in (
            "that",
            "it",
            "this",
        )
        if not isinstance(deed, Event):
            judged = clause.comparisons[0][0] in ("safe", "better", "comfortable", "dangerous")
            hypothetical = clause.modal in ("would", "could") or judged
            if not (spoken and hypothetical) or clause.verb is not None:
                return None
            return Compare((That(), *self._other(clause)), by)
        return Compare((Happens(deed), *self._other(clause)), by)

    def _other(self, clause: Clause) -> tuple[Any, ...]:
        than = clause.than if clause.than is not None else clause.contrast
        if isinstance(than, Clause):
            if than.subject is None or isinstance(than.subject, Event):
                than.subject = Ego()
            found = self.propositions.plain(than)
            return (found,) if found is not None else ()
        if isinstance(than, Event):
            return (Happens(than),)
        thing = as_thing(cast("Sem | None", than)) if not isinstance(than, str) else None
        return (thing,) if thing is not None else ()
