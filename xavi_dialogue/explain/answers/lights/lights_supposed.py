"""Lights supposed: what if a light had shown something else, and why we do not turn on red.

The decision at which it would have mattered is planned again, with the light showing for good what
it is supposed to show.
"""

from typing import Any, Literal

from planner.kernels.limits import FOLLOWING
from planner.record.light_record import GREENS
from planner.record.trace import ON_FOOT, PlanTrace
from sim.scene import EGO, LightState, Signal
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.domain.answers import Answer, NotRecorded
from xavi_dialogue.domain.meaning import Compare, Doing, HowMuch, Question, WhatIf, Whether, Why
from xavi_dialogue.domain.terms import Ego, Event, Feature, Happens, Is, Now, Proposition, Vehicle
from xavi_dialogue.domain.traffic_lights import (
    LightColour,
    LightTold,
    Shown,
    SupposedOfLight,
    TurnOnRed,
)
from xavi_dialogue.explain.answers.lights.lights_ahead import wanted_of
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import event_of, is_own, unwrapped
from xavi_dialogue.explain.answers.suppositions.undone import is_sooner
from xavi_dialogue.explain.causes.driving.traffic_lights import with_light
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.causes.vehicles.involved import LIKELY
from xavi_dialogue.explain.facts.episodes.light_events import HELD
from xavi_dialogue.explain.facts.episodes.light_waits import held_at, holds
from xavi_dialogue.explain.facts.traffic_lights import light_in, meant, shown_at
from xavi_dialogue.explain.history.restraints import restraint_at
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, planned
from xavi_dialogue.explain.history.traffic_lights import ahead, passings

AROUND = 1.0  # [s] by which the time at which we would have come somewhere may be off
SOON = 6.0  # [s] in which somebody who goes first keeps us at the light
STANDING = 0.3  # [m/s] below which we stand
STATES: dict[LightColour, str] = {
    "red": LightState.RED.value, "amber": LightState.AMBER.value, "green": LightState.GREEN.value,
    "red-amber": LightState.RED_AMBER.value, "off": LightState.OFF.value,
    "flashing": LightState.FLASHING.value,
}  # fmt: skip
GOING = frozenset(("go", "move", "continue", "pass", "cross", "enter"))
TURNS: dict[str, Literal["left", "right", "straight"]] = {
    "exit-left": "left", "exit-right": "right", "exit-straight": "straight",
}  # fmt: skip


def supposed(question: WhatIf, scene: Asked) -> Answer:
    """Return what would have happened, or would, if a light had shown something else, or did.

    Raises:
        Unanswered: no decision knows the light; or it must be planned again first.
    """
    of, negated = unwrapped(question.supposed)
    light, wanted = wanted_of(of)
    now = shown_at(scene.ride, light, scene.now)
    wanted = _meant_colour(wanted, now, negated=negated)
    done = passings(scene.ride)
    tense = getattr(of, "tense", "present")
    if isinstance(of, Happens):
        tense = of.event.tense
    stays = isinstance(of, Happens) and of.event.action == "show" and _is_open(now, wanted)
    past = tense in ("past", "perfect") and not stays and not _is_of_now(of, question.then)
    if not past and now is not None and now.colour == wanted == "green":
        return _as_it_is(scene, now, question.then)
    here = None if past else meant(scene.ride, light, scene.now)
    left = [one.time for one in done if one.signal == here]
    if left:
        return LightTold("where", now, passed=left[-1], time=scene.now)
    trace, signal = _decision(scene, light, wanted, past=past)
    one = shown_at(scene.ride, light, trace.sim_time)
    if one is None or signal is None:
        raise Unanswered(NotRecorded("not-recorded", since=trace.sim_time))
    again = with_light(scene.ride, trace, signal, STATES[wanted])
    if again is None:
        raise Unanswered(NotRecorded("not-recorded", since=trace.sim_time))
    passed = next((p.time for p in done if p.signal == signal and p.time > trace.sim_time), None)
    passing = _passing(scene.ride, trace, again, signal)
    waits = _held(again, signal)
    first = () if waits else _let_go_first(scene.ride, again)
    if past and not waits and not first and passing is not None:
        first = _crossing_then(scene, passing)
    if past and not waits and not first and passed is None:
        first = _held_now(scene, signal, STATES[wanted])
    return SupposedOfLight(
        one,
        wanted,
        trace.sim_time,
        planned(trace),
        planned(again),
        same=one.colour == wanted,
        waits=waits,
        passing=None if waits else passing,
        passed=passed,
        past=past,
        standing=trace.scene[EGO].speed < STANDING,
        holds=_would(question.then, waits=waits or bool(first)),
        first=first,
        faster=_asks_speed(question.then),
        amount=isinstance(question.then, HowMuch),
    )


