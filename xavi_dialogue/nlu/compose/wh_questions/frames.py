"""Frames: the condition a question stands under, and the contrast beside it."""

import dataclasses
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import HowDecide, HowKnow, HowSure, Question, WhatIf, Whether, Why
from xavi_dialogue.domain.rewriting import first, rewrite
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Relative,
    That,
    Thing,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.adoption import timed, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import (
    NONE_OF_THEM,
    Group,
    Measure,
    Sem,
    alternative,
    as_thing,
    is_thing,
    members_of,
)
from xavi_dialogue.nlu.compose.propositions.propositions import Propositions
from xavi_dialogue.nlu.compose.states.pacing import at_pace
from xavi_dialogue.nlu.compose.wh_questions.savings import of_option


class Frames:
    """Reads suppositions and contrasts."""

    propositions: Propositions

    def framed(self, question: Question, clause: Clause, value: Any) -> Question:
        """Put a question under its condition, and a "why" beside its contrast."""
        if "either" in clause.focus:
            question = _either_side(question)
        inner = next((c for c in (clause.gerund, clause.infinitive, clause.that) if c), None)
        if clause.contrast is None and inner is not None and inner.contrast is not None:
            clause = inner
        if isinstance(question, Why):
            question = preferred(question) or question
        if isinstance(question, Why | HowDecide):
            apart = inner if inner is not None and clause.lacking is None else clause
            question = _lacking(question, apart)
        if isinstance(question, Why) and clause.contrast is not None:
            instead = self.contrast(clause, question.of)
            if instead is not None:
                question = structs.replace(question, instead=_in_lane(instead, question.of))
        if isinstance(question, Why):
            question = structs.replace(question, rival=alternative(clause.because))
            if clause.condition is not None and not is_contrary(question):
                return question  # "why did you brake if nobody was there": it is taken for granted
        if isinstance(question, HowSure) and clause.contrast is not None:
            return question
        supposed = None if _if_needed(clause.condition) else self.supposition(clause)
        if supposed is None:
            return of_option(question, clause, self._deed(clause))
        if isinstance(question, HowKnow) and question.of is None:
            return HowKnow(supposed)  # "how would you know if somebody came?"
        return WhatIf(supposed, None if _of_difference(question) else question)

    def _deed(self, clause: Clause) -> Proposition | None:
        """Read the deed of "what would it cost us to go straight on"."""
        governed = clause.infinitive
        return None if governed is None else self.propositions.plain(governed)

    def supposition(self, clause: Clause) -> Proposition | None:
        """Read what is supposed: "if he had stopped", "without the lorry"."""
        if clause.without is not None:
            members = members_of(clause.without)
            away = tuple(one for sem in members if (one := _without(sem)) is not None)
            return Both(away) if len(away) > 1 else next(iter(away), None)
        if clause.condition is None:
            return None
        found = self.supposed(clause.condition)
        now = "now" in clause.condition.focus | clause.focus
        return at_once(found) if now and found is not None else found

    def supposed(self, condition: Clause) -> Proposition | None:
        """Read a supposition, of each of several things; that one is away is that it is not.

        "If 1 or 5 were not there" is that neither is.
        """
        sem = condition.subject
        if not isinstance(sem, Group) or any(as_thing(one) is None for one in sem.members):
            return self._supposed(condition)
        each = [self._supposed(dataclasses.replace(condition, subject=one)) for one in sem.members]
        found = tuple(one for one in each if one is not None)
        either = sem.join == "or" and not all(isinstance(one, Not) for one in found)
        return Both(found, "or" if either else "and") if found else None

    def _supposed(self, condition: Clause) -> Proposition | None:
        bare = is_short(condition) and is_thing(condition.subject)
        found: Proposition | None = None if bare else self.propositions.plain(condition)
        found = found if found is None else _of_none(at_pace(condition, found))
        if found is None:
            thing = as_thing(condition.subject)
            if thing is None or isinstance(condition.subject, Event | Measure):
                return None
            plain = Happens(Event("do", thing, Pronoun("that"), tense="past"))
            return Not(plain) if condition.negated else plain
        if condition.contrast is not None:
            other = self.contrast(condition, found)
            found = before(found) if condition.has("have") else found
            return found if other is None else Both((found, Not(other)))
        if condition.instead:
            return found
        lacking = condition.lacking
        if lacking is not None and lacking.action != "do" and isinstance(found, Happens):
            undone = with_fields(lacking, actor=found.event.actor, tense=found.event.tense)
            found = before(found) if condition.has("have") else found
            return Both((found, Not(Happens(undone))))
        match found:
            case Is(state="wrong", thing=Ego()) if (about := _about(condition)) is not None:
                return cast(Proposition, with_fields(found, thing=about))
            case Is(state="present", thing=thing) if thing is not None:
                found = Exists(thing)
            case Not(content=Is(state="present", thing=thing)) if thing is not None:
                found = Not(Exists(thing))
        return before(found) if condition.has("have") else found

    def contrast(self, clause: Clause, of: Proposition) -> Proposition | None:
        """Read what is set against it: "instead of stopping", "and not the first"."""
        other = clause.contrast
        if isinstance(other, Clause):
            if other.verb is None and other.side is not None:
                return _with_side(of, other.side)
            if other.verb is None and not isinstance(clause.subject, type(None)):
                thing = next((as_thing(s.sem) for s in other.complements), None)
                return _with_object(of, thing)
            return self.propositions.plain(other)
        if isinstance(other, str):
            return _with_side(of, other) if other in ("left", "right", "straight") else None
        if isinstance(other, Event):
            return Happens(other)
        return _with_object(of, as_thing(other))


