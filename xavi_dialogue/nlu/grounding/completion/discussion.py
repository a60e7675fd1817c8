"""Discussion: what "that", "it" and an omitted clause stand for."""

from collections.abc import Iterator
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Compare,
    Doing,
    HowLong,
    HowMany,
    Listing,
    Question,
    Request,
    WhatIf,
    Where,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.rewriting import first, parts, rewrite
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Between,
    Both,
    Caused,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Nobody,
    Not,
    Now,
    Proposition,
    Related,
    That,
    Thing,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.events.spans import NOTABLE
from xavi_dialogue.nlu.grounding.salience import IN_FORCE

PROPOSITIONS: Final = (
    Happens, Related, Is, Has, Compares, Exists, Caused, Believed, Not, Both, That,
)  # fmt: skip

_STAYING: Final = ("wait", "keep-lane", "stand")
UNREAL: Final = ("would", "can", "could", "might")


def proposition_of(question: Question | None) -> Proposition | None:
    """Give the proposition that a question is about."""
    match question:
        case HowMany(of=Event() as event):
            return Happens(event)
        case None | HowMany() | Compare():
            return None
        case HowLong(of=Event() as event):
            return Happens(event)
        case Where(of=Event() as event):
            return Happens(event)
        case (
            Doing(actor=Vehicle() as actor, besides=None)
            | Whither(actor=Vehicle() as actor)
            | Listing(of="beliefs", about=Vehicle() as actor)
        ):
            return Happens(Event("do", actor, tense="present"))
        case Doing(besides=proposition):
            return proposition
    for name in ("of", "that", "supposed", "such"):
        found = getattr(question, name, None)
        if isinstance(found, PROPOSITIONS) and not isinstance(found, That):
            return found
    return None


def asserted(context: Context) -> Proposition | None:
    """Give what was said last, by either side: what "that" and a bare "why?" are about."""
    discourse = context.discourse
    for proposition in discourse.propositions:
        if not isinstance(proposition, That):
            return _with_anybody(proposition)
    return _with_anybody(questioned(context))


def _with_anybody(known: Proposition | None) -> Proposition | None:
    """Leave out that we would hit "nobody" where it was asked if we will hit anybody."""
    match known:
        case Happens(event=Event(action="collide", object=Nobody()) as event):
            return Happens(replace(event, object=None))
    return known


def of_others(context: Context) -> Proposition | None:
    """Return what was said last if that is what others do or would do: "..., so why not you?"."""
    match asserted(context):
        case Happens(event=Event(actor=actor) as event) if not isinstance(actor, Ego | None):
            return Happens(replace(event, modal=None))
    return None


def questioned(context: Context) -> Proposition | None:
    """Give what the question under discussion is about; else what we did last."""
    found = spoken_of(context)
    event = last_deed(context) if found is None else None
    return found if event is None else Happens(event)


def explained(context: Context) -> Proposition | None:
    """Return what the question under discussion asks the reason of, for "because of him?"."""
    match context.discourse.question:
        case Why(of=of) | Which(such=Caused(effect=of)):
            return rewrite(of, lambda part: Unsaid() if isinstance(part, Now) else part)
    return None


def spoken_of(context: Context) -> Proposition | None:
    """Give what the question under discussion is about, or what was spoken of last."""
    found = proposition_of(context.discourse.question)
    if found is not None:
        return found
    said = (p for p in context.discourse.propositions if not isinstance(p, That))
    return next(said, None)


def is_supposed(known: Proposition, context: Context) -> bool:
    """Check whether a proposition is about a supposition, or about what would follow from it."""
    event = first(known, Event)
    imagined = event is not None and event.modal == "would"
    return imagined or isinstance(context.discourse.question, WhatIf)


def focus_of(supposed: Proposition, context: Context) -> tuple[float, float] | None:
    """Return when what was discussed happened [s], if a supposition is about that; None: about now.

    What was decided within the last second is still in force.
    """
    focus, event = context.discourse.episode, first(supposed, Event)
    if focus is None or focus[1] >= context.now - IN_FORCE:
        return None
    ours = event is not None and event.actor == Ego() and isinstance(event.time, Now)
    return None if ours else focus


def affirmed(proposition: Proposition) -> Proposition:
    """Return a proposition without its negation, if it has one."""
    return proposition.content if isinstance(proposition, Not) else proposition


