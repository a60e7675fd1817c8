"""Listing: the options of a decision, how they were compared, and how close they were."""

from collections.abc import Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Course, Method, Options, PeakMoment, Weighing
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.meaning import HowDecide, Listing, Peak
from xavi_dialogue.domain.terms import At, Event, Feature
from xavi_dialogue.explain.answers.expectations.foreseen import collision_chance
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reasons.against import against
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import window
from xavi_dialogue.explain.answers.reference.reading import (
    event_of,
    is_own,
    is_past,
    subject,
    unwrapped,
)
from xavi_dialogue.explain.answers.ride.onward import way_chosen
from xavi_dialogue.explain.causes.plans import margins, options
from xavi_dialogue.explain.causes.plans.premise import Premise, Subject, premise
from xavi_dialogue.explain.causes.vehicles.actions import names_of
from xavi_dialogue.explain.history.ride import Unanswered


def listed(question: Listing, scene: Asked) -> Options:
    """List what could have been done, best first; or what was closest to what was done.

    Raises:
        Unanswered: the record lacks it, or has too little evidence.
    """
    ride, said = scene.ride, scene.past
    moment = None
    if said is not None and said.said and said.begin == said.end:
        moment = ride.at(said.begin)
    if question.event is not None:
        found = options.with_choice(ride, _premise_of(question.event, scene))
    elif moment is None and (now := _under_way(scene)) is not None:
        found = options.with_choice(ride, now)
    elif moment is None:  # the time of the action discussed before, if no time is named
        found = options.with_choice(ride, premise(ride, Subject(None, (), False, scene.span)))
    else:
        found = options.with_choice(ride, Premise(moment, None))
    if question.of == "rivals":
        return _told(scene, found, *options.with_rival(ride, found))
    return _told(scene, found, options.weighed(ride, found))


def _under_way(scene: Asked) -> Premise | None:
    """Return the latest decision if it is about a manoeuvre that goes on, and no time is named."""
    span, ride = scene.span, scene.ride
    whole = span is None or (not span.said and span.begin <= scene.world.begin)
    going = [deed for deed in ride.begun if deed.ended is None and deed.action != "continue"]
    return Premise(ride.latest, going[-1]) if whole and going else None


def _premise_of(event: Event, scene: Asked) -> Premise:
    """Find the decision for a deed, or else that which plans it.

    Raises:
        Unanswered: we neither did it nor plan it.
    """
    try:
        return premise(scene.ride, subject(scene, event))
    except Unanswered:
        return premise(scene.ride, subject(scene, replace(event, tense="future")))


def margin(scene: Asked, events: Sequence[Event]) -> Options | None:
    """Return by how much one of two options was chosen before the other; None if it never was.

    Raises:
        Unanswered: there is too little evidence of what was chosen.
    """
    said = scene.past is not None and scene.past.said
    until = scene.past.end if said and scene.past is not None else scene.now
    until = min((e.time.at for e in events if isinstance(e.time, At)), default=until)
    one, other = names_of(events[0]), names_of(events[-1])
    decided = options.chosen_over(scene.ride, one, other, until)
    if decided is None:
        return None
    found, foil = decided
    return replace(_told(scene, found, *options.with_rival(scene.ride, found, foil)), named=True)


def closest_choice(question: Peak, scene: Asked) -> Options | PeakMoment:
    """Return the decision with the least margin [s] between what it chose and the next best.

    It is a moment without a time if no decision weighed several options.
    """
    about = window(scene, question.time)
    begin, end = (about.begin, about.end) if about.said else (scene.world.begin, scene.now)
    inside = (trace for trace in scene.ride.traces if begin <= trace.sim_time <= end)
    known = ((trace, margins.margin(trace)) for trace in inside)
    apart = [(trace, *by) for trace, by in known if by is not None]
    for trace, other, _ in sorted(apart, key=lambda one: (abs(one[2]), one[0].sim_time)):
        found = Premise(trace, None)
        try:
            rows, verdict = options.with_rival(scene.ride, found, (other,))
        except Unanswered:
            continue
        if verdict != "alone":
            return replace(_told(scene, found, rows, verdict), closest=True)
    return PeakMoment(question.of)


def how_decide(question: HowDecide, scene: Asked) -> Method | Course:
    """Return what was compared at a decision, and on how many situations that rests.

    Of our way: where it leads; it is always chosen by the same rule.

    Raises:
        Unanswered: what the question names did not happen; or there is too little evidence.
    """
    of, negated = unwrapped(question.of)
    event = event_of(of)
    ride = scene.ride
    own = event if event is not None and is_own(event.actor) else None
    if own is not None and own.object == Feature("way"):
        return way_chosen(scene)
    if own is not None and negated:
        found = against(own, scene, before=is_past(scene, own)).found
    elif own is None or not choices.is_choice(own):
        found = options.in_force(ride, scene.moment)
    else:
        found = options.open_at(ride, premise(ride, subject(scene, own)))
    count = len(found.trace.predictions)
    rows, rests_on = options.weighed(ride, found), options.situations(found)
    tried = len(ride.model(found.trace).options(found.node))
    risk_now = None
    if scene.past is None and found.trace is not ride.at(scene.now):
        risk_now = collision_chance(scene, scene.now)
    return Method(found.trace.sim_time, rows, rests_on, count, tried, risk_now)


def _told(
    scene: Asked,
    found: Premise,
    rows: tuple[OptionValue, ...],
    rival: Weighing | None = None,
) -> Options:
    decided = found.trace.sim_time
    earlier = decided < scene.ride.latest.sim_time
    return Options(rows, decided, options.situations(found), earlier=earlier, rival=rival)