def at_once(of: Proposition) -> Proposition:
    """Say that what is supposed would come now: "if he stopped now"."""
    match of:
        case Not(content=content):
            return Not(at_once(content))
        case Happens(event=event) if event.tense == "past":
            return Happens(with_fields(event, tense="present"))
        case Has(tense="past"):
            return cast(Proposition, with_fields(of, tense="present"))
    return of


def _in_lane(instead: Proposition, of: Proposition) -> Proposition:
    """Take "staying" or "waiting", set against a change of lanes, for staying in the lane."""
    match of, instead:
        case Happens(event=Event(action=action, where=where)), Happens(
            event=Event(action="wait" | "stand", object=None, where=None) as other
        ) if action.startswith("change-") or isinstance(getattr(where, "to", None), Lane):
            return Happens(with_fields(other, action="keep-lane"))
    return instead


def _of_none(of: Proposition) -> Proposition:
    """Read what is said of none of them as denied of all of them."""
    if first(of, Nobody) != NONE_OF_THEM:
        return of
    every = rewrite(of, lambda part: Pronoun("them-all") if part == NONE_OF_THEM else part)
    return Not(every)


def _lacking(question: Why | HowDecide, clause: Clause) -> Why | HowDecide:
    """Take why or how a deed was done without another for why the other was not done then."""
    lacking, of = clause.lacking, question.of
    if lacking is None or lacking.action == "do" or not isinstance(of, Happens):
        return question
    done = of.event
    time = Relative("during", done) if isinstance(done.time, Unsaid) else done.time
    undone = with_fields(lacking, actor=done.actor, tense=done.tense, time=time)
    return structs.replace(question, of=Not(Happens(undone)))


def _without(sem: Sem) -> Proposition | None:
    """Read that a thing is away, or that a deed is not done: "without the lorry"."""
    if isinstance(sem, Event):
        return Not(Happens(sem))
    thing = as_thing(sem)
    if isinstance(thing, Described) and thing.bearing == "there":
        thing = structs.replace(thing, bearing=None, definite=True)  # "with no bus there"
    return None if thing is None else Not(Exists(thing))


def is_contrary(question: Why) -> bool:
    """Say whether it is asked why something would have come about that did not."""
    event = _inner_event(question.of)
    return event is not None and event.modal == "would"


