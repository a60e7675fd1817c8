"""Carrying: "and without the red one?" is asked what was asked without the blue one."""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    HowLong,
    HowMuch,
    Question,
    WhatIf,
    WhatWouldChange,
    When,
    Whether,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Between,
    Ego,
    Event,
    Exists,
    Happens,
    Measured,
    Nobody,
    Not,
    Proposition,
    Unsaid,
)
from xavi_dialogue.nlu.grounding.completion.discussion import HINDERED
from xavi_dialogue.nlu.grounding.context import Grounder

_OVER: Final = ("past", "perfect")
_TO_COME: Final = ("arrival-time", "time-to-go", "delay")


def carried(spoken: WhatIf, g: Grounder) -> WhatIf:
    """Ask of a bare supposition what the question before asked, or was about.

    That somebody is not there is supposed of the time that the question before was about. What
    he would do is carried over only from one supposition to another of what might have been.
    """
    if spoken.then is not None:
        return spoken
    asked, gone = g.context.discourse.question, _absent(spoken.supposed)
    if isinstance(spoken.supposed, Exists) and isinstance(spoken.supposed.thing, Nobody):
        then = _asked_of(asked)
        g.notes.leaned = g.notes.leaned or then is not None
        return replace(spoken, then=then)
    if gone is not None:
        then, time = _asked_of(asked), _time_of(asked, g)
        if time is not None and isinstance(gone.time, Unsaid) and gone.tense == "present":
            spoken = replace(spoken, supposed=Not(replace(gone, time=time)))
        g.notes.leaned = g.notes.leaned or then is not None or time is not None
        return replace(spoken, then=then)
    event = first(spoken.supposed, Event)
    earlier = asked.then if isinstance(asked, WhatIf) else None
    if earlier is None or event is None or event.actor == Ego() or event.tense not in _OVER:
        return spoken
    g.notes.leaned = True
    return replace(spoken, then=earlier)


def _absent(supposed: Proposition) -> Exists | None:
    match supposed:
        case Not(content=Exists() as gone):
            return gone
    return None


def _asked_of(asked: Question | None) -> Question | None:
    """Give what a question asks, as a question about a supposed world; None: nothing of us."""
    match asked:
        case WhatIf(then=then):
            return then
        case (
            Why(of=Happens(event=Event() as event) | Not(content=Happens(event=Event() as event)))
            | Whether(that=Happens(event=Event() as event))
            | HowLong(of=Event() as event)
        ) if _is_pace(event):
            return Whether(Happens(_imagined(event)))
        case When(of=Happens(event=Event("arrive", Ego(), modal=None) as event)):
            return replace(asked, of=Happens(replace(event, modal="would")))
        case HowMuch(of=Measured(attribute=attribute, thing=Ego())) if attribute in _TO_COME:
            return HowMuch(Measured(attribute))
    return None


def _is_pace(event: Event) -> bool:
    """Tell whether it is how we drove; what else we would have chosen is open."""
    done = event.actor == Ego() and event.tense in _OVER and event.modal is None
    return done and event.action in (*HINDERED, "speed-up")


def _imagined(event: Event) -> Event:
    """Return what we did as something that we would have done."""
    tense: Any = "past"
    return replace(event, time=Unsaid(), tense=tense, modal="would")


def _time_of(asked: Question | None, g: Grounder) -> Between | None:
    """Give when it was that we did what was asked about; None: we do so, or plan to."""
    match asked:
        case WhatIf(supposed=Not(content=Exists(time=Between() as then))):
            return then
    focus, event = g.context.discourse.episode, first(asked, Event)
    if focus is None or event is None or event.actor != Ego() or isinstance(asked, WhatIf):
        return None
    dated = isinstance(asked, Why | WhatWouldChange) or isinstance(event.time, Between)
    return Between(*focus) if dated and event.tense in _OVER else None
