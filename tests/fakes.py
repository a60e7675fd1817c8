"""Stand-ins for the slow or outside parts: a fake world and driver, a recorded ride."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import msgspec

from planner.driving.driver import DriveStep
from planner.record.events import Event
from planner.record.trace import PlanTrace, Rollout, WhatIf
from sim.scene import Command, Scene, VehicleState
from tests.traces import Ride, s1_ride
from xavi_dialogue.bus.messages import WhatIfRequest
from xavi_dialogue.dialogue.state.events import EventRecorded, Input, RideEnded, TraceRecorded
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.vehicle.episode import Moment

EGO = VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.5, 1.8)


def inputs_of(ride: Ride, *, ended: float | None = None) -> tuple[Input, ...]:
    """The ride as inputs of the dialogue manager."""
    over = () if ended is None else (RideEnded(ended),)
    return (*map(TraceRecorded, ride.traces), *map(EventRecorded, ride.events), *over)


def moments_of(ride: Ride, *, step: float = 0.5, until: float | None = None) -> Iterator[Moment]:
    """The ride as moments, the last of which ends it."""
    last = ride.now if until is None else until
    for k in range(round(last / step) + 1):
        time = round(k * step, 6)
        due = lambda t, time=time: time - step / 2 < t <= time + step / 2  # noqa: E731
        trace = next((trace for trace in ride.traces if due(trace.sim_time)), None)
        events = tuple(event for event in ride.events if due(event.sim_time))
        scene = Scene(time, {0: EGO, 1: replace(EGO, position=(20.0, 0.0))})
        yield Moment(scene, ("continue",), trace, events, "duration" if time >= last else None)


def again(trace: PlanTrace, need: NeedRollout | WhatIfRequest) -> PlanTrace:
    """Plan again without a planner: the same decision, said to be what was wanted."""
    what_if = msgspec.convert(msgspec.to_builtins(need), WhatIf)
    gone = need.removed
    return msgspec.structs.replace(
        trace,
        what_if=what_if,
        scene={vehicle: state for vehicle, state in trace.scene.items() if vehicle != gone},
        predictions=tuple(one for one in trace.predictions if one.vehicle != gone),
        rollouts=tuple(
            _without(one, gone)
            for one in trace.rollouts
            if gone is None or one.collided_with != gone
        ),
    )


def _without(one: Rollout, gone: int | None) -> Rollout:
    return msgspec.structs.replace(
        one,
        samples=tuple(drawn for drawn in one.samples if drawn.vehicle != gone),
        held_up=tuple(held for held in one.held_up if held.vehicle != gone),
    )


def s1_moments() -> Iterator[Moment]:
    """A made-up ride through S1."""
    return moments_of(s1_ride())


@dataclass
class FakeWorld:
    """A straight road with nobody on it; the ego goes where it is told to."""

    step_length: float = 0.5
    collides_at: float = float("inf")
    steps: int = 0
    state: VehicleState = EGO

    def scene(self) -> Scene:
        return Scene(round(self.steps * self.step_length, 9), {0: self.state})

    def step(self, command: Command | None) -> Scene:
        assert command is not None
        self.steps += 1
        self.state = replace(
            EGO, position=command.position, heading=command.heading, speed=command.speed
        )
        return self.scene()

    def collisions(self) -> tuple[int, ...]:
        return (2,) if self.scene().time >= self.collides_at else ()


@dataclass
class FakeDriver:
    """Goes straight on at 10 m/s and arrives when told to."""

    arrives_at: float = float("inf")
    decide: Callable[[Scene], PlanTrace | None] = lambda _: None
    finished: bool = False
    seen: list[float] = field(default_factory=list)

    def step(self, scene: Scene, dt: float) -> DriveStep:
        self.seen.append(scene.time)
        x, y = scene.ego.position
        command = Command((x + 10.0 * dt, y), 0.0, 10.0)
        events: tuple[Event, ...] = ()
        if scene.time + dt >= self.arrives_at:
            self.finished = True
            events = (Event("arrived", scene.time + dt),)
        return DriveStep(command, self.decide(scene), events)
