"""Actions: the names that passengers use, in terms of the planner's macro actions."""

from typing import TypeGuard

from planner.record.trace import ACTIONS
from planner.record.trace import Action as MacroAction
from xavi_dialogue.causal.model import Actions, CausalModel
from xavi_dialogue.domain.answers import NotApplicable
from xavi_dialogue.domain.terms import Event, Lane, Thing
from xavi_dialogue.domain.vocabulary import ActionName, Side
from xavi_dialogue.explain.history.ride import Unanswered

#: "Straight" is one word for both; which one is meant depends on whether a junction comes first.
STRAIGHT: tuple[MacroAction, ...] = ("continue", "exit-straight")
CHANGES: tuple[MacroAction, ...] = ("change-left", "change-right")
TURNS: tuple[MacroAction, ...] = ("exit-left", "exit-right", "continue-next-exit")
EXITS: tuple[MacroAction, ...] = ("exit-left", "exit-right", "exit-straight")
#: What a name means to the planner; of several, the first one that is possible.
MEANINGS: dict[ActionName, tuple[MacroAction, ...]] = {
    "continue": STRAIGHT,
    "keep-lane": STRAIGHT,
    "go": STRAIGHT,
    "move": STRAIGHT,
    "exit-straight": ("exit-straight", "continue"),
    "overtake": CHANGES,
    "change-lane": CHANGES,
    "turn": ("exit-left", "exit-right"),
    "leave": EXITS,
    "give-way": ("stop",),
    "let-go": ("stop",),
    "wait": ("stop",),
    "stand": ("stop",),
    "brake": ("stop",),
}
#: Names for a change of lanes, and for a turn; the side decides which.
LANE_WORDS = frozenset[ActionName](("change-lane", "merge", "swerve", "cut-in", "pull-out"))
TURN_WORDS = frozenset[ActionName](("turn",))
#: Descriptions that are read off the speed and are no choice of the planner.
DRIVING = frozenset[ActionName](
    ("slow-down", "brake", "speed-up", "stop", "stand", "wait", "give-way", "let-go", "follow")
)
#: Names for coming to a standstill or staying in it, and for letting somebody go first.
HALTS = frozenset[ActionName](("stop", "stand", "wait", "give-way", "let-go"))
YIELDS = frozenset[ActionName](("give-way", "let-go"))
NO_SPEED = "speed is no choice of its own: it follows from the road and from those ahead"
_CHANGE: dict[Side, MacroAction] = {"left": "change-left", "right": "change-right"}
_EXIT: dict[Side, MacroAction] = {
    "left": "exit-left",
    "right": "exit-right",
    "straight": "exit-straight",
}


def is_macro(action: ActionName) -> TypeGuard[MacroAction]:
    """Check whether an action is one that the planner chooses."""
    return action in ACTIONS


def means(action: ActionName) -> tuple[MacroAction, ...]:
    """List the macro actions that a name may stand for; () for changes of speed."""
    if action in MEANINGS:
        return MEANINGS[action]
    return (action,) if is_macro(action) else ()


def same(one: ActionName, other: ActionName) -> bool:
    """Check whether one action may be called by either name."""
    return one == other or other in means(one) or one in means(other)


def names_of(event: Event) -> tuple[ActionName, ...]:
    """List the names of an event that follow from its action, side and object.

    They are several if the side is open: any of them may be meant.
    """
    action = _plain(event.action, event.object)
    if action == "change-lane":
        return (_CHANGE[event.side],) if event.side in _CHANGE else CHANGES
    if action == "overtake":
        return (_CHANGE[event.side],) if event.side in _CHANGE else ("overtake",)
    if action == "turn":
        return (_EXIT[event.side],) if event.side is not None else ("exit-left", "exit-right")
    if action == "leave":
        return (_EXIT[event.side],) if event.side is not None else EXITS
    return (action,)


def _plain(action: ActionName, thing: Thing | None) -> ActionName:
    """Return the simplest name of an action with an object, such as "change-lane" for "merge"."""
    if action in LANE_WORDS or (action in ("enter", "leave") and isinstance(thing, Lane)):
        return "change-lane"
    same_as: dict[ActionName, ActionName] = {
        "pass": "overtake",
        "enter": "go",
        "brake": "slow-down",
        "let-go": "give-way",
        "keep-lane": "continue",
        "cross": "go",
    }
    return same_as.get(action, action)


def sequence(event: Event) -> tuple[Event, ...]:
    """List an event and those that follow it in the same question."""
    return (event, *(() if event.then is None else sequence(event.then)))


def to_macros(model: CausalModel, asked: tuple[ActionName, ...], node: Actions = ()) -> Actions:
    """Express a foil in macro actions, from a node of the search on.

    Raises:
        Unanswered: it cannot be expressed in this way.
    """
    found: list[MacroAction] = []
    for action in asked:
        meanings = means(action)
        if not meanings:
            raise Unanswered(NotApplicable((), NO_SPEED, model.trace.sim_time))
        possible = model.options((*node, *found))
        choice = next((m for m in meanings if m in possible), meanings[0])
        if not found or found[-1] != choice:
            found.append(choice)
    return tuple(found)
