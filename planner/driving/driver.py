"""The driver: from scene to command, with a new decision at least once a second.

It has no input or output besides: scenes in, commands, traces and events out.
"""

import math
from dataclasses import dataclass, replace

import msgspec

from planner.driving.control import Around, Driving, Outlook, control, view_of
from planner.driving.memory import Memory
from planner.driving.monitoring import as_foreseen, changed, light_courses
from planner.driving.restraint import Restraint
from planner.errors import PlannerError
from planner.hidden_areas.phantoms import around
from planner.manoeuvres.actions import STANDING_TIME, ActionPlan, Situation, expand
from planner.manoeuvres.indicators import lights
from planner.motion.forward import DT, Keeping, Lane, Motion, advance
from planner.record.events import SETTLED, Event, EventKind, LightPlace
from planner.record.hidden_record import Phantom
from planner.record.light_record import LightPrediction
from planner.record.trace import Action, EgoGoal, PlanTrace, Settings
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.rollouts.waypoints import survey, way
from planner.search.decide import Decision, Elsewhere, decide
from planner.search.inputs import Frame, Moment, Root, at_place, on_lane, root_at
from sim.roads.network import Location, Network
from sim.scene import EGO, Command, Scene, Signal, VehicleState

YIELDED = 5.0  # [m/s] below which a hindrance by right of way counts as giving way
PAUSE = 0.3  # [s] minimum time between decisions
NEAR = 60.0  # [m] within which surprises count
STANDING = 0.1  # [m/s]
END_GAP = 1.0  # [m] before the end of the road at which to stop


class DriverError(PlannerError):
    """An error: the car cannot drive on from here."""


@dataclass(frozen=True, slots=True)
class DriveStep:
    """The result of one step."""

    command: Command
    trace: PlanTrace | None
    events: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class _Execution:
    """The macro action that is being driven."""

    plan: ActionPlan
    lane: Lane
    edges: tuple[str, ...]  # that the action leads along, and from there to the goal
    motion: Motion
    decision: int
    committed: bool = False
    standing: float = 0.0  # [s]

    @property
    def over(self) -> bool:
        if self.plan.stops:
            return self.standing >= STANDING_TIME
        return self.motion.arc >= self.plan.end


