"""Which actions count as which: braking is slowing down, a turn is an exit to either side."""

from typing import TypeAlias

from xavi_dialogue.domain.terms import Ego, Event, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName, Side

Actions: TypeAlias = frozenset[ActionName]

#: The actions of episodes that an action asked about may stand for, besides itself.
COVERS: dict[ActionName, tuple[ActionName, ...]] = {
    "slow-down": ("brake",),
    "stand": ("stop",),
    "wait": ("give-way",),
    "let-go": ("give-way",),
    "give-way": ("wait",),
    "change-lane": ("change-left", "change-right"),
    "turn": ("exit-left", "exit-right"),
    "pass": ("overtake",),
    "continue": ("exit-straight",),
    "merge": ("cut-in", "pull-out", "change-left", "change-right"),
    "keep-distance": ("follow",),
    "swerve": ("change-left", "change-right"),
    "see": ("appear",),
}
#: The side that is part of an action.
SIDES: dict[ActionName, Side] = {
    "change-left": "left",
    "change-right": "right",
    "exit-left": "left",
    "exit-right": "right",
    "exit-straight": "straight",
}
#: Actions whose actor and object change places: if a vehicle blocks us, we wait for it.
MIRRORED: dict[ActionName, ActionName] = {"block": "wait"}


def covered(actions: frozenset[ActionName]) -> Actions:
    """Return all actions of episodes that any of some actions may stand for."""
    return actions | {fine for action in actions for fine in COVERS.get(action, ())}


def somebody(thing: Thing | None) -> frozenset[int] | None:
    """Return the vehicles that a grounded thing names, 0 being ours; None if it names none."""
    match thing:
        case Ego():
            return frozenset((0,))
        case Vehicle(number):
            return frozenset((number,))
        case Vehicles(numbers):
            return frozenset(numbers)
    return None


def named(vehicle: int) -> Ego | Vehicle:
    """Return the thing that a number names."""
    return Ego() if vehicle == 0 else Vehicle(vehicle)


def mirrored(event: Event) -> Event:
    """Return an event such as "block" as its mirror image, with actor and object exchanged."""
    other = MIRRORED.get(event.action)
    if other is None:
        return event
    actor = event.object if event.object is not None else Ego()
    return Event(
        other, actor, event.actor, event.side, event.manner, event.time, event.tense, event.modal
    )
