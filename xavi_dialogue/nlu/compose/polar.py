"""Polar questions: whether something is so, and which of two deeds is better."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Compare,
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
    Lane,
    Not,
    Pronoun,
    Proposition,
    That,
    Thing,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.adoption import as_of, with_fields
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
from xavi_dialogue.nlu.compose.tree import words_of
from xavi_dialogue.nlu.compose.wh import fact, prevented
from xavi_dialogue.nlu.compose.which import way_at

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
    """Read "was it for the bus": whom what was done was for."""
    it = isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that", "this")
    if not it or clause.verb is not None or len(clause.complements) != 1 or clause.objects:
        return None
    thing = as_thing(clause.complements[0].sem)
    vehicle = isinstance(thing, (Described, Vehicle)) or (
        isinstance(thing, Pronoun) and thing.form in ("he", "she", "they", "them-all")
    )
    return thing if clause.complements[0].key == "for" and vehicle else None


class Polar(Frames):
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
            return [(Why(That(), suspect=blamed), 0.0)]
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

    def comparison(self, clause: Clause) -> Question | None:
        """Ask "would turning right have been quicker": deeds compared."""
        if _sooner(clause):
            whose = clause.subject
            of = Happens(whose) if isinstance(whose, Event) else That()
            return Compare((_at(of, clause.tense),), "time")
        if not clause.comparisons or clause.comparisons[0][1] == "as":
            return None
        by = cast(Any, BY.get(clause.comparisons[0][0], "best"))
        deed: Any = clause.subject if isinstance(clause.subject, Event) else None
        governed = clause.infinitive or clause.gerund
        if deed is None and governed is not None and isinstance(clause.subject, Pronoun):
            governed.subject = Ego()
            deed = self.propositions.as_event(governed)
        if deed is None and clause.modal in ("would", "could"):
            deed = _lane_taken(clause)
        spoken = isinstance(clause.subject, Pronoun) and clause.subject.form in (
            "that",
            "it",
            "this",
        )
        unreal = clause.modal in ("would", "could", "might")
        key = clause.comparisons[0][0]
        if deed is None and governed is not None and key == "better" and unreal:
            governed.subject = as_thing(clause.subject) or Ego()
            deed = self.propositions.as_event(governed)
        ours = isinstance(clause.subject, Ego) and clause.verb is None and not clause.than
        if deed is None and key in ("better", "safe", "fast") and ours and unreal:
            return Compare((That(), *self._other(clause)), by)
        if not isinstance(deed, Event):
            judged = key in ("safe", "better", "comfortable", "dangerous")
            hypothetical = unreal or judged or isinstance(clause.than, Event | Clause)
            if not (spoken and hypothetical) or clause.verb is not None:
                return None
            return Compare((That(), *self._other(clause)), by)
        if unreal:
            deed = with_fields(deed, modal=clause.modal)
        options = (Happens(deed), *self._other(clause))
        return Compare(tuple(_at(option, clause.tense) for option in options), by)

    def _other(self, clause: Clause) -> tuple[Any, ...]:
        clauses = [c for c in (clause, clause.infinitive, clause.gerund) if c is not None]
        spoken = [o for c in clauses for o in (c.than, c.contrast) if o is not None]
        than = spoken[0] if spoken else None
        if isinstance(than, Clause):
            if than.subject is None or isinstance(than.subject, Event):
                than.subject = Ego()
            found = self.propositions.plain(than)
            return (found,) if found is not None else ()
        if isinstance(than, Event):
            return (Happens(than),)
        thing = as_thing(cast("Sem | None", than)) if not isinstance(than, str) else None
        return (thing,) if thing is not None else ()


def _at(option: Any, tense: str) -> Any:
    return as_of(option, tense) if isinstance(option, Happens) else option


def _lane_taken(clause: Clause) -> Event | None:
    """Read "would the other lane have been faster", "... quicker in the left lane"."""
    places = [as_thing(phrase.sem) for phrase in clause.complements if phrase.key in ("in", "on")]
    lane = next((t for t in (as_thing(clause.subject), *places) if isinstance(t, Lane)), None)
    if lane is None or lane.of is not None or clause.verb is not None:
        return None
    side = {"left": "left", "right": "right", "leftmost": "left", "rightmost": "right"}
    action: Any = f"change-{side.get(lane.which, 'lane')}"
    return Event(action, tense=cast(Any, clause.tense))


def _sooner(clause: Clause) -> bool:
    """Say whether it is asked if we would have got there sooner."""
    key = clause.verb.key if clause.verb is not None else ""
    unreal = clause.modal in ("would", "could", "might") or clause.has("have-past")
    sooner = ("soon", "sooner") in clause.comparisons or "early" in clause.manner
    return key in ("get", "arrive", "be") and unreal and sooner
