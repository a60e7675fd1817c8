"""Supposed when: the decision at which a supposition is to be tested."""

import dataclasses

from msgspec.structs import replace

from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Compare, Doing, HowMuch, Question, When, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Happens,
    Measured,
    Next,
    Now,
    Proposition,
    Time,
    Vehicle,
)
from xavi_dialogue.explain.answers.measuring.durations import halted
from xavi_dialogue.explain.answers.reasons import choices, motions, premises
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import event_of, subject
from xavi_dialogue.explain.answers.suppositions.undone import GOING
from xavi_dialogue.explain.causes.driving.driving import reasons_for
from xavi_dialogue.explain.causes.driving.suppositions import (
    Supposed,
    happens_without,
    is_faster,
    known_to,
    planned_without,
    slows_still,
)
from xavi_dialogue.explain.causes.plans.premise import happened, manoeuvre, premise
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, DRIVING, EXITS, names_of, same
from xavi_dialogue.explain.causes.vehicles.conduct import conduct_names, probability
from xavi_dialogue.explain.facts.looks import STILL
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import ROUNDING, planned, prediction

LATELY = 10.0  # [s] within which a turn that was made is the one that is spoken of
POSSIBLE = 0.02  # probability from which it is open whether somebody does something


def imagined(event: Event, then: Question | None, scene: Asked) -> tuple[Event, Asked]:
    """Read "if you turned left" as about now, unless a time or the past is named."""
    over = scene.past is not None and scene.past.end < scene.ride.latest.sim_time
    said = scene.past is not None and (scene.past.said or (over and not _of_now(then)))
    open_ = event.tense == "past" and event.modal is None and not said
    onward = event.action in GOING and event.side is None
    if not open_ or onward or not choices.is_choice(event):
        return event, scene
    return replace(event, tense="present"), dataclasses.replace(scene, span=None)


def _of_now(then: Question | None) -> bool:
    """Check whether a question about a supposed world is about the present, not the past."""
    match then:
        case Compare():
            return True
        case Whether(that=that):
            asked = event_of(that)
            tense = getattr(that, "tense", None) if asked is None else asked.tense
            return tense == "present"
        case Doing(tense=tense):
            return tense != "past"
    return False


def driven(scene: Asked, then: Event | None) -> Episode | None:
    """Find the episode that is asked about, if it is a way of driving and not a choice."""
    if then is None:
        return None
    if choices.is_choice(then):
        return None
    for kinds in motions.KINDS.get(then.action, (premises.SLOWING,)):
        found = [e for e in scene.world.episodes(Ego(), kinds) if e.action in kinds]
        chosen = scene.pick(found, lambda e: (e.begin, e.end))
        if chosen is not None:
            stop = happened(scene.ride, ("stop",), scene.span)
            end = scene.now if chosen.end is None else chosen.end
            chose = stop is not None and stop.started <= end and chosen.begin <= stop.span[1]
            return None if chose else chosen
    return None


def since_seen(scene: Asked, drove: Episode, vehicles: tuple[int, ...]) -> Episode | None:
    """Find the slowing down since some vehicles came into view; None if they were before it."""
    begun = [m.time[0] for v in vehicles if len((m := scene.ride.motion(v)).time)]
    first = min(begun, default=None)
    if first is None or drove.end is None or drove.end >= first:
        return None
    slowed = [e for e in scene.world.episodes(Ego(), premises.SLOWING) if e.begin >= first]
    return slowed[-1] if slowed else None


def was_done(scene: Asked, then: Event) -> bool:
    """Check whether an event came about, as a choice or in how we drove."""
    if then.action == "keep-lane" and _left_lane(scene) is not None:
        return False
    if then.action in GOING - DRIVING and then.side is None and _moved(scene):
        return True
    if choices.is_choice(then):
        return happened(scene.ride, subject(scene, then).names, scene.span) is not None
    kinds = (*motions.KINDS.get(then.action, (premises.SLOWING,))[0], *premises.STILL)
    found = [e for e in scene.world.episodes(Ego(), kinds) if e.action in kinds]
    if scene.past is not None and scene.past.said:
        return scene.pick(found, lambda e: (e.begin, e.end)) is not None
    return bool(found) or ("stop" in kinds and halted(scene))


def _moved(scene: Asked) -> bool:
    """Check whether we drove at the end of the part of the ride that is spoken of."""
    at = scene.now if scene.past is None else min(scene.past.end, scene.now)
    speed = scene.world.measure("speed", Ego(), at).value
    return speed is not None and speed > STILL


def is_new(found: Supposed, then: Event) -> bool:
    """Check whether an event is not part of the plan as things are."""
    names = names_of(then)
    if set(names) & DRIVING:
        return False
    return not any(same(name, step) for name in names for step in found.here.plan)


def without_at(
    scene: Asked, drove: Episode, vehicles: tuple[int, ...]
) -> tuple[Supposed, bool] | None:
    """Check whether we would have driven that way without vehicles, as `why` tests it.

    Args:
        scene: the setting.
        drove: how we drove.
        vehicles: those that are supposed to be absent.

    Returns:
        The decision that explains it, planned again without them, and whether we would; None if
        that cannot be planned.

    Raises:
        Unanswered: that decision does not know them, or does not show it surely enough.
    """
    reasons = reasons_for(scene.ride, scene.world, drove, scene.moment)
    trace = reasons.trace
    known = tuple(vehicle for vehicle in vehicles if vehicle in trace.scene)
    if not known:
        raise Unanswered(
            NotRecorded("out-of-view", thing=Vehicle(vehicles[0]), since=trace.sim_time)
        )
    happens = happens_without(scene.ride, reasons, known)
    if happens is None:
        return None
    found = planned_without(scene.ride, trace, known)
    slowing = drove.action in premises.SLOWING and not drove.standing
    unchanged = found.same and not is_faster(found)
    return found, happens or (slowing and (unchanged or slows_still(found)))


