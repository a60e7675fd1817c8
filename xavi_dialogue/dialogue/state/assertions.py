"""Assertions: what either side put forward in a turn, as propositions. Pure."""

from collections.abc import Iterable, Iterator

from xavi_dialogue.dialogue.state.turn import Part, Turn
from xavi_dialogue.domain.answers import (
    Activity,
    Beliefs,
    Bound,
    ChoiceReason,
    DidNotHappen,
    Grounds,
    Happenings,
    Identified,
    MotionReason,
    OtherReason,
    PeakMoment,
    PlanAhead,
    SupposedOfOther,
    SupposedOfUs,
    Verdict,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Whether,
)
from xavi_dialogue.domain.terms import (
    At,
    Event,
    Happens,
    Has,
    Not,
    Proposition,
    Tense,
    Vehicle,
)
from xavi_dialogue.domain.traffic_lights import LightTold, Shown


def asserted(turn: Turn) -> Iterator[Proposition]:
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
        case LightTold(shown=Shown(light=light, colour=colour), whose=None):
            yield Has("colour", colour, light)
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
