"""Verdicts: yes or no questions, and claims checked against the record."""

from dataclasses import replace as refound

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    Beliefs,
    Closeness,
    MotionReason,
    NeedRollout,
    NotRecorded,
    Priority,
    SupposedOfOther,
    Wavered,
)
from xavi_dialogue.domain.meaning import Claim, HowMuch, Whether, Why
from xavi_dialogue.domain.terms import (
    Believed,
    Caused,
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Junction,
    Measured,
    Nobody,
    Not,
    Now,
    Proposition,
    Quantity,
    Related,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName, State
from xavi_dialogue.explain.answers.events.acting import activity
from xavi_dialogue.explain.answers.expectations.foreseen import CROSSING, macros
from xavi_dialogue.explain.answers.propositions.conditions import handed
from xavi_dialogue.explain.answers.propositions.lasting import staying
from xavi_dialogue.explain.answers.propositions.nobody import of_nobody
from xavi_dialogue.explain.answers.propositions.weighing import weigh
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import window
from xavi_dialogue.explain.answers.reference.naming import first_look, is_us, number
from xavi_dialogue.explain.answers.reference.occasions import lacks_deeds, occasion
from xavi_dialogue.explain.answers.ride.onward import WAYS, whether_ours
from xavi_dialogue.explain.answers.suppositions.own_suppositions import claimed, of_us

#: Manners that are a matter of opinion; the reply is the reason for what we did.
JUDGED = frozenset(("late", "early", "long"))
HELD = frozenset[ActionName](("stop", "stand", "wait", "brake", "slow-down"))
THROUGH: tuple[ActionName, ...] = ("exit-left", "exit-right", "exit-straight")
LATELY = 2.0  # [s] before a time asked about in which we entered a junction then
HELD_BY_TREND: dict[str, ActionName] = {"standing": "stand", "slowing": "slow-down"}
PACES: dict[str, State] = {"fast": "fast", "slowly": "slow"}
PASSING = frozenset(("pass", "overtake"))
DRIVING = frozenset(("move", "go", "turn", "exit-left", "exit-right", "enter", "pass"))


def whether(question: Whether, asked: Asked) -> Answer:
    """Answer whether something holds, with the facts that support it or hold instead.

    Raises:
        Unanswered: it is about something unknown, or what did not happen; or it needs rollouts.
    """
    ours = whether_ours(question, asked)
    if ours is not None:
        return ours
    that = _as_chance(_as_state(_as_it_was(_affirmed(question.that), asked)))
    if (behind := _stays_behind(that, asked)) is not None:
        return staying(asked, behind)
    if (why := _disputed(that, asked)) is not None:
        return why
    found = _seen_since(that, weigh(that, asked), asked)
    if found.holds is False and isinstance(that, Happens) and lacks_deeds(asked.ride, that.event):
        raise Unanswered(NotRecorded("no-deeds"))
    that, found = of_nobody(that, found, asked)
    if question.tag and _is_denied(question.that) and found.holds and found.answer is None:
        told = _seen_since(Not(that), found.negated(), asked)
        return told.verdict(Not(that), claim=True)  # "actually", as "yes" is open
    if found.holds is False and (kept := _kept_behind(that, found, asked)) is not None:
        return kept
    if found.holds is False and isinstance(that, Happens) and "safely" in that.event.manner:
        that = Happens(replace(that.event, manner=()))  # it has not done so at all
    if question.degree and isinstance(found.answer, Closeness):
        return replace(found.answer, degree=True)
    if isinstance(found.answer, Priority):
        return _with_basis(asked, found.answer)
    return found.answer if found.answer is not None else found.verdict(that)


def _with_basis(asked: Asked, found: Priority) -> Priority:
    """Return a rule with its basis."""
    # Deferred import: the basis rests on reasons, which may be about propositions themselves.
    from xavi_dialogue.explain.answers.owing import reason

    return reason(asked, found)


def _kept_behind(that: Proposition, found: Finding, asked: Asked) -> Answer | None:
    """Return why we are not going to overtake, if the question is whether we are."""
    match that:
        case Happens(event=Event(action="overtake", actor=Ego(), tense="future") as event):
            reason = Why(Not(Happens(replace(event, tense="present", modal=None, time=Now()))))
            try:
                return handed(reason, asked) if not found.facts else None
            except Unanswered as unanswered:
                if isinstance(unanswered.result, NeedRollout):
                    raise
    return None


def _stays_behind(that: Proposition, asked: Asked) -> Vehicle | None:
    """Find the vehicle ahead, if the question is whether we are about to stay behind it."""
    match that:
        case Happens(
            event=Event(action="follow" | "move", actor=Ego(), object=Vehicle() as leader) as event
        ):
            if event.modal not in (None, "will", "want"):
                return None
            lasts = "long" in event.manner or isinstance(event.time, WholeRide)
            onward = event.tense == "future" or (event.tense == "present" and lasts)
            look = asked.world.look(leader.number, asked.now)
            ahead = look is not None and look.in_view and not look.oncoming and look.ahead > 0.0
            over = asked.past is not None and event.tense == "present"
            return leader if onward and ahead and not over else None
    return None


def _as_it_was(that: Proposition, asked: Asked) -> Proposition:
    """Read overtaking of somebody who stood or came towards us as driving past.

    Of a junction that we entered, it is the way through it that is on record.
    """
    if (way := _entered(that, asked)) is not None:
        return way
    if not isinstance(that, Happens) or that.event.action != "overtake":
        return that
    if isinstance(that.event.actor, Nobody) or isinstance(that.event.object, Nobody):
        return that  # nobody overtook: then somebody who came towards us matters not
    world, passed = asked.world, replace(that.event, action="pass")
    if world.holds(that.event, world.begin, asked.now):
        return that
    return Happens(passed) if world.holds(passed, world.begin, asked.now) else that


def _entered(that: Proposition, asked: Asked) -> Happens | Not | None:
    """Return our way through a junction, for whether we entered it."""
    match that:
        case Not(content=content):
            way = _entered(content, asked)
            return None if way is None else Not(way)
        case Happens(
            event=Event(action="enter", actor=Ego(), object=Junction(), modal=None) as event
        ) if event.tense in ("past", "perfect"):
            about = window(asked, event.time, event.tense)
            ways = asked.world.episodes(Ego(), THROUGH, about.begin, about.end)
            ways = tuple(w for w in ways if about.begin - LATELY <= w.begin <= about.end)
            if ways:
                return Happens(replace(event, action=ways[-1].action, object=None))
    return None


def _as_state(that: Proposition) -> Proposition:
    """Read "he is going too fast" as a statement that he is fast."""
    match that:
        case Not(content=content):
            return replace(that, content=_as_state(content))
        case Happens(event=event) if event.action in PASSING and "fast" in event.manner:
            return Happens(replace(event, manner=()))  # "he shot past"
        case Happens(event=event) if event.action in ("go", "move") and event.modal is None:
            state = next((PACES[m] for m in event.manner if m in PACES), None)
            if state is not None and (state == "fast" or not is_us(event.actor)):
                return Is(state, event.actor, time=event.time, tense=event.tense)
    return that


def _as_chance(that: Proposition) -> Proposition:
    """Read "could he pull out?" as whether he will; the chance shows what is possible."""
    match that:
        case Happens(event=Event(modal="can" | "could" | "might", tense="present") as event) if (
            number(event.actor) is not None and "first" not in event.manner
        ):
            into = event.action in CROSSING
            if into or (event.modal != "can" and macros(event)):  # "can" may be allowed to
                return Happens(replace(event, modal=None, tense="future"))
    return that


def _affirmed(that: Proposition) -> Proposition:
    """Return a question without its negation and "do you think"; "yes" affirms the fact itself."""
    while (isinstance(that, Not) and not that.lexical) or (
        isinstance(that, Believed)
        and that.tense == "present"
        and isinstance(that.time, Unsaid | Now)
    ):
        that = that.content
    return that


def _is_denied(that: Proposition) -> bool:
    """Check whether a question denies the fact, or that we think so."""
    of = that.content if isinstance(that, Believed) else that
    return isinstance(of, Not) and not of.lexical


def claim(act: Claim, asked: Asked) -> Answer:
    """Answer whether a claim is right: agree, deny with what held instead, or not known.

    Raises:
        Unanswered: it is about something unknown, or rollouts are needed.
    """
    that = _as_state(act.that)
    act = replace(act, that=_entered(that, asked) or that)
    if (why := _disputed(act.that, asked) or _our_way(act.that, asked)) is not None:
        return why
    if (wavering := _wavered(act.that, asked)) is not None:
        return wavering
    if (held := _held_now(act.that, asked)) is not None:
        return held
    found = _seen_since(act.that, weigh(act.that, asked), asked)
    if isinstance(found.answer, Priority):
        return replace(found.answer, claim=True)
    if isinstance(found.answer, Beliefs):
        return found.answer
    if found.answer is not None and (found.holds is None or _own_type(act.that)):
        return found.answer
    return found.verdict(act.that, claim=True, challenge=act.challenge)


def _held_now(that: Proposition, asked: Asked) -> Answer | None:
    """Return the reason why we stand or slow down now, for a claim that says that we do."""
    match that:
        case Happens(event=event) if event.action in HELD:
            pass
        case Not(content=Happens(event=Event(action="go" | "move") as event)):
            pass
        case _:
            return None
    said = asked.past is not None and asked.past.said
    now = event.tense == "perfect" and not said
    now = now or (event.tense == "present" and isinstance(event.time, Unsaid | Now))
    plain = event.modal is None and event.then is None and event.object is None
    doing = HELD_BY_TREND.get(activity(asked, Ego(), asked.now).trend or "")
    if not (is_us(event.actor) and now and plain) or doing is None:
        return None
    try:
        found = handed(Why(Happens(Event(doing, tense="present"))), refound(asked, span=None))
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    return found if isinstance(found, MotionReason) else None


def _wavered(that: Proposition, asked: Asked) -> Answer | None:
    """Return why we gave up a plan, for a claim that we are undecided, or start and stop."""
    match that:
        case Happens(event=Event(action="change-plan", actor=Ego(), modal=None) as event):
            pass
        case Happens(
            event=Event(
                action="go" | "move", actor=Ego(), then=Event(action="stop" | "brake")
            ) as event
        ):
            pass
        case _:
            return None
    changed = replace(event, action="change-plan", time=Unsaid(), then=None)
    try:
        found = handed(Why(Happens(changed)), asked)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    return replace(found, claim=True) if isinstance(found, Wavered) else None


def _our_way(that: Proposition, asked: Asked) -> Answer | None:
    """Return our way, for a claim which way we were or were not meant to go."""
    content = that.content if isinstance(that, Not) else that
    match content:
        case Happens(event=Event(actor=Ego(), modal="should" | "must") as event) if (
            event.action in WAYS or event.action == "leave"
        ):
            meant = replace(event, tense="present", modal=None, time=Unsaid())
            found = whether_ours(Whether(Happens(meant)), asked)
            return None if found is None else replace(found, holds=None)
    return None


def _disputed(that: Proposition, asked: Asked) -> Answer | None:
    """Return the reason for an action of ours that is called late, early or long, or its cost."""
    match that:
        case Not(content=Happens(event=Event(modal="should" | "would") as event)) if is_us(
            event.actor
        ):  # "I would not have stopped there"
            done = replace(event, modal=None, tense="past", time=Unsaid())
            return handed(Why(Happens(done)), asked) if occasion(asked, done) else None
        case Happens(event=event) if event.modal is None and is_us(event.actor):
            slow = "slowly" in event.manner and event.action in DRIVING
            judged = bool(set(event.manner) & JUDGED) and occasion(asked, event) is not None
            return handed(Why(that), asked) if slow or judged else None
        case Compares(left=Measured(attribute="count", event=Event(modal="could") as event)) if (
            is_us(event.actor)
        ):  # "you could have overtaken him twice by now"
            return handed(Whether(that), asked)
        case Compares(left=Measured(attribute="delay") as left, right=None | Quantity(unit="s")):
            return claimed(_cost(HowMuch(left), asked), that)
        case Compares(left=Measured(attribute="duration") as left, right=None):
            timed = number(left.thing) is not None
            return _cost(HowMuch(replace(left, attribute="delay")), asked) if timed else None
    return None


def _cost(question: HowMuch, asked: Asked) -> Answer:
    """Return what something cost in time, for a claim or question that it cost any."""
    # Deferred import: measures may be about propositions themselves.
    from xavi_dialogue.explain.answers.propositions.measures import how_much

    event = question.of.event
    if event is not None and event.modal in ("would", "could"):
        return of_us(event, asked, "quicker")
    found = how_much(question, asked)
    return replace(found, form="quicker") if isinstance(found, SupposedOfOther) else found


def _seen_since(that: Proposition, found: Finding, asked: Asked) -> Finding:
    """Return when we first saw a vehicle, not where it is, if a claim denies that we saw it."""
    match that:
        case Not(content=Related(relation="can-see", to=Vehicle(number=vehicle))):
            first = first_look(asked, vehicle, asked.world.begin)
            if first is not None and found.holds is False:
                return refound(found, facts=(first,))
    return found


def _own_type(that: Proposition) -> bool:
    """Check whether an answer of another type is a better reply to a claim than a verdict."""
    content = that.content if isinstance(that, Not) else that
    if isinstance(content, Caused):
        return True
    if isinstance(content, Is):
        return content.state not in ("right", "wrong")
    return not isinstance(content, Happens)
