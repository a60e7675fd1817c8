"""Own suppositions: what would have happened if we had acted otherwise."""

from dataclasses import replace
from typing import TypeGuard, cast

from msgspec import structs

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Contrast,
    DidNotHappen,
    Measures,
    MotionCause,
    SupposedOfUs,
    Verdict,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import (
    Compare,
    HowLong,
    HowMuch,
    HowSure,
    Question,
    When,
    Where,
    Whether,
    Which,
)
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import (
    At,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Lane,
    Measured,
    Now,
    Proposition,
    Quantity,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.reasons import choices, knowing
from xavi_dialogue.explain.answers.reasons.against import against
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.foils import Did
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.reading import (
    event_of,
    is_past,
    manner_of,
    vehicle_in,
)
from xavi_dialogue.explain.answers.suppositions import reacting
from xavi_dialogue.explain.answers.suppositions.hastening import as_it_was, hastened, past_red
from xavi_dialogue.explain.answers.suppositions.undone import (
    GOING,
    as_going_on,
    braking_of,
    is_halted,
    is_of_us,
    is_paced_turn,
    is_present,
    is_sooner,
    straight,
)
from xavi_dialogue.explain.causes.driving.blocking import blocking
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.contrast import alone, factual
from xavi_dialogue.explain.causes.plans.natural import DIRECTIONS, STAYING, natural
from xavi_dialogue.explain.causes.plans.premise import happened, manoeuvre
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, DRIVING, names_of
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.ride import planned

STANDING = 0.5  # [m/s]
FAST = 15.0  # [m/s] minimum speed at which staying means staying in the lane
ABOUT = 1.5  # maximum factor between a time and what the question says about it
PAST = frozenset[ActionName](("overtake", "pass", "avoid"))
SQUEEZING = frozenset[ActionName](("cut-in", "merge", "pull-out", "pass"))


def form_of(then: Question | None) -> Asking:
    """Return the question about a supposed world."""
    if reacting.asks(then) == "collide":
        return "crash"
    if _collision_in(then) is not None:
        return "chance"
    if is_sooner(then):
        return "quicker"
    match then:
        case Compare(by="safety", least=least):
            return "riskier" if least else "safer"
        case Whether(that=Is(state="dangerous" | "safe" as state, thing=Ego(), event=None)):
            return cast(Asking, state)
        case Compare(by="time" | "speed"):
            return "quicker"
        case Whether(
            that=Compares(
                left=Measured(attribute="distance", thing=Ego(), to=None), comparator="more"
            )
        ):
            return "quicker"  # "would we be further along?"
        case Whether(that=Compares(left=Measured(attribute="arrival-time"), comparator="less")):
            return "quicker"
        case Whether(that=Is(state="possible", event=None)):
            return "could"
        case Where(of=Ego()):
            return "arrival"
        case Whether(that=Happens(event=Event("arrive", Ego(), time=Now() | At()))):
            return "arrival"  # "would we be there by now?"
        case Whether(
            that=Happens(event=Event(actor=Ego(), action="go" | "enter" | "arrive", manner=()))
        ):
            return "could"
        case When(of=of) if is_of_us(of):
            return "arrival"  # "when would we have been through?"
        case HowLong(of=Event(actor=Ego())):
            return "arrival"
        case HowMuch(
            of=Measured(attribute="arrival-time" | "time-to-go" | "delay" | "time" | "duration")
        ):
            return "arrival"
    return "what-if"


def claimed_in(that: Proposition | None) -> float | None:
    """Return the length [s] of a delay according to the question; None if it does not say."""
    match that:
        case Compares(left=Measured(attribute="delay"), right=Quantity(value=value, unit="s")):
            return value
    return None


def claimed(found: Answer, that: Proposition | None) -> Answer:
    """Add to an answer what time the question says that something cost, or would gain."""
    said = claimed_in(that)
    match found:
        case SupposedOfUs() if said is not None:
            return structs.replace(found, claimed=said, form="quicker")
        case Measures(measures=(Measure(value=float(value)) as told,)) if (
            said is not None and value <= ABOUT * said
        ):
            spent = Compares(Measured("delay"), "same", Quantity(said, "s"))
            return Verdict(spent, said <= ABOUT * value, (told,))
    return found


def struck_in(then: Question | None) -> int | None:
    """Return the vehicle that a question about our collision names."""
    event = _collision_in(then)
    return None if event is None else vehicle_in(event.object) or vehicle_in(event.actor)


def _collision_in(then: Question | None) -> Event | None:
    """Read a question whether, how probably, or with whom a collision would happen."""
    match then:
        case Whether(that=of) | HowSure(of=of) | Which(such=of):
            event = event_of(of)
        case _:
            return None
    return event if event is not None and event.action in reacting.COLLIDING else None


def with_chance(found: Answer, vehicle: int | None, scene: Asked) -> Answer:
    """Add how probably we would have collided with the vehicle in the question.

    Raises:
        Unanswered: rollouts are needed.
    """
    of_risk = isinstance(found, SupposedOfUs) and found.form in ("crash", "chance")
    if vehicle is None or not isinstance(found, SupposedOfUs) or not of_risk:
        return found
    trace, foil = scene.ride.at(found.contrast.decided), found.contrast.foil
    if trace is None or not foil or found.done is not None:
        return found
    risk = chances(scene.ride.evidence(trace, foil)[1]).collision_with(vehicle)
    return structs.replace(found, struck=vehicle, struck_risk=risk)


def stays_ahead(event: Event | None) -> TypeGuard[Event]:
    """Check whether somebody is supposed to go on driving ahead of us."""
    return event is not None and event.action == "continue" and event.object == Ego()


def kept_ahead(event: Event, form: Asking) -> tuple[Proposition, bool]:
    """Return the supposition to test, and whether it is denied: later with it is sooner without."""
    if form == "arrival":
        return Exists(event.actor), True
    return Happens(structs.replace(event, object=None)), False


def of_us(
    event: Event, scene: Asked, form: Asking = "what-if", struck: int | None = None
) -> Answer:
    """Return the consequences of another action of ours.

    Raises:
        Unanswered: it cannot be done; or rollouts are needed.
    """
    past = is_past(scene, event) or event.modal == "would"
    asked, event = event, straight(_staying(event, scene), scene, form)
    if asked.action == "wait" and event.action == "keep-lane":
        scene = replace(scene, span=None)  # the end of a duration is not when it was chosen
    if event.action in SQUEEZING and scene.world.episodes(Ego(), ("give-way",)):
        return hastened(structs.replace(event, object=None), scene, form, struck)
    if event.action in reacting.COLLIDING:
        now = Window(scene.now, scene.now)
        return closeness(scene, vehicle_in(event.object), now, "hit", past=False)
    if event.action in GOING and (not _stopped(scene) or manner_of(event, "fast") is not None):
        return hastened(event, scene, form, struck)
    if is_paced_turn(event):
        return hastened(structs.replace(event, action="go", side=None), scene, form, struck)
    if event.action in GOING and event.side is None and event.object is None:
        return undone(structs.replace(event, action="stop", manner=()), scene, form, struck)
    if (drove := braking_of(event, scene)) is not None:
        raise Unanswered(DidNotHappen(event, (drove,)))
    try:
        tried = against(event, scene)
    except Did as did:
        if set(names_of(event)) & set(DIRECTIONS) and is_present(event, scene) and is_halted(scene):
            return hastened(Event("go", tense="present"), scene, form, struck)  # not waiting
        if form in ("crash", "dangerous"):
            return as_it_was(scene, form, struck, past=past)
        if form == "chance":
            collide = Event("collide", object=None if struck is None else Vehicle(struck))
            return knowing.how_sure(HowSure(Happens(collide)), scene)
        return _done(did, scene, form)
    compared = tried.contrast
    nearest = event.action if event.action in ("brake", "slow-down") else None
    return SupposedOfUs(
        compared,
        past=past or tried.earlier,
        asked=nearest,
        form=form,
        arrival=arrival(scene, compared),
        ahead=_standing_ahead(scene, compared),
        later=tried.later,
        open_at=tried.open_at,
    )


def _standing_ahead(scene: Asked, against: Contrast) -> MotionCause | None:
    """Return who stood in our lane, if the supposition is that we had stayed in it."""
    fact = against.fact[:1]
    if against.foil != STAYING or not fact or fact[0] not in CHANGES:
        return None
    found = blocking(scene.ride, scene.world, against.decided, fact[0])
    return found if found is not None and (found.speed or 0.0) < STANDING else None


def _staying(event: Event, scene: Asked) -> Event:
    """Read staying, or waiting behind somebody that we moved out for, as staying in our lane."""
    behind = event.where is not None and event.where.relation == "behind"
    lane = None if event.where is None else event.where.to
    if isinstance(lane, Lane) and lane.which == "own" and event.action in ("pass", "overtake"):
        return structs.replace(event, action="keep-lane", object=None, where=None)
    lets = event.action in ("let-go", "give-way", "wait") and vehicle_in(event.object) is not None
    stands = behind and event.action in ("stand", "wait", "stop")
    bides = event.action == "wait" and event.object is None and event.where is None
    if event.action != "follow" and not stands and not lets and not bides:
        return event
    deed = manoeuvre(scene.ride, None if bides else scene.span)
    if bides and (deed is None or deed.action not in CHANGES):
        driving = (speed_at(scene.ride, scene.moment) or 0.0) >= FAST  # where nobody waits
        return structs.replace(event, action="keep-lane") if driving else event
    if deed is None or deed.action not in CHANGES:
        return event if event.action != "follow" else structs.replace(event, action="slow-down")
    time = Unsaid() if bides else event.time
    return structs.replace(event, action="keep-lane", object=None, where=None, time=time)


def arrival(scene: Asked, against: Contrast) -> float | None:
    """Return when [s] we would be there under the foil."""
    due = scene.world.measure("arrival-time", Ego(), scene.now).value
    later = next((e.delta for e in against.effects if e.component == "time"), None)
    return None if due is None or later is None else due + later


def _stopped(scene: Asked) -> bool:
    """Check whether a stop was chosen, so that driving on was the alternative."""
    trace = scene.ride.at(scene.moment)
    return trace is not None and "stop" in planned(trace)[:1]


def _done(did: Did, scene: Asked, form: Asking) -> SupposedOfUs:
    """Return that it is exactly what we did, do or plan, with its natural alternative.

    Raises:
        Unanswered: there is too little evidence, or rollouts are needed.
    """
    ride, found = scene.ride, did.found
    if found is None:
        raise did
    compared = natural(ride, found.trace, found.node)
    foil, done = compared.foil[len(found.node) :], did.performed.action
    elsewhere = done == "keep-lane" and not set(foil[:1]) & set(CHANGES)
    if elsewhere or (foil == ("stop",) and done != "stop"):
        model = ride.model(found.trace)  # stopping is not a natural alternative
        compared = alone(ride, model, factual(model, found.trace))
    past = did.performed.when == "did"
    return SupposedOfUs(compared, done=did.performed, past=past, form=form)


def undone(event: Event, scene: Asked, form: Asking, struck: int | None) -> Answer:
    """Return what would have happened without what we did: the best alternative.

    Raises:
        Unanswered: it cannot be known; or rollouts are needed.
    """
    event = as_going_on(event, scene)
    names = names_of(event)
    if form == "what-if" and (red := past_red(event, scene)) is not None:
        return red
    present = is_present(event, scene)
    trace = scene.ride.at(scene.now if present else scene.moment)
    begun = happened(scene.ride, names, scene.span) is not None or not set(names) & DRIVING
    chosen = event.action == "stop" and trace is not None and "stop" in planned(trace)[:1]
    if chosen and trace is not None and (present or not begun):
        found = natural(scene.ride, trace, ())
        return SupposedOfUs(found, past=not present, form=form, arrival=arrival(scene, found))
    if not begun:
        return hastened(event, scene, form, struck)  # it was not a choice of its own
    try:
        reason = choices.why(event, scene)
    except Unanswered as unanswered:
        around = event.action in PAST and isinstance(unanswered.result, DidNotHappen)
        moved = [deed for deed in scene.ride.deeds if deed.action in CHANGES]
        if not around or not moved:
            raise
        reason = choices.why(Event(moved[-1].action), replace(scene, span=None))
    assert isinstance(reason, ChoiceReason)
    against = reason.contrast
    past = reason.past or event.tense == "perfect"
    due, ahead = arrival(scene, against), _standing_ahead(scene, against)
    return SupposedOfUs(against, past=past, form=form, arrival=due, ahead=ahead)
