"""Avoiding: from when a mishap could have been avoided, and by which options.

Every decision of the seconds before is examined, and planned again where an option was not tried
often enough. An option is judged twice: by its rollouts, as it was believed then, and by its lines
against the other as it really drove.
"""

from collections.abc import Mapping, Sequence

from msgspec.structs import replace

from planner.record.trace import ACTIONS, Action, PlanTrace, Rollout
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.explain.causes.plans.avoidance import LEEWAY, LESS, SELDOM
from xavi_dialogue.explain.causes.vehicles.course import brakes, lines
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import Ride, planned
from xavi_dialogue.report.content import Chosen
from xavi_dialogue.report.decisions.alternatives import Avoidability, Chance, Mishap, Way
from xavi_dialogue.report.decisions.replayed import AFTER, clearance, emergencies
from xavi_dialogue.report.decisions.weighed import Ground, collision, hardest
from xavi_dialogue.report.figures import Figure, rounded
from xavi_dialogue.report.ridden import Inquiry
from xavi_dialogue.report.road_users.tracks import Tracks
from xavi_dialogue.report.stopped import light_stop

PART = 0.75  # of the peak, from which braking counts as the same
LEAST = 1.5  # [m/s2] of a peak below which there is nothing to avoid
WORSE = 0.05  # probability of a collision that an option may have that avoids braking


def avoidability(
    inquiry: Inquiry, tracks: Tracks, moment: Chosen, since: float
) -> Avoidability | None:
    """Find from when the mishap of a moment could have been avoided; None if there was none.

    Args:
        inquiry: the record.
        tracks: where everybody was.
        moment: what happened.
        since: [s] from which on decisions are examined.
    """
    mishap = _mishap(moment)
    if mishap is None:
        return None
    kind, threshold = mishap
    case = _Case(inquiry, tracks, moment, kind, threshold)
    found = [
        case.chance(trace)
        for trace in inquiry.ridden.between(since, moment.time)
        if trace.sim_time < moment.time - 1e-6
    ]
    seen = moment.vehicle in tracks.shapes and kind == "collide"
    return Avoidability(
        mishap=kind,
        threshold=threshold,
        at=moment.time,
        vehicle=moment.vehicle,
        chances=tuple(found),
        last=_last(found, lost=True),
        last_on_route=_last(found, lost=False),
        emergency=emergencies(tracks, moment.vehicle, moment.time)
        if seen and moment.vehicle is not None
        else (),
        supposed_from=_recorded_until(tracks, moment.vehicle) if seen else None,
        light=light_stop(inquiry.ridden, tracks, moment.time, since) if kind == "stop" else None,
    )


def _recorded_until(tracks: Tracks, vehicle: int | None) -> float | None:
    """Return the time [s] of the last sample of the other."""
    times = () if vehicle is None else tracks.motion(vehicle).time
    return times[-1] if times else None


def _last(found: Sequence[Chance], *, lost: bool) -> int | None:
    """Return the last decision with an option that avoids the mishap.

    Args:
        found: the decisions, oldest first.
        lost: options that lose the way to the goal count, too.
    """
    open_at = [
        chance.number
        for chance in found
        if any(way.avoids and (lost or keeps_route(way)) for way in chance.ways)
    ]
    return open_at[-1] if open_at else None


def keeps_route(way: Way) -> bool:
    """Check whether an option probably keeps to the way to the goal."""
    return way.off_route is None or way.off_route.value <= 0.5


def _mishap(moment: Chosen) -> tuple[Mishap, float | None] | None:
    """Return what is to be avoided, and from which deceleration [m/s2] on braking counts."""
    if moment.kind == "collision":
        return "collide", None
    if moment.kind == "red-light":
        return "stop", None
    braking = moment.figures.get("deceleration")
    if braking is None or braking.value < LEAST:
        return None
    return "brake", rounded(PART * braking.value, 2)


