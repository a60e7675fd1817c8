"""Reacting: how we could react to another vehicle's sudden action, and whether we could stop."""

from typing import Literal

from msgspec.structs import replace

from xavi_dialogue.domain.answers import NotRecorded, Reaction
from xavi_dialogue.domain.meaning import Question, Whether
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Is,
    Nobody,
    Proposition,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.measuring.durations import stands
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import event_of, is_own, manner_of, unwrapped
from xavi_dialogue.explain.causes.driving.stopping import stopping, stopping_distance
from xavi_dialogue.explain.history.restraints import lasted

#: Sudden actions of another vehicle that leave us only braking.
SUDDEN = frozenset[ActionName](
    ("stop", "brake", "pull-out", "cut-in", "block", "swerve", "reverse", "merge", "stand")
)
#: Actions whose omission is sudden.
DUTIES = frozenset[ActionName](("wait", "give-way", "let-go", "stop", "brake", "see", "slow-down"))
IN_LANE = frozenset[ActionName](("stop", "brake", "slow-down", "stand", "go", "move", "speed-up"))
#: Actions that are sudden if the vehicle stands or was about to stop.
STARTING = frozenset[ActionName](("go", "move", "enter", "cross"))
COMING = frozenset[ActionName](("move", "go", "enter", "cross", "appear", "come"))
LYING = frozenset[ActionName](("stop", "stand", "brake"))  # actions that end in our way
HALTING = frozenset[ActionName](("stop", "brake", "slow-down", "avoid", "swerve"))
COLLIDING = frozenset[ActionName](("collide", "nearly-collide"))
HALTS = frozenset[ActionName](("stop", "brake", "slow-down", "stand"))
GOING_ON = frozenset[ActionName](("go", "move", "speed-up", "continue"))
WAITS: tuple[ActionName, ...] = ("give-way", "wait")
LOOK_BACK = 15.0  # [s] before the question, in which the worst time is searched
STEP = 0.5  # [s]

Asks = Literal["stop", "collide"]


def is_sudden(
    event: Event,
    then: Question | None,
    scene: Asked,
    vehicle: int,
    time: float,
    *,
    negated: bool,
) -> bool:
    """Check whether a supposition about another vehicle leaves us only braking."""
    if asks(then) is not None:
        return True
    if _frees(event, scene, vehicle, time, negated=negated):
        return False
    if negated:
        return event.action in DUTIES
    if event.action in SUDDEN or manner_of(event, "suddenly", "hard") is not None:
        return True
    trend = scene.ride.motion(vehicle).until(time).trend
    return event.action in STARTING and trend in ("slowing", "standing")


def _frees(event: Event, scene: Asked, vehicle: int, time: float, *, negated: bool) -> bool:
    """Check whether somebody who held us up, or drove before us, is supposed to have gone on."""
    if event.tense not in ("past", "perfect") or _is_before_us(event):
        return False
    if event.action not in (HALTS if negated else GOING_ON):
        return False
    past = scene.past
    since, until = (time, time) if past is None else (past.begin, past.end)
    held = (r.vehicle for r in lasted(scene.ride, since, until + STEP) if r.by == "blocked")
    return vehicle in held or bool(scene.world.relation("ahead-of", Vehicle(vehicle), Ego(), time))


def asks(then: Question | None) -> Asks | None:
    """Return whether a question is about stopping in time or a collision; None: neither."""
    if not isinstance(then, Whether):
        return None
    of, _ = unwrapped(then.that)
    event = event_of(of)
    if event is not None and event.action in COLLIDING:
        return "collide"
    if event is not None and is_own(event.actor) and _is_able(event):
        return "stop" if event.action in HALTING else None
    return "stop" if _is_room(of) else None


def _is_able(event: Event) -> bool:
    """Check whether a question is if we can do it: "could we stop", "would we stop in time"."""
    return event.modal in ("can", "could") or (event.modal == "would" and "early" in event.manner)


