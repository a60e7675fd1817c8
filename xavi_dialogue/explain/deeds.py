"""Deeds: whether the ego did what a question takes for granted, and what it did instead."""

from sim.scene import EGO
from xavi_dialogue.explain.actions import same
from xavi_dialogue.explain.explanation import Facts, NoExplanation
from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.explain.ride import Deed, Ride, Unanswered, planned

#: Descriptions that are read off the recorded speeds and not off the planner's choices.
DRIVING: tuple[QueryAction, ...] = ("slow-down", "speed-up", "give-way", "stop")
#: Deeds that are told from driving on.
MANOEUVRES: tuple[QueryAction, ...] = (
    *("change-left", "change-right", "exit-left", "exit-right", "continue-next-exit", "stop"),
    "overtake",
)


def happened(ride: Ride, action: QueryAction) -> Deed | None:
    """The last deed of the ego that may be called by a name."""
    return next((deed for deed in reversed(ride.deeds) if same(action, deed.action)), None)


def did_not_happen(ride: Ride, asked: tuple[QueryAction, ...]) -> Unanswered:
    """The refusal where the ego did not do what the question says, with what it did instead."""
    facts: Facts = {"vehicle": EGO, "asked": asked, "did": False}
    deed = ride.manoeuvre
    if deed is not None:
        facts |= {"happened": (deed.action,), "time": deed.time}
    if ride.traces and any(same(action, step) for action in asked for step in planned(ride.latest)):
        facts["planned"] = True
    return Unanswered(NoExplanation(reason="did-not-happen", facts=facts))


def was_done(ride: Ride, foil: tuple[QueryAction, ...]) -> Unanswered | None:
    """The refusal where the foil is what the ego did; driving on is not held against it."""
    deed = happened(ride, foil[0]) if len(foil) == 1 and foil[0] in MANOEUVRES else None
    if deed is None:
        return None
    facts: Facts = {"vehicle": EGO, "asked": foil, "did": True}
    facts |= {"happened": (deed.action,), "time": deed.time}
    return Unanswered(NoExplanation(reason="did-not-happen", facts=facts))
