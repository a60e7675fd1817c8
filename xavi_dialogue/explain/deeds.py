"""Deeds: whether the ego did what a question takes for granted, and what it did instead."""

from typing import TypeAlias

from sim.scene import EGO
from xavi_dialogue.explain.actions import same
from xavi_dialogue.explain.explanation import Facts, NoExplanation
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Deed, Ride, Unanswered, planned
from xavi_dialogue.explain.when import distance

Span: TypeAlias = tuple[float, float]  # [s] start and end

#: Descriptions that are read off the recorded speeds and not off the planner's choices.
DRIVING: tuple[QueryAction, ...] = ("slow-down", "speed-up", "give-way", "stop")
HALTS = frozenset[QueryAction](("stop", "give-way"))
NO_CHOICE = "it follows from the road and from the others on it"
#: Deeds that are told from driving on.
MANOEUVRES: tuple[QueryAction, ...] = (
    *("change-left", "change-right", "exit-left", "exit-right", "continue-next-exit", "stop"),
    "overtake",
)


def happened(ride: Ride, action: QueryAction) -> Deed | None:
    """The last deed of the ego that may be called by a name; at the time asked about, if any."""
    return ride.meant(_called(ride, action))


def occurrences(ride: Ride, vehicle: int, action: QueryAction) -> tuple[Span, ...]:
    """All times [s] at which a vehicle did something, oldest first."""
    seen = [sighting.span for sighting in ride.motion(vehicle).times(action)]
    if vehicle != EGO:
        return tuple(seen)
    deeds = [(d.time, ride.now if d.ended is None else d.ended) for d in _called(ride, action)]
    if action not in DRIVING:
        return tuple(deeds)
    if action == "give-way":
        seen = [(e.sim_time, e.sim_time) for e in ride.events if e.kind == "gave-way"]
    if action == "stop":
        seen += deeds
    return tuple(sorted(seen))


def _called(ride: Ride, action: QueryAction) -> list[Deed]:
    return [deed for deed in ride.deeds if same(action, deed.action)]


def elsewhere(ride: Ride, vehicle: int, asked: tuple[QueryAction, ...]) -> Facts:
    """Where the question says when: that it was done, but at another time; else nothing.

    Facts: `elsewhere`, with what was done and the time nearest to the one asked about; or, where
    it was done less often than the question says, how many `times`, and when last.
    """
    focus = ride.past
    if focus is None:
        return {}
    done = [(span, action) for action in asked for span in occurrences(ride, vehicle, action)]
    if not done and "stop" in asked:  # who says brake may mean either
        done = [(span, "slow-down") for span in occurrences(ride, vehicle, "slow-down")]
    inside = [span for span, _ in done if focus.meets(*span)]
    if not done or (inside and not focus.counted):
        return {}
    if inside:
        return {"happened": done[-1][1:], "time": max(inside)[0], "times": len(inside)}
    (start, _), action = min(done, key=lambda one: (distance(focus, *one[0]), one[0]))
    return {"happened": (action,), "time": start, "elsewhere": True}


def did_not_happen(ride: Ride, asked: tuple[QueryAction, ...]) -> Unanswered:
    """The refusal where the ego did not do what the question says, with what it did instead.

    Facts: `happened` and since when, where it has done more than driving on; `planned` where it
    means to do it yet, which can then be asked about.
    """
    facts: Facts = {"vehicle": EGO, "asked": asked, "did": False}
    found = elsewhere(ride, EGO, asked)
    if found:
        return Unanswered(NoExplanation(reason="did-not-happen", facts=facts | found))
    facts |= _instead(ride, asked)
    expected = [a for a in asked if a != "give-way"]  # which no plan foresees as such
    if ride.traces and any(same(a, step) for a in expected for step in planned(ride.latest)):
        facts["planned"] = True
        ahead = (Query(type="why", factual=asked, tense="future"),)
        return Unanswered(NoExplanation(reason="did-not-happen", facts=facts, suggestions=ahead))
    return Unanswered(NoExplanation(reason="did-not-happen", facts=facts))


def was_done(ride: Ride, foil: tuple[QueryAction, ...]) -> Unanswered | None:
    """The refusal where the foil is what the ego did; driving on is not held against it."""
    deed = happened(ride, foil[0]) if len(foil) == 1 and foil[0] in MANOEUVRES else None
    if deed is None:
        return None
    facts: Facts = {"vehicle": EGO, "asked": foil, "did": True}
    facts |= {"happened": (deed.action,), "time": deed.time}
    return Unanswered(NoExplanation(reason="did-not-happen", facts=facts))


def no_choice(ride: Ride, undone: tuple[QueryAction, ...]) -> Unanswered:
    """The refusal to undo what the ego did without choosing it, which can be explained."""
    facts: Facts = {"vehicle": EGO, "asked": undone, "undone": True, "reason": NO_CHOICE}
    facts["time"] = ride.now
    why = (Query(type="why", factual=undone),)
    return Unanswered(NoExplanation(reason="not-applicable", facts=facts, suggestions=why))


def _instead(ride: Ride, asked: tuple[QueryAction, ...]) -> Facts:
    """What comes nearest to what did not happen, and when."""
    if asked and all(action in DRIVING for action in asked):
        nearest: tuple[QueryAction, ...] = ("slow-down",) if set(asked) & HALTS else ()
        motion = ride.motion(EGO)
        seen = [found for action in nearest if (found := motion.last(action)) is not None]
        return {"happened": (seen[0].action,), "time": seen[0].start} if seen else {}
    deed = ride.manoeuvre
    if deed is None:
        return {}
    if deed.action == "continue":
        return {"happened": (deed.action,)}
    return {"happened": (deed.action,), "time": deed.time}
