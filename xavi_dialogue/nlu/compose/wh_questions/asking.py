"""Asking: a question word and a clause become a question."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Changed,
    Doing,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowMuch,
    HowSure,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Is,
    Measured,
    Next,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Road,
    That,
)
from xavi_dialogue.nlu.compose.clauses.adoption import adopted, as_of, timed, with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import propose
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.times import as_coming_to
from xavi_dialogue.nlu.compose.propositions.propositions import Propositions
from xavi_dialogue.nlu.compose.verbs.trends import as_slowing, believed, trend
from xavi_dialogue.nlu.compose.wh_questions.amounts import amounts
from xavi_dialogue.nlu.compose.wh_questions.doings import has_gone
from xavi_dialogue.nlu.compose.wh_questions.grades import graded
from xavi_dialogue.nlu.compose.wh_questions.lasting import measured, since
from xavi_dialogue.nlu.compose.wh_questions.rating import rated
from xavi_dialogue.nlu.compose.wh_questions.reasoning import decisive
from xavi_dialogue.nlu.compose.wh_questions.wh import (
    NEXT,
    Wh,
    answer_to,
    content_of,
    deed_of,
    fact,
    is_that,
    time_of,
)
from xavi_dialogue.nlu.compose.wh_questions.what import What
from xavi_dialogue.nlu.compose.wh_questions.which import WhichOne

_MOVING = frozenset({"go", "pull-out", "head", "move", "turn", "leave", "take-turn", "continue",
                     "exit-left", "exit-right", "change-lane"})  # fmt: skip


_WAY = Feature("way")
_PASSING = frozenset({"go", "move", "cross", "enter", "pass", "come", "pull-out", "merge"})


def _embedded(clause: Clause) -> Proposition | None:
    """Return what answers a clause's embedded question, as it was read first; None if none."""
    readings = () if clause.question is None else clause.question[1]
    return next((answer_to(question) for question in readings[:1]), None)