def _is_of_now(of: Proposition | None, then: Question | None) -> bool:
    """Check whether "if it were green" is of now: so it says, or what is asked is of now."""
    event = event_of(then.that) if isinstance(then, Whether) else then
    present = isinstance(event, Event | Doing) and event.tense == "present"
    return isinstance(getattr(of, "time", None), Now) or present


def _as_it_is(scene: Asked, now: Shown, then: Question | None) -> SupposedOfLight:
    """Return that a light is green already, and whom we let go first all the same."""
    trace = scene.ride.latest
    holder = restraint_at(scene.ride, scene.now)
    held = () if holder is None or holder.by != "right-of-way" else (holder.vehicle,)
    first = tuple(dict.fromkeys(v for v in (*held, *_let_go_first(scene.ride, trace)) if v))
    holds = _would(then, waits=True) if first else None
    return SupposedOfLight(
        now, "green", trace.sim_time, planned(trace), planned(trace),
        same=True, waits=False, past=False, holds=holds, first=first,
    )  # fmt: skip


def _asks_speed(then: Question | None) -> bool:
    """Check whether the question is if we would be faster, or come there sooner."""
    return is_sooner(then) or (isinstance(then, Compare) and then.by in ("time", "speed"))


def _would(then: Question | None, *, waits: bool) -> bool | None:
    """Return the reply to whether we would have stopped then, or driven on; None: not asked."""
    event = event_of(then.that) if isinstance(then, Whether) else None
    if event is None or not is_own(event.actor):
        return None
    return waits if event.action in HELD else not waits if event.action in GOING else None


def _meant_colour(wanted: LightColour | None, now: Shown | None, *, negated: bool) -> LightColour:
    """Return what a light is supposed to show: "green", "not red", "changed", "not changed"."""
    red = now is not None and now.colour in ("red", "red-amber")
    if wanted is None:
        return "red" if red == negated else "green"
    if negated:
        return "green" if wanted in ("red", "amber") else "red"
    return wanted


def _is_open(now: Shown | None, wanted: LightColour) -> bool:
    """Check whether a supposition in the past tense is about what goes on: "if it stayed red"."""
    return now is not None and now.end is None and now.colour == wanted


def _decision(
    scene: Asked, light: Feature, wanted: LightColour, *, past: bool
) -> tuple[PlanTrace, Signal | None]:
    """Return the decision at which the supposition would have mattered, and the light.

    For a light that is supposed green, it is the first at which the light held us; else the last
    before we passed it, and early enough to stop at its line.
    """
    ride = scene.ride
    time = scene.moment if past else scene.now
    known = [t for t in ride.traces if t.lights and t.road is not None and t.road.lights]
    if past and STATES[wanted] in GREENS:
        held = [h for h in holds(ride, EGO) if h.begin <= max(time, scene.now) + ROUNDING]
        first = [t for h in held[-1:] for t in known if t.sim_time >= h.begin - ROUNDING]
        if first:
            return first[0], held[-1].signal
    if past:
        done = [p for p in passings(ride) if p.time <= scene.now]
        before = [t for p in done[-1:] for t in known if t.sim_time < p.time]
        known = [t for t in before if _can_stop(t, done[-1].signal)] or before or known
    known = [t for t in known if t.sim_time <= scene.now]
    free = [t for t in known if t.under_way is None and past] or known
    if not free:
        raise Unanswered(NotRecorded("not-recorded", since=scene.now))
    trace = free[-1]
    first_ahead = trace.road.lights[0] if trace.road is not None else None
    here = None if first_ahead is None else Signal(first_ahead.controller, first_ahead.place)
    return trace, meant(ride, light, trace.sim_time) or here


def _can_stop(trace: PlanTrace, signal: Signal) -> bool:
    """Check whether a light is so far ahead that we could stop at its line without hard braking."""
    stopping = trace.scene[EGO].speed ** 2 / (2.0 * FOLLOWING)
    lights = () if trace.road is None else trace.road.lights
    return any(one.distance >= stopping for one in lights if _signal(one) == signal)


