"""What speeds of another a decision expected, against those that were seen."""

from collections.abc import Iterable, Iterator

from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from xavi_dialogue.report.content import SpeedExpected
from xavi_dialogue.report.decisions.weighed import Ground
from xavi_dialogue.report.figures import Figure, rounded
from xavi_dialogue.report.ridden import predicted
from xavi_dialogue.report.road_users.tracks import Tracks

AHEAD = (1.0, 2.0, 3.0, 4.0)  # [s] after the decision
COUNTS = 0.05  # probability from which a trajectory belongs to the interval
SPREAD = "least and greatest of the trajectories with a probability of 5 % or more"


def expected_speeds(
    traces: Iterable[PlanTrace], tracks: Tracks, vehicle: int
) -> tuple[SpeedExpected, ...]:
    """Return how fast decisions expected a road user to drive in the seconds after them.

    Args:
        traces: the decisions.
        tracks: where everybody was.
        vehicle: the road user.
    """
    return tuple(one for trace in traces for one in _of_decision(trace, tracks, vehicle))


def _of_decision(trace: PlanTrace, tracks: Tracks, vehicle: int) -> Iterator[SpeedExpected]:
    found = predicted(trace, vehicle)
    if found is None:
        return
    at, known = found
    ways = [
        (goal.probability * way.probability, way.speed)
        for goal in known.goals
        for way in goal.trajectories
    ]
    for ahead in AHEAD:
        k = round(ahead / SAMPLE_PERIOD)
        reached = [(chance, speed[k]) for chance, speed in ways if len(speed) > k and chance > 0.0]
        mass = sum(chance for chance, _ in reached)
        if mass < 0.5:
            return
        mean = sum(chance * speed for chance, speed in reached) / mass
        likely = [speed for chance, speed in reached if chance >= COUNTS] or [mean]
        share = "" if mass > 0.999 else f", the {mass:.0%} that are recorded so far ahead"
        how = f"mean by probability, {ahead:g} s after the decision{share}"
        source = Ground(trace).source(f"predictions[{at}].goals[*].trajectories[*].speed", how)
        time = trace.sim_time + ahead
        yield SpeedExpected(
            decision=trace.decision,
            time=trace.sim_time,
            at=rounded(time, 2),
            speed=Figure(
                rounded(mean),
                "m/s",
                source,
                rounded(min(*likely, mean)),
                rounded(max(*likely, mean)),
                SPREAD,
            ),
            driven=_driven(tracks, vehicle, time),
        )


def _driven(tracks: Tracks, vehicle: int, time: float) -> Figure | None:
    """Return the speed [m/s] of a road user as it was seen at a time [s]."""
    state = tracks.state(vehicle, time)
    if state is None:
        return None
    source = tracks.source("speed", vehicle, how=f"at {time:.2f} s")
    return Figure(rounded(state.speed), "m/s", source)
