"""Alternatives: what "or" joins that one answer settles: a fear, a stop, who goes first."""

from msgspec.structs import replace

from xavi_dialogue.domain.terms import Both, Ego, Event, Happens, Proposition, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import HALTS, YIELDS
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import is_past
from xavi_dialogue.explain.answers.reference.naming import is_us, number

#: What is seen of how somebody drives.
MOTIONS: frozenset[ActionName] = frozenset(
    ("speed-up", "slow-down", "brake", "stand", "move", "go", "stop", "wait")
)
STATES: frozenset[ActionName] = frozenset(("stand", "wait"))  # what can be seen now


def lets_us(of: Both) -> Happens | None:
    """Return that another lets us go first, if the question is which of us does; else None."""
    for part in of.contents:
        match part:
            case Happens(event=Event("let-go", Ego(), Vehicle() as other, tense="future")):
                return Happens(Event("let-go", other, Ego(), tense="future"))
    return None


def is_our_course(of: Both, asked: Asked) -> bool:
    """Check whether the question is which of several things we are doing or about to do."""
    events = [part.event for part in of.contents if isinstance(part, Happens)]
    return len(events) == len(of.contents) and all(
        is_us(event.actor)
        and event.modal in (None, "will")
        and event.tense in ("present", "future")
        for event in events
    )


def acts_now(of: Both) -> Ego | Vehicle | None:
    """Return who acts, if the question is which of several things we or another do now."""
    events = [part.event for part in of.contents if isinstance(part, Happens)]
    actors = {event.actor for event in events}
    moves = all(e.tense == "present" and e.modal is None and e.action in MOTIONS for e in events)
    if len(events) < len(of.contents) or len(actors) != 1 or not moves:
        return None
    actor = events[0].actor
    return actor if isinstance(actor, Ego | Vehicle) else None


def feared(of: Both, asked: Asked) -> Proposition | None:
    """Find the collision that a question names besides what comes before it or instead of it."""
    for part in of.contents:
        match part:
            case Happens(event=Event(action="collide" | "nearly-collide") as event) if not is_past(
                asked, event.time, event.tense
            ):
                return part
    return None


def spares(part: Proposition) -> bool:
    """Check whether it is asked if another stops for us, which also tells the risk."""
    if not isinstance(part, Happens) or number(part.event.actor) is None:
        return False
    return part.event.action in HALTS | YIELDS and is_us(part.event.object)


def stops(of: Both) -> Happens | None:
    """Find whether somebody stops, if the question also asks whether they come out or drive on.

    Where they go is another matter: one that stops for us may go straight on.
    """
    events = [part.event for part in of.contents if isinstance(part, Happens)]
    ahead = all(e.tense in ("present", "future") and number(e.actor) is not None for e in events)
    held = [e for e in events if e.action in HALTS | YIELDS]
    if len(events) < len(of.contents) or not ahead or len(held) != 1 or is_us(held[0].actor):
        return None
    if held[0].tense == "present" and held[0].action in STATES:  # "is it moving or standing?"
        return None
    return Happens(replace(held[0], tense="future", object=held[0].object or Ego()))