def events(discourse: Discourse, *, real: bool = False) -> Iterator[Event]:
    """Yield the events spoken of, those of the question under discussion first.

    With `real`, what was supposed, what would follow from it, and what somebody could do are left
    out.
    """
    acts = (act for act in discourse.last_acts if isinstance(act, Ask | Claim | Request))
    for source in (discourse.question, *discourse.propositions, *acts):
        if not real or first(source, WhatIf) is None:
            found = parts(source, Event)
            yield from (e for e in found if not real or e.modal not in UNREAL)


def discussed(context: Context, actor: Thing | None = None, *, real: bool = False) -> Event | None:
    """Return the event under discussion, of an actor if one is given; `real`: none supposed."""
    for event in events(context.discourse, real=real):
        if actor is None or event.actor == actor:
            return event
    if isinstance(actor, Vehicle):
        return _last_of(context, actor)
    if actor is None or isinstance(actor, Ego):
        return last_deed(context)
    return None


def last_deed(context: Context) -> Event | None:
    """Return the last thing we did that people would mention."""
    return _last_of(context, Ego())


#: What we do because somebody or something hinders us.
HINDERED: Final = frozenset(
    ("brake", "slow-down", "stop", "stand", "wait", "give-way", "let-go", "follow", "swerve",
     "avoid", "keep-distance", "collide", "nearly-collide")
)  # fmt: skip


def hindrance(context: Context) -> Event | None:
    """Return what we did or do because we were hindered.

    What was spoken of comes first, then what is in focus, then the last such action.
    """
    for event in events(context.discourse):
        if event.action in HINDERED and event.actor == Ego() and event.time != Unsaid():
            return event
    deeds = context.deeds(Ego(), context.begin, context.now)
    hindered = [e for e in deeds if e.action in HINDERED]
    focus = context.discourse.episode
    if focus is not None:
        near = [e for e in hindered if e.begin <= focus[1] and (e.end or context.now) >= focus[0]]
        hindered = near or hindered
    return None if not hindered else event_of(hindered[-1], context.now)


def wished(discourse: Discourse) -> Event | None:
    """Give what the passenger just wished us to do; None if there was no such wish."""
    option = discourse.option
    if option is None or option.action in _STAYING or not discourse.last_acts:
        return None
    match discourse.last_acts[-1]:
        case Request(negated=False):
            pass
        case Claim(Happens(Event(actor=Ego(), modal="should" | "must"))):
            pass
        case _:
            return None
    return replace(option, time=Unsaid(), tense="present", modal=None)


def beside_road(context: Context) -> Event | None:
    """Return what we did last, if "what was that for?" follows answers about surroundings only."""
    known = next((p for p in context.discourse.propositions if not isinstance(p, That)), None)
    free = isinstance(known, Is) and known.state == "free"
    if not (free or isinstance(known, Exists | Related)):
        return None
    since = context.discourse.asked_at or context.begin
    begun = [e for e in context.deeds(Ego(), since, context.now) if e.action in HINDERED]
    fresh = [e for e in begun if e.begin > since]
    return event_of(fresh[-1], context.now) if fresh else hindrance(context)


def _last_of(context: Context, actor: Ego | Vehicle) -> Event | None:
    deeds = context.deeds(actor, context.begin, context.now)
    focus = context.discourse.episode
    notable = [e for e in deeds if e.action in NOTABLE]
    if focus is not None:
        near = [e for e in notable if e.begin <= focus[1] and (e.end or context.now) >= focus[0]]
        notable = near or notable
    return None if not notable else event_of(notable[-1], context.now)


def event_of(episode: Episode, now: float) -> Event:
    """Turn an episode of the record into an event that is spoken of."""
    end = now if episode.end is None else episode.end
    return Event(
        action=episode.action,
        actor=episode.actor,
        object=episode.object,
        side=episode.side,
        time=Between(episode.begin, end),
        tense="past",
    )


def interval(event: Event) -> tuple[float, float] | None:
    """Give the part of the ride that a grounded event names."""
    match event.time:
        case Between(begin=begin, end=end):
            return begin, end
        case At(at=at):
            return at, at
    return None


def main_event(question: Question | None) -> Event | None:
    """Give the first event in a question."""
    return first(question, Event)
