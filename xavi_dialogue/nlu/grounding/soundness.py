"""Soundness: grounded acts that say nothing, such as a vehicle that waits for itself."""

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.meaning import Request
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Nobody,
    Passenger,
    Related,
    Thing,
    Vehicle,
)

_ROAD_USERS = (Ego, Vehicle)


def is_sound(value: object) -> bool:
    """Say whether no event or relation in a grounded term is between a thing and itself."""
    if isinstance(value, tuple):
        return all(map(is_sound, value))
    if not isinstance(value, Value):
        return True
    aboard = isinstance(value, Event) and value.action == "drop-off"  # passengers
    if isinstance(value, Event) and _arrives_nowhere(value):
        return False
    if isinstance(value, Event) and not aboard and not _may_meet(value.actor, value.object):
        return False
    if isinstance(value, Related) and value.relation != "same-as":
        upon = value.relation == "on" and isinstance(value.thing, _ROAD_USERS)
        if (upon and isinstance(value.to, _ROAD_USERS)) or not _may_meet(value.thing, value.to):
            return False
    if isinstance(value, Request) and not _can_be_bidden(value.event):
        return False
    return all(is_sound(getattr(value, name)) for name in value.__struct_fields__)


def _arrives_nowhere(event: Event) -> bool:
    """Say whether somebody else arrives at no place that is stated: only we have a destination."""
    others = not isinstance(event.actor, Ego | Passenger)
    return event.action == "arrive" and others and event.object is None and event.where is None


def _can_be_bidden(event: Event) -> bool:
    """Say whether it is we who are to do something, and not to ourselves."""
    towards_us = isinstance(event.object, Ego) and event.action != "drop-off"
    return isinstance(event.actor, Ego) and not towards_us


def _may_meet(one: Thing | None, other: Thing | None) -> bool:
    """Say whether two may take part in one event: they are two, and one of them is somebody."""
    if isinstance(one, Ego | Vehicle) and one == other:
        return False
    return not (isinstance(one, Nobody | Everyone) and isinstance(other, Nobody | Everyone))
