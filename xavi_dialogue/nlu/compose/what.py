"""What and who: questions for a thing, an event or a person."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Changed,
    Doing,
    Fault,
    HowAvoid,
    HowKnow,
    HowMuch,
    Identify,
    Listing,
    Question,
    Summarise,
    WhatWouldChange,
    Where,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Back,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Measured,
    Next,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Relative,
    That,
    Thing,
    Unsaid,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.adoption import adopted, as_of, with_fields
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.lasting import measured
from xavi_dialogue.nlu.compose.nominal import asked_of, propose
from xavi_dialogue.nlu.compose.others import (
    expected_of,
    is_idle,
    is_vehicle,
    nearest,
    placed,
    shown,
    with_whom,
)
from xavi_dialogue.nlu.compose.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.tree import leaves_of
from xavi_dialogue.nlu.compose.wh import (
    Wh,
    fact,
    prevented,
)


class What:
    """Builds questions that "what" and "who" ask."""

    def what(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask what or who it is of which the clause holds."""
        lit = shown(clause)
        if lit is not None:
            return lit
        named = isinstance(clause.subject, Measure) or (
            isinstance(clause.subject, Noun) and clause.verb is None
        )
        if named and wh.kind == "what":
            return self._what_is(wh, clause)
        if isinstance(value, Special):
            found = self._what_special(wh, clause, value)
            if found is not None:
                return found
            value = fact(value)
        if value is None or _empty(clause) or _named(clause):
            return self._what_is(wh, clause)
        return _cost_asked(value) or self._what_holds(wh, clause, value)

    def _what_is(self, wh: Wh, clause: Clause) -> Question:
        subject = clause.subject
        open_ = isinstance(subject, Wanted) or subject is None
        open_ = open_ and not any(not isinstance(sem, Quantity) for sem, _ in clause.objects)
        if open_ and isinstance(clause.time, (WholeRide, Back)) and not clause.complements:
            return Doing(None, clause.time, "past")
        if open_ and clause.side == "left" and clause.verb is None:
            return HowMuch(Measured("distance-to-go"))  # "what's left?"
        if _next_named(clause):
            return Doing(Ego(), Next(), "future")
        if isinstance(subject, Wanted) or subject is None:
            subject = clause.objects[0][0] if clause.objects else Pronoun("that")
        for phrase in clause.complements:
            if phrase.sem is not None:
                subject = adopted(subject, phrase) or subject
        found = asked_of(subject, clause.time, clause.tense)
        return found or Identify(as_thing(subject) or Pronoun("that"))

    def _what_special(self, wh: Wh, clause: Clause, value: Special) -> Question | None:
        name, subject = value.name, value.subject
        time = clause.time
        match name:
            case "do":
                return self._doing(wh, clause, value)
            case "happen" | "happen-wrong":
                return self._happened(clause, value)
            case "load":
                return measured("load", clause, subject)
            case "driver" if isinstance(clause.subject, Wanted):
                return measured("occupant", clause, as_thing(value.object))
            case "make-do" | "cause":
                effect = fact(value)
                inner = effect.effect if isinstance(effect, Caused) else None
                if clause.modal in ("would", "could") and isinstance(clause.subject, Wanted):
                    return WhatWouldChange(inner)
                if isinstance(inner, Happens) and is_idle(inner.event):
                    return Doing(inner.event.actor, time)  # "what makes the lorry there?"
                return Why(inner or That())
            case "take-time" if isinstance(subject, Wanted) and not clause.gerund:
                return Why(Compares(Measured("duration", time=time), "more"))
            case "see" | "look" | "hear" if isinstance(value.subject, Ego) and wh.kind == "what":
                return Listing("vehicles", time=time)
            case "plan" if clause.tense == "past" and not isinstance(time, Unsaid):
                return Listing("decisions", time=time)
            case "plan" | "want" if isinstance(value.object, Wanted) or value.object is None:
                return Doing(subject, time, "future")
            case "plan" | "want" | "decide" if isinstance(value.content, Happens):
                then = value.content.event.time if isinstance(time, Unsaid) else time
                return Doing(subject, then, "future" if name != "decide" else "past")
        return _of_reasons(clause, value)

    def _doing(self, wh: Wh, clause: Clause, value: Special) -> Question:
        undone = clause.modal == "could" and clause.tense == "past"
        if (undone or clause.modal == "should") and not isinstance(clause.subject, Wanted):
            content = value.content
            avoiding = clause.infinitive is not None or "differently" in clause.focus
            if undone and content is None and isinstance(clause.subject, Ego) and not avoiding:
                return Listing("options", time=clause.time)
            return HowAvoid(content.content if isinstance(content, Not) else content)
        actor = as_thing(clause.subject) or Ego()
        if isinstance(clause.subject, Wanted):
            actor = Ego()
        if isinstance(actor, Passenger):
            actor = Ego()
        tense = clause.tense
        if clause.modal in ("would", "could", "should", "might") and tense != "past":
            tense = "future"
        besides = That() if wh.besides or clause.else_ else None
        return Doing(
            actor, clause.time, cast(Any, "past" if tense == "perfect" else tense), besides
        )

    def _happened(self, clause: Clause, value: Special) -> Question:
        about = next((as_thing(s) for s in value.match.phrases.values()), None)
        if is_vehicle(about or Ego()) and clause.tense in ("past", "perfect"):
            return Where(Event("go", cast(Thing, about), time=clause.time))
        if about is not None and not isinstance(about, Pronoun):
            return Summarise(about, clause.time)
        tense = clause.tense if clause.tense != "perfect" else "past"
        thing: Thing | None = about
        if thing is None and isinstance(clause.subject, Described):
            thing = clause.subject
        return Doing(thing, clause.time, cast(Any, tense))

    def _what_holds(self, wh: Wh, clause: Clause, value: Proposition) -> Question:
        wanted = _wanted(wh)
        match value:
            case Is(state="at-fault"):
                return Fault()
            case Happens(
                event=Event(action="change-plan", actor=Wanted(), modal="would" | "could")
            ):
                return WhatWouldChange()
            case Happens(event=Event(action="change-plan", actor=Wanted()) as event) if (
                wh.kind == "what"
            ):
                return Why(Happens(with_fields(event, actor=Ego())))
            case Related(relation="with", thing=Wanted(), to=to) if is_vehicle(to):
                return Doing(to, clause.time, "present")  # "what is up with that van"
            case Is(state="wrong", thing=Wanted()) if (who := with_whom(clause)) is not None:
                return Doing(who, clause.time, "present")
            case Is(state="over", thing=Wanted()) if clause.modal in ("could", "should"):
                return HowAvoid()
            case Is(state="wrong", thing=Wanted()):
                return Doing(None, clause.time, "present")
            case Happens(event=Event(action="come", actor=Wanted(), object=None, time=Relative())):
                return Doing(Ego(), clause.time, "future")  # "what comes after this turn?"
            case Related(thing=Wanted(), to=Ego()) if clause.focus & {"closest", "nearest"}:
                return Identify(nearest(value, wanted))
            case Happens(event=Event(action="go" | "continue", actor=Wanted(), object=None)):
                if "on" in {leaf.key for leaf in clause.particles} | {*clause.focus}:
                    return Doing(None, clause.time, cast(Any, clause.tense))
            case Related(relation="same-as", thing=Wanted(), to=to):
                return asked_of(to, clause.time, clause.tense) or Identify(to)
            case Caused(cause=Wanted(), effect=effect):
                return Why(effect or That())
            case Exists():
                return Listing("vehicles", time=clause.time)
            case Related(relation="near", thing=Wanted(), to=Described() as to) if _inside(clause):
                return measured("load" if wh.kind == "what" else "occupant", clause, to)
            case Related(relation=relation, thing=thing, to=to) if not _open(thing, to):
                return Identify(placed(relation, thing, to))
        if isinstance(value, Happens) and _complete(value.event):
            actor = value.event.actor
            if isinstance(actor, Described) and actor.doing is None:
                event = with_fields(value.event, actor=Wanted())
                return Identify(cast(Thing, with_fields(actor, doing=event)))
            if isinstance(actor, Pronoun) and actor.form in ("that", "this"):
                event = with_fields(value.event, actor=Wanted())
                return Identify(cast(Thing, Described(doing=event)))
            if wh.kind == "who" and isinstance(actor, Pronoun):
                return Which(wanted, Happens(with_fields(value.event, actor=Wanted())))
        if wh.kind == "what" and _does_something(value):
            value = cast(Happens, value)
            if value.event.modal in ("could", "should") and value.event.tense == "past":
                ours = value.event.modal == "could" and isinstance(value.event.actor, Ego)
                ours = ours and clause.infinitive is None and "differently" not in clause.focus
                return Listing("options", time=clause.time) if ours else HowAvoid()
            return Doing(value.event.actor, clause.time, cast(Any, clause.tense))
        return Which(wanted, value)


