"""Plan traces made by hand, for tests that need no planner.

A `World` says what comes of each action sequence under each joint sample; `trace_of` draws the
rollouts of a decision from it. `s1_ride` and `s2_ride` tell the two stories of the paper.
"""

import itertools
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from msgspec.structs import replace

from planner.record.events import Event
from planner.record.trace import (
    SCHEMA,
    Action,
    EgoGoal,
    GoalPrediction,
    HeldUp,
    NotApplicable,
    Outcome,
    PlannedAction,
    PlanTrace,
    Rollout,
    Sample,
    Settings,
    TimedAction,
    Track,
    TrajectoryPrediction,
    VehiclePrediction,
)
from sim.scene import VehicleState

Actions = tuple[Action, ...]
Joint = tuple[tuple[int, int, int], ...]
Chosen = Mapping[int, tuple[Action, int]]  # by vehicle: kind of goal, number of trajectory
PENALTY = {"collision": -200.0, "dead": -100.0, "termination": -100.0}


@dataclass(frozen=True)
class Way:
    """One trajectory of one goal."""

    actions: Actions
    probability: float = 1.0
    speed: tuple[float, ...] = (10.0, 10.0, 10.0)
    held_up: tuple[HeldUp, ...] = ()


@dataclass(frozen=True)
class Aim:
    """One goal of one vehicle."""

    kind: Action
    probability: float
    ways: tuple[Way, ...]
    place: str = "the road"


@dataclass(frozen=True)
class End:
    """What comes of a rollout."""

    outcome: Outcome = "done"
    time: float = 10.0
    jerk: float = 0.5
    angular: float = 0.05
    curvature: float = 0.002
    collided_with: int | None = None
    held_up: tuple[HeldUp, ...] = ()

    @property
    def components(self) -> dict:
        if self.outcome != "done":
            return dict.fromkeys(("time", "jerk", "angular-acceleration", "curvature"))
        return {
            "time": self.time,
            "jerk": self.jerk,
            "angular-acceleration": self.angular,
            "curvature": self.curvature,
        }

    @property
    def reward(self) -> float:
        return PENALTY.get(self.outcome, -self.time - self.jerk)


@dataclass(frozen=True)
class World:
    """A decision in full: aims of the others, plans, and what comes of them.

    `simulate(plan, joint)` gives the end of a rollout, and how many actions of the plan it took.
    """

    aims: Mapping[int, tuple[Aim, ...]]
    plans: tuple[Actions, ...]
    simulate: Callable[[Actions, Chosen], tuple[End, int]]
    not_applicable: tuple[NotApplicable, ...] = ()
    plan: Actions = ()


def joints(aims: Mapping[int, tuple[Aim, ...]]) -> list[Joint]:
    """Every joint sample."""
    choices = [
        [(v, g, t) for g, aim in enumerate(known) for t in range(len(aim.ways))]
        for v, known in sorted(aims.items())
    ]
    return [tuple(joint) for joint in itertools.product(*choices)]


def prior(aims: Mapping[int, tuple[Aim, ...]], joint: Joint) -> float:
    """p(S) of a joint sample."""
    product = 1.0
    for vehicle, goal, way in joint:
        aim = aims[vehicle][goal]
        product *= aim.probability * aim.ways[way].probability
    return product


def rollout(
    world: World,
    index: int,
    plan: Actions,
    joint: Joint,
    *,
    start: float = 0.0,
    forced: bool = False,
) -> Rollout:
    """One rollout of a world."""
    chosen = {v: (world.aims[v][g].kind, way) for v, g, way in joint}
    end, taken = world.simulate(plan, chosen)
    return Rollout(
        index=index,
        forced=forced,
        samples=tuple(Sample(*one) for one in joint),
        actions=tuple(TimedAction(a, start + 2.0 * k) for k, a in enumerate(plan[:taken])),
        path=((0.0, 0.0), (1.0, 0.0)),
        speed=(10.0, 10.0),
        same_as=None,
        outcome=end.outcome,
        components=end.components,
        reward=end.reward,
        collided_with=end.collided_with,
        held_up=end.held_up,
    )


