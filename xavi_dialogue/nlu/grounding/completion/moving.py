"""Moving: "and now?", "and before that?", "and then?": the question asked of another time."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Changed,
    Doing,
    HowDecide,
    HowMuch,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatIf,
    When,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Back,
    Between,
    Ego,
    Event,
    Happens,
    Junction,
    Measured,
    Next,
    Not,
    Now,
    Relative,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Within,
)
from xavi_dialogue.nlu.grounding.completion.discussion import interval, main_event
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.events.spans import focus


def at_another_time(time: Time, question: Question) -> Question | None:
    """Ask what is meant of another time where it is not the same question; None: the same."""
    if isinstance(time, Now) and isinstance(question, TIMELESS):
        return Doing(Ego())
    if time == Back("before") and isinstance(question, Why | WhatIf | Peak | Changed):
        return Doing(None, time, "past")
    later = _then(question) if _is_later(time) else None
    return later or _onward(time, question)


#: Questions that are not asked again of another time.
TIMELESS: Final = (Why, WhatIf, Summarise, Listing, Peak, Changed, HowDecide)


def _onward(time: Time, question: Question) -> Question | None:
    """Ask for the next step of our way, or for what we do then."""
    if not (isinstance(time, Next) or (isinstance(time, Back) and time.relation == "after")):
        return None
    match question:
        case HowMuch(of=Measured(attribute="turn" | "exit-number", thing=Ego()) as of):
            rank = of.to.rank if isinstance(of.to, Junction) and of.to.rank else 1
            place = Junction(rank=rank + 1)
            return replace(question, of=Measured("turn", to=place, time=Next(), tense="future"))
        case (
            Whither() | Whether(that=Happens(event=Event(actor=Ego(), tense="present" | "future")))
        ):
            return HowMuch(Measured("turn", to=Junction(rank=2), time=Next(), tense="future"))
        case Doing(tense="past") | Summarise() | Listing() | When() | Peak() | Changed():
            return Doing(None, time, "past") if isinstance(time, Back) else None
        case Doing(actor=Vehicle()):
            return None
    event = main_event(question)
    over = event is not None and event.tense in ("past", "perfect")
    return Doing(None, time, "past") if over else Doing(Ego(), Next(), "future")


def _is_later(time: Time) -> bool:
    return isinstance(time, Next | Within) or (
        isinstance(time, Relative) and time.relation == "after"
    )


def _then(question: Question) -> Question | None:
    """Ask whether what is not done now will be done later; None where nothing is."""
    match question:
        case Why(of=Not(content=Happens(event=Event(tense="present") as event))):
            return Whether(Happens(replace(event, tense="future", modal="will", time=Unsaid())))
    return None


def counted_from(time: Time, question: Question) -> Time:
    """Count "before that" from the part of the ride that the question was about."""
    event = main_event(question)
    when = None if event is None else interval(event)
    if not isinstance(time, Back) or when is None:
        return time
    match time.relation:
        case "before" if time.seconds is not None:
            return At(max(when[0] - time.seconds, 0.0))
        case "before":
            return Between(max(when[0] - 8.0, 0.0), max(when[0] - 0.05, 0.0))
        case "after":
            return Between(when[1] + 0.05, when[1] + 8.0)
    return Between(*when)


def as_it_was(it: Thing, time: Time, g: Grounder) -> Question:
    """Ask "what was it two seconds ago?" of the measure under discussion, else who it was."""
    asked = g.context.discourse.question
    if not isinstance(asked, HowMuch):
        return Doing(it, time, "past")
    g.notes.leaned = True
    told = focus(g.context.discourse)
    if isinstance(time, Within) and time.seconds is not None and told is not None:
        time = At(told[1] + time.seconds)  # "and a second later?"
    return HowMuch(replace(asked.of, time=time, tense="past"), asked.extreme)
