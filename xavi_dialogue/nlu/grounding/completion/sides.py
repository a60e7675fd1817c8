"""Sides: "left again?" and "and the right?" are of a turn or a lane, as the question before."""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Elliptic, Question, Which
from xavi_dialogue.domain.terms import Described, Ego, Event, Lane, Related, Thing
from xavi_dialogue.domain.vocabulary import Relation
from xavi_dialogue.nlu.grounding.completion.discussion import main_event
from xavi_dialogue.nlu.grounding.context import Grounder

_CHANGES: Final = {"exit-left": "change-left", "exit-right": "change-right"}
_OF_LANES: Final = frozenset((*_CHANGES.values(), "change-lane"))
_OF_WAYS: Final = frozenset((*_CHANGES, "exit-straight", "turn"))
#: Where somebody is, as a relation to us or to another.
_RELATIONS: Final[dict[str, Relation]] = {
    "ahead": "ahead-of", "behind": "behind", "left": "left-of", "right": "right-of",
    "beside": "beside", "oncoming": "oncoming-to", "around": "near",
}  # fmt: skip
LATELY: Final = 4.0  # [s] for which a lane change is what "left again?" is of


def on_a_side(spoken: Elliptic, question: Question, g: Grounder) -> Elliptic:
    """Say what we would do on the side that a fragment names."""
    if spoken.event is not None:
        return replace(spoken, event=lane_or_turn(spoken.event, g))
    event = main_event(question)
    side = spoken.thing.which if isinstance(spoken.thing, Lane) else ""
    if event is None or event.actor != Ego() or side not in ("left", "right"):
        return spoken
    if event.action not in _OF_LANES | _OF_WAYS:
        return spoken
    action: Any = f"{'change' if event.action in _OF_LANES else 'exit'}-{side}"
    return replace(spoken, thing=None, event=Event(action, tense=event.tense))


def at_place(thing: Thing, question: Question) -> Question | None:
    """Ask who is at another place, where it was asked who is at one: "and behind us?"."""
    if not isinstance(thing, Described) or thing.bearing not in _RELATIONS:
        return None
    if thing != Described(bearing=thing.bearing, of=thing.of, definite=thing.definite):
        return None
    old = question.such if isinstance(question, Which) else None
    if not isinstance(old, Related) or old.relation not in _RELATIONS.values():
        return None
    there = replace(old, relation=_RELATIONS[thing.bearing], to=thing.of or Ego())
    return replace(question, such=there)


def lane_or_turn(event: Event, g: Grounder) -> Event:
    """Take "left again?" for the lane change where we are changing lanes."""
    change: Any = _CHANGES.get(event.action)
    if change is None or not isinstance(event.actor, Ego):
        return event
    since = max(g.context.begin, g.context.now - LATELY)
    done = any(e.action == change for e in g.context.deeds(Ego(), since, g.context.now))
    return replace(event, action=change, tense="present") if done else event
