"""Refraining: why we did not wait, stop, slow down, or stay behind somebody."""

import math
from dataclasses import replace
from typing import Literal

from msgspec import structs

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    CrossingVehicle,
    DidNotHappen,
    GoReason,
    MotionCause,
    MotionReason,
    NeedRollout,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Ego, Event, Lane, Related, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import choices, going, motions
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.reading import foil_subject, is_past, vehicle_in
from xavi_dialogue.explain.answers.ride.priority import priority_at
from xavi_dialogue.explain.causes.driving.going import reckoned_with
from xavi_dialogue.explain.causes.driving.yielding import leads
from xavi_dialogue.explain.causes.plans.premise import is_open
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, HALTS
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.restraints import held_by

#: Actions of going on behind somebody, or letting somebody go first.
REFRAINS = HALTS | frozenset[ActionName](
    ("slow-down", "brake", "follow", "keep-distance", "keep-lane")
)
APART = 2.0  # [m] minimum offset sideways of a vehicle in another lane
FRESH = 5.0  # [s] after a change of lanes in which it is meant although nothing says so
#: By lane: the change of lanes by which it is left.
LEFT_BY: dict[str, MacroAction] = {
    "right": "change-left",
    "rightmost": "change-left",
    "left": "change-right",
    "leftmost": "change-right",
}
BESIDE = 5.0  # [m] maximum offset sideways of a vehicle in front of us
SLOWER = 0.5  # [m/s] by which a slower vehicle is slower than us
#: By our rule towards a vehicle: who has right of way.
WHO_FIRST: dict[str, Literal["ego", "vehicle"]] = {"priority": "ego", "give-way": "vehicle"}
LATELY = 12.0  # [s] after a change of lanes that may have been done instead of staying behind