def trace_of(
    world: World,
    *,
    draws: int | None = None,
    time: float = 4.0,
    decision: int = 4,
    seed: int = 0,
    extra: Sequence[tuple[Actions, int]] = (),
    history: Mapping[int, Track] | None = None,
    under_way: Action | None = None,
) -> PlanTrace:
    """The trace of one decision.

    With `draws`, that many rollouts of each plan with samples drawn from the prior; else one of
    each plan under every joint sample. `extra` adds (plan, draws) as forced rollouts.
    """
    rng = random.Random(f"{seed}/{decision}")
    every = joints(world.aims)
    weights = [prior(world.aims, joint) for joint in every]
    rows: list[tuple[Actions, Joint, bool]] = []
    for plan in world.plans:
        drawn = every if draws is None else rng.choices(every, weights, k=draws)
        rows += [(plan, joint, False) for joint in drawn]
    for plan, count in extra:
        rows += [(plan, joint, True) for joint in rng.choices(every, weights, k=count)]
    tracks = dict(history or {})
    for vehicle in (0, *world.aims):
        tracks.setdefault(vehicle, straight_track(time, vehicle))
    return PlanTrace(
        schema=SCHEMA,
        vehicle="car",
        sim_time=time,
        decision=decision,
        seed=seed,
        settings=Settings(),
        network="0",
        goal=EgoGoal("out", 80.0, None),
        under_way=None if under_way is None else TimedAction(under_way, time),
        history=dict(sorted(tracks.items())),
        scene={v: _last_state(track) for v, track in sorted(tracks.items())},
        predictions=tuple(_prediction(v, known) for v, known in sorted(world.aims.items())),
        rollouts=tuple(
            rollout(world, k, plan, joint, start=time, forced=forced)
            for k, (plan, joint, forced) in enumerate(rows)
        ),
        not_applicable=world.not_applicable,
        plan=tuple(PlannedAction(a, -10.0, 50) for a in world.plan or world.plans[0]),
    )


def straight_track(time: float, vehicle: int, speed: Sequence[float] | float = 10.0) -> Track:
    """A vehicle that drives east for up to 5 s until `time`; speeds [m/s] at 5 Hz."""
    count = min(26, int(time * 5.0) + 1)
    speeds = [float(speed)] * count if isinstance(speed, float | int) else list(speed)
    x, positions = 20.0 * vehicle, []
    for value in speeds:
        positions.append((x, -5.0 * vehicle))
        x += 0.2 * value
    start = round(time - 0.2 * (len(speeds) - 1), 3)
    return Track(start, tuple(positions), (0.0,) * len(speeds), tuple(speeds))


def _last_state(track: Track) -> VehicleState:
    return VehicleState(track.position[-1], track.heading[-1], track.speed[-1], 0.0, 4.5, 1.8)


def _prediction(vehicle: int, known: tuple[Aim, ...]) -> VehiclePrediction:
    return VehiclePrediction(
        vehicle,
        tuple(
            GoalPrediction(
                aim.kind,
                aim.place,
                aim.kind,
                1.0 / len(known),
                1.0,
                aim.probability,
                tuple(
                    TrajectoryPrediction(
                        way.probability,
                        way.actions,
                        tuple((float(k), 0.0) for k in range(len(way.speed))),
                        way.speed,
                        way.held_up,
                    )
                    for way in aim.ways
                ),
            )
            for aim in known
        ),
    )


def random_world(rng: random.Random) -> World:
    """A small random world in which outcomes depend on everything."""
    aims: dict[int, tuple[Aim, ...]] = {}
    for vehicle in range(1, rng.randint(1, 3) + 1):
        kinds: list[Action] = ["exit-left", "exit-right", "continue"]
        shares = _shares(rng, rng.randint(1, 2))
        aims[vehicle] = tuple(
            Aim(
                kinds[g], share, tuple(Way((kinds[g],), p) for p in _shares(rng, rng.randint(1, 2)))
            )
            for g, share in enumerate(shares)
        )
    firsts: list[Action] = ["continue", "change-left", "stop"]
    seconds: list[Action] = ["continue", "exit-right"]
    plans = tuple((a, b) for a in firsts[: rng.randint(2, 3)] for b in seconds)
    salt = rng.random()

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        state = tuple(chosen.items())
        early = random.Random(f"{salt}/{plan[:1]}/{state}").random() < 0.25
        dice = random.Random(f"{salt}/{plan[:1] if early else plan}/{state}")
        outcome = dice.choices(("done", "collision", "termination", "dead"), (6, 1, 1, 1))[0]
        hit = dice.choice(sorted(chosen)) if outcome == "collision" else None
        end = End(
            outcome,
            round(dice.uniform(5, 20), 1),
            round(dice.uniform(0, 2), 2),
            round(dice.uniform(0, 0.2), 3),
            round(dice.uniform(0, 0.02), 4),
            hit,
        )
        return end, 1 if early else 2

    return World(aims, plans, simulate)


