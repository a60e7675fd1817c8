"""What and who: questions for a thing, an event or a person."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Doing,
    Fault,
    HowAvoid,
    HowKnow,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Question,
    WhatWouldChange,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Back,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Junction,
    Measured,
    Next,
    Not,
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
from xavi_dialogue.nlu.compose.alternatives.nearness import rivals
from xavi_dialogue.nlu.compose.clauses.adoption import adopted, with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.nominal import asked_of, deed_of, propose
from xavi_dialogue.nlu.compose.clauses.peaks import longest_of
from xavi_dialogue.nlu.compose.clauses.risks import is_danger, risk_beside, who_endangers
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of, words_of
from xavi_dialogue.nlu.compose.propositions.propositions import Propositions
from xavi_dialogue.nlu.compose.verbs.others import (
    is_idle,
    is_vehicle,
    nearest,
    placed,
    pointed_out,
    shown,
    with_lane,
    with_whom,
)
from xavi_dialogue.nlu.compose.wh_questions import doings
from xavi_dialogue.nlu.compose.wh_questions.lasting import measured
from xavi_dialogue.nlu.compose.wh_questions.pointing import as_said, who_there
from xavi_dialogue.nlu.compose.wh_questions.reasoning import reasoned
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh, content_of, fact, held_then, pointed_at


class What:
    """Builds questions that "what" and "who" ask."""

    propositions: Propositions

    def what(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask what or who it is of which the clause holds."""
        if (lit := shown(clause) or longest_of(clause)) is not None:
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
        return _amount_asked(value) or self._what_holds(wh, clause, value)

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
            subject = clause.objects[0][0] if clause.objects else pointed_at(clause)
        subject = as_said(subject, clause)
        for phrase in clause.complements:
            if phrase.sem is not None:
                subject = adopted(subject, phrase) or subject
        if isinstance(subject, Noun) and subject.key == "rival":
            return rivals(clause)
        if wh.kind == "who" and is_danger(subject):
            return who_endangers(clause)
        found = risk_beside(clause, subject) or asked_of(subject, clause.time, clause.tense)
        return _person(wh, found or Identify(as_thing(subject) or Pronoun("that")))

    def _what_special(self, wh: Wh, clause: Clause, value: Special) -> Question | None:
        name, subject = value.name, value.subject
        time = clause.time
        match name:
            case "do":
                return doings.doing(wh, clause, value)
            case "happen" | "happen-wrong":
                return doings.happened(clause, value)
            case "load":
                return measured("load", clause, subject)
            case "driver" if isinstance(clause.subject, Wanted):
                return measured("occupant", clause, as_thing(value.object))
            case "make-do" | "cause":
                effect = fact(value)
                inner = effect.effect if isinstance(effect, Caused) else None
                if clause.modal in ("would", "could") and isinstance(clause.subject, Wanted):
                    return _lacking(inner) or WhatWouldChange(inner)
                if isinstance(inner, Happens) and is_idle(inner.event):
                    return Doing(inner.event.actor, time)  # "what makes the lorry there?"
                if inner in (None, That()) and isinstance(time, AtDecision | At):
                    inner = Happens(Event("do", object=Pronoun("that"), time=time))
                return Why(inner or That())  # "what tipped it at decision 3?"
            case "make-safe" if isinstance(value.content, Happens):
                event = value.content.event  # "what made it all right to go?"
                ours = with_fields(event, actor=Ego()) if _open(event.actor) else event
                return Why(Is("safe", event=cast(Any, ours), tense=cast(Any, clause.tense)))
            case "take-time" if isinstance(subject, Wanted) and not clause.gerund:
                return Why(Compares(Measured("duration", time=time), "more"))
            case "see" | "look" | "hear" if isinstance(value.subject, Ego) and wh.kind == "what":
                return Listing("hidden" if clause.negated else "vehicles", who_there(clause), time)
            case "assign" | "give-priority" if isinstance(value.object, Wanted):
                held = held_then(clause, content_of(clause, value))
                return HowSure(held, time)  # "what did you give it?"
            case "rest":
                based = propose(clause.subject)  # "what is that based on?"
                return HowKnow(None if based == That() else based)
            case "plan" if clause.tense == "past" and not isinstance(time, Unsaid):
                return Listing("decisions", time=time)
            case "plan" | "want" if isinstance(value.object, Wanted) or value.object is None:
                return Doing(subject, time, "future")
            case "plan" | "want" | "decide" if isinstance(value.content, Happens):
                then = value.content.event.time if isinstance(time, Unsaid) else time
                return Doing(subject, then, "future" if name != "decide" else "past")
        return reasoned(clause, value)

    def _of_change(self, wh: Wh, clause: Clause, event: Event) -> Question | None:
        """Ask what would change a plan, or what changed it: "what made you change your mind?"."""
        plan = event.action == "change-plan"
        if plan and event.modal in ("would", "could"):
            return WhatWouldChange()
        if event.modal == "must":
            governed = clause.that or clause.infinitive
            return WhatWouldChange(None if governed is None else self.propositions.plain(governed))
        if plan and wh.kind == "what":
            return Why(Happens(with_fields(event, actor=Ego())))
        return None

    def _what_holds(self, wh: Wh, clause: Clause, value: Proposition) -> Question:
        wanted = _wanted(wh)
        match value:
            case Is(state="at-fault"):
                return Fault()
            case Happens(
                event=Event(action="change-plan" | "change-lane", actor=Wanted()) as event
            ):
                if (changing := self._of_change(wh, clause, event)) is not None:
                    return changing
            case Related(relation="with", thing=Wanted(), to=to) if is_vehicle(to):
                return doings.up_with(to, clause.time)
            case Is(state="wrong", thing=Wanted()) if (who := with_whom(clause)) is not None:
                return Doing(who, clause.time, "present")
            case Is(state="over", thing=Wanted()) if clause.modal in ("could", "should"):
                return HowAvoid()
            case Is(state="wrong", thing=Wanted()) if (lane := with_lane(clause)) is not None:
                kept = Event("keep-lane", object=lane, tense=cast(Any, clause.tense))
                return Why(Not(Happens(kept)))  # "what's wrong with this lane?"
            case Is(state="wrong", thing=Wanted() | Ego()) if clause.verb is not None:
                return Listing("wrong-predictions", time=clause.time)  # "what did you get wrong?"
            case Is(state="wrong", thing=Wanted()):
                return Doing(None, clause.time, "present")
            case Happens(event=Event(action="come", actor=Wanted(), object=None, time=time)) if (
                isinstance(time, Relative | Next) or doings.comes_up(wh, clause)
            ):  # "what comes after this turn?", "what's coming up?"
                return Doing(Ego(), clause.time, "future")
            case Related(thing=Wanted(), to=Ego()) if clause.focus & {"closest", "nearest"}:
                return Identify(nearest(value, wanted))
            case Happens(event=Event(action="go" | "continue", actor=Wanted(), object=None)):
                if "on" in {leaf.key for leaf in clause.particles} | {*clause.focus}:
                    return Doing(None, clause.time, cast(Any, clause.tense))
            case Happens(
                event=Event(
                    action="move" | "go" | "stand", actor=Wanted(), manner=(), where=Related() as at
                )
            ):  # "what is driving in front of the bus"
                return Which(wanted, with_fields(at, time=clause.time))
            case Related(relation="same-as", thing=Wanted(), to=to):
                return asked_of(to, clause.time, clause.tense) or Identify(to)
            case Is(state="present", thing=Described(definite=True) as thing, event=None):
                return Identify(cast(Thing, thing))  # "what is that big thing over there"
            case Caused(cause=Wanted(), effect=effect):
                return Why(effect or That())
            case Exists():
                return Listing("vehicles", time=clause.time)
            case Related(
                relation="near" | "on", thing=Wanted(), to=Described() | Pronoun() as to
            ) if _inside(clause):
                return measured("load" if wh.kind == "what" else "occupant", clause, to)
            case Related(relation=relation, thing=thing, to=to) if not _open(thing, to):
                found = placed(relation, thing, to)
                for phrase in clause.complements:  # "who is that behind us on the motorbike"
                    found = cast(Thing, adopted(found, phrase) or found)
                return _person(wh, Identify(found))
        if (doer := _doer(wh, clause, value)) is not None:
            return doer
        done = doings.deed_asked(clause, value) if wh.kind == "what" else None
        return done or Which(wanted, value)


