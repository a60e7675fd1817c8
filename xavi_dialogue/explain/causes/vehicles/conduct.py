"""Conduct: what a decision expects of another vehicle, matched with what a question names."""

from collections.abc import Sequence

from planner.record.trace import GoalPrediction, PlanTrace, TrajectoryPrediction
from xavi_dialogue.causal.model import Actions, CausalModel, Choice
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.facts import Belief, Expectation
from xavi_dialogue.domain.terms import Event, Lane, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.actions import EXITS, TURN_WORDS, names_of
from xavi_dialogue.explain.causes.vehicles.involved import expected_actions
from xavi_dialogue.explain.history.motion import branches_off, foretold, steps
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, Unanswered, prediction

#: By action that people name: the action that predicted ways can show.
FORESEEN: dict[ActionName, ActionName] = {
    "brake": "slow-down",
    "wait": "give-way",
    "stand": "stop",
    "let-go": "give-way",
    "go": "continue",
    "move": "continue",
    "keep-lane": "continue",
    "follow": "continue",
    "come": "continue",
}


def conduct_names(event: Event) -> tuple[ActionName, ...]:
    """List the names that predictions have for an event; any of them may be meant."""
    if event.action in TURN_WORDS and event.side is None:
        return EXITS[:2]
    if event.action == "leave" and not isinstance(event.object, Lane):
        return ("leave",)
    return tuple(FORESEEN.get(name, name) for name in names_of(event))


def matching(model: CausalModel, vehicle: int, names: Sequence[ActionName]) -> frozenset[Choice]:
    """Find the goals and ways of a vehicle that contain any of some actions."""
    known = prediction(model.trace, vehicle)
    if known is None:
        return frozenset()
    return frozenset(
        (g, t)
        for g, t in model.choices(vehicle)
        if any(_does(known.goals[g], known.goals[g].trajectories[t], name) for name in names)
    )


def _does(goal: GoalPrediction, way: TrajectoryPrediction, name: ActionName) -> bool:
    """Check whether a predicted way contains an action; for "leave", at the next exit."""
    if name != "leave" or branches_off(goal, way):
        return foretold(goal, way, name)
    first = next((action for action in way.actions if action != "continue"), None)
    return first in EXITS


def last_with(ride: Ride, vehicle: int, time: float) -> PlanTrace:
    """Find the last decision up to a time [s] that expects something of a vehicle.

    Raises:
        Unanswered: none does.
    """
    for trace in reversed(ride.traces):
        if trace.sim_time <= time + ROUNDING and prediction(trace, vehicle) is not None:
            return trace
    raise Unanswered(NotRecorded("out-of-view", thing=Vehicle(vehicle), since=time))


def likeliest(
    model: CausalModel, vehicle: int, goal: int, among: frozenset[Choice] | None = None
) -> tuple[Actions, float]:
    """Return what a vehicle most probably does under one goal, and how probable that is."""
    chances = model.choices(vehicle).items()
    ways = {c: p for c, p in chances if c[0] == goal and (among is None or c in among)}
    return expected_actions(model, vehicle, max(ways, key=lambda c: ways[c]))


def belief_of(ride: Ride, trace: PlanTrace, vehicle: int) -> Belief:
    """Return what a decision expects of a vehicle: actions with probabilities, likeliest first."""
    known = prediction(trace, vehicle)
    found: dict[tuple[ActionName, ...], tuple[float, str | None]] = {}
    if known is not None:
        for (g, t), chance in ride.model(trace).choices(vehicle).items():
            actions = steps(known.goals[g], known.goals[g].trajectories[t])
            before, edge = found.get(actions, (0.0, known.goals[g].edge))
            found[actions] = (before + chance, edge)
    ranked = sorted(found, key=lambda actions: -found[actions][0])
    expected = (Expectation(a, min(found[a][0], 1.0), found[a][1]) for a in ranked)
    return Belief(vehicle, trace.sim_time, tuple(expected))


def probability(ride: Ride, trace: PlanTrace, vehicle: int, names: Sequence[ActionName]) -> float:
    """Return the probability, for a decision, that a vehicle takes any of some actions."""
    model = ride.model(trace)
    if vehicle not in model.vehicles:
        return 0.0
    chances = model.choices(vehicle)
    return min(sum(chances[way] for way in matching(model, vehicle, names)), 1.0)