class Driver:
    """Drives one car to its goal."""

    def __init__(
        self,
        network: Network,
        goal: EgoGoal,
        settings: Settings,
        seed: int,
        vehicle: str = "car",
        elsewhere: Elsewhere | None = None,
    ) -> None:
        self._elsewhere = elsewhere
        self._frame = Frame(Roads(network), goal, settings, seed, vehicle)
        self._memory = Memory(self._frame.roads)
        survey(self._frame.roads, goal)
        self._current: _Execution | None = None
        self._last: Decision | None = None
        self._moment: Moment | None = None  # of the last decision
        self._decided = -math.inf
        self._number = 0
        self._waiting_for: int | None = None
        self._stopped_at: Signal | None = None
        self._restraint: Restraint | None = None  # of the last step
        self._restrained = -math.inf  # [s] since when
        self._told: Restraint | None = None  # the last one that lasted
        self._left: str | None = None  # the lane on which the last action ended
        self.finished = False

    def step(self, scene: Scene, dt: float) -> DriveStep:
        """Drive on for one step; beyond the goal, without further decisions.

        Args:
            scene: what is seen now.
            dt: [s] length of the step.

        Raises:
            DriverError: the ego is not on any lane.
        """
        events: list[Event] = []
        self._memory.observe(scene)
        trace = None
        elapsed = scene.time - self._decided
        due = elapsed >= self._frame.settings.period - 1e-6
        due = due or (elapsed >= PAUSE - 1e-6 and self._surprised(scene))
        if (due or self._current is None) and not self.finished:
            trace = self._decide(scene, events)
        command = self._drive(scene, dt, events)
        return DriveStep(command, trace, tuple(events))

    def carry_out(self, action: Action, scene: Scene, dt: float) -> DriveStep:
        """Drive another action than the one just chosen, to its end.

        Args:
            action: one that applied at the decision.
            scene: of the step that has just decided; the command returned stands in for its own.
            dt: [s] length of the step.

        Raises:
            DriverError: nothing was decided in that step, or the action does not apply.
        """
        if self._moment is None or self._moment.time != round(scene.time, 3):
            raise DriverError(f"no decision was made at {scene.time:.1f} s")
        begun = self._begin(action, self._moment)
        if isinstance(begun, Refusal):
            raise DriverError(f"{action} does not apply at {scene.time:.1f} s: {begun.reason}")
        self._current = replace(begun, committed=True)
        events = [_event("action-started", self._moment.time, self._current)]
        command = self._drive(scene, dt, events)
        return DriveStep(command, None, tuple(events))

    def _decide(self, scene: Scene, events: list[Event]) -> PlanTrace:
        current = self._current
        committed = current is not None and current.committed
        under_way = (current.plan, current.motion) if current is not None and committed else None
        driving = current.plan.action if current is not None and not committed else None
        now = self._memory.now
        moment = Moment(
            self._number,
            round(scene.time, 3),
            now,
            {vehicle: self._memory.recorded(vehicle, scene.time) for vehicle in now},
            Root(self._situation(scene), under_way, driving),
            self._memory.unseen,
            lights=self._lookout(scene),
            phantoms=self._imagined(scene),
        )
        decision = decide(self._frame, moment, self._elsewhere)
        self._last, self._moment, self._decided = decision, moment, scene.time
        if scene.unseen and decision.trace.road is not None:
            places = decision.trace.road.places
            self._memory.counts.note({v: at.edge for v, at in places.items() if v != EGO})
        self._number += 1
        if not committed:
            self._adopt(decision, moment, events)
        return decision.trace

    def _lookout(self, scene: Scene) -> tuple[LightPrediction, ...]:
        """Return the possible courses of the lights in view."""
        roads, goal, here = self._frame.roads, self._frame.goal, self._situation(scene)
        edges = way(roads, (here.location.lane,), goal)
        horizon, now = self._frame.settings.horizon, round(scene.time, 3)
        return light_courses(roads, self._memory.watched, now, horizon, edges)

    def _imagined(self, scene: Scene) -> tuple[Phantom, ...]:
        """Return phantoms that may come out of hidden areas at the junction here or ahead."""
        if not scene.unseen:
            return ()
        view = view_of(self._frame.roads, self._memory, scene)
        return around(view, self._situation(scene).location)

    def _adopt(self, decision: Decision, moment: Moment, events: list[Event]) -> None:
        """Begin the first action of the plan, unless it is being driven already."""
        plan, current = decision.trace.plan, self._current
        action: Action = plan[0].action if plan else "stop"
        if current is not None and current.plan.action == action:
            self._current = replace(current, decision=moment.number)
            return
        if current is not None:
            events.append(_event("action-ended", moment.time, current))
        begun = self._begin(action, moment)
        if isinstance(begun, Refusal):
            raise DriverError(f"no macro action applies at {moment.time:.1f} s: {begun.reason}")
        self._current = begun
        events.append(_event("action-started", moment.time, begun))

    def _begin(self, action: Action, moment: Moment) -> _Execution | Refusal:
        """Return an action at its beginning."""
        frame, here = self._frame, moment.root.here
        plan = expand(frame.roads, here, action, frame.goal, frame.settings.view_radius)
        if isinstance(plan, Refusal):
            return plan
        ahead = tuple(lane for lane, start in plan.path.lanes if start <= plan.end)
        edges = way(frame.roads, ahead, frame.goal)
        lane = Lane(plan.path, self._end_of_the_road(plan))
        motion = Motion(0.0, here.speed, here.acceleration)
        return _Execution(plan, lane, edges, motion, moment.number)

    def _end_of_the_road(self, plan: ActionPlan) -> float:
        """Return the arc [m] of the road's end, before which to stop if the goal is elsewhere."""
        (last, begin), network = plan.path.lanes[-1], self._frame.roads.network
        if network.links_from(last) or plan.goal is not None:
            return math.inf
        return min(plan.path.length, begin + network.lanes[last].length) - END_GAP

    def _surprised(self, scene: Scene) -> bool:
        """Check whether a near road user does something that the last decision did not foresee.

        It matters if the ego has to give way, since it then relies on what it foresaw. A change of
        a light ahead matters too.
        """
        if self._last is None or self._current is None:
            return False
        if changed(self._current.plan, scene, self._last.trace.lights):
            return True
        if not self._current.plan.lines:
            return False
        step = round((scene.time - self._last.trace.sim_time) / DT)
        for vehicle, beliefs in self._last.beliefs.items():
            state = scene.vehicles.get(vehicle) or scene.people.get(vehicle)
            if state is None or math.dist(state.position, scene.ego.position) > NEAR:
                continue
            ways = (way.motion for belief in beliefs for way in belief.trajectories)
            if not any(as_foreseen(state, motion, step) for motion in ways):
                return True
        return False

    def _situation(self, scene: Scene) -> Situation:
        current = self._current
        if current is None:
            ego = self._memory.now[EGO]
            here = root_at(self._frame.roads, ego, scene.time) or self._beyond(ego, scene.time)
            if here is None:
                raise DriverError(f"the ego is on no lane at {scene.time:.1f} s")
            return here
        lane, begin = current.plan.path.lane_at(current.motion.arc)
        known = Location(lane, current.motion.arc - begin, 0.0)
        return on_lane(self._frame.roads, self._memory.now[EGO], scene.time, known)

    def _beyond(self, ego: VehicleState, time: float) -> Situation | None:
        """Return its situation if it could not stop and has driven beyond the end of the road."""
        if self._left is None:
            return None
        end = self._frame.roads.network.lanes[self._left].length
        return at_place(ego, time, Location(self._left, end, 0.0))

    def _drive(self, scene: Scene, dt: float, events: list[Event]) -> Command:
        current = self._current
        assert current is not None
        last = (
            None if self._last is None else Outlook(self._last.trace.sim_time, self._last.beliefs)
        )
        around = Around(self._frame.roads, self._memory, last, scene)
        driving = Driving(current.plan, current.lane, current.motion)
        chosen = control(driving, around, dt)
        motion = advance(current.motion, chosen.acceleration, dt)
        standing = current.standing + dt if motion.speed < 0.1 else 0.0
        current = replace(current, motion=motion, standing=standing)
        later = scene.time + dt
        if not current.committed and motion.arc >= current.plan.commit:
            current = replace(current, committed=True)
            events.append(_event("action-committed", later, current))
        self._note_waiting(chosen.keeping, motion, later, current, events)
        self._note_restraint(chosen.restraint, later, current, events)
        position, heading = current.plan.path.pose(motion.arc, scene.ego.length)
        self._current = self._close(current, later, events)
        shown = self._lights(current, motion, (motion.speed - scene.ego.speed) / dt)
        return Command(position, heading, motion.speed, current.edges, shown)

    def _lights(self, current: _Execution, motion: Motion, acceleration: float) -> tuple[str, ...]:
        """Return the vehicle lights that the car shows in the coming step."""
        plan = self._last.trace.plan if self._last is not None else ()
        actions = tuple(planned.action for planned in plan)
        later = actions[1:] if actions[:1] == (current.plan.action,) else ()
        roads = self._frame.roads
        return lights(roads, current.plan, motion.arc, motion.speed, acceleration, later)

    def _close(self, current: _Execution, time: float, events: list[Event]) -> _Execution | None:
        goal = current.plan.goal
        if goal is not None and current.motion.arc >= goal and not self.finished:
            self.finished = True
            events.append(_event("action-ended", time, current))
            events.append(_event("arrived", time, None))
        elif current.over and not self.finished:
            events.append(_event("action-ended", time, current))
            self._left = current.plan.path.lane_at(current.motion.arc)[0]
            return None
        return current

    def _note_waiting(
        self,
        keeping: Keeping,
        motion: Motion,
        time: float,
        current: _Execution,
        events: list[Event],
    ) -> None:
        """Add an event once when the ego gives way to a vehicle, or has stopped at a light."""
        hindrance, light = keeping.hindrance, keeping.light
        if light is not None and motion.speed < STANDING and light != self._stopped_at:
            self._stopped_at = light
            events.append(_event("stopped-at-light", time, current, light=light))
        elif motion.speed > 3.0:
            self._stopped_at = None
        if hindrance is not None and hindrance.how == "right-of-way" and light is None:
            if motion.speed < YIELDED and hindrance.vehicle != self._waiting_for:
                self._waiting_for = hindrance.vehicle
                events.append(_event("gave-way", time, current, hindrance.vehicle))
        elif motion.speed > 3.0:
            self._waiting_for = None

    def _note_restraint(
        self, found: Restraint, time: float, current: _Execution, events: list[Event]
    ) -> None:
        """Add an event when something else has kept the ego from driving faster for a while."""
        if self.finished:
            return
        if found != self._restraint:
            self._restraint, self._restrained = found, time
        settled = self._told is None or time - self._restrained >= SETTLED - 1e-6
        if found != self._told and settled:
            self._told = found
            events.append(
                msgspec.structs.replace(
                    _event("restrained", time, current, found.vehicle, found.light), by=found.by
                )
            )


def _event(
    kind: EventKind,
    time: float,
    current: _Execution | None,
    vehicle: int | None = None,
    light: Signal | None = None,
) -> Event:
    action = None if current is None else current.plan.action
    decision = None if current is None else current.decision
    where = msgspec.UNSET if light is None else LightPlace(light.controller, light.index)
    return Event(kind, round(time, 3), action, decision, vehicle, light=where)
