"""Turning: predicted ways named by the turns and exits that they lead through."""

from msgspec.structs import replace

from planner.record.trace import Action, GoalPrediction, VehiclePrediction

ALONG: tuple[Action, ...] = ("continue",)
NEXT: Action = "continue-next-exit"


def by_turns(known: VehiclePrediction) -> VehiclePrediction:
    """Name the ways of a vehicle within its turn by that turn, or by the exit that they pass.

    Where the lane leads nowhere else, the recorded action is to continue along it. Where it may be
    leaving a roundabout, the recorded exits are counted from the one after.
    """
    leaving = any(_turns(g) and not _in_ring(g) for g in known.goals)
    passing = leaving and any(_in_ring(g) for g in known.goals)
    within = any(_turns(g) and _along(g) for g in known.goals)
    if not passing and not within:
        return known
    return replace(known, goals=tuple(_by_turn(g, passing=passing) for g in known.goals))


def _turns(goal: GoalPrediction) -> bool:
    return goal.kind.startswith("exit-")


def _in_ring(goal: GoalPrediction) -> bool:
    return goal.place.endswith("exit of the roundabout")


def _along(goal: GoalPrediction) -> bool:
    return any(way.actions == ALONG for way in goal.trajectories)


def _by_turn(goal: GoalPrediction, *, passing: bool) -> GoalPrediction:
    if not _turns(goal):
        return goal
    return replace(
        goal,
        trajectories=tuple(
            replace(way, actions=_named(goal, way.actions, passing=passing))
            for way in goal.trajectories
        ),
    )


def _named(
    goal: GoalPrediction, actions: tuple[Action, ...], *, passing: bool
) -> tuple[Action, ...]:
    if passing and _in_ring(goal):
        return (NEXT, *actions)
    return (goal.kind,) if actions == ALONG else actions