def _person(wh: Wh, found: Question) -> Question:
    """Give a question for somebody; who is asked for is no place."""
    those = found.thing if isinstance(found, Identify) else None
    place = those if wh.kind == "who" else None
    if not isinstance(place, Junction):
        return found
    return Which(Wanted(), Related("same-as", Wanted(), place))


def _doer(wh: Wh, clause: Clause, value: Proposition) -> Question | None:
    """Ask who or what does something: "who is that turning left?"."""
    if not isinstance(value, Happens):
        return None
    if (doer := pointed_out(clause, value.event)) is not None:
        return Identify(doer)
    if _complete(value.event):
        actor = value.event.actor
        if isinstance(actor, Described) and actor.doing is None:
            event = with_fields(value.event, actor=Wanted())
            return Identify(cast(Thing, with_fields(actor, doing=event)))
        if isinstance(actor, Pronoun) and actor.form in ("that", "this"):
            event = with_fields(value.event, actor=Wanted())
            return Identify(cast(Thing, Described(doing=event)))
        if wh.kind == "who" and isinstance(actor, Pronoun):
            return Which(_wanted(wh), Happens(with_fields(value.event, actor=Wanted())))
    return None


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


def _amount_asked(value: Proposition) -> Question | None:
    """Read "what did that save us" as how much time, "what is allowed here" as how fast."""
    match value:
        case Is(state="allowed", thing=Wanted(), event=None):
            return HowMuch(Measured("limit", time=value.time))
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
    stranded = {phrase.key for phrase in clause.complements if _is_stranded(phrase)}
    named = deed_of(clause.subject) is not None or isinstance(clause.subject, Pronoun)
    deed = (clause.verb is None and named) or going_on(clause)
    about = any(leaf.words == ("about",) for leaf in clause.particles)
    alone = "for" in stranded or (deed and (about or "about" in stranded))
    return alone and (clause.verb is None or clause.verb.key not in _SOUGHT)


def going_on(clause: Clause) -> bool:
    """Say whether "that" goes with a deed: "what was all that braking about"."""
    verb, subject = clause.verb, clause.subject
    pointed = isinstance(subject, Pronoun) and subject.form in ("that", "this")
    return pointed and verb is not None and verb.category == "VING"


def _is_stranded(phrase: Complement) -> bool:
    """Say whether nothing stands behind a preposition, or when it is: "for this time"."""
    said = words_of(phrase.node).split() if isinstance(phrase.sem, Noun) else []
    return phrase.sem is None or said[-2:] in (["this", "time"], ["that", "time"])


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


def _lacking(effect: Proposition | None) -> Question | None:
    """Ask what keeps us from another speed: no decision turns on it, so that none can be varied."""
    match effect:
        case Happens(event=Event(actor=Ego(), action="speed-up")):
            return Why(Not(effect))
    return None
