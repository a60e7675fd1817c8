"""Kin: actions that people may mean when they name another one."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Context

_SLOWING: Final[tuple[ActionName, ...]] = ("brake", "slow-down")
_HALTING: Final[tuple[ActionName, ...]] = ("stand", "stop", "wait", "give-way")
_SHIFTING: Final[tuple[ActionName, ...]] = ("change-lane", "change-left", "change-right")

_PASSING: Final = frozenset[ActionName](("overtake", "pass"))
_MUTUAL: Final[tuple[ActionName, ...]] = ("pass", "cross")
_LETTING: Final = frozenset[ActionName](("let-go",))
_HELD: Final[tuple[ActionName, ...]] = ("stop", "brake")

#: By action that people name: what may have happened instead, closest in meaning first.
KIN: Final[dict[ActionName, tuple[ActionName, ...]]] = {
    "stop": ("stand", "wait", "give-way", *_SLOWING),
    "stand": ("stop", "wait", *_SLOWING),
    "wait": ("give-way", "let-go", "stand", "stop", *_SLOWING),
    "give-way": ("let-go", "wait", "stop", "stand", *_SLOWING),
    "let-go": ("give-way", "wait", *_SLOWING),
    "brake": ("slow-down", "stop", "give-way"),
    "slow-down": ("brake", "stop", "give-way"),
    "swerve": (*_SHIFTING, "avoid"),
    "avoid": ("swerve", "give-way", *_SLOWING),
    "overtake": ("pass", *_SHIFTING),
    "pass": ("overtake", "cross"),
    "merge": ("change-lane", "enter", "cut-in"),
    "cut-in": ("merge", "change-lane", "pull-out"),
    "pull-out": ("enter", "leave", "cut-in", "turn", "exit-straight", "go", *_SHIFTING),
    "change-lane": ("merge", "overtake"),
    "leave": ("exit-left", "exit-right", "exit-straight", "turn"),
    "enter": ("merge", "turn", "go"),
    "go": ("enter", "turn", "exit-straight", "speed-up"),
    "move": ("go", "continue"),
    "cross": ("pass", "continue", "exit-straight"),
    "turn": ("leave",),
    "appear": ("approach", "come"),
    "come": ("approach", "appear"),
    "block": ("stand",),
}


def like(context: Context, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
    """Find the episodes that people may mean by an event, though they are of another action.

    They are of the closest action that has any. Else the event is looked for without its object;
    but whom we passed is meant, and nobody else.
    """
    for action in KIN.get(event.action, ()):
        if action in _SHIFTING and event.object is not None and event.action in _PASSING:
            continue  # a change of lane does not mean that somebody was passed
        kin = replace(event, action=action)
        found = context.holds(kin, begin, end)
        if found:
            return found
    if event.action in _LETTING and event.actor == Ego() and isinstance(event.object, Vehicle):
        crossed = context.holds(Event("cross", event.object, Ego()), begin, end)
        halts = [
            halt for action in _HELD for halt in context.holds(Event(action, Ego()), begin, end)
        ]
        if any(_meets(one, halt, context) for one in crossed for halt in halts):
            return crossed
    if event.action in _PASSING and isinstance(event.object, Vehicle | Vehicles):
        ours = event.action == "pass" and event.actor == Ego()
        return _passed(context, event.object, begin, end) if ours else ()
    if event.object is not None and not isinstance(event.actor, Vehicle):
        return context.holds(replace(event, object=None), begin, end)
    return ()


def _passed(
    context: Context, whom: Vehicle | Vehicles, begin: float, end: float
) -> tuple[Episode, ...]:
    """Find when somebody whom we passed went past us, which is the same."""
    found = (context.holds(Event(action, whom, Ego()), begin, end) for action in _MUTUAL)
    return next((episodes for episodes in found if episodes), ())


def _meets(one: Episode, other: Episode, context: Context) -> bool:
    """Tell whether two episodes overlap."""
    ends = [context.now if e.end is None else e.end for e in (one, other)]
    return one.begin <= ends[1] and other.begin <= ends[0]
