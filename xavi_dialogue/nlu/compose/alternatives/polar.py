"""Polar questions: whether something is so, and which of two actions is better."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Doing,
    Fault,
    HowAvoid,
    HowKnow,
    HowMany,
    HowMuch,
    HowSure,
    Listing,
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
    Feature,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Proposition,
    That,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.compose.alternatives.blames import blamed, cleft_cause, either_cause, rival
from xavi_dialogue.nlu.compose.alternatives.choosing import asks_which, chosen
from xavi_dialogue.nlu.compose.alternatives.comparing import Comparing
from xavi_dialogue.nlu.compose.alternatives.nearness import nearly_even
from xavi_dialogue.nlu.compose.alternatives.recast import (
    about_whom,
    caused_by,
    judged_so,
    surely_valued,
)
from xavi_dialogue.nlu.compose.alternatives.swapped import swapped
from xavi_dialogue.nlu.compose.alternatives.ways import way_asked
from xavi_dialogue.nlu.compose.clauses.adoption import as_of
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import asked_of, event_in
from xavi_dialogue.nlu.compose.clauses.risks import risk_asked
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.propositions.tally import counts, exits_passed, how_often, tallied
from xavi_dialogue.nlu.compose.states.pacing import (
    is_by_the_law,
    kept_to,
    not_rather,
    permitted,
)
from xavi_dialogue.nlu.compose.verbs.expecting import hindsight
from xavi_dialogue.nlu.compose.verbs.sheltering import concealed
from xavi_dialogue.nlu.compose.wh_questions.wh import fact, sureness

WHOLE = -0.25  # cost of what is read as a whole: "are you sure that was right?"
#: Nouns whose existence is a state, not a question for them.
_STATED = frozenset(("danger", "problem", "sight", "side", "truth"))


def judged(clause: Clause) -> Thing | None:
    """Return who is called rude or unfair; None if an event is."""
    thing = as_thing(clause.subject)
    return None if isinstance(thing, Pronoun) and thing.form in ("that", "this", "it") else thing


def _foreseen(clause: Clause) -> Proposition | None:
    """Read "was your prediction right": whether we were right about the vehicle in question."""
    sem = clause.subject
    state = next((key for key, _ in clause.adjectives if key in ("right", "wrong")), clause.side)
    if clause.verb is not None or state not in ("right", "wrong"):
        return None
    who = about_whom(clause)
    if isinstance(sem, Noun) and sem.key == "prediction":
        who = who or as_thing(sem.about) or as_thing(sem.of) or Pronoun("he")
    elif not isinstance(sem, Ego):
        return None
    if who is None and (clause.side is None or clause.tense != "past" or clause.bearings):
        return None
    return Is(cast(Any, state), who or Ego(), time=clause.time, tense="past")  # "were you right?"


def _is_all(clause: Clause) -> bool:
    """Check whether a clause is "that is it": it asks whether anything is still to come."""
    it = [sem for sem, _ in clause.objects] == [Pronoun("it")]
    plain = clause.verb is None and not clause.complements and not clause.adjectives
    return clause.subject == Pronoun("that") and it and plain


def _is_option(clause: Clause) -> bool:
    """Check whether a clause is about options or alternatives."""
    named = [clause.subject] if clause.passive else [sem for sem, _ in clause.objects]
    return any(isinstance(sem, Noun) and sem.key == "option" for sem in named) or any(
        isinstance(sem, Described) and sem.other for sem in named
    )


def _our_sureness(thing: Thing | None) -> bool:
    """Check whether the one who is sure is the ego, or the empty "it"."""
    return isinstance(thing, Ego) or (isinstance(thing, Pronoun) and thing.form in ("it", "that"))


class Polar(Comparing):
    """Builds yes or no questions."""

    def whether(self, clause: Clause, *, tag: bool = False) -> list[tuple[Question, float]]:
        """Build the yes or no questions of a clause."""
        inner = clause.that if clause.that is not None and not clause.adjectives else clause
        if any(key in ("opinion", "kind") for key, _ in inner.adjectives):
            deems = clause.verb is not None and clause.verb.key in ("consider", "call", "find")
            return [(Fault(That(), None if deems else judged(inner)), 0.0)]
        if _is_all(clause):
            return [(Doing(tense="future"), 0.0)]
        if is_by_the_law(clause):
            return [(Fault(None, Ego(), legal=True), 0.0)]
        if clause.verb is not None and clause.verb.key == "mean" and clause.that is not None:
            return self.whether(clause.that, tag=True)  # "do you mean that he will stop?"
        if (amiss := hindsight(clause)) is not None:
            return [(amiss, 0.0)]
        if (even := nearly_even(clause)) is not None:
            return [(even, 0.0)]
        if (limited := permitted(clause)) is not None:
            return [(Whether(limited, tag), 0.0)]
        if (either := either_cause(clause)) is not None:
            return [(either, 0.0)]
        if found := chosen(clause, self.propositions):
            return [(self.framed(question, clause, None), cost) for question, cost in found]
        if (sure := surely_valued(clause)) is not None:
            return [(Whether(sure), WHOLE)]
        if (there := concealed(clause)) is not None:
            return [(Whether(there, tag), 0.0)]
        foreseen = _foreseen(clause)
        if foreseen is not None:
            return [(judged_so(clause, foreseen, tag=tag) or Whether(foreseen, tag), 0.0)]
        cleft = cleft_cause(clause)
        if cleft is not None:
            cause, told = cleft
            caused = self.propositions.plain(told) if isinstance(told, Clause) else told
            return [(Why(caused or That(), suspect=cause), 0.0)]
        suspect = blamed(clause)
        if suspect is not None:
            deed = clause.subject
            of = Happens(deed) if isinstance(deed, Event) else That()
            return [(Why(of, suspect=suspect, rival=rival(clause)), 0.0)]
        compare = self.comparison(clause) or self._existing(clause)
        if compare is not None:
            return [(self.framed(compare, clause, None), 0.0)]
        found = []
        for candidate in self.propositions.readings(clause):
            question = asks_which(self.polar(clause, candidate.value, tag=tag))
            found.append((self.framed(question, clause, candidate.value), candidate.cost))
        return found

    def _existing(self, clause: Clause) -> Question | None:
        """Read "is there a reason you are waiting", "do we have another option"."""
        if not clause.there or not clause.objects:
            return None
        way = self._way_round(clause)
        if way is not None or clause.negated:
            return way
        sem = clause.objects[0][0]
        if isinstance(sem, Measure) and sem.of.attribute == "probability":
            return self._chance(clause, sem)
        if isinstance(sem, Noun) and sem.key == "danger" and sem.clause is not None:
            return HowSure(sem.clause, clause.time)
        if not isinstance(sem, Noun) or sem.key in _STATED:
            return None
        governed = clause.that or clause.infinitive
        if governed is not None and sem.clause is None:
            governed.subject = governed.subject or Ego()
            sem = replace(sem, clause=self.propositions.plain(governed))
        return asked_of(sem, clause.time, clause.tense)

    def _chance(self, clause: Clause, sem: Measure) -> Question | None:
        """Read "is there a risk that he hits us", "is there any risk with the lorry"."""
        if clause.that is not None:
            return HowSure(self.propositions.plain(clause.that), clause.time)
        if (risk := risk_asked(sem.of, cast(Any, clause.tense))) is not None:
            return risk
        event = sem.of.event
        whom = next((t for p in clause.complements if (t := as_thing(p.sem)) is not None), None)
        if event is not None and event.action == "collide" and event.object is None:
            event = structs.replace(event, object=whom)
        return None if event is None else HowSure(Happens(event), clause.time)

    def _special(self, clause: Clause, value: Special) -> Question | None:
        if value.name == "hear" and clause.that is None and clause.question is None:
            return HowMuch(Measured("sound", tense=cast(Any, clause.tense)))
        found = self._whether_special(clause, value)
        if isinstance(found, Whether):  # "did you exceed the limit or brake hard?"
            return structs.replace(found, that=self.propositions.joined(clause, found.that))
        return found

    def polar(self, clause: Clause, value: Any, *, tag: bool) -> Question:
        if isinstance(value, Special) and (asked := self._special(clause, value)) is not None:
            return asked
        joined = swapped(self.propositions.joined(clause, fact(value)))
        of = counts(clause) or tallied(clause, joined)
        of = not_rather(clause, of, self.propositions)
        if (often := how_often(clause, of)) is not None:
            return often
        if (avoidable := self._avoidable(clause, of)) is not None:
            return avoidable
        way = way_asked(of) or self._either_way(clause, of)
        if way is not None:
            return way
        if (passed := exits_passed(clause, of)) is not None:
            return HowMany(passed)  # "did we go past any exits?"
        if isinstance(of, Is) and of.state == "sure" and _our_sureness(of.thing):
            content = self._sure_of(clause)
            if isinstance(content, Is) and content.state in ("right", "wrong"):
                return Whether(content)
            if content is None and clause.that is not None:  # "sure this is the right way"
                return next((question for question, _ in self.whether(clause.that)), HowSure())
            return sureness(clause, content)
        if (meant := judged_so(clause, of, tag=tag) or caused_by(clause, of, tag=tag)) is not None:
            return meant
        if clause.because is not None:
            if isinstance(clause.because, Clause):
                cause_fact = self.propositions.plain(clause.because)
                return Whether(Caused(cause_fact, of), tag) if cause_fact else Whether(of, tag)
            return Why(of, suspect=as_thing(clause.because))
        return Whether(of, tag)

    def _either_way(self, clause: Clause, of: Proposition) -> Question | None:
        """Read "do we come off at this one or the next" as the question which way we go."""
        sems = [*(phrase.sem for phrase in clause.complements), *(sem for sem, _ in clause.objects)]
        other = any(isinstance(sem, Group) and sem.join == "or" for sem in sems)
        if not other or not isinstance(of, Happens) or of.event.action != "leave":
            return None
        return way_asked(Both((of, of), "or"))

    def _avoidable(self, clause: Clause, of: Proposition) -> Question | None:
        """Read "could the crash have been avoided", "was there anything you could have done"."""
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
        """Read "was there any way to avoid the crash", "is there no way round it"."""
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
        if governed is None:
            deeds = (event_in(p.sem) for p in clause.complements if p.key in ("about", "of"))
            deed = next((one for one in deeds if one is not None), None)
            return None if deed is None else as_of(Happens(deed), clause.tense)
        return self.weighed_deed(governed) or self.propositions.plain(governed)

    def _whether_special(self, clause: Clause, value: Special) -> Question | None:
        if value.name == "obey":
            kept = kept_to(value)
            return Fault(None, value.subject, legal=True) if kept is None else Whether(kept)
        if value.name == "violate":
            return Fault(None, value.subject, legal=True)
        if value.name == "blame":
            return Fault(None, as_thing(value.object))
        if value.name == "prevent" and value.content is not None:
            return Why(Not(value.content))
        if clause.verb is not None and clause.verb.key == "guess" and value.name == "believe":
            return HowKnow(value.content)  # "did you just guess?"
        if value.name == "startle" and isinstance(as_thing(value.object), Ego):
            return Why(That(), suspect=value.subject)  # "did he scare you?"
        if value.name == "matter":
            whom = as_thing(value.subject)
            users = isinstance(whom, Vehicle | Vehicles | Described | Nobody)
            return Why(That(), suspect=whom) if users else WhatWouldChange(None)
        staked = clause.verb is not None and clause.verb.key == "bet"
        if staked and clause.modal == "would" and isinstance(as_thing(value.subject), Ego):
            return HowSure(value.content)  # "would you bet on it?"
        deed = value.content.event if isinstance(value.content, Happens) else value.object
        ours = isinstance(deed, Event) and isinstance(deed.actor, Ego)
        if value.name == "consider" and (ours or (value.content is None and _is_option(clause))):
            return Listing("options", time=clause.time)  # "did you consider alternatives?"
        return None
