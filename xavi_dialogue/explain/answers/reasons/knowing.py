"""Knowing: the evidence for what is believed, how sure the car is, and how it decides."""

from itertools import pairwise

from msgspec.structs import replace

from planner.record.trace import PlanTrace
from xavi_dialogue.domain.answers import (
    Answer,
    Beliefs,
    Certainty,
    NeedRollout,
    NotRecorded,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Belief, Episode
from xavi_dialogue.domain.meaning import HowDecide, HowKnow, HowSure
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Happens,
    Now,
    Proposition,
    Related,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.events.beliefs import denied, ruled, since_when
from xavi_dialogue.explain.answers.expectations.foreseen import (
    besides,
    chance,
    collision_chance,
    considers,
    is_behind,
    stops_for_another,
    unconsidered,
)
from xavi_dialogue.explain.answers.measuring.closeness import assured, was_assured
from xavi_dialogue.explain.answers.measuring.nearing import BEFORE_US, POSSIBLE, comes_before
from xavi_dialogue.explain.answers.reasons import choices, others
from xavi_dialogue.explain.answers.reasons.motions import motion
from xavi_dialogue.explain.answers.reference import foils
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.reading import (
    check_seen,
    event_of,
    foil_subject,
    is_own,
    is_past,
    subject,
    unwrapped,
    vehicle_in,
)
from xavi_dialogue.explain.answers.ride.crossings import entries
from xavi_dialogue.explain.answers.ride.priority import priority_at
from xavi_dialogue.explain.answers.suppositions.listing import how_decide
from xavi_dialogue.explain.causes.plans import certainty, options
from xavi_dialogue.explain.causes.plans.premise import Premise, about_foil, premise
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, EXITS, HALTS, YIELDS, to_macros
from xavi_dialogue.explain.causes.vehicles.conduct import (
    belief_of,
    conduct_names,
    probability,
)
from xavi_dialogue.explain.causes.vehicles.grounds import grounds
from xavi_dialogue.explain.history.ride import planned, prediction

COLLIDING = frozenset[ActionName](("collide", "nearly-collide"))
SPEEDS = frozenset[ActionName](("brake", "slow-down", "speed-up"))
FORESEEN = 12.0  # [s] after a prediction in which what came is what was predicted
LATELY = 20.0  # [s] after our last crossing in which expectations of others are about it
BEFORE = 0.2  # [s] before an event, when it was still to come
MOVED = 0.05  # minimum change of the probability of a belief that has moved


def how_know(question: HowKnow, scene: Asked) -> Answer:
    """Return the evidence for something that was believed or decided.

    For another vehicle, it is how the belief grew. For an action of ours, it is how we came to
    expect what the vehicle that caused it would do, else how we decided.

    Raises:
        Unanswered: nothing was believed of the vehicle; or the record lacks it.
    """
    of, _ = unwrapped(question.of)
    if isinstance(of, Believed) and isinstance(of.time, At):
        crash = event_of(of.content)
        if crash is not None and crash.action in COLLIDING:
            return was_assured(scene, vehicle_in(crash.object), of.time.at)
    event = event_of(of)
    vehicle = _whom(scene, of, event)
    yields = event is not None and event.action in YIELDS | {"wait"}
    if vehicle is not None and event is not None and yields:
        return since_when(scene, event)
    if event is not None and event.action in COLLIDING and not is_past(scene, event):
        return assured(scene, vehicle or vehicle_in(event.object))
    if event is not None and vehicle is not None and event.action in BEFORE_US:
        told = comes_before(scene, event)
        open_ = told is not None and (told.probability is None or told.probability >= POSSIBLE)
        if told is not None and open_:
            return told.answer or told.verdict(Happens(event))
        return assured(scene, vehicle)
    if vehicle is not None:
        names = () if event is None else conduct_names(event)
        held = event is None or event.modal == "would" or not isinstance(event.time, Now)
        return grounds(scene.ride, vehicle, names, scene.moment, held=held)
    rule = None if event is None else _owed(event, scene)
    if rule is not None:
        return rule
    held_up = None if event is None else _because_of(event, scene)
    if held_up is not None:
        return grounds(scene.ride, held_up, (), scene.moment)
    return how_decide(HowDecide(of), scene)


def how_sure(question: HowSure, scene: Asked) -> Answer:
    """Return how probable something is for the car, or how sure it was of what it did.

    Raises:
        Unanswered: the record lacks it.
    """
    of, negated = unwrapped(question.of)
    if isinstance(of, Related) and of.relation == "has-priority-over":
        rule = ruled(scene, of)
        if rule is not None:
            return rule
    event = event_of(of)
    vehicle = _whom(scene, of, event)
    if vehicle is not None and event is not None and _stays(event, vehicle, scene):
        return others.why(Event("stand", Vehicle(vehicle), tense="present"), scene, negated=False)
    if vehicle is not None:
        of_it = event is not None and event.action != "do"
        asked_of = None if event is None else replace(event, actor=Vehicle(vehicle))
        found = beliefs(scene, vehicle, event if of_it else None)
        at = scene.moment if found.time is None else found.time
        left_out = None if asked_of is None else unconsidered(scene, asked_of, at)
        if left_out is not None:
            return left_out
        return replace(denied(found) if negated else found, changed=question.changed)
    if event is not None and event.action in ("collide", "nearly-collide"):
        struck = vehicle_in(event.object)
        share = collision_chance(scene, scene.moment, struck)
        if struck is not None:
            event = replace(event, actor=Vehicle(struck), object=Ego())
        if scene.past is not None:
            event = replace(event, time=At(scene.moment), tense="past")
        return Verdict(Happens(event), None, probability=share, either=True)
    return certain(scene, event, negated=negated)


def _stays(event: Event, vehicle: int, scene: Asked) -> bool:
    """Check whether a question is if a vehicle that stands stays; its reason answers that."""
    here = event.action in HALTS and event.modal != "would" and not is_past(scene, event)
    return here and scene.ride.motion(vehicle).trend == "standing"


def certain(scene: Asked, event: Event | None, *, negated: bool) -> Certainty:
    """Return how surely an action was better than its alternative, or the plan goes well.

    Raises:
        Unanswered: the action did not happen, or the record lacks it.
    """
    ride = scene.ride
    if event is None and scene.past is None:
        chosen = certainty.of_choice(ride, options.in_force(ride, scene.moment))
        return chosen or certainty.of_plan(ride, Premise(ride.latest, None))
    if event is not None and (negated or event.modal == "would"):  # what was not done
        about = foil_subject(scene, event)
        names = foils.settled(scene, event)[:1]
        found = about_foil(ride, about, names)
        foil = to_macros(ride.model(found.trace), names, found.node)
        return certainty.of_choice(ride, found, foil) or certainty.of_plan(ride, found)
    if event is not None and not choices.is_choice(event):
        found = Premise(_trace_at(scene), None)
        stops = planned(found.trace)[:1] == ("stop",)
        if event.action in SPEEDS and not stops:  # no option of its own: it follows from the plan
            return certainty.of_plan(ride, found)
    else:
        found = _as_now(scene, event, premise(ride, subject(scene, event)))
    return certainty.of_choice(ride, found) or certainty.of_plan(ride, found)


def _as_now(scene: Asked, event: Event | None, found: Premise) -> Premise:
    """Take the last decision, if it chose again what goes on and is asked about as present."""
    deed, last = found.deed, scene.ride.latest
    if deed is None or deed.ended is not None or event is None or event.tense == "past":
        return found
    again = last.under_way is None and planned(last)[:1] == (deed.action,)
    return Premise(last, deed) if again else found


def _in_order(rows: tuple[Belief, ...]) -> tuple[Belief, ...]:
    return tuple(sorted(rows, key=lambda belief: belief.time))


def _held(scene: Asked, vehicle: int, event: Event, trace: PlanTrace) -> float:
    """Return the probability of conduct at a decision, as for the question whether it comes."""
    found = chance(scene, replace(event, actor=Vehicle(vehicle)), trace.sim_time)
    if found is not None:
        return found
    return probability(scene.ride, trace, vehicle, conduct_names(event))


def beliefs(scene: Asked, vehicle: int, event: Event | None) -> Beliefs:
    """Return what was believed of a vehicle, how the belief moved, and what the vehicle then did.

    Raises:
        Unanswered: no decision expects anything of the vehicle.
    """
    ride, at = scene.ride, scene.moment
    known = [t for t in ride.traces if prediction(t, vehicle) is not None]
    if not known:
        raise Unanswered(NotRecorded("out-of-view", thing=Vehicle(vehicle), since=at))
    untold = event is None or stops_for_another(event)
    event = None if event is None or untold else replace(event, actor=Vehicle(vehicle))
    if event is not None and (event.modal == "would" or isinstance(event.object, Vehicle)):
        met = [t for t in known if (p := prediction(t, vehicle)) and considers(p, event)]
        known = met or known
    names = () if event is None else conduct_names(event)
    done = () if event is None else _done(scene, event)
    if event is not None and (event.modal == "would" or (done and is_behind(scene, event, at))):
        entered = [t for t in entries(scene) if max(known[0].sim_time, at - LATELY) <= t <= at]
        at = min(at, done[-1].begin - BEFORE) if done else entered[-1] if entered else at
    trace = next((t for t in reversed(known) if t.sim_time <= at), known[0])
    rows = [belief_of(ride, t, vehicle) for t in known]
    current = belief_of(ride, trace, vehicle)
    chances = [0.0 if event is None else _held(scene, vehicle, event, t) for t in known]
    moved = _moved(rows, chances, asked=bool(names))
    told = _turning(rows, chances, asked=bool(names))
    return Beliefs(
        vehicle=vehicle,
        of=event,
        history=moved if current in moved else _in_order((*moved, current)),
        probability=None if event is None else _held(scene, vehicle, event, trace),
        time=trace.sim_time,
        why=None if told is None else _meanwhile(scene, vehicle, told),
        turning=told,
        came=done[-1] if done else _went(scene, vehicle, trace.sim_time, names),
        besides=() if event is None else besides(current, event),
    )


def _done(scene: Asked, event: Event) -> tuple[Episode, ...]:
    """Return the episodes of an event; without another vehicle, else those with any object."""
    found = scene.world.holds(event, 0.0, scene.now)
    if isinstance(event.object, Vehicle):
        return found
    return found or scene.world.holds(replace(event, object=None), 0.0, scene.now)


def _trace_at(scene: Asked) -> PlanTrace:
    return scene.ride.at(scene.moment) or scene.ride.latest


def _whom(scene: Asked, of: Proposition | None, event: Event | None) -> int | None:
    """Return the other vehicle that a proposition is about."""
    if event is not None:
        return check_seen(scene, event.actor)
    thing = getattr(of, "thing", None)
    found = check_seen(scene, thing)
    return found if found is not None else vehicle_in(getattr(of, "to", None))


def _owed(event: Event, scene: Asked) -> Priority | None:
    """Return the right of way for which we gave way or waited; None: that was not the reason."""
    whom = vehicle_in(event.object)
    if event.action not in YIELDS | {"wait"} or not is_own(event.actor):
        return None
    about = scene.past or Span(scene.now, scene.now)
    try:
        found = priority_at(scene, whom, Window(about.begin, about.end))
    except Unanswered:
        return None
    return found if found.rule == "give-way" else None


def _because_of(event: Event, scene: Asked) -> int | None:
    """Return the vehicle because of which we chose to do so, or drove so.

    Raises:
        Unanswered: rollouts are needed.
    """
    whom = vehicle_in(event.object)
    if whom is not None and event.action in HALTS | YIELDS:
        return whom
    try:
        choice = choices.is_choice(event)
        found = choices.why(event, scene) if choice else motion(event, scene)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    against = getattr(found, "contrast", None)
    causes = getattr(found, "causes", ()) if against is None else against.causes
    return next((cause.vehicle for cause in causes if cause.vehicle), None)


def _moved(rows: list[Belief], chances: list[float], *, asked: bool) -> tuple[Belief, ...]:
    """Return the beliefs that moved, with the first and the last."""
    kept: list[int] = []
    for k, row in enumerate(rows):
        if kept and k < len(rows) - 1:
            before = rows[kept[-1]]
            same = abs(chances[k] - chances[kept[-1]]) < MOVED if asked else _alike(before, row)
            if same:
                continue
        kept.append(k)
    return tuple(rows[k] for k in kept)


def _alike(one: Belief, other: Belief) -> bool:
    if not one.expectations or not other.expectations:
        return one.expectations == other.expectations
    first, second = one.expectations[0], other.expectations[0]
    return first.actions == second.actions and abs(first.probability - second.probability) < MOVED


def _turning(
    rows: list[Belief], chances: list[float], *, asked: bool
) -> tuple[float, float] | None:
    """Return the times [s] of the decisions between which the belief moved most."""
    values = chances if asked else [r.expectations[0].probability for r in rows if r.expectations]
    steps = [abs(b - a) for a, b in pairwise(values)]
    best = max(range(len(steps)), key=lambda k: steps[k], default=None)
    if best is None or steps[best] < MOVED or len(values) != len(rows):
        return None
    return rows[best].time, rows[best + 1].time


def _meanwhile(scene: Asked, vehicle: int, told: tuple[float, float]) -> Episode | None:
    """Return what a vehicle did while the belief moved."""
    seen = scene.world.episodes(Vehicle(vehicle), begin=told[0], end=told[1])
    real = [e for e in seen if e.action not in ("appear", "disappear", "follow", "move")]
    return real[-1] if real else None


def _went(
    scene: Asked, vehicle: int, since: float, names: tuple[ActionName, ...]
) -> Episode | None:
    """Return where a vehicle went after a time [s], or to which lane if that was asked about."""
    kinds = CHANGES if set(names) & set(CHANGES) else EXITS
    found = scene.world.episodes(Vehicle(vehicle), tuple(kinds), begin=since)
    return next((one for one in found if since <= one.begin <= since + FORESEEN), None)
