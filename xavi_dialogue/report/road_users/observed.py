"""What was observed: speeds, gaps, lights on the car's way, and who goes first."""

from msgspec.structs import replace

from planner.record.trace import ON_FOOT, PlanTrace
from sim.scene import EGO
from xavi_dialogue.explain.causes.plans.avoidance import SELDOM
from xavi_dialogue.report.content import Course, Gaps, LightSpan, Precedence
from xavi_dialogue.report.figures import Figure, rounded
from xavi_dialogue.report.ridden import Ridden
from xavi_dialogue.report.road_users.parties import of_trace
from xavi_dialogue.report.road_users.tracks import Tracks

DIGITS = 3  # of lists of samples


def course(tracks: Tracks, vehicle: int, window: tuple[float, float]) -> Course:
    """Return the motion of a road user in a window [s]."""
    motion = tracks.motion(vehicle)
    inside = motion.within(*window)
    return Course(
        vehicle=vehicle,
        time=tuple(rounded(motion.time[k], DIGITS) for k in inside),
        speed=tuple(rounded(motion.speed[k], DIGITS) for k in inside),
        rate=tuple(rounded(motion.rate[k], DIGITS) for k in inside),
        source=tracks.source("speed", vehicle),
    )


def gaps(tracks: Tracks, vehicle: int, window: tuple[float, float]) -> Gaps:
    """Return the distance of a road user from the car in a window [s]."""
    known = [
        (time, gap)
        for time in tracks.times(EGO, *window)
        if (gap := tracks.gap(vehicle, time)) is not None
    ]
    closing = []
    for k in range(len(known)):
        (t0, g0), (t1, g1) = known[max(k - 1, 0)], known[min(k + 1, len(known) - 1)]
        closing.append((g0 - g1) / (t1 - t0) if 0.0 < t1 - t0 < 1.0 else 0.0)
    return Gaps(
        vehicle=vehicle,
        time=tuple(rounded(time, DIGITS) for time, _ in known),
        distance=tuple(rounded(gap, DIGITS) for _, gap in known),
        closing=tuple(rounded(rate, DIGITS) for rate in closing),
        source=tracks.source("position", EGO, vehicle, how="least distance of the bodies"),
    )


def lights(ridden: Ridden, window: tuple[float, float]) -> tuple[LightSpan, ...]:
    """Return what the next traffic light on the car's way showed in a window [s]."""
    found: dict[tuple[str, int], list[LightSpan]] = {}
    for trace in ridden.between(*window):
        for k, light in enumerate(() if trace.road is None else trace.road.lights[:1]):
            spans = found.setdefault((light.controller, light.place), [])
            if spans and spans[-1].state == light.state:
                spans[-1] = replace(spans[-1], until=trace.sim_time)
                continue
            if spans and light.change_seen:
                spans[-1] = replace(spans[-1], until=max(light.since, spans[-1].since))
            far = Figure(light.distance, "m", of_trace(trace, f"road.lights[{k}].distance"))
            span = LightSpan(
                controller=light.controller,
                place=light.place,
                state=light.state,
                since=light.since,
                until=trace.sim_time,
                change_seen=light.change_seen,
                decision=trace.decision,
                distance=far,
            )
            spans.append(span)
    return tuple(sorted((s for spans in found.values() for s in spans), key=lambda s: s.since))


def precedence(ridden: Ridden, window: tuple[float, float]) -> tuple[Precedence, ...]:
    """Return who goes first by each decision of a window [s], where it changes."""
    found: list[Precedence] = []
    for trace in ridden.between(*window):
        road = trace.road
        if road is None:
            continue
        step = road.route[0] if road.route else None
        far = None
        if step is not None:
            far = Figure(step.distance, "m", of_trace(trace, "road.route[0].distance"))
        now = Precedence(
            decision=trace.decision,
            time=trace.sim_time,
            rule=None if step is None else step.rule,
            distance=far,
            first={fact.vehicle: fact.who for fact in road.priority},
            source=of_trace(trace, "road.priority"),
            crossing=_crossing(trace),
        )
        if not found or _who(found[-1]) != _who(now):
            found.append(now)
    return tuple(found)


def _who(row: Precedence) -> tuple[object, ...]:
    """Return what makes a row differ from the one before."""
    return row.rule, row.first, row.crossing.keys()


def _crossing(trace: PlanTrace) -> dict[int, Figure]:
    """Return who may cross the car's way on foot, with the probability; the car lets them go.

    Right of way on lanes, as the road has it, leaves them out.
    """
    found: dict[int, Figure] = {}
    for k, known in enumerate(trace.predictions):
        there = trace.scene.get(known.vehicle)
        if there is None or there.kind not in ON_FOOT:
            continue
        chance = sum(goal.probability for goal in known.goals if goal.kind == "cross")
        if chance > SELDOM:
            how = "sum of the goals that cross this car's way"
            source = of_trace(trace, f"predictions[{k}].goals[*].probability", how)
            found[known.vehicle] = Figure(rounded(min(chance, 1.0)), "", source)
    return found
