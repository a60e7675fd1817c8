"""Discourse: how each turn changes the state of the conversation. Pure.

The discourse before a question is a fold over the turns of the ride, so that a resumed
conversation has the same state.
"""

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from typing import get_args

from msgspec.structs import replace

from xavi_dialogue.dialogue.state.turn import Part, Turn
from xavi_dialogue.domain.answers import (
    Activity,
    Answer,
    Beliefs,
    Bound,
    Cause,
    ChoiceReason,
    Contrast,
    Declined,
    DidNotHappen,
    Grounds,
    Happenings,
    Identified,
    Method,
    MotionCause,
    MotionReason,
    Options,
    OtherReason,
    PeakMoment,
    PlanAhead,
    Priority,
    Refusal,
    SupposedOfOther,
    SupposedOfUs,
    Verdict,
)
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Compare,
    Feel,
    Question,
    Request,
    WhatIf,
    Whether,
    Why,
)
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Now,
    Proposition,
    Tense,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.traffic_lights import Shown
from xavi_dialogue.nlu.grounding.salience import decayed, mention, mentions_of, renewed

REMEMBERED = 20  # turns; later ones no longer refer to what was said before them
ASSERTED = 6  # maximum of propositions that are kept
TIMES = 4  # maximum of moments named by the passenger that are kept
_UNSETTLED = frozenset(("do", "go", "overtake"))  # that a decision calls by another name
LONG = 60.0  # [s] longest episode that "that" or "then" may mean


def discourse_of(turns: Sequence[Turn]) -> Discourse:
    """Return the discourse after the turns of a ride, oldest first."""
    first = max(0, len(turns) - REMEMBERED)
    return reduce(after, turns[first:], Discourse(turn=first))


def after(discourse: Discourse, turn: Turn) -> Discourse:
    """Return the discourse after one more turn."""
    number = discourse.turn
    if turn.turned_away:
        return replace(discourse, turn=number + 1)
    offer = turn.offer
    said = tuple(_said(turn))
    question = next((q.question for q in reversed(said) if isinstance(q, Ask)), None)
    named = (*_mentions(turn, number), *_named(turn, number))
    weighed = _weighed(turn, discourse)
    return Discourse(
        turn=number + 1,
        mentions=renewed(decayed(discourse.mentions), named),
        question=question or discourse.question,
        propositions=(*_asserted(turn), *discourse.propositions)[:ASSERTED],
        episode=_episode(turn) or discourse.episode,
        offered=() if offer is None else offer.acts,
        offered_things=() if offer is None else offer.things,
        pending=None if offer is None else offer.pending,
        last_acts=said or discourse.last_acts,
        asked_at=turn.reply.sim_time if said else discourse.asked_at,
        option=weighed[0],
        decided=weighed[1],
        times=tuple(dict.fromkeys((*_times(turn), *discourse.times)))[:TIMES],
    )


def _weighed(turn: Turn, before: Discourse) -> tuple[Event | None, Event | None]:
    """Return the option of ours that a turn discussed, and what was decided instead of it.

    A turn that follows up on an earlier one keeps the earlier pair.
    """
    for part in reversed(turn.parts):
        asked = None if part.act is None else part.act.act
        option = _option_in(asked.question) if isinstance(asked, Ask) else None
        match part.result:
            case Options(risk=True, options=(told,)) if option is None:
                option = Event(told.action, tense="present")
            case Declined(reason=ChoiceReason(), request=Request(event=event)):
                option = replace(event, actor=Ego(), tense="present")
        against = next(parts(part.result, Contrast), None)
        if option is None or isinstance(part.result, get_args(Refusal)):
            continue
        done = None if against is None else next(iter(against.fact), None)
        if against is not None and option.action in _UNSETTLED:
            option = replace(option, action=against.foil[0])
        in_force = isinstance(option.time, Now) and getattr(part.result, "open_at", 0.0) is None
        if in_force or getattr(part.result, "past", True) is False:
            option = replace(option, time=Unsaid(), tense="present", modal=None)
        elif against is not None:
            option = replace(option, time=At(against.decided))
        return option, None if done is None else Event(done, tense=option.tense)
    if any(act.leaned for act in turn.acts):
        return before.option, before.decided
    return None, None


