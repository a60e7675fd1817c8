"""Telling: what an order or a polite question to tell, list or explain something asks."""

from typing import Any, Final, cast

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Compare,
    HowMany,
    Identify,
    Listing,
    Question,
    Repair,
    Summarise,
    WhatIf,
    When,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ago,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Happens,
    Junction,
    Next,
    Passenger,
    Pronoun,
    Proposition,
    Relative,
    That,
    Thing,
    Time,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.compose.clauses.adoption import timed, with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import asked_of, counted, propose
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Moment, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.propositions.severally import asked_each, towards
from xavi_dialogue.nlu.compose.verbs.others import is_person
from xavi_dialogue.nlu.compose.wh_questions.frames import is_short
from xavi_dialogue.nlu.compose.wh_questions.rating import rated
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh

_SHOWING = frozenset(
    {"give", "show", "describe", "report", "provide", "present", "walk me through"}
)


class Telling:
    """Turns orders to tell into questions."""

    composer: Any

    def embedded(self, clause: Clause) -> tuple[Act, ...]:
        """Give the acts of the embedded question of a clause."""
        wh, questions = cast("tuple[Wh | None, list[Question]]", clause.question)
        if questions:
            framed = self.composer.questions.framed(questions[0], clause, None)
            return (Ask(framed), *(Ask(question) for question in clause.also))
        if wh is not None and wh.kind == "why":
            return (Repair("why"),)
        return ()

    def asked_time(self, clause: Clause) -> Any:
        """Tell the time that an embedded question is about."""
        _, questions = cast("tuple[Wh | None, list[Question]]", clause.question)
        return getattr(questions[0], "time", clause.time) if questions else clause.time

    def told(self, clause: Clause, value: Special) -> tuple[Act, ...]:
        """Give the question that an order to tell something amounts to."""
        sem = self._told_of(clause, value)
        name = value.name
        if name == "justify":
            content = value.content or propose(sem)
            why = Why(timed(content or That(), clause.time))
            return (Ask(self.composer.questions.framed(why, clause, None)),)
        if name == "compare":
            return self._compared(clause, sem)
        if name == "count" and sem is not None:
            question = counted(sem)
            return (Ask(question or HowMany(Described(plural=True))),)
        if name == "summarise":
            return (Ask(Summarise(_summary(sem), _summed(sem, clause.time))),)
        done = None if value.content is None else _all_done(sem, value.content)
        if name in ("list", "summarise", "describe") and done is not None:
            return (Ask(done),)
        if name == "list":
            return (Ask(_listing(sem, clause)),)
        if name == "describe":
            return (Ask(_description(sem, clause)),)
        if name == "rate":
            rating = rated(clause, value)
            return () if rating is None else (Ask(rating),)
        if name not in (
            "tell",
            "report",
            "show",
            "identify",
            "name",
            "say",
            "know",
            "understand",
            "ask",
        ):
            return ()
        return self._told(clause, value, sem)

    def asked_if(self, clause: Clause) -> Question | None:
        """Read "tell me if he brakes" and "remind me when he braked" as the question there."""
        given = clause.condition
        if given is not None and not clause.led and not is_short(given):
            found = self.composer.questions.whether(given)
            return cast(Question, found[0][0]) if found else None
        match clause.time:
            case Relative(relation="during", anchor=Event() as event):
                return When(Happens(event))
        return None

    def _told(self, clause: Clause, value: Special, sem: Sem | None) -> tuple[Act, ...]:
        if value.content is None and isinstance(sem, Passenger | Pronoun | None):
            inner = self.asked_if(clause)
            if inner is not None:
                return (Ask(inner),)
        if clause.verb is not None and clause.verb.key == "say" and clause.that is not None:
            supposed = self.composer.questions.supposed(clause.that)
            if supposed is not None:
                return (Ask(WhatIf(supposed)),)  # "say he had braked"
        if value.content is not None and clause.that is not None:
            return (Ask(_all_done(sem, value.content) or Whether(value.content)),)
        if sem is None and isinstance(clause.time, Ago | WholeRide):
            return (Ask(Summarise(time=clause.time)),)  # "tell me about the last ten seconds"
        if sem is None or isinstance(sem, (Passenger, Pronoun)):
            return (Repair("longer" if value.name == "tell" else "repeat"),)
        if isinstance(sem, Event):
            if clause.verb is not None and clause.verb.key in _SHOWING and sem.action != "do":
                return (Ask(Summarise(sem, clause.time)),)
            return (Ask(Why(timed(Happens(sem), clause.time))),)
        if isinstance(sem, (Moment, Unknown)):
            return (Ask(Identify(sem)),) if isinstance(sem, Unknown) else ()
        each = asked_each(sem, clause, clause.tense)
        if each:
            return tuple(Ask(question) for question in each)
        thing = as_thing(sem)
        if isinstance(thing, (Described, Vehicle)) and any(
            p.key == "about" for p in clause.complements
        ):
            return (Ask(Summarise(thing, clause.time)),)
        if isinstance(thing, Junction):
            return (Ask(Summarise(thing, clause.time)),)  # "give me the whole junction"
        question = asked_of(towards(sem, clause.complements), clause.time, clause.tense)
        if isinstance(question, Why):
            question = Why(timed(question.of, clause.time))
        return (Ask(question),) if question is not None else ()

    def _told_of(self, clause: Clause, value: Special) -> Sem | None:
        for sem in (value.match.second, value.object, *value.match.phrases.values()):
            if sem is not None and not isinstance(sem, Passenger):
                return sem
        left = [sem for sem, _ in clause.objects if not isinstance(sem, Passenger)]
        return left[0] if left else None

    def _compared(self, clause: Clause, sem: Sem | None) -> tuple[Act, ...]:
        members: list[Sem | None] = list(sem.members) if isinstance(sem, Group) else [sem]
        if sem is None and clause.gerund is not None:
            inner = clause.gerund
            members = [self.composer.propositions.as_deed(inner)]
            members += [p.sem for p in inner.complements if p.key in ("with", "into")]
        members += [p.sem for p in clause.complements if p.key in ("with", "into")]
        options = tuple(
            Happens(m) if isinstance(m, Event) else as_thing(m) for m in members if m is not None
        )
        return (Ask(Compare(cast(Any, tuple(o for o in options if o is not None)), "best")),)


