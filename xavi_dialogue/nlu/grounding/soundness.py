"""Soundness: grounded acts that say nothing, such as a vehicle that waits for itself."""

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.terms import Ego, Event, Everyone, Nobody, Related, Thing, Vehicle


def is_sound(value: object) -> bool:
    """Say whether no event or relation in a grounded term is between a thing and itself."""
    if isinstance(value, tuple):
        return all(map(is_sound, value))
    if not isinstance(value, Value):
        return True
    aboard = isinstance(value, Event) and value.action == "drop-off"  # passengers
    if isinstance(value, Event) and not aboard and not _may_meet(value.actor, value.object):
        return False
    if isinstance(value, Related) and not _may_meet(value.thing, value.to):
        return False
    return all(is_sound(getattr(value, name)) for name in value.__struct_fields__)


def _may_meet(one: Thing | None, other: Thing | None) -> bool:
    """Say whether two may take part in one event: they are two, and one of them is somebody."""
    if isinstance(one, Ego | Vehicle) and one == other:
        return False
    return not (isinstance(one, Nobody | Everyone) and isinstance(other, Nobody | Everyone))
