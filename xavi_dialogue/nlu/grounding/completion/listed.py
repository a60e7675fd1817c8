"""Listed: "which of those?" is asked of what was listed last: deeds of ours, or options."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Ask,
    Compare,
    Elliptic,
    HowMany,
    HowMuch,
    Identify,
    Listing,
    Peak,
    Question,
    When,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Compares,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Pronoun,
    Rank,
    Time,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName, PeakKind
from xavi_dialogue.nlu.grounding.context import Context, Grounder

_THOSE: Final = Pronoun("them-all")
_VAGUE: Final = ("they", "them-all", "it", "that")
#: By what deeds are ranked, and whether the most is the worst: what is at its most then.
_PEAKS: Final[dict[tuple[str, bool], PeakKind]] = {
    ("time", True): "delay", ("best", True): "delay", ("comfort", True): "braking",
    ("safety", True): "risk", ("size", False): "waiting", ("speed", True): "slowness",
    ("speed", False): "speed",
}  # fmt: skip
_DEEDS: Final[dict[PeakKind, ActionName]] = {
    "delay": "slow-down", "braking": "brake", "slowing": "slow-down", "waiting": "stop",
}  # fmt: skip
_HALTS: Final = frozenset(("stop", "stand", "wait", "give-way", "let-go"))
_WEIGHED: Final = ("value", "cost", "delay", "duration")


def of_listed(spoken: Question, g: Grounder) -> Question | None:
    """Ask of what was listed last, where "those" or "they" can be nothing else; None: of others."""
    found = _of_options(spoken, g.context) or _of_deeds(spoken, g.context)
    g.notes.leaned = g.notes.leaned or found is not None
    return found


def _of_options(spoken: Question, context: Context) -> Question | None:
    """Ask how options came out beside the one chosen: options score, and nobody else does."""
    asked = context.discourse.question
    if not isinstance(asked, Listing) or asked.of not in ("options", "rivals", "decisions"):
        return None
    asked = replace(asked, time=_decided(asked.time, context))
    match spoken:
        case HowMuch(of=Measured(attribute=attribute, thing=Pronoun(form=form), event=None)) if (
            attribute in _WEIGHED and form in _VAGUE
        ):
            return Listing("rivals", time=asked.time)
        case Why(of=Compares(left=Measured(attribute=attribute, thing=Pronoun(form=form)))) if (
            attribute in _WEIGHED and form in _VAGUE
        ):
            return Listing("rivals", time=asked.time)
        case Compare(options=(Pronoun(form="them-all"),), by=by):
            return replace(asked, of="rivals" if by in ("best", "time", "margin") else "options")
        case Identify(thing=Described(kind="vehicle", rank=int(), colour=None, bearing=None)):
            return Listing("rivals", time=asked.time)
    return None


def _decided(time: Time, context: Context) -> Time:
    """Give when that was decided of which the options were told."""
    told = context.discourse.weighed_at
    return time if told is None or not isinstance(time, Unsaid | WholeRide) else At(told)


def _of_deeds(spoken: Question, context: Context) -> Question | None:
    """Ask which of the deeds that were listed stands out."""
    listed = deeds_listed(context)
    if listed is None:
        return None
    deed, time = listed
    match spoken:
        case Compare(options=(Pronoun(form="them-all"),), by=by, least=least):
            most = _PEAKS.get((by, least))
            if most == "waiting" and deed.action not in _HALTS:
                most = None
            return Listing("events", time=time, event=deed) if most is None else Peak(most, time)
        case Identify(thing=Described(kind="vehicle", rank=int(rank), colour=None, bearing=None)):
            return When(Happens(replace(deed, time=Rank(rank))))
        case Which(such=Is(state="first"), among=(Pronoun(form="them-all"),)):
            return When(Happens(replace(deed, time=Rank(1))))
        case HowMuch(of=Measured(attribute="duration" | "delay", thing=Pronoun(form=form)) as of):
            if form in ("they", "them-all"):
                return Peak("waiting" if of.attribute == "duration" else "delay", time)
    return None


def one_of_listed(spoken: Elliptic, g: Grounder) -> Elliptic | None:
    """Take "and the second?" for the second of the deeds that were listed; None: of others."""
    thing, listed = spoken.thing, deeds_listed(g.context)
    if listed is None or not isinstance(thing, Described) or thing.rank is None:
        return None
    if thing != Described(kind=thing.kind, rank=thing.rank, definite=thing.definite):
        return None
    deed = replace(listed[0], time=Rank(thing.rank))
    return replace(spoken, thing=None, event=deed)


def deeds_listed(context: Context) -> tuple[Event, Time] | None:
    """Give what we did that was listed, counted or explained several times, and when."""
    deeds = [
        act.question.of.event
        for act in context.discourse.last_acts
        if isinstance(act, Ask)
        and isinstance(act.question, Why)
        and isinstance(act.question.of, Happens)
        and act.question.of.event.actor == Ego()
    ]
    spans = [deed.time for deed in deeds if isinstance(deed.time, Between)]
    if len(spans) > 1:
        return deeds[0], _named(context) or Between(spans[0].begin, spans[-1].end)
    match context.discourse.question:
        case Listing(of="stops", time=time):
            return Event("stop"), _said(time)
        case Listing(of="events" | "reasons", event=Event(actor=Ego()) as deed, time=time):
            return deed, _said(deed.time if isinstance(time, Unsaid) else time)
        case HowMany(of=Event(actor=Ego(), tense="past" | "perfect") as deed):
            return replace(deed, tense="past"), _said(deed.time)
        case Peak(of=most, time=time, deed=None) if most in _DEEDS:
            return Event(_DEEDS[most]), _said(time)
    return None


def _named(context: Context) -> Between | None:
    """Give the part of the ride of which a list of reasons was asked."""
    focus = context.discourse.episode
    return None if focus is None or focus[0] == focus[1] else Between(*focus)


def _said(time: Time) -> Time:
    return WholeRide() if isinstance(time, Unsaid) else time
