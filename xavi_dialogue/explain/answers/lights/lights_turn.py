"""Lights and turns: whether it is our turn to go while a traffic light holds us."""

from typing import Final

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Is,
    Proposition,
    Related,
)
from xavi_dialogue.domain.traffic_lights import LightTold
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import is_own, unwrapped
from xavi_dialogue.explain.facts.episodes.light_waits import holding
from xavi_dialogue.explain.facts.traffic_lights import shown_at
from xavi_dialogue.explain.history.traffic_lights import ahead

GOING: Final = frozenset[ActionName](
    (
        "go",
        "move",
        "enter",
        "cross",
        "continue",
        "turn",
        "exit-left",
        "exit-right",
        "exit-straight",
    )
)
NEAR: Final = 60.0  # [m] maximum distance of a red light that is about to hold us
ONWARD: Final = frozenset[ActionName](("go", "move", "enter", "cross", "continue"))
MAY: Final = frozenset(("can", "could", "might", "should"))


def held(asked: Asked) -> LightTold | None:
    """Return the light that holds us now, or is about to; None if none does."""
    one = shown_at(asked.ride, Feature("light"), asked.now)
    near = next(iter(ahead(asked.ride, asked.now)), None)
    waits = holding(asked.ride, EGO, asked.now, asked.now) is not None
    comes = near is not None and near.distance <= NEAR and one is not None and one.colour == "red"
    if one is None or one.colour == "green" or not (waits or comes):
        return None
    return LightTold("turn", one, time=asked.now)


def is_turn(that: Proposition, scene: Asked) -> bool:
    """Check whether a proposition is that it is our turn to go, while a light holds us."""
    of, negated = unwrapped(that)
    ours = False
    match of:
        case Is(state="allowed", event=Event() as event, tense="present"):
            ours = _is_going(event)
        case Happens(event=Event(modal=modal) as event) if modal in MAY:
            ours = _is_going(event)
        case Related(relation="has-priority-over", thing=Ego(), to=to):
            ours = of.tense == "present" and to in (None, Everyone())
    return ours and not negated and held(scene) is not None


def whether(question: Whether, scene: Asked) -> Answer:
    """Return that it is not our turn.

    Raises:
        AssertionError: no light holds us; see `is_turn`.
    """
    del question
    found = held(scene)
    assert found is not None
    return replace(found, holds=False)


def _is_going(event: Event) -> bool:
    """Check whether an event is our going on now, with no object."""
    now = event.tense == "present" and event.object is None
    return is_own(event.actor) and event.action in GOING and now
