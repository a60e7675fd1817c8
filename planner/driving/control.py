"""Control: the acceleration in the coming step, given what is seen and foreseen."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from planner.driving.memory import Memory
from planner.driving.monitoring import shown_now
from planner.driving.restraint import Controlled, Restraint, restraint_of
from planner.driving.walkers import AROUND, passing_speed, with_walkers
from planner.hidden_areas.caution import allowed_speed
from planner.hidden_areas.phantoms import View
from planner.kernels.limits import (
    COMFORT,
    CRAWL,
    EMERGENCY,
    FOLLOWING,
    FORESIGHT,
    GAP_HORIZON,
    LEAST,
    REACTION,
    RELAXATION,
    safe_speed,
    towards,
)
from planner.manoeuvres.clearance import first_touch
from planner.manoeuvres.layout import INSIDE
from planner.manoeuvres.plans import ActionPlan, GiveWay
from planner.motion.forward import DT, Hindrance, Keeping, Lane, Motion, accelerate
from planner.motion.obstacles import Obstacle, Traffic, occupancy
from planner.motion.road_users import road_users_in, standing
from planner.motion.tracks import aligned
from planner.prediction.recognise import Belief
from planner.record.trace import ON_FOOT
from planner.roads.trajectory import Roads
from sim.scene import EGO, Scene, VehicleState

CAUTION = 0.08  # probability from which the ego gives way to a motion of a slow vehicle
CERTAIN = 0.5  # the same for people who have held the ego up for a while, so that it can go on
LIKELY = 0.3  # probability from which the ego makes room for a vehicle that moves in
SLOW = 4.0  # [m/s] the ego gives way to every foreseen motion of a faster vehicle
PATIENCE = 25  # samples at 5 Hz after which a standing vehicle is assumed to wait
STANDING = 0.1  # [m/s]
SPARE = 3.0  # [m] to look ahead beyond the stopping distance of the ego


@dataclass(frozen=True, slots=True)
class Driving:
    """The plan that the ego drives, and its motion along the path."""

    plan: ActionPlan
    lane: Lane
    motion: Motion


@dataclass(frozen=True, slots=True)
class Outlook:
    """The beliefs of the last decision."""

    time: float  # [s] of the decision
    beliefs: Mapping[int, Sequence[Belief]]


@dataclass(frozen=True)
class Around:
    """The information about the others."""

    roads: Roads
    memory: Memory
    outlook: Outlook | None
    scene: Scene

    @cached_property
    def seen(self) -> dict[int, VehicleState]:
        """All road users in the scene."""
        return road_users_in(self.scene)


def control(driving: Driving, around: Around, dt: float) -> Controlled:
    """Keep behind what is seen, give way to what is predicted, and obey the lights.

    Returns:
        The acceleration in the coming step of `dt` [s], and what it rests on.
    """
    path, ego, lights = driving.plan.path, around.scene.ego, shown_now(around.scene)
    seen = _seen(around)
    plan, walkers = with_walkers(driving.plan, around.roads, seen, ego)
    predicted = _predicted(driving, around, 0.0 if plan.lines else LIKELY)
    meeting = [motion for _, motion in predicted] if plan.lines else []
    crossing = occupancy(path, Traffic.of([*meeting, *walkers], lights), ego.width, 0, GAP_HORIZON)
    foreseen = Traffic.of([motion for probability, motion in predicted if probability >= LIKELY])
    acceleration, keeping = accelerate(
        plan,
        driving.lane,
        driving.motion,
        occupancy(path, Traffic.of(seen, lights), ego.width, 0, 2),
        crossing,
        occupancy(path, foreseen, ego.width, 0, FORESIGHT),
        ego.length,
        dt,
    )
    restraint = restraint_of(plan, driving.lane, driving.motion, keeping, crossing, around.roads)
    chosen = Controlled(acceleration, keeping, restraint)
    chosen = _at_the_end(driving, _beside(driving, around, chosen, dt), dt)
    return _clear(driving, around, _careful(driving, around, chosen, dt), dt)


def view_of(roads: Roads, memory: Memory, scene: Scene) -> View:
    """Return the view: what is seen now, and what is hidden."""

    def rate(edge: str) -> float:
        return memory.counts.rate(edge, scene.time)

    return View(roads, scene.vehicles, scene.unseen, rate, shown_now(scene))


def _careful(driving: Driving, around: Around, chosen: Controlled, dt: float) -> Controlled:
    """Approach a line slowly if a vehicle with priority may come from a hidden area."""
    if not around.scene.unseen:
        return chosen
    motion = driving.motion
    view = view_of(around.roads, around.memory, around.scene)
    allowed = allowed_speed(view, driving.plan, motion.arc)
    if allowed >= motion.speed + COMFORT * dt:
        return chosen
    braking = towards(motion.speed, motion.acceleration, allowed, FOLLOWING, dt)
    return chosen.slowed(braking, Restraint("hidden"))


def _at_the_end(driving: Driving, chosen: Controlled, dt: float) -> Controlled:
    """Brake as hard as necessary to stop before the end of the road."""
    motion = driving.motion
    needed = motion.speed**2 / (2.0 * max(driving.lane.end - motion.arc, LEAST))
    if needed <= FOLLOWING:
        return chosen
    wanted = max(motion.speed - needed * RELAXATION, 0.0)
    braking = towards(motion.speed, motion.acceleration, wanted, EMERGENCY, dt)
    return chosen.slowed(braking, Restraint("road-end"))


def _beside(driving: Driving, around: Around, chosen: Controlled, dt: float) -> Controlled:
    """Drive slowly past a vehicle that waits at a crossing on the lane beside."""
    motion = driving.motion
    others = {v: s for v, s in around.scene.vehicles.items() if v != EGO}
    found = passing_speed(driving.plan, motion, others) if driving.plan.crossings else None
    if found is None or found[0] >= motion.speed + COMFORT * dt:
        return chosen
    braking = towards(motion.speed, motion.acceleration, found[0], FOLLOWING, dt)
    return chosen.slowed(braking, Restraint("beside-crossing", found[1]))


def _clear(driving: Driving, around: Around, chosen: Controlled, dt: float) -> Controlled:
    """Stop before a vehicle that stands so near the path that the turning ego would touch it.

    Do not even set off if the ego would then stop inside a junction and block it.
    """
    motion, now = driving.motion, around.memory.now
    standing = {v: s for v, s in now.items() if v != EGO and s.speed <= CRAWL}
    reach = motion.speed**2 / (2.0 * COMFORT) + motion.speed * REACTION + SPARE
    halted = motion.speed <= CRAWL
    if halted:
        reach = max([reach, *(line.clear - motion.arc for line in _crossing(driving))])
    found = first_touch(driving.plan.path, motion.arc, reach, around.scene.ego, standing)
    if found is None:
        return chosen
    free, vehicle = found
    held = halted and any(line.clear > free for line in _crossing(driving))
    wanted = 0.0 if held else safe_speed(free - motion.arc, 0.0, FOLLOWING)
    braking = towards(motion.speed, motion.acceleration, wanted, EMERGENCY, dt)
    if braking >= chosen.acceleration:
        return chosen
    keeping = Keeping(Hindrance(vehicle, "blocked", standing[vehicle].speed), None)
    return Controlled(braking, keeping, Restraint("blocked", vehicle))


def _seen(around: Around) -> list[Obstacle]:
    """Return the others at their present places, which is all that following them needs."""
    ego = around.scene.ego
    return [
        standing(around.roads, vehicle, state)
        for vehicle, state in around.memory.now.items()
        if vehicle != EGO
        and (state.kind not in ON_FOOT or math.dist(state.position, ego.position) < AROUND)
    ]


def _predicted(driving: Driving, around: Around, likely: float) -> list[tuple[float, Obstacle]]:
    """Return the motions that the last decision found likely enough, with probabilities."""
    found: list[tuple[float, Obstacle]] = []
    if around.outlook is None:
        return found
    elapsed, seen = round((around.scene.time - around.outlook.time) / DT), around.seen
    lingering = _kept(driving, around) if driving.plan.crossings else False
    for vehicle, beliefs in around.outlook.beliefs.items():
        here = seen.get(vehicle)
        if here is not None and _waits_for_us(driving, around, vehicle):
            continue
        slow = here is None or here.speed < SLOW
        least = max(likely, CAUTION if slow else 0.0)
        if here is not None and here.kind in ON_FOOT and lingering:
            least = max(least, CERTAIN)
        for belief in beliefs:
            for line in belief.trajectories:
                probability = belief.probability * line.probability
                if probability >= least:
                    motion = aligned(line.motion, -elapsed, GAP_HORIZON + 10)
                    found.append((probability, motion))
    return found


def _waits_for_us(driving: Driving, around: Around, vehicle: int) -> bool:
    """Check whether a vehicle that may go first lets the ego go on.

    Otherwise the two could wait for each other forever. The other must have stood for a while.
    Besides, the ego must be past its line, or have waited at its line for as long without a light.
    """
    if not _crossing(driving):
        arc = driving.motion.arc
        at_line = any(-SPARE < line.stop - arc < SPARE for line in driving.plan.lines)
        if not at_line or not _kept(driving, around):
            return False
    return _stands(around, vehicle)


def _stands(around: Around, vehicle: int) -> bool:
    """Check whether a vehicle has stood for a while."""
    speeds = around.memory.track(vehicle, around.scene.time).speed[-PATIENCE:]
    return len(speeds) == PATIENCE and max(speeds) < STANDING


def _kept(driving: Driving, around: Around) -> bool:
    """Check whether the ego has hardly moved for a while, and not because of a light."""
    return _lingers(around) and not _just_green(driving, around)


def _lingers(around: Around) -> bool:
    """Check whether the ego moved less than SPARE in the last PATIENCE samples."""
    places = around.memory.track(EGO, around.scene.time).position[-PATIENCE:]
    return len(places) == PATIENCE and math.dist(places[0], places[-1]) < SPARE


def _just_green(driving: Driving, around: Around) -> bool:
    """Check whether a light ahead of the ego has changed within the last PATIENCE samples."""
    found = (around.scene.light(ahead.signal) for ahead in driving.plan.obey_lights)
    since = around.scene.time - PATIENCE * DT
    return any(light is not None and light.since > since for light in found)


def _crossing(driving: Driving) -> list[GiveWay]:
    """Return the lines that the ego has crossed without being clear of the junction."""
    arc = driving.motion.arc
    return [line for line in driving.plan.give_ways if line.stop + INSIDE < arc < line.clear]