def _inside(clause: Clause) -> bool:
    """Say whether it is asked who or what is in a vehicle: "what is in that lorry?"."""
    return any(phrase.key == "in" for phrase in clause.complements)


def _next_named(clause: Clause) -> bool:
    """Say whether "what is next" is asked: of no thing that is said."""
    if isinstance(clause.time, Next):
        return clause.verb is None and not clause.complements
    named = [node for sem, node in clause.objects if sem == Described(rank=1)]
    words = {word for node in named for leaf in leaves_of(node) for word in leaf.words}
    return bool(words) and words <= {"next", "up"}


def _of_reasons(clause: Clause, value: Special) -> Question | None:
    """Ask what was considered, believed, decisive, preventive."""
    name, subject, time = value.name, value.subject, clause.time
    match name:
        case "consider" | "score":
            return Listing("options", time=time)
        case "know" | "believe" | "conclude":
            about = getattr(value.content, "event", None)
            thing = about.actor if about is not None else expected_of(value)
            if about is not None and isinstance(time, Unsaid):
                time = about.time  # "what did you expect it to do then"
            return Listing("beliefs", None if isinstance(thing, Ego) else thing, time)
        case "matter" | "influence" | "depend":
            return WhatWouldChange(None, most=True)
        case "decide" | "choose":
            return Listing("decisions", time=time)
        case "save" | "cost" if isinstance(by := value.match.phrases.get("by"), Event):
            return Why(as_of(Happens(by), value.clause.tense))
        case "achieve":
            by = value.match.phrases.get("by")
            return Why(as_of(Happens(by), clause.tense) if isinstance(by, Event) else That())
        case "change" if value.content is None and clause.modal is None:
            return Changed(time)
        case "require" | "change" | "need":
            return WhatWouldChange(value.content)
        case "prevent" if (denied := prevented(value)) is not None:
            if clause.modal in ("would", "could"):
                return HowAvoid(denied)
            return Why(Not(denied))
        case "take-time" if clause.infinitive is not None and clause.modal == "would":
            return WhatWouldChange(value.content)
        case "make-know":
            return HowKnow(value.content)
        case "prevent" | "help" | "improve":
            return HowAvoid(value.content or propose(value.object))
        case "tell" | "say" | "report":
            return HowKnow(value.content)
        case "cost" | "take-time" if isinstance(subject, (Pronoun, Event)):
            return measured("delay", clause, as_thing(subject))
    return None


