"""Restating: events that say of somebody what he is: that he comes from behind, or moves."""

from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Proposition,
    Related,
    Wanted,
)
from xavi_dialogue.nlu.grounding.context import Mode


def restated(spoken: Happens, mode: Mode) -> Proposition | None:
    """Put what is meant in the place of an event of another vehicle; None: it is as said."""
    match spoken.event:
        case (
            Event(
                action="come",
                actor=Described(definite=False) as somebody,
                object=None,
                side=None,
                where=None | Related(relation="behind"),
                tense="present",
                modal=None,
            ) as event
        ) if mode == "asked":  # "is anyone else coming after the red one?"
            coming = replace(somebody, doing=replace(event, actor=Wanted(), where=None))
            if event.where is not None and somebody.bearing is None:
                coming = replace(coming, bearing="behind")
            return Exists(coming)
        case (
            Event(
                action="come", actor=actor, object=None, where=Related(relation="behind", to=Ego())
            ) as event
        ) if not isinstance(actor, Ego):  # "is that van coming up behind us?"
            return Happens(replace(event, action="approach", object=Ego(), where=None))
        case (
            Event(action="go" | "move", actor=actor, object=None, side=None, tense="past") as event
        ) if "still" in event.manner and not isinstance(
            actor, Ego
        ):  # "it was still moving when you decided"
            return Is("moving", actor, time=event.time, tense="past")
    return None
