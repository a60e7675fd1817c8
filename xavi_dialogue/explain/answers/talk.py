"""Talk: replies to feelings and social moves, with facts that bear on them."""

from xavi_dialogue.domain.answers import Answer, Comforting, Measures, Sociable
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Feel, Social
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Not,
    Proposition,
    Related,
    That,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import FeelingKind
from xavi_dialogue.explain.answers.events.acting import activity
from xavi_dialogue.explain.answers.measuring.closeness import closeness, nearest_vehicle
from xavi_dialogue.explain.answers.measuring.durations import remaining_wait, stands
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import known
from xavi_dialogue.explain.answers.reference.moments import RECENT, Window, window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.ride.comfort import BRAKING, HARD, comfort_of
from xavi_dialogue.explain.answers.ride.places import time_to_go

NEAR = 8.0  # [m] maximum distance of a vehicle that may have startled somebody
FRIGHT: frozenset[FeelingKind] = frozenset(("afraid", "nervous", "startled", "distrustful"))
TIRESOME: frozenset[FeelingKind] = frozenset(("impatient", "bored", "tired"))
HASTE: frozenset[FeelingKind] = TIRESOME | {"annoyed", "angry"}
PUZZLED: frozenset[FeelingKind] = frozenset(("surprised", "confused"))


def feel(act: Feel, asked: Asked) -> Answer:
    """Reply to a feeling with a fact that bears on what it is about.

    Raises:
        Unanswered: it is about something unknown.
    """
    try:
        return Comforting(act, _bearing(act, asked))
    except Unanswered:
        return Comforting(act)


def social(act: Social, asked: Asked) -> Answer:
    """Reply to a social move; a question about our feelings gets how close that came."""
    if act.about is None:
        return Sociable(act.kind)
    vehicle, _, _ = _about(act.about)
    time = _recent(asked)
    if isinstance(act.about, Vehicles):
        vehicle = nearest_vehicle(asked, time, among=act.about.numbers)
    try:
        found = _fright(asked, time) if vehicle is None else closeness(asked, vehicle, time, "safe")
    except Unanswered:
        return Sociable(act.kind)
    return Sociable(act.kind, found)


def _bearing(act: Feel, asked: Asked) -> Answer | None:
    about = act.about
    vehicle, speedy, event = _about(about)
    time = _recent(asked)
    if vehicle is not None and act.feeling not in TIRESOME:
        return closeness(asked, vehicle, time, "safe")
    if speedy:
        return speed_of(asked)
    if event is not None:
        return _of_event(act, asked, event)
    if act.feeling == "sick":
        return comfort_of(asked, time)
    if act.feeling in FRIGHT:
        return _fright(asked, time)
    if act.feeling == "disliking":
        hard = comfort_of(asked, time)
        return hard if (hard.peak.value or 0.0) >= HARD / 2.0 else None
    if act.feeling in HASTE:
        upset = act.feeling in ("annoyed", "angry")
        return _waiting(asked) if not upset or stands(asked) else None
    if act.feeling in PUZZLED:
        return activity(asked, Ego(), asked.now)
    return None


def _about(about: Proposition | Thing | None) -> tuple[int | None, bool, Event | None]:
    """Return what a feeling is about: a vehicle, our speed, or an action of ours."""
    match about:
        case Not(content=content):
            return _about(content)
        case Is(state="fast" | "slow", thing=thing) if number(thing) is None:
            return None, True, None
        case Is(thing=thing, event=event):
            return number(thing), False, event
        case Happens(event=event):
            other = number(event.actor) or number(event.object)
            quick = is_us(event.actor) and "fast" in event.manner
            return other, quick, None if other is not None else event
        case Compares(left=left):
            return number(left.thing), left.attribute in ("speed", "limit", "excess"), None
        case Related(thing=thing, to=to):
            return number(thing) or number(to), False, None
        case Has(thing=thing) | Exists(thing=thing):
            return number(thing), False, None
        case That() | None:
            return None, False, None
    return (about.number if isinstance(about, Vehicle) else None), False, None


def _recent(asked: Asked) -> Window:
    """Return the stretch that a feeling is about: the one discussed, else the last seconds."""
    if asked.past is not None:
        return window(asked)
    return Window(max(asked.now - RECENT, asked.world.begin), asked.now)


def speed_of(asked: Asked) -> Answer:
    """Return our speed, with the limit."""
    speed = asked.world.measure("speed", Ego(), asked.now)
    limit = asked.world.measure("limit", Ego(), asked.now)
    if limit.value is not None and speed.value is not None:
        beside = Measure("speed", Ego(), asked.now, value=speed.value, reference=limit.value)
        return Measures((beside,))
    return Measures((speed,))


def _of_event(act: Feel, asked: Asked, event: Event) -> Answer | None:
    """Return facts on a feeling about an action of ours: how hard it was, or how close."""
    if event.action in ("wait", "stand", "stop") and act.feeling in HASTE:
        return _waiting(asked)
    found = occasion(asked, event) if is_us(event.actor) else None
    if found is None:
        return _fright(asked, _recent(asked))
    end = asked.now if found.end is None else found.end
    if found.action not in BRAKING:
        return closeness(asked, None, Window(found.begin, end), "safe")
    return comfort_of(asked, Window(found.begin, end), found)


def _fright(asked: Asked, time: Window) -> Answer:
    """Return what may have caused fear: a vehicle that came close, else braking, else the speed."""
    near = closeness(asked, None, time, "safe")
    if near.closest is not None and near.closest.value is not None and near.closest.value <= NEAR:
        return near
    hard = comfort_of(asked, time)
    if hard.peak.value is not None and hard.peak.value >= HARD / 2.0:
        return hard
    return speed_of(asked)


def _waiting(asked: Asked) -> Answer:
    """Return how long it will take until we drive on, and until we arrive."""
    wait = (remaining_wait(asked),) if stands(asked) else ()
    return Measures((*known(*wait), time_to_go(asked, asked.now)))