def _shares(rng: random.Random, count: int) -> list[float]:
    cuts = [rng.randint(1, 9) for _ in range(count)]
    return [cut / sum(cuts) for cut in cuts]


# The stories of the paper ------------------------------------------------------------------


def s1_world(*, cut_in_collides: bool = False) -> World:
    """S1: vehicle 1 has cut in ahead and probably slows to turn right; vehicle 2 waits."""
    aims = {
        1: (
            Aim(
                "exit-right",
                0.8,
                (Way(("exit-right",), 1.0, (10.0, 7.0, 4.0)),),
                "the road to the right",
            ),
            Aim("continue", 0.2, (Way(("continue",)),), "the road straight on"),
        ),
        2: (
            Aim("exit-right", 0.6, (Way(("exit-right",), 1.0, (0.0, 0.0, 0.0)),)),
            Aim("exit-left", 0.4, (Way(("exit-left",), 1.0, (0.0, 0.0, 0.0)),)),
        ),
    }
    slowing = HeldUp(1, 4.0, 9.0, "leader", 9.4, 4.2)

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        turning = chosen[1][0] == "exit-right"
        match plan:
            case ("change-left", *_):
                return End(time=12.0, jerk=0.6, angular=0.09), 2
            case ("continue", *_) if turning and cut_in_collides:
                return End("collision", collided_with=1, held_up=(slowing,)), 1
            case ("continue", *_):
                held = (slowing,) if turning else ()
                return End(time=16.0 if turning else 11.5, jerk=0.8, held_up=held), 1
            case ("exit-right", *_):
                return End("dead", held_up=(slowing,) if turning else ()), 1
        return End(time=20.0), len(plan)

    refused = (
        NotApplicable((), "change-right", "there is no lane to the right"),
        NotApplicable((), "exit-left", "there is no road to the left"),
        NotApplicable((), "exit-straight", "going straight on needs no giving way here"),
        NotApplicable((), "continue-next-exit", "there is no roundabout ahead"),
    )
    plans: tuple[Actions, ...] = (
        ("change-left", "continue"),
        ("continue",),
        ("exit-right",),
        ("stop", "continue"),
    )
    return World(aims, plans, simulate, refused)


def s2_world() -> World:
    """S2: vehicle 1 probably waits to turn left, so that the ego can turn right at once."""
    aims = {
        1: (
            Aim(
                "exit-left",
                0.85,
                (Way(("exit-left",), 1.0, (6.0, 1.0, 0.0)),),
                "the road to the left",
            ),
            Aim("continue", 0.15, (Way(("continue",)),), "the road straight on"),
        ),
        2: (Aim("continue", 1.0, (Way(("continue",), 1.0, (13.0, 13.0, 13.0)),)),),
    }

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        waits = chosen[1][0] == "exit-left"
        passing = HeldUp(1, 6.0, 11.0, "right-of-way", 10.0, 9.0)
        match plan:
            case ("exit-right", *_):
                return End(time=9.0 if waits else 14.0, held_up=() if waits else (passing,)), 2
            case ("stop", *_):
                return End(time=13.5, jerk=1.2), 3
        return End("dead"), 1

    refused = (
        NotApplicable((), "continue", "a junction comes first, where it has to give way"),
        NotApplicable((), "change-left", "there is no lane to the left"),
        NotApplicable((), "change-right", "there is no lane to the right"),
        NotApplicable((), "continue-next-exit", "there is no roundabout ahead"),
    )
    plans: tuple[Actions, ...] = (
        ("exit-right", "continue"),
        ("exit-straight",),
        ("exit-left",),
        ("stop", "exit-right", "continue"),
    )
    return World(aims, plans, simulate, refused)


@dataclass(frozen=True)
class Ride:
    """What a record is made of."""

    now: float
    traces: tuple[PlanTrace, ...]
    events: tuple[Event, ...] = field(default=())


