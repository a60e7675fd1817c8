"""Discourse: how each turn changes the state of the conversation. Pure.

The discourse before a question is a fold over the turns of the ride, so that a resumed
conversation has the same state.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import TypeAlias, get_args

from msgspec.structs import replace

from xavi_dialogue.dialogue.state.assertions import asserted
from xavi_dialogue.dialogue.state.focus import episode_of, moments_told, stretch_named
from xavi_dialogue.dialogue.state.turn import Turn, kept
from xavi_dialogue.domain.answers import (
    Answer,
    Cause,
    Contrast,
    Declined,
    Identified,
    MotionCause,
    NotApplicable,
    Options,
    Refusal,
)
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Compare,
    Feel,
    Identify,
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
    Junction,
    Not,
    Now,
    Proposition,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.traffic_lights import Shown
from xavi_dialogue.domain.vocabulary import MACRO_ACTIONS
from xavi_dialogue.nlu.grounding.salience import decayed, mention, mentions_of, renewed

REMEMBERED = 20  # turns; later ones no longer refer to what was said before them
ASSERTED = 6  # maximum of propositions that are kept
TIMES = 4  # maximum of moments named by the passenger that are kept
_UNSETTLED = frozenset(("do", "go", "overtake"))  # that a decision calls by another name
#: What we could do or not: "could you overtake?" is of an option, "could you see it?" is not.
OPTIONAL = frozenset((*MACRO_ACTIONS, "overtake", "change-lane", "turn", "go", "pass",
                      "enter", "leave", "merge", "speed-up", "keep-lane", "wait"))  # fmt: skip
POSSIBLE = ("can", "could", "should", "might")
STALE = 15.0  # [s] between two questions after which the earlier one is over


def discourse_of(turns: Sequence[Turn]) -> Discourse:
    """Return the discourse after the turns of a ride, oldest first."""
    first = max(0, len(turns) - REMEMBERED)
    return reduce(after, turns[first:], Discourse(turn=first))


def after(discourse: Discourse, turn: Turn) -> Discourse:
    """Return the discourse after one more turn."""
    number = discourse.turn
    if turn.turned_away:
        return replace(discourse, turn=number + 1)
    offer, new = turn.offer, _news(turn)
    named = (replace(one, turn=number) for one in new.mentions)
    before = (discourse.option, discourse.decided)
    weighed = before if new.weighed is None else new.weighed
    return Discourse(
        turn=number + 1,
        mentions=renewed(decayed(discourse.mentions), named),
        question=new.question or discourse.question,
        propositions=(*new.propositions, *discourse.propositions)[:ASSERTED],
        episode=new.episode or (None if _is_over(discourse, turn) else discourse.episode),
        stretch=discourse.stretch if new.episode in (None, discourse.stretch) else new.stretch,
        offered=() if offer is None else offer.acts,
        offered_things=() if offer is None else offer.things,
        pending=None if offer is None else offer.pending,
        last_acts=new.said or discourse.last_acts,
        asked_at=turn.reply.sim_time if new.said else discourse.asked_at,
        weighed_at=discourse.weighed_at if new.weighed_at is None else new.weighed_at,
        option=weighed[0],
        decided=weighed[1],
        anchor=new.anchor if new.question is not None else discourse.anchor,
        times=tuple(dict.fromkeys((*new.times, *discourse.times)))[:TIMES],
        moments=tuple(dict.fromkeys((*new.moments, *discourse.moments)))[:TIMES],
    )


def _is_over(discourse: Discourse, turn: Turn) -> bool:
    """Check whether what was spoken of is too long ago to be meant by "that" any more."""
    asked = discourse.asked_at
    return asked is not None and turn.reply.sim_time - asked > STALE


_Weighed: TypeAlias = tuple[Event | None, Event | None]


@dataclass(frozen=True, slots=True)
class _News:
    """What a turn adds to the discourse, whatever was said before it."""

    said: tuple[Ask | Claim | Request | Feel, ...]
    question: Question | None
    mentions: tuple[Mention, ...]  # as if in turn 0
    propositions: tuple[Proposition, ...]
    episode: tuple[float, float] | None
    stretch: tuple[float, float] | None
    weighed: _Weighed | None  # None: as before
    weighed_at: float | None  # None: as before
    anchor: Event | Junction | None
    times: tuple[float, ...]
    moments: tuple[float, ...]


@kept
def _news(turn: Turn) -> _News:
    said = tuple(_said(turn))
    return _News(
        said=said,
        question=_under_discussion(turn, said),
        mentions=(*_mentions(turn, 0), *_named(turn, 0)),
        propositions=tuple(asserted(turn))[:ASSERTED],
        episode=episode_of(turn),
        stretch=stretch_named(turn),
        weighed=_weighed(turn),
        weighed_at=next((r.decided for r in turn.results if isinstance(r, Options)), None),
        anchor=next((a.anchor for a in reversed(turn.acts) if a.anchor is not None), None),
        times=tuple(_times(turn)),
        moments=moments_told(turn),
    )


def _under_discussion(turn: Turn, said: Sequence[Ask | Claim | Request | Feel]) -> Question | None:
    """Return the last question of a turn; a mere "who?" leaves the one before under discussion."""
    aside = [a.act for a in turn.acts if a.leaned and _is_who(a.act)]
    return next((q.question for q in reversed(said) if isinstance(q, Ask) and q not in aside), None)


def _is_who(act: Act) -> bool:
    return isinstance(act, Ask) and isinstance(act.question, Identify)


def _weighed(turn: Turn) -> _Weighed | None:
    """Return the option of ours that a turn discussed, and what was decided instead of it.

    A turn that follows up on an earlier one keeps the earlier pair: None.
    """
    for part in reversed(turn.parts):
        asked = None if part.act is None else part.act.act
        option = _option_in(asked.question) if isinstance(asked, Ask) else None
        match part.result:
            case Options(risk=True, options=(told,)) if option is None:
                option = Event(told.action, tense="present")
            case Declined(request=Request(event=event)) if event.action in OPTIONAL:
                option = replace(event, actor=Ego(), tense="present")
        if option is None and (wish := _wish(asked)) is not None and wish.action in OPTIONAL:
            option = replace(wish, actor=Ego(), tense="present", modal=None)
        against = next(parts(part.result, Contrast), None)
        refused = isinstance(part.result, get_args(Refusal))
        if option is None or (refused and not isinstance(part.result, NotApplicable)):
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
        return None
    return None, None


def _wish(act: Act | None) -> Event | None:
    """Find what we are asked or advised to do from now on."""
    match act:
        case Request(event=event, negated=False):
            return event
        case Claim(Happens(Event(actor=Ego(), modal="should", tense="present") as event)):
            return event
    return None


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
        case (
            Whether(that=Happens(event=event)) | Whether(that=Not(content=Happens(event=event)))
        ) if event.actor == Ego() and event.modal in POSSIBLE and event.action in OPTIONAL:
            return replace(event, modal=None)
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


@kept
def causes_in(turn: Turn) -> tuple[tuple[int, tuple[str, ...]], ...]:
    """Return what `causes_of` yields for all results of a turn."""
    return tuple(cause for result in turn.results for cause in causes_of(result))


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