class Asking(What, WhichOne):
    """Builds questions."""

    propositions: Propositions

    def why(self, clause: Clause, value: Any) -> Question:
        """Ask why it is so, or not."""
        if value is None:
            deed = propose(clause.subject)
            return Why(That() if deed is None else timed(as_of(deed, clause.tense), clause.time))
        if isinstance(value, Special) and value.name == "change":
            if clause.negated and isinstance(clause.subject, Ego):  # "why did you not change?"
                change = Event("change-lane", time=clause.time, tense=cast(Any, clause.tense))
                return Why(Not(Happens(change)))
            paced = as_slowing(trend(clause))  # "why did our speed drop?"
            if isinstance(paced, Happens):
                return Why(paced)
            return HowSure(None, clause.time, changed=True)
        of = fact(value)
        match of:
            case Compares(left=Measured(attribute="probability") as left, right=Measured()):
                return HowSure(believed(left), changed=True)
            case Compares(left=Measured(attribute="probability") as left):
                return HowKnow(believed(left))
            case Is(state="sure", thing=Ego()) if clause.that is not None:
                return HowKnow(self.propositions.plain(clause.that))
            case Is(state="allowed", event=Event(object=None | Ego()) as passing) if (
                passing.action in _PASSING and not isinstance(passing.actor, Ego)
            ):  # "why do they get to walk in front of us?"
                first = with_fields(passing, action="go", manner=("first",), tense=of.tense)
                return Why(Happens(with_fields(first, where=None)))
        if isinstance(of, Happens) and of.event.action == "do" and is_that(of.event.object):
            of = Happens(of.event)
        if isinstance(of, Happens) and is_that(of.event.actor) and not clause.aux:
            of = Happens(with_fields(of.event, actor=Ego()))  # "why all this weaving?"
        suspect = as_thing(clause.because) if not isinstance(clause.because, Clause) else None
        return Why(as_slowing(of) or That(), suspect=suspect)

    # --- which -------------------------------------------------------

    # --- where, when, how --------------------------------------------

    def where(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask for a place, a way to go or an origin."""
        actor = as_thing(clause.subject) or Ego()
        if actor == NEXT and clause.verb is None:
            return Doing(Ego(), Next(), "future")  # "where next?"
        if isinstance(value, Special) and value.name in ("cost", "delay"):
            return Peak("delay", clause.time)  # "where did we lose time?"
        source = (
            wh.key == "whence"
            or wh.preposition == "from"
            or any(phrase.key == "from" and phrase.sem is None for phrase in clause.complements)
        )
        event = value.event if isinstance(value, Happens) else None
        if source or (event is not None and event.action in ("come", "appear")):
            return measured("origin", clause, event.actor if event else actor)
        if wh.key == "whither" or (
            event is not None and event.action in _MOVING and _onward(clause)
        ):
            whom = event.actor if event else actor
            if clause.tense in ("past", "perfect") and not isinstance(whom, Ego):
                return Where(Event("go", whom, time=time_of(clause, value)))
            return Whither(whom, time_of(clause, value))
        if _is_led(clause):
            whose = Ego() if isinstance(actor, Road) else actor
            went = clause.tense in ("past", "perfect") and event is not None
            if went and not isinstance(whose, Ego):
                return Where(Event("go", whose, time=time_of(clause, value)))
            return Whither(whose, time_of(clause, value))
        if event is not None:
            return Where(event, clause.time)
        if value is None or isinstance(value, (Special, Related, Is, Exists)):
            if isinstance(value, Exists):
                return Where(value.thing, clause.time)
            if isinstance(value, Special) and value.name == "look":
                return Listing("vehicles", time=clause.time)
            return Where(actor, clause.time)
        return Where(actor, clause.time)

    def when(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask at what time, or under what circumstances."""
        if wh.key == "circumstances" and value is not None:
            return WhatWouldChange(fact(value))
        if value is None:
            return When(propose(clause.subject) or That())
        if isinstance(value, Special) and value.name in ("end", "begin"):
            of = value.content or fact(value)
            if isinstance(of, Happens):
                of = Happens(with_fields(of.event, tense=clause.tense))
            return When(of, "end" if value.name == "end" and value.content else "begin")
        if isinstance(value, Special) and value.name == "change":
            paced = as_slowing(trend(clause))  # "why did our speed drop?"
            if isinstance(paced, Happens):
                return Why(paced)
            return HowSure(None, clause.time, changed=True)
        of = fact(value)
        if isinstance(of, Is) and of.state == "sure" and clause.that is not None:
            content = self.propositions.plain(clause.that)
            return When(of if content is None else Believed(content, tense=of.tense))
        if isinstance(of, Compares) and of.left.attribute == "delay":
            return HowMuch(of.left)  # "what time did the roundabout cost us?"
        match of:
            case Believed(content=Is(state="present", thing=thing)) if thing is not None:
                seen = Related("can-see", Ego(), thing, tense="past")
                return When(seen)  # "when did you first know it was there?"
        ours = isinstance(of, Happens) and isinstance(of.event.actor, Ego)
        getting_in = isinstance(of, Happens) and of == Happens(Event("enter", tense=of.event.tense))
        if ours and getting_in:
            of = Happens(Event("arrive", tense="future"))  # "when do we get in?"
        if isinstance(of, Happens) and ours and of.event.tense == "present":  # "when do we turn?"
            of = Happens(with_fields(of.event, tense="future"))
        return When(as_coming_to(of))

    def how(self, clause: Clause, value: Any) -> Question:
        """Ask in what manner, by what evidence, or how to avoid."""
        if isinstance(clause.subject, Measure) and clause.verb is None:
            sem: Sem = clause.subject
            for phrase in clause.complements:
                sem = adopted(sem, phrase) or sem
            return HowMuch(cast(Measure, sem).of, cast(Measure, sem).extreme)
        if isinstance(value, Special):
            found = self._how_special(clause, value)
            if found is not None:
                return found
        ahead = isinstance(value, Related) and value.relation == "ahead-of"
        if (value is None or ahead) and as_thing(clause.subject) == Described():
            # "how is the traffic (ahead)?"
            return Whether(Is("busy", Road(), time=clause.time, tense=cast(Any, clause.tense)))
        if value is None:
            subject = clause.subject
            if isinstance(subject, Noun) and subject.key == "ride":
                return HowMuch(Measured("comfort", time=clause.time, tense=cast(Any, clause.tense)))
            if isinstance(subject, Measure):
                return HowMuch(subject.of, subject.extreme)
            return rated(clause, subject) or HowDecide(propose(subject) or That())
        if has_gone(clause):
            return Summarise(None, clause.time)
        of = fact(value)
        if isinstance(of, Happens) and of.event.action == "avoid":
            return HowAvoid(self._avoided(clause, of.event))
        if isinstance(of, Happens) and of.event.action == "happen":
            return Why(That())
        if isinstance(of, Compares) and of.left == Measured("value", of.left.thing):
            return Why(That())  # "how is that any better?"
        if isinstance(of, Believed):
            return HowKnow(of.content)
        return HowDecide(of)

    def _avoided(self, clause: Clause, event: Event) -> Proposition | None:
        """Find what is avoided: a deed of the one who avoids it."""
        governed = None if clause.gerund is None else self.propositions.as_event(clause.gerund)
        named = (governed, *(sem for sem, _ in clause.objects))
        deed = next((sem for sem in named if isinstance(sem, Event)), None)
        if deed is None or isinstance(event.actor, Pronoun):
            return None if is_that(event.object) else propose(deed_of(event))
        actor = event.actor if isinstance(deed.actor, Ego) else deed.actor
        return Happens(with_fields(deed, actor=actor, tense=event.tense))

    def _how_special(self, clause: Clause, value: Special) -> Question | None:
        match value.name:
            case "see" | "deem" if (
                clause.verb is not None
                and clause.verb.key == "find"
                and ((opinion := rated(clause, value)) is not None)
            ):
                return opinion  # "how did you find the ride?"
            case "know" | "believe" | "conclude" | "see" | "say" | "tell" | "hear" | "find":
                content = value.content
                if content is None and value.object is not None and value.name == "see":
                    return HowKnow(fact(value))
                return HowKnow(_embedded(clause) if content is None else content)
            case "decide" | "choose" | "plan" | "consider":
                return HowDecide(value.content or _own_way(value) or propose(value.object))
            case "prevent" | "improve":
                return HowAvoid(value.content or propose(value.object))
            case "rate":
                return rated(clause, value)
            case "score":
                return HowMuch(Measured("value", value.subject, time=clause.time))
            case "change" if isinstance(clause.subject, Noun) and clause.subject.key == "plan":
                return Changed(clause.time)
            case "change":
                return HowSure(None, clause.time, changed=True)
            case "cost" | "take-time":
                return measured("delay", clause, value.subject)
            case "happen":
                return Why(That())
            case "work" | "do":
                return HowDecide(None if value.name == "work" else fact(value))
        return None

    # --- dispatch ----------------------------------------------------

    def ask(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Build the question that a question word asks of a clause."""
        if wh.kind in ("what", "who", "which") and (mattered := decisive(clause)) is not None:
            return mattered
        if wh.kind == "which" and clause.modal in ("would", "could") and _replans(value):
            return WhatWouldChange()  # "which input would flip the decision?"
        match wh.kind:
            case "why":
                return self.why(clause, value)
            case "evidence":
                of = content_of(clause, value)
                match of:
                    case Not(content=Happens(event=Event(actor=Ego(), tense=tense))) if (
                        tense != "future"
                    ):
                        return Why(of)  # "on what basis are you not stopping?"
                    case Happens(event=Event(actor=Ego(), tense="past", modal=None)):
                        return Why(of)  # "on what basis did you proceed?"
                return HowKnow(of)
            case "what" | "who" | "whose":
                return self.what(wh, clause, value)
            case "where":
                return self.where(wh, clause, value)
            case "when":
                if wh.key == "span":
                    return graded("long", wh.words, clause, value)
                lasting = since(clause, value) if wh.key == "since" else None
                return lasting or self.when(wh, clause, value)
            case "grade":
                governed = clause.infinitive
                if wh.key == "safe" and governed is not None and is_that(clause.subject):
                    governed.subject = Ego()  # "how risky would it be to stop?"
                    clause.subject = self.propositions.as_event(governed) or clause.subject
                return graded(wh.key, wh.words, clause, value)
            case "count":
                return amounts(cast(Sem, wh.sem), clause, value, wh.words)
            case "which":
                return self.which(wh, clause, value)
        return self.how(clause, value)


_LEADING = frozenset({"take", "bring", "lead", "drive", "get"})


def _is_led(clause: Clause) -> bool:
    """Say whether it is asked where somebody is taken, a road leads, or we are off to."""
    stranded = any(phrase.key == "into" and phrase.sem is None for phrase in clause.complements)
    if clause.verb is None or (stranded and clause.verb.key in _LEADING | {"go", "travel"}):
        return stranded
    objects = [as_thing(sem) for sem, _ in clause.objects]
    us = any(isinstance(thing, Ego | Passenger) for thing in objects)
    return clause.verb.key in _LEADING and (us or isinstance(as_thing(clause.subject), Road))


def _onward(clause: Clause) -> bool:
    return (
        clause.tense in ("present", "future")
        or clause.has("be")
        or clause.modal in ("must", "want", "should")
    )


def _own_way(value: Special) -> Proposition | None:
    """Return that we go our way, if a way or route is decided on: "how do you choose the way?"."""
    route = isinstance(value.object, Measure) and value.object.of.attribute == "route"
    return Happens(Event("go", Ego(), _WAY)) if route or as_thing(value.object) == _WAY else None


def _replans(value: Any) -> bool:
    """Say whether a plan or decision is said to change."""
    return isinstance(value, Happens) and value.event.action == "change-plan"