def _all_done(sem: Sem | None, content: Proposition) -> Listing | None:
    """Read "everything that vehicle 1 did" as all its deeds."""
    match sem, content:
        case Noun(word="everything"), Happens(event=Event(action="do" | "happen") as event):
            return Listing("events", None if event.actor == Ego() else event.actor, event.time)
    return None


def _summed(sem: Sem | None, time: Time) -> Time:
    """Give the time of "the decisions you made since the turn", which the clause in it may tell."""
    if isinstance(time, Unsaid) and isinstance(sem, Noun) and isinstance(sem.clause, Happens):
        return sem.clause.event.time
    return time


def _summary(sem: Sem | None) -> Thing | Event | None:
    if sem is None or isinstance(sem, (Noun, Measure, Moment)):
        return None
    if isinstance(sem, Event):
        return sem
    thing = as_thing(sem)
    from_ride = getattr(thing, "form", "") in ("it", "that", "this")
    return None if from_ride else thing


_TIMES: Final = frozenset({"time", "times", "moment", "moments", "occasion", "occasions"})


def _listing(sem: Sem | None, clause: Clause) -> Question:
    match sem, clause.time:
        case Noun(word=word), Relative(relation="during", anchor=Event() as event) if (
            word in _TIMES
        ):  # "the moments when you braked"
            return listed(event, Unsaid())
    if sem is None:
        return Listing("events", time=clause.time)
    if isinstance(sem, Event):
        if sem.tense == "future" or _lies_ahead(clause.time):
            return HowMany(cast(Event, with_fields(sem, tense="future", time=Unsaid())))
        return listed(sem, clause.time)
    thing = as_thing(sem)
    if isinstance(thing, Described):
        met = thing.doing is not None and _is_met(thing.doing)
        if met:
            whom = None if thing.kind == "vehicle" else Everyone(thing.kind)
            return Listing("vehicles", whom, WholeRide())
        due = thing.doing is not None and thing.doing.modal is not None  # "you have to yield to"
        if thing.doing is not None and isinstance(thing.doing.object, Wanted) and not due:
            return listed(cast(Event, with_fields(thing.doing, object=None)), clause.time)
        return Listing("vehicles", thing, clause.time)
    found = asked_of(sem, clause.time)
    match found:
        case When(Happens(Event(object=Wanted()) as event)):  # "the times you braked"
            return listed(cast(Event, with_fields(event, object=None)), clause.time)
    return found or Listing("events", time=clause.time)


def _lies_ahead(time: Time) -> bool:
    """Say whether a stretch is still to come: "from here on", "until we arrive"."""
    if isinstance(time, Relative) and time.relation == "until":
        return isinstance(time.anchor, Destination) or (
            isinstance(time.anchor, Event) and time.anchor.tense != "past"
        )
    return isinstance(time, Next | Within)


def _is_met(doing: Event) -> bool:
    """Say whether it is all who were met: "that came towards us"; who went past did more."""
    return doing.action in ("approach", "see", "come", "appear")


def listed(event: Event, time: Time) -> Listing:
    """List the events of a kind; what is done without a name is all that happened."""
    if event.action in ("do", "happen"):
        return Listing("events", time=time)
    if event.action == "stop":
        return Listing("stops", time=time)
    return Listing("events", time=time, event=cast(Event, with_fields(event, tense="past")))


def _description(sem: Sem | None, clause: Clause) -> Question:
    thing = as_thing(sem)
    if isinstance(thing, Described | Vehicle) or is_person(thing):
        return Identify(cast(Thing, thing))
    if isinstance(sem, Event):
        return Summarise(sem, clause.time)
    measured = asked_of(sem, clause.time) if isinstance(sem, Measure) else None
    return measured or Summarise(None, clause.time)