def _is_room(of: Proposition | None) -> bool:
    match of:
        case Exists(thing=Feature(kind="space")):
            return True
        case Is(state="far" | "safe" | "possible" | "roomy", thing=thing):
            return is_own(thing) or not isinstance(thing, Vehicle)
    return False


def reaction(
    event: Event | None,
    then: Question | None,
    scene: Asked,
    vehicle: int,
    time: float,
    *,
    negated: bool = False,
    past: bool = False,
) -> Reaction:
    """Return whether we could stop if another vehicle did something at a time [s].

    For the past without a time, it is the time when it would have been closest.

    Raises:
        Unanswered: it is not known where it was.
    """
    action = None if event is None or negated else event.action
    before_us = event is not None and _is_before_us(event)
    in_lane = action in IN_LANE and not before_us
    waited = _waited(scene, vehicle) if negated and event is not None else None
    if past and waited is not None:
        time = waited
    elif past and not (scene.past is not None and scene.past.said):
        ahead = _closest(scene, vehicle, scene.now, in_lane=in_lane)
        if ahead is None and action in STARTING:  # it stood next to our way, not on it
            in_lane = False
            ahead = _closest(scene, vehicle, scene.now, in_lane=False)
        time = scene.now if ahead is None else ahead
    found = stopping(scene.world.states, vehicle, time, in_lane=in_lane, halts=action in LYING)
    if found is None:
        raise Unanswered(NotRecorded("out-of-view", thing=Vehicle(vehicle), since=time))
    along = in_lane and action in STARTING and found.left is not None  # it sets off ahead of us
    sayable = event if event is None or event.action not in ("do", "happen") else None
    if sayable is not None and not isinstance(sayable.object, Ego | Vehicle):
        sayable = replace(sayable, object=None)
    return Reaction(
        vehicle=vehicle,
        kind="joins" if along else found.kind,
        supposed=sayable,
        time=time,
        speed=found.speed,
        needed=found.needed,
        room=found.room,
        left=found.left,
        closing=found.closing if negated else None,
        past=past,
        negated=negated,
        asked=asks(then),
    )


def _is_before_us(event: Event) -> bool:
    """Check whether somebody is supposed to do something right in our way: "in front of us"."""
    place = event.where
    return place is not None and place.relation == "ahead-of" and place.to == Ego()


def _waited(scene: Asked, vehicle: int) -> float | None:
    """Return when [s] a vehicle last began to wait for us, when it could have gone on instead."""
    found = scene.world.episodes(Vehicle(vehicle), actions=WAITS, object=Ego())
    begun = [e.begin for e in found if e.begin <= scene.now]
    return begun[-1] if begun else None


def _closest(scene: Asked, vehicle: int, last: float, *, in_lane: bool) -> float | None:
    """Return the time [s] before the last at which a sudden action would leave the least room.

    Times when it drives ahead of us come first. For an action in its own lane, only these and times
    when we stand count. None if there is no such time.
    """
    found = []
    for k in range(round(LOOK_BACK / STEP) + 1):
        time = last - k * STEP
        one = stopping(scene.world.states, vehicle, time, in_lane=in_lane)
        if one is None or one.room is None or (in_lane and one.kind == "first"):
            continue
        rank = 0 if one.left is not None else 1 if one.kind == "standing" or not in_lane else 2
        if rank < 2:
            found.append((rank, one.room - (one.needed or 0.0), time))
    return min(found)[2] if found else None


def is_somebody(event: Event | None) -> bool:
    """Check whether somebody who is not there is supposed to get in our way: a child, a dog."""
    if event is None or not isinstance(event.actor, Nobody | Described):
        return False
    return event.action in SUDDEN | COMING


def for_anybody(event: Event, scene: Asked) -> Reaction:
    """Return our stopping distance for somebody who gets in our way."""
    speed = scene.world.measure("speed", Ego(), scene.now).value or 0.0
    needed = stopping_distance(speed)
    kind: Literal["standing", "anybody"] = "standing" if stands(scene) else "anybody"
    return Reaction(None, kind, None, scene.now, speed, needed, past=event.tense == "perfect")
