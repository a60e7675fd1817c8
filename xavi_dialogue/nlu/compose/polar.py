"""Polar questions: whether something is so, and which of two deeds is better."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Fault,
    HowAvoid,
    HowKnow,
    HowSure,
    Question,
    WhatIf,
    WhatWouldChange,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Caused,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Feature,
    Happens,
    Is,
    Not,
    Pronoun,
    Proposition,
    That,
    Thing,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.adoption import as_of
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.comparing import Comparing
from xavi_dialogue.nlu.compose.nominal import asked_of
from xavi_dialogue.nlu.compose.sem import (
    Noun,
    as_thing,
    is_thing,
)
from xavi_dialogue.nlu.compose.tree import words_of
from xavi_dialogue.nlu.compose.wh import fact, prevented
from xavi_dialogue.nlu.compose.which import way_at

_WAYS = frozenset(
    {"exit-left", "exit-right", "exit-straight", "turn", "continue", "continue-next-exit",
     "leave", "enter", "u-turn", "head", "go", "pass"}
)  # fmt: skip


def way_asked(of: Proposition) -> Question | None:
    """Take "do we turn left or go straight on" for the question which way we go."""
    if not isinstance(of, Both) or of.join != "or":
        return None
    found = [one.event for one in of.contents if isinstance(one, Happens)]
    if len(found) < len(of.contents) or not all(
        event.action in _WAYS and isinstance(event.actor, Ego) and event.modal is None
        for event in found
    ):
        return None
    exits = any(isinstance(event.object, Exit) for event in found)
    time = next((e.time for e in found if not isinstance(e.time, Unsaid)), Unsaid())
    return way_at(Ego(), time, found[0].tense, "exit-number" if exits else "turn")


def about_whom(clause: Clause) -> Thing | None:
    """Find of whom a judgement is: "were you wrong about the blue one"."""
    found = (as_thing(p.sem) for p in clause.complements if p.key in ("about", "with", "on"))
    vehicles = (Described, Vehicle, Pronoun)
    return next((thing for thing in found if isinstance(thing, vehicles)), None)


def judged(clause: Clause) -> Thing | None:
    """Tell who is said to be rude or unfair; nobody where it is what happened."""
    thing = as_thing(clause.subject)
    return None if isinstance(thing, Pronoun) and thing.form in ("that", "this", "it") else thing


def _foreseen(clause: Clause) -> Proposition | None:
    """Read "was your prediction right": whether we were right about whom is spoken of."""
    sem = clause.subject
    state = next((key for key, _ in clause.adjectives if key in ("right", "wrong")), clause.side)
    if clause.verb is not None or state not in ("right", "wrong"):
        return None
    who = about_whom(clause)
    if isinstance(sem, Noun) and sem.key == "prediction":
        who = who or as_thing(sem.about) or as_thing(sem.of) or Pronoun("he")
    elif not isinstance(sem, Ego):
        return None
    if who is None:
        return None
    return Is(cast(Any, state), who, time=clause.time, tense="past")


def _blamed(clause: Clause) -> Thing | None:
    """Read "was it for the bus", "was that braking because of him": whom it was for."""
    plain = clause.verb is None and not (clause.complements or clause.objects)
    if isinstance(clause.subject, Event) and plain and not isinstance(clause.because, Clause):
        return as_thing(clause.because)
    it = isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that", "this")
    if not it or clause.verb is not None or len(clause.complements) != 1 or clause.objects:
        return None
    thing = as_thing(clause.complements[0].sem)
    vehicle = isinstance(thing, (Described, Vehicle)) or (
        isinstance(thing, Pronoun) and thing.form in ("he", "she", "they", "them-all")
    )
    return thing if clause.complements[0].key == "for" and vehicle else None


class Polar(Comparing):
    """Builds yes or no questions."""

    def whether(self, clause: Clause, *, tag: bool = False) -> list[tuple[Question, float]]:
        """Build the yes or no questions of a clause."""
        if any(key == "opinion" for key, _ in clause.adjectives):
            return [(Fault(That(), judged(clause)), 0.0)]
        foreseen = _foreseen(clause)
        if foreseen is not None:
            return [(Whether(foreseen, tag), 0.0)]
        blamed = _blamed(clause)
        if blamed is not None:
            deed = clause.subject
            of = Happens(deed) if isinstance(deed, Event) else That()
            return [(Why(of, suspect=blamed), 0.0)]
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
        if not clause.there or not clause.objects:
            return None
        way = self._way_round(clause)
        if way is not None or clause.negated:
            return way
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
        avoidable = self._avoidable(clause, of)
        if avoidable is not None:
            return avoidable
        way = way_asked(of)
        if way is not None:
            return way
        about = about_whom(clause)
        match of:
            case Is(state="wrong" | "right", thing=Ego()) if about is not None:
                return Whether(structs.replace(of, thing=about), tag)
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

    def _avoidable(self, clause: Clause, of: Proposition) -> Question | None:
        """Ask "could the crash have been avoided", "was there anything you could have done"."""
        inner = of.content if isinstance(of, Not) else of
        match inner:
            case Happens(event=Event(action="avoid", modal="could" | "would" | "should")):
                if isinstance(clause.subject, Event) and not clause.passive:
                    return WhatIf(as_of(Happens(clause.subject), "past"), Whether(of))
                sems = [clause.subject] if clause.passive else [sem for sem, _ in clause.objects]
                deed = next((sem for sem in sems if isinstance(sem, Event)), None)
                governed = None if clause.gerund is None else self.propositions.plain(clause.gerund)
                return HowAvoid(governed if deed is None else Happens(deed))
            case Exists(
                thing=Described(doing=Event(action="do", modal="could" | "should", actor=actor))
            ) if not isinstance(actor, Wanted):
                return HowAvoid()
        return None

    def _way_round(self, clause: Clause) -> Question | None:
        """Ask "was there any way to avoid the crash", "is there no way round it"."""
        thing = as_thing(clause.objects[0][0])
        if not isinstance(thing, Feature) or thing.kind != "way":
            return None
        if clause.infinitive is None:
            words = words_of(clause.objects[0][1]).split()
            around = any(phrase.key == "bearing-around" for phrase in clause.complements)
            around = around or not {"round", "around", "not", "avoiding"}.isdisjoint(words)
            return HowAvoid() if around else None
        governed = clause.infinitive
        governed.subject = Ego()
        found = self.propositions.plain(governed)
        if found is not None and (isinstance(found, Not) or clause.negated):
            of = found.content if isinstance(found, Not) else found
            return HowAvoid(as_of(of, clause.tense))
        if isinstance(found, Happens) and found.event.action == "avoid":
            deed = next((sem for sem, _ in governed.objects if isinstance(sem, Event)), None)
            return HowAvoid(Happens(deed) if deed is not None else None)
        return None

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
        if clause.verb is not None and clause.verb.key == "guess" and value.name == "believe":
            return HowKnow(value.content)  # "did you just guess?"
        if value.name == "matter":
            return WhatWouldChange(None)
        return None