def _held(again: PlanTrace, signal: Signal) -> bool:
    """Check whether the light holds us under the new plan."""
    found = held_at(again, EGO)
    if found is not None and found[0] == signal:
        return True
    drives = [
        r for r in again.rollouts if r.actions and r.actions[0].action == again.plan[0].action
    ]
    held = sum(any(h.place == signal.index for h in r.held_by_lights) for r in drives)
    return 2 * held > len(drives) > 0


def _held_now(scene: Asked, signal: Signal, state: str) -> tuple[int, ...]:
    """List who would go first now, while we are still before the light.

    Raises:
        Unanswered: the decision in force must be planned again first.
    """
    trace = scene.ride.at(scene.moment)
    again = None if trace is None else with_light(scene.ride, trace, signal, state)
    return () if again is None else _let_go_first(scene.ride, again)


def _let_go_first(ride: Ride, again: PlanTrace) -> tuple[int, ...]:
    """List who would still probably go first under the new plan, the longest hold-up first."""
    try:
        plan = factual(ride.model(again), again)
    except Unanswered:
        return ()
    found = [h for h in hold_ups(plan).values() if h.how == "right-of-way" and h.share >= LIKELY]
    found = [h for h in found if h.began <= again.sim_time + SOON]
    return tuple(h.vehicle for h in sorted(found, key=lambda h: (-h.expected, h.vehicle)))


def _crossing_then(scene: Asked, time: float) -> tuple[int, ...]:
    """List the people who were seen to cross our way when we would have come there, by number."""
    crossed = scene.world.episodes(None, ("cross",), time - AROUND, time + AROUND, object=Ego())
    who = (e.actor.number for e in crossed if isinstance(e.actor, Vehicle))
    looks = ((v, scene.world.look(v, time)) for v in dict.fromkeys(who))
    return tuple(sorted(v for v, look in looks if look is not None and look.kind in ON_FOOT))


def _passing(ride: Ride, trace: PlanTrace, again: PlanTrace, signal: Signal) -> float | None:
    """Return when [s] we would have passed the line, in the mean of the new plan's rollouts."""
    far = [x.distance for x in ahead(ride, trace.sim_time) if _signal(x) == signal]
    if not far:
        return None
    try:
        plan = factual(ride.model(again), again)
    except Unanswered:
        return None
    known, times = lines(again), []
    for result, weight in zip(plan.results, plan.weights, strict=True):
        line = known.get(result.rollout.index)
        if line is None or weight <= 0.0:
            continue
        gone = 0.0
        for k in range(1, len(line.time)):
            gone += 0.5 * (line.speed[k] + line.speed[k - 1]) * (line.time[k] - line.time[k - 1])
            if gone >= far[0]:
                times.append((weight, line.time[k]))
                break
    total = sum(weight for weight, _ in times)
    return sum(w * t for w, t in times) / total if total > 0.5 else None


def _signal(light: Any) -> Signal:
    return Signal(light.controller, light.place)


# --- turning on red -------------------------------------------------------------------------------


def turn_on_red(of: Proposition | None) -> Event | None:
    """Find the turn of ours that the question says we do not make on red."""
    inner, negated = unwrapped(of)
    return turns_on_red(inner) if negated else None


def turns_on_red(of: Proposition | None) -> Event | None:
    """Find the turn of ours on red that a proposition says we make, or may make."""
    match of:
        case Happens(event=event) | Is(state="allowed", event=Event() as event) if is_own(
            event.actor
        ):
            pass
        case _:
            return None
    light = light_in(event.object, None if event.where is None else event.where.to)
    on_red = light is not None and light.colour == "red"
    return event if on_red and event.action in TURNS else None


def why_not_turn(question: Why, scene: Asked) -> Answer:
    """Explain why we do not turn on red: what the light on our way shows, and where that leads."""
    return _turning(turn_on_red(question.of), scene)


def whether_turn(question: Whether, scene: Asked) -> Answer:
    """Return whether we may turn on red, by the same facts."""
    return _turning(turns_on_red(unwrapped(question.that)[0]), scene)


def _turning(event: Event | None, scene: Asked) -> Answer:
    assert event is not None
    one = shown_at(scene.ride, Feature("light"), scene.now)
    road = scene.world.road(scene.now)
    step = next(iter(() if road is None else road.route), None)
    way = None if step is None else TURNS.get(step.turn)
    return TurnOnRed(one, way, TURNS[event.action])