def moment(scene: Asked, then: Event | None, driven: Episode | None, *, past: bool) -> float:
    """Find the time [s] of the decision that a supposition is about."""
    if driven is not None:
        return driven.begin  # later, planning without its cause shows less
    left = None if then is None or then.action != "keep-lane" else _left_lane(scene)
    if then is not None and choices.is_choice(then):
        turns = set(names_of(then)) <= set(EXITS) and scene.ride.latest.under_way is None
        ahead = (then.tense == "present" and not past) or is_turn_ahead(scene, then)
        try:
            if turns and ahead:
                return scene.moment  # the next turn, not the last one
            if past and left is not None:
                return scene.ride.choice_of(left).sim_time
            return premise(scene.ride, subject(scene, then)).trace.sim_time
        except Unanswered:
            return scene.moment
    if then is not None:
        stop = happened(scene.ride, ("stop",), scene.span)
        if stop is not None:
            try:
                return scene.ride.choice_of(stop).sim_time
            except Unanswered:
                return stop.time
    if past:
        said = scene.past is not None and scene.past.said
        deed = manoeuvre(scene.ride, scene.span if said else None)
        if deed is not None and deed.action != "continue":
            try:
                return scene.ride.choice_of(deed).sim_time
            except Unanswered:
                return deed.time
    return scene.moment


def is_turn_ahead(scene: Asked, then: Event | None) -> bool:
    """Check whether "would you have turned?" is about a turn that the plan has yet to make.

    So it is where no turn was made lately, and none of that kind before.
    """
    said = scene.past is not None and scene.past.said
    if then is None or said or not set(names_of(then)) <= set(EXITS):
        return False
    made = [deed for deed in scene.ride.deeds if deed.action in EXITS]
    ended = [scene.now if deed.ended is None else deed.ended for deed in made]
    lately = any(time > scene.now - LATELY for time in ended)
    done = any(deed.action in names_of(then) for deed in made)
    turns = any(action in EXITS for action in planned(scene.ride.latest))
    return turns and not lately and not done


def _left_lane(scene: Asked) -> Deed | None:
    """Find the lane change that was made instead of keeping the lane."""
    made = [deed for deed in scene.ride.deeds if deed.action in CHANGES]
    return scene.pick(made, lambda deed: deed.span)


def open_until(scene: Asked, vehicle: int, event: Event, moment: float) -> float:
    """Find the last time [s] up to a moment when it was possible that a vehicle would do so.

    It is the moment itself if it was never possible, or if we decided otherwise while it was. Then
    that decision is planned again with the supposition, if the vehicle was still in view.
    """
    names, decided = conduct_names(event), scene.ride.at(moment)
    known = [trace for trace in known_to(scene.ride, vehicle, moment) if trace.sim_time <= moment]
    if decided is not None and prediction(decided, vehicle) is not None:
        chosen = planned(decided)[:1]
        known = [trace for trace in known if planned(trace)[:1] == chosen]
    chances = [(t.sim_time, probability(scene.ride, t, vehicle, names)) for t in known]
    open_ = [time for time, chance in chances if POSSIBLE < chance < 1.0 - POSSIBLE]
    return open_[-1] if open_ else moment


def is_over(
    scene: Asked,
    of: Proposition | None,
    question: Question | None,
    then: Event | None,
    vehicle: int,
) -> bool:
    """Check whether a supposition is about the past: "if he braked now" is not.

    "If he stopped" may be either: it is about now while it can still happen. With the question why,
    it is about the time of what that asks about.

    Args:
        scene: the act and its setting.
        of: what is supposed, without its negation.
        question: the question about the supposed world.
        then: the action of ours that it is about.
        vehicle: the vehicle of the supposition.
    """
    if isinstance(question, Why):
        asked = event_of(question.of)
        return asked is not None and asked.tense in ("past", "perfect")
    event = event_of(of)
    if event is not None and _is_now(event.time, scene):
        return False
    tense = event.tense if event is not None else getattr(of, "tense", "present")
    said = scene.past is not None and scene.past.said
    if tense in ("present", "future") and isinstance(of, Happens) and not said:
        return False
    if scene.past is not None or tense == "perfect" or (then is not None and then.tense == "past"):
        return True
    if _asks_now(question) or tense != "past":
        return False
    if event is None:
        return True
    look = scene.world.look(vehicle, scene.now)
    return look is None or not look.in_view or look.ahead < 0.0


def _asks_now(question: Question | None) -> bool:
    """Check whether a question about a supposed world is what we would do, not have done."""
    event = event_of(question.that) if isinstance(question, Whether) else None
    if event is not None:
        return event.tense != "past"
    return isinstance(question, Doing) and question.tense != "past"


def _is_now(time: Time, scene: Asked) -> bool:
    reached = isinstance(time, At) and time.at >= scene.now - ROUNDING
    return reached or isinstance(time, Now | Next)


def asks_when(then: Question | None) -> bool:
    """Check whether the question is when we arrive, and not whether that is later."""
    match then:
        case When(of=Happens(event=Event(action="arrive", actor=Ego()))):
            return True
        case HowMuch(of=Measured(attribute="time-to-go" | "arrival-time")):
            return True
    return False
