"""Choices: why the ego did one thing and not another, and whether it had to."""

from collections.abc import Collection
from typing import Literal

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Contrast,
    MotionCause,
    NotApplicable,
    TooLittle,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Proposition
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons.against import against
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.foils import earlier_exit, foil_at, named_foil
from xavi_dialogue.explain.answers.reference.reading import check_able, event_of, is_past, subject
from xavi_dialogue.explain.causes.driving.blocking import blocking, in_lane_beside
from xavi_dialogue.explain.causes.plans.contrast import (
    SameAsPlan,
    alone,
    alternatives,
    compare,
    contrast,
    factual,
)
from xavi_dialogue.explain.causes.plans.natural import STAYING, natural, on_way, other_way
from xavi_dialogue.explain.causes.plans.options import free
from xavi_dialogue.explain.causes.plans.premise import (
    Premise,
    deeds_called,
    episode_of,
    led_to,
    premise,
)
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, DRIVING, TURNS, names_of
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import ROUNDING, planned

Form = Literal["why", "why-not", "necessary", "worth-it", "mistaken"]
LATELY = 12.0  # [s] after a change of lanes in which it still explains why we are in our lane
LEAST = 1.0  # [s] minimum duration of a change of lanes or a turn


def why(event: Event | None, scene: Asked, instead: Proposition | None = None) -> Answer:
    """Explain why we did or plan something, against the foil named, else the natural one.

    Raises:
        Unanswered: we did not; or the record lacks it; or rollouts are needed.
    """
    if event is not None:
        check_able(event)
    other = event_of(instead)
    exit_ = None if other is None else earlier_exit(other, scene)
    if exit_ is not None:
        found, foil = exit_
    else:
        found = free(scene.ride, premise(scene.ride, subject(scene, event)))
        foil = named_foil(scene, other, found) or ()
        found = led_to(scene.ride, found, foil) or found
    if not foil:
        return _reason(scene, event, found, natural(scene.ride, found.trace, found.node))
    try:
        compared = contrast(scene.ride, found.trace, foil, found.node)
        compared = on_way(found.trace, compared, found.node)
    except SameAsPlan:  # the question's contrast is no contrast
        compared = natural(scene.ride, found.trace, found.node)
    return _reason(scene, event, found, compared)


def _reason(scene: Asked, event: Event | None, found: Premise, against: Contrast) -> ChoiceReason:
    """Return the reason for what was chosen, with the vehicle for which a lane was left.

    Going straight on is not what was chosen if the plan begins with something else.
    """
    chosen = against.fact[len(found.node) : len(found.node) + 1]
    if found.deed is not None and found.deed.action == "continue" and chosen not in ((), STAYING):
        found = Premise(found.trace, None, found.node)
    past = _over(scene, event, found)
    ahead = _left_for(scene, found, against)
    return ChoiceReason("why", deed_of(scene, found), against, past=past, ahead=ahead)


def _left_for(scene: Asked, found: Premise, against: Contrast) -> MotionCause | None:
    """Return the slow vehicle in the lane that was left, if one was left."""
    first = against.fact[:1]
    if found.node or not first or first[0] not in CHANGES:
        return None
    ahead = blocking(scene.ride, scene.world, against.decided, first[0])
    refuted = ahead is not None and ahead.vehicle in against.cleared
    return None if refuted else ahead


def _beside(scene: Asked, found: Premise, against: Contrast) -> MotionCause | None:
    """Return the vehicle in the lane we did not change to: beside us, or slower than we drive."""
    if found.node or against.foil[0] not in CHANGES or against.route is not None:
        return None
    there = in_lane_beside(scene.ride, scene.world, against.decided, against.foil[0])
    return None if there is not None and there.vehicle in against.cleared else there


def why_not(event: Event, scene: Asked, deed: Event | None = None) -> Answer:
    """Explain why we did not do something.

    Args:
        event: what was not done.
        scene: the setting.
        deed: what was done instead, if the question says so.

    Raises:
        Unanswered: we did; or it was not possible; or the record lacks it; or rollouts are needed.
    """
    later = open_at = None
    try:
        tried = against(event, scene, deed, before=is_past(scene, event))
        found, compared, later = tried.found, tried.contrast, tried.later
        open_at = tried.open_at
    except Unanswered as unanswered:
        thin = unanswered.result
        if not isinstance(thin, TooLittle) or thin.reason != "too-little-evidence":
            raise
        found, foil = foil_at(event, scene, deed)
        model = scene.ride.model(found.trace)
        compared = replace(alone(scene.ride, model, factual(model, found.trace)), foil=foil)
        if found.node or _beside(scene, found, compared) is None:  # who is there is enough
            raise
    stays = compared.foil == STAYING
    past = _over(scene, event, found) or is_past(scene, event)
    ahead = _left_for(scene, found, compared) if stays else _beside(scene, found, compared)
    done = deed_of(scene, found)
    return ChoiceReason(
        "why-not", done, compared, past=past, ahead=ahead, later=later, open_at=open_at
    )