class _Case:
    """A mishap, and the options of earlier decisions."""

    def __init__(
        self,
        inquiry: Inquiry,
        tracks: Tracks,
        moment: Chosen,
        kind: Mishap,
        threshold: float | None,
    ) -> None:
        self.inquiry, self.tracks, self.moment = inquiry, tracks, moment
        self.kind, self.threshold = kind, threshold

    def chance(self, trace: PlanTrace) -> Chance:
        """Judge the options of a decision."""
        chosen = planned(trace)[:1]
        if trace.under_way is not None:
            chosen = (trace.under_way.action,)
        ways, unknown = [], {one.action: one.reason for one in trace.not_applicable if not one.node}
        for action in ACTIONS:
            if action in unknown:
                continue
            if trace.under_way is not None and (action,) != chosen:
                continue
            way = self._way(trace, action, chosen=(action,) == chosen)
            if way is not None:
                ways.append(way)
            elif action in CausalModel(trace).options():
                unknown[action] = "too few rollouts"
        own = next((way for way in ways if way.chosen), None)
        judged = tuple(self._judged(way, own) for way in ways)
        return Chance(trace.decision, trace.sim_time, judged, unknown)

    def _way(self, trace: PlanTrace, action: Action, *, chosen: bool) -> Way | None:
        """Return what an option leads to; None if that is not known."""

        def work(ride: Ride) -> tuple[CausalModel, Intervention]:
            return ride.evidence(trace, (action,))

        model = CausalModel(trace)
        if trace.under_way is not None:
            found = model.intervene(planned(trace)[:1])
            known = None if found is None else (model, found)
        else:
            known = self.inquiry.find(work)
        if known is None:
            return None
        model, plan = known
        again = model.trace is not trace
        ground, drawn = Ground(model.trace, "replan" if again else "decision"), lines(model.trace)
        rows = ground.rows(plan)
        touched, nearest = self._replay(ground, plan, drawn)
        return Way(
            action=action,
            chosen=chosen,
            believed=self._believed(ground, plan, drawn),
            replayed=touched,
            clearance=nearest,
            braking=hardest(ground, rows, f"of the rollouts that begin with {action}, by weight"),
            collision=collision(ground, plan, f"of the rollouts that begin with {action}"),
            off_route=Figure(
                rounded(min(sum(w for one, w in rows if one.outcome == "dead"), 1.0)),
                "",
                ground.source("rollouts[*].outcome", "share of dead by weight"),
            ),
            planned=again,
            avoids=None,
        )

    def _believed(
        self, ground: Ground, plan: Intervention, drawn: Mapping[int, Motion]
    ) -> Figure | None:
        """Return the probability of the mishap by the rollouts."""
        if self.kind == "stop":
            return _held(ground, plan)
        if self.threshold is None:
            return collision(ground, plan, f"of the rollouts that begin with {plan.plan[0]}")
        rows = [
            (brakes(line.until(self.moment.time + LEEWAY)) >= self.threshold, weight)
            for one, weight in ground.rows(plan)
            if (line := drawn.get(one.index)) is not None
        ]
        mass = sum(weight for _, weight in rows)
        if mass <= 0.0:
            return None
        share = min(sum(weight for hard, weight in rows if hard) / mass, 1.0)
        how = (
            f"share of the rollouts that begin with {plan.plan[0]}, by weight, that brake at "
            f"{self.threshold:g} m/s2 or more"
        )
        return Figure(rounded(share), "", ground.source("rollouts[*].speed", how))

    def _replay(
        self, ground: Ground, plan: Intervention, drawn: Mapping[int, Motion]
    ) -> tuple[Figure | None, Figure | None]:
        """Return the share of lines that touch the other as it drove, and the least distance."""
        vehicle = self.moment.vehicle
        if self.kind != "collide" or vehicle is None:
            return None, None
        found: list[tuple[float, float]] = []
        kept: dict[int, float | None] = {}
        until = self.moment.time + AFTER
        for one, weight in ground.rows(plan):
            key = _line_of(one)
            if one.index not in drawn:
                continue
            if key not in kept:
                kept[key] = clearance(self.tracks, drawn[one.index], vehicle, until)
            least = kept[key]
            if least is not None:
                found.append((least, weight))
        mass = sum(weight for _, weight in found)
        if mass <= 0.0:
            return None, None
        touching = sum(weight for least, weight in found if least <= 0.0) / mass
        typical = max(found, key=lambda pair: pair[1])[0]
        how = f"lines against vehicle {vehicle} as it drove"
        source = ground.source("rollouts[*].path", how)
        values = [least for least, _ in found]
        near = Figure(rounded(typical, 2), "m", source, rounded(min(values), 2),
                      rounded(max(values), 2), "least and greatest of all lines")  # fmt: skip
        return Figure(rounded(min(touching, 1.0)), "", source), near

    def _judged(self, way: Way, own: Way | None) -> Way:
        """Return an option with whether it avoids the mishap; None: the record does not show it."""
        if way.believed is None:
            return way
        if self.kind == "collide" and self.moment.vehicle not in (None, *self.tracks.shapes):
            return way  # the other was never seen
        seldom = way.believed.value <= SELDOM
        if self.kind == "collide":
            replay = None if way.replayed is None else way.replayed.value <= SELDOM
            avoids = seldom if replay is None else seldom and replay
            return replace(way, avoids=avoids)
        if own is None or own.believed is None:
            return way
        if own.believed.value <= SELDOM and not way.chosen:
            return way  # it was not foreseen, so nothing was to be avoided
        if way.collision is not None and way.collision.value > WORSE:
            return replace(way, avoids=False)  # what it avoids is outweighed
        better = seldom and own.believed.value - way.believed.value >= LESS
        return way if way.chosen and seldom else replace(way, avoids=better)


def _held(ground: Ground, plan: Intervention) -> Figure:
    """Return the probability that a light holds the car up."""
    share = sum(weight for one, weight in ground.rows(plan) if one.held_by_lights)
    how = f"share of the rollouts that begin with {plan.plan[0]}, by weight, that a light holds up"
    source = ground.source("rollouts[*].held_by_lights", how)
    return Figure(rounded(min(share, 1.0)), "", source)


def _line_of(rollout: Rollout) -> int:
    """Return the number of the rollout that has the line of another."""
    return rollout.index if rollout.same_as is None else rollout.same_as