def refrained(event: Event, scene: Asked) -> Answer:
    """Explain why we did not wait, stop, slow down or stay behind, by what we did instead.

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    slowed = _slowed_for(event, scene)
    if slowed is not None:
        return slowed
    change, crossed = _change(scene), going.crossed(scene)
    behind = isinstance(event.where, Related) and event.where.relation == "behind"
    stays = behind or event.action in ("follow", "keep-distance", "keep-lane")
    stays |= change is not None and _passed_by(event, scene, change)
    since = math.inf if change is None else scene.moment - change.time
    own = event.action in ("slow-down", "brake", "stop")  # each is compared by itself
    fresh = crossed is None and not own and (since <= FRESH or event.action == "wait")
    if change is not None and (stays or fresh):
        past = change.ended is not None
        foil = Event("keep-lane", tense="past" if past else event.tense, time=event.time)
        return choices.why_not(foil, scene, Event(change.action, tense="past"))
    aside = _aside(event, scene)
    if aside is not None:
        return choices.why_not(structs.replace(event, action=aside, object=None), scene)
    if stays:
        return choices.why_not(Event("keep-lane", tense=event.tense, time=event.time), scene)
    if crossed is None or _is_over(event, scene, crossed):
        return _undone(event, scene)
    return _went(event, scene, crossed)


def _is_over(event: Event, scene: Asked, crossed: Deed) -> bool:
    """Check whether a question about stopping is about now, not a junction that we crossed."""
    named = event.object is not None or event.where is not None or foil_subject(scene, event).span
    through = crossed.ended is None and is_past(scene, event)
    if event.action != "stop" or named or through:
        return False
    trace = scene.ride.at(scene.now)
    return trace is not None and is_open(scene.ride, trace, ("stop",))


def _passed_by(event: Event, scene: Asked, change: Deed) -> bool:
    """Check whether slowing down would be for the vehicle that we left behind by changing lanes."""
    slowing = event.action in ("slow-down", "brake")
    return slowing and leads(scene.world, vehicle_in(event.object), change.time)


def _aside(event: Event, scene: Asked) -> ActionName | None:
    """Find the change of lanes by which we would get behind the vehicle we are asked to follow."""
    vehicle = vehicle_in(event.object)
    look = None if vehicle is None else scene.world.look(vehicle, scene.moment)
    if event.action != "follow" or look is None or look.oncoming or abs(look.left) < APART:
        return None
    return "change-left" if look.left > 0.0 else "change-right"


def _change(scene: Asked) -> Deed | None:
    """Return the change of lanes at the moment asked about, or shortly before it."""
    made = [d for d in scene.ride.deeds if d.action in CHANGES]
    before = [d for d in made if d.time <= scene.moment + 1.0]
    late = [d for d in before if d.ended is None or d.ended >= scene.moment - LATELY]
    return late[-1] if late else None


def _went(event: Event, scene: Asked, crossed: Deed) -> Answer:
    """Explain why we went on at a junction: who had gone, or was no reason to wait."""
    reason = going.went(Event("go", tense="past"), scene)
    if not isinstance(reason, GoReason):
        return _undone(event, scene)
    asked = vehicle_in(event.object)
    others = reason.others
    if asked is not None:
        named = tuple(one for one in others if one.vehicle == asked)
        if any(one.gone for one in named):
            return _done(event, scene)
        others = named or (CrossingVehicle(asked, first="none"),)
    else:
        counted = tuple(one for one in others if _counts(scene, one, crossed.time))
        if others and not counted:
            return _undone(event, scene)
        others = counted
    short = event.action if event.action in HALTS else "wait"
    return structs.replace(reason, others=others, refrained=short, past=True)


def _counts(scene: Asked, one: CrossingVehicle, time: float) -> bool:
    """Check whether a vehicle whose way crossed ours may be stated in a reason for not waiting.

    A vehicle with right of way may only if rollouts reckon with it.
    """
    yields = one.first != "vehicle" or one.gone
    return yields or reckoned_with(scene.ride, one.vehicle, time)


def _done(event: Event, scene: Asked) -> Answer:
    """Explain that we did give way: for whom, and why."""
    answer = motions.motion(structs.replace(event, action="give-way", tense="past"), scene)
    if isinstance(answer, MotionReason):
        return structs.replace(answer, form="did")
    return answer


def _slowed_for(event: Event, scene: Asked) -> Answer | None:
    """Explain that we slowed down for somebody, for whom we did not come to a standstill."""
    vehicle = vehicle_in(event.object)
    if vehicle is None or event.action not in HALTS or not is_past(scene, event):
        return None
    since = scene.moment - LATELY
    let = held_by(scene.ride, vehicle, since, scene.moment)
    if not let:
        return None
    span = Span(let[-1].begin, min(let[-1].end, scene.now), said=True)
    try:
        found = motions.motion(Event("slow-down", tense="past"), replace(scene, span=span))
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    if not isinstance(found, MotionReason):
        return None
    return found if event.action in ("stop", "stand") else structs.replace(found, form="did")


def _undone(event: Event, scene: Asked) -> Answer:
    """Explain why we did not, if neither a junction nor another lane is meant."""
    vehicle = vehicle_in(event.object)
    if vehicle is not None and event.action in ("let-go", "give-way", "wait"):
        past = scene.past or Span(scene.now, scene.now)
        rule = priority_at(scene, vehicle, Window(past.begin, past.end))
        if rule.rule == "priority":
            return rule
        if rule.rule == "give-way" and not is_past(scene, event):
            return _kept_speed(event, vehicle, scene)
    if is_past(scene, event) and event.action != "stop":
        try:
            found = _done(structs.replace(event, object=None), scene)
            if not isinstance(found, MotionReason) or found.premise:
                return found  # else it was only braking
        except Unanswered as unanswered:
            if not isinstance(unanswered.result, DidNotHappen):
                raise
    if event.action in ("slow-down", "brake") and not is_past(scene, event):
        return motions.fast(scene) if vehicle is None else _kept_speed(event, vehicle, scene)
    foil = Event("stop", tense=event.tense, time=event.time)
    return choices.why_not(foil, scene)


def _kept_speed(event: Event, vehicle: int, scene: Asked) -> Answer:
    """Explain why we do not slow down for a vehicle: how far ahead it is, and whether slower."""
    at = scene.moment
    look = scene.world.look(vehicle, at)
    theirs = scene.world.measure("speed", Vehicle(vehicle), at).value
    ours = scene.world.measure("speed", Ego(), at).value
    if look is None or theirs is None or ours is None:
        return motions.fast(scene)
    in_front = look.ahead > 0.0 and abs(look.left) < BESIDE and not look.oncoming
    rule = None if in_front else priority_at(scene, vehicle, Window(at, at), blame=True).rule
    found = CrossingVehicle(
        vehicle,
        first="ahead" if in_front else WHO_FIRST.get(rule or "", "none"),
        trend="steady" if theirs >= ours - SLOWER else "slowing",
        distance=look.distance,
    )
    return GoReason(None, (found,), past=False, refrained=event.action)


def left_lane(event: Event, scene: Asked) -> Event | None:
    """Find the change of lanes by which we left the lane that the question names."""
    lane = event.object
    if event.action != "keep-lane" or not isinstance(lane, Lane) or lane.which not in LEFT_BY:
        return None
    change = LEFT_BY[lane.which]
    made = [d for d in scene.ride.deeds if d.action == change and d.time <= scene.moment + 1.0]
    return Event(change, tense="past") if made else None


def is_refraining(event: Event) -> bool:
    """Check whether an event is one of waiting, slowing down or staying behind."""
    if event.action == "keep-lane":
        return not isinstance(event.object, Lane) or event.object.which == "own"
    return event.action in REFRAINS


def not_passed(event: Event, scene: Asked) -> Answer | None:
    """Explain why we stay behind a vehicle that we could overtake; None: we could not."""
    leader = vehicle_in(event.object)
    if event.action != "follow" or leader is None or is_past(scene, event):
        return None
    try:
        found = choices.why_not(Event("overtake", object=event.object, tense="present"), scene)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    speed = scene.world.measure("speed", Vehicle(leader), scene.now).value
    if not isinstance(found, ChoiceReason) or not leads(scene.world, leader, scene.now):
        return found
    return structs.replace(found, behind=MotionCause("leader", vehicle=leader, speed=speed))
