"""A ride to a traffic light, made by hand: the car stands at red, and goes when it turns green.

The ego drives east at 10 m/s and brakes from 4 s on; it stands 5 m before the line from 15 s on.
The light comes into view at 2 s and turns green at 30 s; the line is passed 2.24 s later.
"""

import itertools
import math
from dataclasses import dataclass
from functools import cache

from msgspec.structs import replace

from planner.record.light_record import (
    HeldByLight,
    LightCourse,
    LightPrediction,
    LightSample,
    Showing,
)
from planner.record.places import LightAhead, RoadFacts, RouteStep
from planner.record.trace import (
    EgoGoal,
    PlannedAction,
    PlanTrace,
    Rollout,
    Settings,
    TimedAction,
    Track,
    WhatIf,
)
from sim.scene import Signal, VehicleState
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.explain.answers.engine import Result, explain
from xavi_dialogue.explain.history.record import Record

LINE = 100.0  # [m]
VIEW, BRAKES, STANDS, GREEN = 2.0, 4.0, 15.0, 30.0  # [s]
PASSED = GREEN + math.sqrt(5.0)  # [s]
SIGNAL = Signal("J", 0)
DT = 0.2  # [s]


@dataclass(frozen=True)
class Story:
    """What the light does, and whether the car obeys."""

    turns: float = GREEN  # [s] to green
    obeys: bool = True  # else it drives on at 10 m/s
    first: str = "r"
    to: str = "G"


OBEYS = Story()


def speed(story: Story, time: float) -> float:
    """How fast [m/s] the car is."""
    if not story.obeys or time < BRAKES:
        return 10.0
    if time < GREEN:
        return max(10.0 * (STANDS - time) / (STANDS - BRAKES), 0.0)
    return min(2.0 * (time - GREEN), 10.0)


@cache
def driven(story: Story) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Speeds [m/s] and places [m] at 5 Hz from 0 s on."""
    speeds = tuple(speed(story, k * DT) for k in range(300))
    places = [0.0]
    for one, other in itertools.pairwise(speeds):
        places.append(places[-1] + 0.5 * DT * (one + other))
    return speeds, tuple(places)


def decision(story: Story, time: float) -> PlanTrace:
    """A decision of the ride."""
    speeds, places = driven(story)
    last = round(time / DT)
    first = max(last - 25, 0)
    track = Track(
        round(first * DT, 3),
        tuple((places[k], 0.0) for k in range(first, last + 1)),
        (0.0,) * (last + 1 - first),
        tuple(speeds[first : last + 1]),
    )
    here = VehicleState((places[last], 0.0), 0.0, speeds[last], 0.0, 4.5, 1.8)
    near = time >= VIEW and places[last] < LINE + 15.0
    lights = (prediction(story, time),) if near else ()
    ahead = ()
    if near and places[last] < LINE:
        now = lights[0].now
        ahead = (LightAhead(LINE - places[last], "J", 0, now, *lights[0].since(0)),)
    step = RouteStep(LINE - places[last], "junction", "exit-straight", None, None, 4, "priority")
    held = bool(ahead) and ahead[0].state == "r" and time >= BRAKES
    return PlanTrace(
        schema="xavi.plan_trace/2",
        vehicle="car",
        sim_time=time,
        decision=round(time),
        seed=0,
        settings=Settings(),
        network="0",
        goal=EgoGoal("out", 80.0, None),
        under_way=None,
        history={0: track},
        scene={0: here},
        predictions=(),
        rollouts=drives(time, lights, held=held),
        not_applicable=(),
        plan=(PlannedAction("exit-straight", -10.0, 50),),
        road=RoadFacts({}, (step,), 300.0, 30.0, lights=ahead),
        lights=lights,
    )


def prediction(story: Story, time: float) -> LightPrediction:
    """What was seen of the light, and how it may go on."""
    seen = [Showing(VIEW, story.first)]
    if time >= story.turns:
        seen.append(Showing(story.turns, story.to))
        ways = [LightCourse(1.0, (Showing(time, story.to), Showing(time + 20.0, "r")))]
    else:
        first = Showing(time, story.first)
        ways = [
            LightCourse(0.3, (first, Showing(time + 6.0, "G"))),
            LightCourse(0.4, (first, Showing(time + 12.0, "G"))),
            LightCourse(0.3, (first,)),
        ]
    return LightPrediction("J", (0,), tuple(seen), tuple(ways))


def drives(time: float, lights: tuple[LightPrediction, ...], *, held: bool) -> tuple[Rollout, ...]:
    """The drives that were imagined: under each course of the light, held for as long as red."""
    courses = lights[0].courses if lights else ()
    rows = [(k, c.probability) for k, c in enumerate(courses)] or [(None, 1.0)]
    waits = (6.0, 12.0, 30.0)
    found = []
    for index, (course, weight) in enumerate(rows):
        wait = waits[course or 0] if held else 0.0
        stop = (HeldByLight("J", 0, time, time + wait),) if held else ()
        sample = () if course is None else (LightSample("J", course),)
        found.append(drive(index, time, 10.0 + wait, weight, sample, stop))
    return tuple(found)


def drive(index, time, lasts, weight, sample, held, pace=10.0):
    """One drive that was imagined."""
    steps = range(round(lasts / DT) + 1)
    return Rollout(
        index=index,
        forced=False,
        samples=(),
        actions=(TimedAction("exit-straight", time),),
        path=tuple((k * DT * pace, 0.0) for k in steps),
        speed=(pace,) * len(steps),
        same_as=None,
        outcome="done",
        components={"time": lasts, "jerk": 0.1, "angular-acceleration": 0.0, "curvature": 0.0},
        reward=-lasts,
        collided_with=None,
        held_up=(),
        terms={"time": lasts},
        weight=weight,
        lights=sample,
        held_by_lights=held,
    )


def again(trace: PlanTrace, need: NeedRollout, *, frees: bool = True) -> PlanTrace:
    """A decision planned again with a light supposed; green saves the wait where it frees us."""
    state = need.lights[0].state
    now = Showing(trace.sim_time, state)
    light = LightPrediction("J", (0,), (now,), (LightCourse(1.0, (now,)),))
    red = state == "r"
    lasts = 40.0 if red else 10.0 if frees else 30.0
    held = (HeldByLight("J", 0, trace.sim_time, trace.sim_time + 30.0),) if red else ()
    return replace(
        trace,
        rollouts=(drive(0, trace.sim_time, lasts, 1.0, (), held),),
        lights=(light,),
        what_if=WhatIf(lights=need.lights),
    )


def record(now: float, story: Story = OBEYS, **more) -> Record:
    """The ride up to a moment [s]."""
    known = tuple(decision(story, float(t)) for t in range(int(now) + 1))
    return Record(now, known, **more)


def answer(act, now: float, story: Story = OBEYS, *, frees: bool = True, span=None) -> Result:
    """The answer to an act, planned again where that is needed."""
    known = record(now, story)
    asked = GroundedAct(act, None if span is None else Span(*span, said=True))
    for _ in range(8):
        found = explain(asked, known)
        if not isinstance(found, NeedRollout):
            return found
        trace = next(t for t in known.traces if t.trace_id == found.trace_id)
        if isinstance(found.lights, tuple):
            made = again(trace, found, frees=frees)
            known = Record(now, known.traces, extra=(*known.extra, made), refused=known.refused)
        else:
            known = Record(now, known.traces, extra=known.extra, refused=(*known.refused, found))
    raise AssertionError("planned again for ever")