def straight(scene: Asked) -> Answer:
    """Explain why we go straight on: by the way, if we could turn next; else by the lane.

    Raises:
        Unanswered: there is no other lane; or rollouts are needed.
    """
    trace = scene.ride.at(scene.moment)
    if trace is None or trace.under_way is not None or planned(trace)[:1] != ("continue",):
        return in_lane(scene)
    against = other_way(scene.ride, trace)
    if against is None:
        return in_lane(scene)
    going = Episode(Ego(), "continue", trace.sim_time)
    return ChoiceReason("why", going, against, past=scene.past is not None)


def in_lane(scene: Asked) -> Answer:
    """Explain why we are in our lane: why we moved there, or what speaks against another.

    Raises:
        Unanswered: there is no other lane; or rollouts are needed.
    """
    ride = scene.ride
    moves = [d for d in deeds_called(ride, (*CHANGES, *TURNS)) if _lasted(d)]
    before = [d for d in moves if d.time <= scene.moment + ROUNDING]
    last = before[-1] if before else None
    if last is not None and last.action in CHANGES and scene.moment - last.time <= LATELY:
        return ChoiceReason("why", episode_of(last), natural(ride, ride.choice_of(last)))
    unfrozen = [t for t in ride.traces if t.under_way is None and t.sim_time <= scene.moment]
    trace = unfrozen[-1] if unfrozen else ride.latest
    model = ride.model(trace)
    known = {a: model.intervene((a,)) for a in CHANGES if a in model.options()}
    sides = sorted(known, key=lambda a: -(i.value if (i := known[a]) is not None else 0.0))
    stay = Episode(Ego(), "keep-lane", trace.sim_time)
    if sides and planned(trace)[:1] != (sides[0],):
        found = contrast(ride, trace, (sides[0],))
        return ChoiceReason("why-not", stay, found, past=scene.past is not None)
    refused = [n for n in trace.not_applicable if not n.node and n.action in CHANGES]
    if refused:
        asked = tuple(n.action for n in refused)
        raise Unanswered(NotApplicable(asked, refused[0].reason, trace.sim_time))
    return why(None, scene)


def needed(event: Event | None, scene: Asked, form: Form = "necessary") -> Answer:
    """Return whether we had to do what we did: what the best alternative would have cost.

    Raises:
        Unanswered: we did not do it; or the record lacks it; or rollouts are needed.
    """
    found = free(scene.ride, premise(scene.ride, subject(scene, event)))
    ride, trace, node = scene.ride, found.trace, found.node
    model, plan = ride.model(trace), planned(trace)
    try:
        here = factual(model, trace)
    except Unanswered:
        model, here = ride.evidence(trace, plan[: len(node) + 1])
    others = alternatives(model, plan[len(node)], node) if len(plan) > len(node) else []
    past = _over(scene, event, found)
    if not others:
        return ChoiceReason(form, deed_of(scene, found), alone(ride, model, here), past=past)
    foil, there = others[0]
    against = compare(ride, model, here, there, foil)
    return ChoiceReason(form, deed_of(scene, found), against, past=past)


def is_choice(event: Event) -> bool:
    """Check whether an event of ours is one that the planner chooses, not a way of driving."""
    return not set(names_of(event)) & DRIVING


def is_kept_from(other: Event, event: Event, keeping: Collection[ActionName]) -> bool:
    """Check whether what was done is only going on, so that the question is why not the other.

    Args:
        other: what was not done.
        event: what was done.
        keeping: actions that only keep on with what went before.
    """
    plain = event.object is None and event.side is None and event.where is None
    going_on = event.action in keeping or (plain and event.action in ("go", "continue"))
    return going_on and (is_choice(other) or other.action == "stop")


def deed_of(scene: Asked, found: Premise) -> Episode | None:
    """Return what was done, with the place, as far as the road is recorded."""
    if found.deed is None:
        return None
    deed = episode_of(found.deed)
    end = scene.now if deed.end is None else deed.end
    seen = scene.world.episodes(Ego(), deed.action, deed.begin, end)
    same = next((e for e in seen if e.action == deed.action and e.place is not None), None)
    return deed if same is None else replace(deed, place=same.place, exit=same.exit)


def _over(scene: Asked, event: Event | None, found: Premise) -> bool:
    """Check whether the answer is in the past tense: the question is, or the action has ended."""
    if found.deed is None:
        return is_past(scene, event) and found.trace is not scene.ride.latest
    if found.deed.ended is None and (event is None or event.tense != "future"):
        return False
    return is_past(scene, event) or found.deed.ended is not None


def _lasted(deed: Deed) -> bool:
    """Check whether an action was not given up at once."""
    return deed.ended is None or deed.ended - deed.started >= LEAST