def s1_ride(*, draws: int | None = 60, cut_in_collides: bool = False) -> Ride:
    """The ego goes on until 4 s, changes left until 7 s, and goes on."""
    world = s1_world(cut_in_collides=cut_in_collides)
    before = World(world.aims, world.plans, world.simulate, world.not_applicable, ("continue",))
    after = World(
        world.aims,
        (("continue",),),
        world.simulate,
        (NotApplicable((), "change-left", "there is no lane to the left"),),
    )
    traces = (
        trace_of(before, draws=draws, time=2.0, decision=2, history={1: _cut_in(2.0)}),
        trace_of(world, draws=draws, time=4.0, decision=4, history={1: _cut_in(4.0)}),
        trace_of(
            after,
            draws=draws,
            time=5.0,
            history={1: _cut_in(5.0)},
            decision=5,
            under_way="change-left",
        ),
        trace_of(after, draws=draws, time=7.0, decision=7, history={1: _cut_in(7.0)}),
    )
    events = (
        Event("action-started", 0.0, "continue", 0),
        Event("action-ended", 4.0, "continue", 3),
        Event("action-started", 4.0, "change-left", 4),
        Event("action-committed", 4.1, "change-left", 4),
        Event("action-ended", 7.0, "change-left", 4),
        Event("action-started", 7.0, "continue", 7),
    )
    return Ride(7.0, traces, events)


def s2_ride(*, draws: int | None = 60) -> Ride:
    """The ego turns right at 6 s, while vehicle 1 waits, and is through at 9 s."""
    world = s2_world()
    after = World(world.aims, (("continue",),), lambda plan, chosen: (End(time=3.0), 1))
    slowing = straight_track(5.0, 1, [10.0 - 0.4 * k for k in range(26)])
    traces = (
        trace_of(world, draws=draws, time=5.0, decision=5, history={1: slowing}),
        trace_of(after, draws=draws, time=9.0, decision=9),
    )
    events = (
        Event("action-started", 0.0, "exit-right", 0),
        Event("action-committed", 6.0, "exit-right", 5),
        Event("action-ended", 9.0, "exit-right", 5),
        Event("action-started", 9.0, "continue", 9),
    )
    return Ride(9.0, traces, events)


def _cut_in(time: float) -> Track:
    """Vehicle 1 until `time`: it changes to the lane on its right between 0.6 and 3.6 s."""
    count = round(time * 5.0) + 1
    positions, headings = [], []
    for k in range(count):
        share = min(max((k - 3) / 15.0, 0.0), 1.0)
        positions.append((20.0 + 2.0 * k, 3.5 - 3.5 * (3.0 - 2.0 * share) * share**2))
        headings.append(-0.17 * 4.0 * share * (1.0 - share))
    return Track(0.0, tuple(positions), tuple(headings), (10.0,) * count)


# Records with everything that may be missing from one ---------------------------------------


def ragged_trace(seed: int) -> PlanTrace:
    """A small random record: samples not drawn or drawn again, ends of all kinds, absences.

    What comes of (actions, sample) is the same however often it is drawn, as in the planner.
    """
    rng = random.Random(f"ragged/{seed}")
    world = random_world(rng)
    plain = trace_of(world, draws=rng.randint(1, 9), seed=seed)
    rows = []
    for row in plain.rollouts:
        if rng.random() < 0.1:
            continue
        key = f"{seed}/{[a.action for a in row.actions]}/{row.samples}"
        rows += [
            replace(_frayed(row, random.Random(key), sorted(world.aims)), forced=rng.random() < 0.3)
        ] * rng.choice((1, 1, 2))
    return replace(plain, rollouts=tuple(replace(r, index=k) for k, r in enumerate(rows)))


def _frayed(row: Rollout, dice: random.Random, vehicles: list[int]) -> Rollout:
    """A rollout with some components missing and some vehicles in the way."""
    components = {
        name: None if dice.random() < 0.2 else value for name, value in row.components.items()
    }
    held = []
    for _ in range(dice.choice((0, 0, 1, 2, 3))):
        since = round(dice.uniform(4.0, 9.0), 1)
        how = dice.choice(("leader", "right-of-way", "cut-in", "blocked"))
        until, speed = since + round(dice.uniform(0.2, 4.0), 1), round(dice.uniform(2.0, 9.0), 1)
        held.append(HeldUp(dice.choice(vehicles), since, until, how, speed, speed / 2.0))
    return replace(row, components=components, held_up=tuple(held))


def recorded(
    world: World, rows: Sequence[tuple[Actions, Joint, int, bool]], *, seed: int = 0
) -> PlanTrace:
    """A trace of exactly these rollouts: (plan, sample, how often, whether forced)."""
    expanded = [(p, j, forced) for p, j, count, forced in rows for _ in range(count)]
    return replace(
        trace_of(world, draws=0, seed=seed),
        rollouts=tuple(
            rollout(world, k, plan, joint, start=4.0, forced=forced)
            for k, (plan, joint, forced) in enumerate(expanded)
        ),
    )
