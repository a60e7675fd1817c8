"""Expectation: what a decision expects of another vehicle, and where it is seen last."""

from planner.trace import Action, PlanTrace
from xavi_dialogue.causal.model import CausalModel, Choice
from xavi_dialogue.explain.causes import expected_actions
from xavi_dialogue.explain.explanation import Activity, Destination, Evidence, Explanation
from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.explain.ride import Ride, decline, prediction

NEARLY = 0.7  # of the likeliest goal's probability, from which another must be told as well
TOLD = 2  # things that may be done that are told apart; of more, it cannot be told which


def last_seen(ride: Ride, vehicle: int) -> float | None:
    """When [s] a vehicle that is out of view was seen last; None where it is in view."""
    if vehicle in ride.latest.scene:
        return ride.latest.unseen.get(vehicle)
    last = next((t for t in reversed(ride.traces) if vehicle in t.scene), None)
    return None if last is None else last.unseen.get(vehicle, last.sim_time)


def expectation(
    ride: Ride,
    trace: PlanTrace,
    vehicle: int,
    asked: tuple[QueryAction, ...],
    moment: float | None = None,
    among: frozenset[Choice] | None = None,
) -> Explanation:
    """What a decision expects of a vehicle: its likeliest actions, and the likeliest goal.

    Where that is only asked of some of its ways, the likeliest among those. Neither, where more
    than `TOLD` different things are about as likely and it is not asked about any of them.

    Raises:
        Unanswered: the record lacks its goals, or its motion up to then.
    """
    known = prediction(trace, vehicle)
    assert known is not None
    open_ = range(len(known.goals)) if among is None else sorted({goal for goal, _ in among})
    ranked = sorted(open_, key=lambda g: -known.goals[g].probability)
    motion = ride.motion(vehicle).until(trace.sim_time)
    if not ranked or not motion.speed:
        raise decline("trace-gap", vehicle=vehicle, time=trace.sim_time)
    model = ride.model(trace)
    aim = known.goals[ranked[0]]
    actions, probability = likeliest(model, vehicle, ranked[0], among)
    near = [g for g in ranked if known.goals[g].probability >= NEARLY * aim.probability]
    ways = [likeliest(model, vehicle, g, among)[0] for g in near]
    rival: tuple[QueryAction, ...] = ways[1] if len(ways) > 1 else ()
    going: Destination | None = Destination(vehicle, aim.edge, aim.kind, aim.place, aim.probability)
    expected: float | None = probability
    if among is None and not asked and len(set(ways)) > TOLD:
        actions, expected, rival, going = (), None, (), None
    return Explanation(
        factual=tuple(a for a in actions if a in asked),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=recorded(trace),
        activity=Activity(vehicle, actions, expected, motion.speed[-1], motion.trend),
        sim_time=trace.sim_time,
        destination=going,
        moment=moment,
        rival=rival if rival != actions else (),
        seen=last_seen(ride, vehicle) if moment is None else None,
    )


def likeliest(
    model: CausalModel, vehicle: int, goal: int, among: frozenset[Choice] | None = None
) -> tuple[tuple[Action, ...], float]:
    """What a vehicle most probably does under one goal, and how probable that is."""
    chances = model.choices(vehicle).items()
    ways = {c: p for c, p in chances if c[0] == goal and (among is None or c in among)}
    return expected_actions(model, vehicle, max(ways, key=lambda c: ways[c]))


def recorded(trace: PlanTrace) -> Evidence:
    """The evidence of what rests on the record and its predictions alone."""
    return Evidence("tree", 0, 0, (trace.trace_id,))