def _cost_asked(value: Proposition) -> Question | None:
    """Read "what did that save us" as the question how much time it saved."""
    match value:
        case Compares(left=Measured(attribute="delay") as left, right=None) if not _open(
            left.thing
        ):
            return HowMuch(left)
    return None


def _wanted(wh: Wh) -> Thing:
    if isinstance(wh.sem, Described):
        return wh.sem
    return Wanted()


_SOUGHT = frozenset({"wait", "look", "head", "stand", "give way", "yield", "check", "aim", "use"})


def purpose(clause: Clause) -> bool:
    """Say whether "what ... for" asks for the reason: "what did you brake for"."""
    stranded = {phrase.key for phrase in clause.complements if phrase.sem is None}
    deed = isinstance(clause.subject, (Event, Pronoun)) and clause.verb is None
    about = any(leaf.words == ("about",) for leaf in clause.particles)
    alone = "for" in stranded or (deed and (about or "about" in stranded))
    return alone and (clause.verb is None or clause.verb.key not in _SOUGHT)


def _does_something(value: Proposition) -> bool:
    """Say whether it is asked what somebody does."""
    if not isinstance(value, Happens) or value.event.action != "do":
        return False
    return value.event.object is None or isinstance(value.event.object, (Wanted, Pronoun))


def _complete(event: Event) -> bool:
    """Say whether nothing is left open in an event."""
    return event.action not in ("do", "happen") and not _open(event.actor, event.object or Ego())


def _named(clause: Clause) -> bool:
    """Say whether "what is X" names X after the verb."""
    return clause.verb is None and isinstance(clause.subject, Wanted) and bool(clause.objects)


def _open(*things: Thing) -> bool:
    return any(isinstance(thing, Wanted) for thing in things)


def _empty(clause: Clause) -> bool:
    """Say whether nothing is said of the subject of "what is"."""
    return clause.verb is None and not (
        clause.objects or clause.complements or clause.bearings or clause.adjectives
        or clause.comparisons or clause.manner or clause.feelings
    )  # fmt: skip