def _option_in(question: Question) -> Event | None:
    """Find the action of ours that is supposed, compared, asked why not, or asked to be safe."""
    match question:
        case (
            WhatIf(supposed=Happens(event=Event(actor=Ego()) as event))
            | Why(of=Not(content=Happens(event=Event(actor=Ego()) as event)))
            | Why(instead=Happens(event=Event(actor=Ego()) as event))
            | Compare(options=(Happens(event=Event(actor=Ego()) as event),))
            | Whether(that=Is(state="safe" | "dangerous", event=Event(actor=Ego()) as event))
        ):
            return event
    return None


def _times(turn: Turn) -> Iterator[float]:
    """Yield the moments [s] that the passenger named, latest first."""
    for act in reversed(turn.acts):
        if act.span is not None and act.span.said and not act.span.ahead:
            yield act.span.end


def _said(turn: Turn) -> Iterator[Ask | Claim | Request | Feel]:
    """Yield the acts about the drive; talk does not change what is under discussion."""
    for act in turn.acts:
        if isinstance(act.act, Ask | Claim | Request | Feel):
            yield act.act


def _mentions(turn: Turn, number: int) -> Iterator[Mention]:
    """Yield the things that the passenger mentioned, and those in the answers with their roles.

    A cause that the words of the reply omit has not been mentioned.
    """
    for act in turn.acts:
        yield from mentions_of(act.act, number)
    for part in turn.parts:
        for thing, role in _roles(part.result):
            cause = thing.number if role == "cause" and isinstance(thing, Vehicle) else None
            if cause is None or not turn.mentioned or cause in turn.mentioned:
                yield mention(thing, number, role, by_car=True)


def _roles(result: Answer | Refusal) -> Iterator[tuple[Thing, str]]:
    """Yield the things that an answer is about, with their roles."""
    for vehicle, _ in causes_of(result):
        if vehicle != 0:
            yield Vehicle(vehicle), "cause"
    if isinstance(result, Identified) and len(result.looks) > 1:
        yield Vehicles(tuple(look.vehicle for look in result.looks)), "subject"
    elif isinstance(result, Identified):
        yield from ((Vehicle(look.vehicle), "subject") for look in result.looks)
    for episode in parts(result, Episode):
        yield from _others(episode.actor, episode.object)
    for measure in parts(result, Measure):
        yield from _others(measure.thing, measure.to)
    for light in dict.fromkeys(shown.light for shown in parts(result, Shown)):
        yield light, "cause"


