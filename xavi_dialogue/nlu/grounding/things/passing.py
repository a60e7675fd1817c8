"""Passing: who goes past us just now, read off where he is and how fast, with no episode yet."""

from typing import Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.terms import Described, Ego, Event, Pronoun, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName, Bearing, Relation
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.salience import vehicles_of

PASSING: Final = frozenset[ActionName](("pass", "overtake"))
BESIDE: Final = 1.8  # [m] to the side from which somebody is in another lane
REACH: Final = 35.0  # [m] within which somebody is said to pass us
NEARER: Final = 0.1  # cost of being as far away as that
_SIDES: Final[dict[Relation, Bearing]] = {"left-of": "left", "right-of": "right"}


def placed(thing: Described) -> Described:
    """Take "who passes us on the left" for somebody on our left who passes us."""
    event = thing.doing
    where = None if event is None else event.where
    if event is None or where is None or thing.bearing is not None or event.object != Ego():
        return thing
    side = _SIDES.get(where.relation)
    if side is None or where.to != Ego() or event.action not in PASSING:
        return thing
    return replace(thing, bearing=side, doing=replace(event, where=None))


def to_pass(event: Event, context: Context) -> Event:
    """Take "overtake him" of who is ahead of us: whom we spoke of, else the next in our lane."""
    to_come = event.tense in ("present", "future") and event.actor == Ego()
    if not to_come or event.action not in PASSING or not isinstance(event.object, Pronoun):
        return event
    ahead = [
        look
        for vehicle in context.in_view(context.now)
        if (look := context.look(vehicle, context.now)) is not None
        if look.bearing.startswith("ahead") and not look.oncoming and look.kind not in ON_FOOT
    ]
    spoken = {vehicle for vehicle, _ in vehicles_of(context.discourse.mentions)}
    if any(look.vehicle in spoken for look in ahead):
        return event
    leaders = [look for look in ahead if look.bearing == "ahead"]
    if not leaders:
        return event
    return replace(event, object=Vehicle(min(leaders, key=lambda one: one.distance).vehicle))


def comes(thing: Described) -> bool:
    """Tell whether somebody is described as coming now, which is to be seen."""
    event = thing.doing
    return event is not None and event.action in ("come", "approach") and event.tense == "present"


def goes_past(event: Event | None) -> bool:
    """Tell whether somebody is described by his going past us."""
    return event is not None and event.action in PASSING and event.object == Ego()


def passing_cost(context: Context, look: Look, moment: float) -> float:
    """Weigh that somebody goes past us at a moment [s]: the nearer, the likelier."""
    quicker = context.world.relation("faster-than", Vehicle(look.vehicle), Ego(), moment)
    faster = look.oncoming or quicker is True
    along = look.oncoming or not look.bearing.startswith("crossing")
    if not look.in_view or abs(look.left) < BESIDE or not faster or not along:
        return 1.0
    if abs(look.ahead) > REACH:
        return 1.0
    return NEARER * abs(look.ahead) / REACH