def preferred(question: Why) -> Why | None:
    """Take why one deed was valued more than another for why it was done and not the other."""
    match question.of:
        case Compares(
            left=Measured(attribute="value", event=first, time=time),
            comparator="more",
            right=Measured(attribute="value", event=Event() as second),
        ):
            done = That() if first is None else timed(Happens(first), time)
            return Why(done, Happens(second), question.suspect)
    return None


def _of_difference(question: Question) -> bool:
    """Say whether it is only asked if that would have made a difference."""
    match question:
        case Whether(that=Happens(event=Event(action=action, actor=Pronoun(), object=what))):
            return action in ("change-plan", "do") and (what is None or isinstance(what, Pronoun))
    return False


def _about(condition: Clause) -> Thing | None:
    """Tell of whom it is supposed that we are wrong."""
    sems = (phrase.sem for phrase in condition.complements if phrase.key in ("about", "with", "on"))
    return next((thing for sem in sems if (thing := as_thing(sem)) is not None), None)


def is_short(condition: Clause) -> bool:
    """Say whether it leaves what is done to what was spoken of: "if he hadn't"."""
    auxiliary = condition.verb is None or condition.verb.key in ("have", "do")
    return (
        auxiliary and bool(condition.aux or condition.verb) and not condition.there
        and condition.subject is not None and not condition.has("be")
        and not (condition.objects or condition.complements or condition.adjectives
                 or condition.bearings or condition.side or condition.comparisons)
    )  # fmt: skip


def _if_needed(condition: Clause | None) -> bool:
    """Say whether only a need is supposed: "could you stop if you had to?"."""
    if condition is None:
        return False
    wished = condition.verb is not None and condition.verb.key in ("want", "like")
    if wished and not condition.objects and condition.infinitive is None:
        return True  # "could it go faster if it wanted?"
    if condition.negated or not is_short(condition):
        return False
    return condition.modal == "must" or "semi-must" in condition.aux


def before(of: Proposition) -> Proposition:
    """Say that what is supposed lies in the past: "had stopped" is not "stopped now"."""
    match of:
        case Not(content=content):
            return Not(before(content))
        case Both(contents=contents, join=join):
            return Both(tuple(before(one) for one in contents), join)
        case Happens(event=event) if isinstance(event.time, Unsaid):
            return Happens(with_fields(event, tense="perfect"))
        case Exists(thing=thing, time=time):
            return Exists(thing, time, "past")
    return of


def _inner_event(of: Proposition) -> Event | None:
    match of:
        case Happens(event=event) | Not(content=Happens(event=event)):
            return event
    return None


def _with_object(of: Proposition, thing: Thing | None) -> Proposition | None:
    event = _inner_event(of)
    if event is None or thing is None:
        return None
    if isinstance(thing, (Ego, Passenger, Pronoun)) and event.object is None:
        return Happens(structs.replace(event, actor=thing))
    if isinstance(thing, Described) and thing.rank and hasattr(event.object, "rank"):
        thing = with_fields(event.object, rank=thing.rank)
    return Happens(structs.replace(event, object=thing))


def _with_side(of: Proposition, side: str) -> Proposition | None:
    event = _inner_event(of)
    if event is None:
        return None
    stem = event.action.split("-")[0]
    if stem in ("exit", "change") and event.action.split("-")[-1] in ("left", "right", "straight"):
        way = f"{stem}-{side}" if stem == "exit" or side != "straight" else "continue"
        return Happens(structs.replace(event, action=way))
    if event.action in ("turn", "go"):
        return Happens(structs.replace(event, action=f"exit-{side}"))
    return Happens(structs.replace(event, side=side))


def _either_side(question: Question) -> Question:
    """Ask on which side of an event something was: "before or after you saw him"."""
    match question:
        case Whether(that=Happens(event=Event(time=Relative(relation="before") as time) as event)):
            later = structs.replace(event, time=structs.replace(time, relation="after"))
            return Whether(Both((Happens(event), Happens(later)), "or"))
        case Whether(that=Is(time=Relative(relation="before") as time) as that):
            after = structs.replace(that, time=structs.replace(time, relation="after"))
            return Whether(Both((that, after), "or"))
    return question
