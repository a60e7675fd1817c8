"""What passengers call actions, in terms of the planner's macro actions."""

from typing import TypeGuard

from planner.trace import ACTIONS, Action
from xavi_dialogue.causal.model import Actions, CausalModel
from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.explain.ride import decline

#: "Straight" is one word for both: whether a junction comes first decides.
STRAIGHT: tuple[Action, ...] = ("continue", "exit-straight")
#: What a foil means to the planner; of several, the first one that is possible.
MEANINGS: dict[QueryAction, tuple[Action, ...]] = {
    "continue": STRAIGHT,
    "exit-straight": ("exit-straight", "continue"),
    "overtake": ("change-left", "change-right"),
    "give-way": ("stop",),
}
#: Descriptions of how the ego drives rather than of what it chooses.
SPEEDS: tuple[QueryAction, ...] = ("slow-down", "speed-up")
NO_SPEED = "speed is no choice of its own: it follows from the road and from those ahead"


def is_macro(action: QueryAction) -> TypeGuard[Action]:
    """Whether an action is one that the planner chooses."""
    return action in ACTIONS


def same(one: QueryAction, other: QueryAction) -> bool:
    """Whether a deed may be called by either name."""
    return other in means(one) or one in means(other)


def means(action: QueryAction) -> tuple[Action, ...]:
    """The macro actions that an action of a question may stand for; () for SPEEDS."""
    if action in MEANINGS:
        return MEANINGS[action]
    return (action,) if is_macro(action) else ()


def to_macros(model: CausalModel, asked: tuple[QueryAction, ...], node: Actions = ()) -> Actions:
    """The macro actions of a foil, from a node of the search on.

    Raises:
        Unanswered: it cannot be expressed in macro actions.
    """
    found: list[Action] = []
    for action in asked:
        meanings = means(action)
        if not meanings:
            time = model.trace.sim_time
            raise decline("not-applicable", asked=asked, reason=NO_SPEED, time=time)
        possible = model.options((*node, *found))
        choice = next((m for m in meanings if m in possible), meanings[0])
        if not found or found[-1] != choice:
            found.append(choice)
    return tuple(found)