def causes_of(result: Answer | Refusal) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Yield the vehicles that an answer names as causes, with what was expected of each."""
    for cause in parts(result, Cause):
        yield cause.vehicle, tuple(cause.actions)
    for reason in parts(result, MotionCause):
        if reason.vehicle is not None:
            yield reason.vehicle, tuple(reason.actions)


def _others(*things: Thing | None) -> Iterator[tuple[Thing, str]]:
    yield from ((thing, "other") for thing in things if isinstance(thing, Vehicle))


def _named(turn: Turn, number: int) -> Iterator[Mention]:
    """Yield the vehicles that the words of the reply name."""
    for vehicle in turn.mentioned:
        yield mention(Vehicle(vehicle), number, "other", by_car=True)


def _asserted(turn: Turn) -> Iterator[Proposition]:
    """Yield what either side asserted, the latest and most relevant first."""
    for part in reversed(turn.parts):
        told = tuple(_answered(part))
        yield from told
        act = None if part.act is None else part.act.act
        if isinstance(act, Claim):
            yield act.that
        elif isinstance(act, Ask) and isinstance(act.question, Whether) and not told:
            yield act.question.that


def _answered(part: Part) -> Iterator[Proposition]:
    """Yield what the car asserted in answer to one act."""
    result = part.result
    match result:
        case Verdict(that=that, holds=True):
            yield that
        case Verdict(that=that, holds=False):
            yield that.content if isinstance(that, Not) else Not(that)
        case ChoiceReason(deed=Episode() as deed) | MotionReason(deed=deed):
            yield Happens(event_of(deed))
        case OtherReason(deed=Episode() as deed) | Bound(went=Episode() as deed):
            yield Happens(event_of(deed))
        case Happenings(episodes=episodes) if episodes:
            yield Happens(event_of(episodes[-1]))
        case Identified(facts=facts) if deeds := [f for f in facts if isinstance(f, Episode)]:
            yield Happens(event_of(deeds[-1]))
        case PeakMoment(deeds=deeds) if deeds:
            yield Happens(event_of(deeds[0]))
        case DidNotHappen(asked=asked, instead=instead):
            yield from (Happens(event_of(one)) for one in instead[-1:])
            yield Not(Happens(asked))
        case SupposedOfUs(contrast=contrast):
            ours = contrast.foil[:1]
            yield from (Happens(Event(a, time=At(contrast.decided), modal="would")) for a in ours)
        case SupposedOfOther(then=then, past=past):
            tense: Tense = "past" if past else "future"
            yield from (Happens(Event(a, tense=tense, modal="would")) for a in then[:1])
        case Grounds(vehicle=vehicle, actions=actions) if actions:
            yield Happens(Event(actions[-1], Vehicle(vehicle), tense="future", modal="will"))
        case PlanAhead(steps=steps):
            yield from (Happens(Event(a, tense="future", modal="will")) for a, _ in steps[:1])
        case Activity(doing=doing) if doing:
            yield Happens(event_of(doing[-1]))
        case Activity(belief=belief) | Bound(belief=belief) if belief is not None:
            yield from _expected(belief.vehicle, belief.expectations[:1])
        case Beliefs(history=history) if history:
            yield from _expected(history[-1].vehicle, history[-1].expectations[:1])


def _expected(vehicle: int, likeliest: Iterable[object]) -> Iterator[Proposition]:
    for expectation in likeliest:
        for action in getattr(expectation, "actions", ())[-1:]:
            yield Happens(Event(action, Vehicle(vehicle), tense="future", modal="will"))


def event_of(deed: Episode) -> Event:
    """Return an episode as the event that it was."""
    tense: Tense = "present" if deed.end is None else "past"
    return Event(
        action=deed.action,
        actor=deed.actor,
        object=deed.object,
        side=deed.side,
        time=At(deed.begin),
        tense=tense,
    )


def _episode(turn: Turn) -> tuple[float, float] | None:
    """Return the part of the ride [s] that was discussed last, for "that" and "then"."""
    now = turn.reply.sim_time
    for part in reversed(turn.parts):
        found = _told(part.result, now) or _asked(part)
        if found is not None and found[1] - found[0] <= LONG:
            return found
    return None


def _told(result: Answer | Refusal, now: float) -> tuple[float, float] | None:
    match result:
        case ChoiceReason(deed=Episode() as deed) | MotionReason(deed=deed):
            return _stretch(deed, now)
        case OtherReason(deed=Episode() as deed) | Bound(went=Episode() as deed):
            return _stretch(deed, now)
        case ChoiceReason(contrast=contrast) | SupposedOfUs(contrast=contrast):
            return contrast.decided, contrast.decided
        case Method(decided=float() as decided):
            return decided, decided
        case Happenings(form="list" | "summary"):
            return None
        case Priority(time=time) | Beliefs(time=float() as time):
            return time, time
    deeds = tuple(parts(result, Episode))
    if deeds:
        return _stretch(deeds[-1], now)
    measures = [m for m in parts(result, Measure) if m.gap is None and m.time < now]
    return (measures[0].time, measures[0].until or measures[0].time) if measures else None


def _asked(part: Part) -> tuple[float, float] | None:
    span = None if part.act is None else part.act.span
    return None if span is None or span.ahead else (span.begin, span.end)


def _stretch(deed: Episode, now: float) -> tuple[float, float]:
    return deed.begin, now if deed.end is None else deed.end
