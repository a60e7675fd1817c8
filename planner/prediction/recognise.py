"""Goal recognition by inverse planning: goals of other road users, with probabilities.

For every goal in view, the best ways there are planned. `planner.prediction.likelihood` computes
how well a goal explains the track.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from planner.manoeuvres.actions import Situation
from planner.motion.forward import DT
from planner.motion.obstacles import Motions, Obstacle, Traffic
from planner.motion.surroundings import Others, Surroundings
from planner.motion.tracks import Observed, coast, queued
from planner.prediction.beliefs import NEGLIGIBLE, Belief, Trajectory, likeliest
from planner.prediction.goals import PLACES, Goal, goals_in_view
from planner.prediction.indication import indicated
from planner.prediction.insisting import insists
from planner.prediction.likelihood import likelihoods
from planner.prediction.onward import Way, trajectories, ways_on, ways_to
from planner.prediction.people import past_of, recognise_people
from planner.prediction.relevance import gives_way
from planner.record.trace import ON_FOOT, EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Task
from planner.traffic_lights.signals import DARK, Outlook

__all__ = ["Belief", "Trajectory", "recognise"]


@dataclass(frozen=True, slots=True, eq=False)
class _Coasting:
    """The motion of one road user that others expect."""

    elapsed: int  # steps of its track
    now: Motions  # from now on
    past: Obstacle  # from the first sample of its track on


def recognise(
    roads: Roads,
    tracks: Sequence[Observed],
    settings: Settings,
    time: float,
    ego: int,
    outlook: Outlook = DARK,
    apart: Collection[int] = (),
    bound: EgoGoal | None = None,
) -> dict[int, tuple[Belief, ...]]:
    """Return the beliefs about all road users except for the ego.

    Each expects the others to coast. A vehicle that stands, or will be held at a light, would then
    stand forever, so the others expect its likeliest motion: a queue dissolves from its head.
    Vehicles that have to give way to the ego expect it to drive to the place that it is bound for.

    Args:
        roads: the road network.
        tracks: vehicles in view, the ego included, and people on foot; each ends now.
        settings: view radius [m], horizon [s], rationality [1/s].
        time: [s] now.
        ego: number of the ego.
        outlook: the lights.
        apart: vehicles without beliefs: they count only as obstacles to others.
        bound: the place that the ego is bound for; None if it is not known, and the ego coasts.
    """
    steps = round(settings.horizon / DT)
    surroundings = Surroundings(roads, outlook, steps)
    usual = surroundings.lights(outlook.usual)
    people = [track for track in tracks if track.kind in ON_FOOT]
    vehicles = [track for track in tracks if track.kind not in ON_FOOT]
    coasting = {
        track.vehicle: _Coasting(
            track.elapsed,
            surroundings.on(track.kind).coast(track),
            coast(surroundings.on(track.kind).roads, track, steps, past=True, lights=usual),
        )
        for track in vehicles
    }
    found: dict[int, tuple[Belief, ...]] = {}
    if people:
        going_on = [mine.now.usual for mine in coasting.values()]
        found = recognise_people(surroundings, people, vehicles, going_on, settings)
    for walker in people:
        now = likeliest(found[walker.vehicle])
        coasting[walker.vehicle] = _Coasting(walker.elapsed, now, past_of(walker, now.usual))
    held = {one for one, mine in coasting.items() if outlook.known and mine.now.usual.rests}
    us: tuple[_Coasting, _Coasting] | None = None  # the ego as it coasts, and as it would drive
    for observed in queued(vehicles, held, None if bound is None else ego):
        one, own = observed.vehicle, surroundings.on(observed.kind)
        waits = observed.standing or one in held
        if one == ego and bound is not None:
            driving = _bound_for(own, observed, coasting, settings, time, bound)
            us = coasting[ego], driving or coasting[ego]
        elif one != ego and one not in apart:
            found[one] = _beliefs(own, observed, coasting, settings, time, us)
            if waits:
                coasting[one] = replace(coasting[one], now=likeliest(found[one]))
    return {track.vehicle: found[track.vehicle] for track in tracks if track.vehicle in found}


def _frame(surroundings: Surroundings, observed: Observed, settings: Settings, time: float) -> Task:
    """Return the task of planning for a vehicle from now on, without a goal."""
    size, nowhere = (observed.length, observed.width), EgoGoal("", 0.0, None)
    steps, view, pace = surroundings.steps, settings.view_radius, observed.pace
    return Task(surroundings.roads, nowhere, size, time, steps, view, yielding=True, pace=pace)


def _bound_for(
    surroundings: Surroundings,
    observed: Observed,
    coasting: Mapping[int, _Coasting],
    settings: Settings,
    time: float,
    bound: EgoGoal,
) -> _Coasting | None:
    """Return the likeliest motion of a vehicle to the place that it is bound for."""
    others = [other.now for vehicle, other in coasting.items() if vehicle != observed.vehicle]
    starts = observed.situation(surroundings.roads, -1, time)
    goal, frame = Goal("continue", "", bound, 1.0), _frame(surroundings, observed, settings, time)
    found = ways_on(frame, starts, goal, observed, Others(surroundings, tuple(others)))
    return replace(coasting[observed.vehicle], now=found[0].motions) if found else None


def _beliefs(
    surroundings: Surroundings,
    observed: Observed,
    coasting: Mapping[int, _Coasting],
    settings: Settings,
    time: float,
    us: tuple[_Coasting, _Coasting] | None,
) -> tuple[Belief, ...]:
    roads = surroundings.roads
    others = [other for vehicle, other in coasting.items() if vehicle != observed.vehicle]
    starts = observed.situation(roads, -1, time)
    if not starts:
        return _unknown(surroundings, observed)
    goals = goals_in_view(roads, starts, settings.view_radius)
    frame = _frame(surroundings, observed, settings, time)
    now = Others(surroundings, tuple(other.now for other in others))
    onwards = ways_to(frame, starts, goals, observed, now)
    if us is not None:
        onwards = _regarding_us(frame, starts, goals, observed, onwards, now, others, us)
    left = [ways[0].cost - ways[0].waiting if ways else None for ways in onwards]
    likelihood = (
        likelihoods(frame, observed, goals, left, _before(surroundings, observed, others), settings)
        if settings.recognition
        else [0.0 if driving is None else 1.0 for driving in left]
    )
    shown = [1.0] * len(goals)
    if settings.recognition:
        shown = indicated(roads, observed, starts[0], goals, settings.view_radius)
        likelihood = [like * share for like, share in zip(likelihood, shown, strict=True)]
    weights = [goal.prior * like for goal, like in zip(goals, likelihood, strict=True)]
    if sum(weights) == 0.0:
        return _unknown(surroundings, observed)
    weights = [w if w >= NEGLIGIBLE * sum(weights) else 0.0 for w in weights]
    return tuple(
        Belief(goal, like, weight / sum(weights), trajectories(onward, settings, time), share)
        for goal, like, weight, onward, share in zip(
            goals, likelihood, weights, onwards, shown, strict=True
        )
        if weight > 0.0
    )


def _regarding_us(
    frame: Task,
    starts: tuple[Situation, ...],
    goals: Sequence[Goal],
    observed: Observed,
    onwards: Sequence[list[Way]],
    now: Others,
    others: Sequence[_Coasting],
    us: tuple[_Coasting, _Coasting],
) -> list[list[Way]]:
    """Return the ways on, where the vehicle has to give way to the ego, as the ego would drive.

    Who has set off across the ego's way regardless is expected to go on.

    Args:
        frame, starts, goals, observed: of the vehicle.
        onwards: its ways on to each goal if the ego coasts.
        now: the others, with the ego as it coasts.
        others: the same.
        us: the ego as it coasts, and as it would drive.
    """
    surroundings, network = now.surroundings, now.surroundings.roads.network
    links = us[0].now.usual.links | us[1].now.usual.links
    reckoned = tuple(us[1].now if other is us[0] else other.now for other in others)
    with_us = Others(surroundings, reckoned, now.pool)
    without_us = Others(
        surroundings, tuple(other.now for other in others if other is not us[0]), now.pool
    )
    found = []
    for goal, ways in zip(goals, onwards, strict=True):
        if ways and gives_way(network, ways[0].motions.usual.links, links):
            ways = ways_on(frame, starts, goal, observed, with_us) or ways
            if insists(network, starts, observed, ways[0].legs):
                ways = ways_on(frame, starts, goal, observed, without_us) or ways
        found.append(ways)
    return found


def _before(surroundings: Surroundings, observed: Observed, others: Sequence[_Coasting]) -> Traffic:
    """Return the motions of the others from the first sample of a track on."""
    return Traffic.shifted(
        [(other.past, observed.elapsed - other.elapsed) for other in others],
        surroundings.steps + observed.elapsed,
        surroundings.lights_before(observed.elapsed),
    )


def _unknown(surroundings: Surroundings, observed: Observed) -> tuple[Belief, ...]:
    """Return the belief about a vehicle for which no goal is possible: it coasts."""
    goal = Goal("continue", PLACES["continue"], None, 1.0)
    return (
        Belief(goal, 1.0, 1.0, (Trajectory(1.0, ("continue",), surroundings.coast(observed)),)),
    )
