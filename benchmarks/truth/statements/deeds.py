"""Statements about actions: manoeuvres, overtaking, going first, distance and speed."""

import math
import re
from collections.abc import Iterator
from itertools import pairwise

from benchmarks.truth.context import Fault, Said, claim, near, rounded
from benchmarks.truth.statements.chances import risks, told_as
from sim.scene import EGO

DOING = {
    "moving to the left lane": "change-left",
    "moving to the right lane": "change-right",
    "turning right": "exit-right",
    "turning left": "exit-left",
}
EXITS = ("exit-left", "exit-right", "exit-straight")
DONE = {
    "turned right": ("exit-right",),
    "turned left": ("exit-left",),
    "left the roundabout": EXITS,
}
HARD = -1.5  # [m/s2] acceleration below which braking is obvious
JUST = 3.0  # [s] before the question that count as "just now"
NEARLY = 0.5  # [s] around a decision, within which its reasons were seen


@claim(rf"I am (?P<how>{'|'.join(DOING)})")
def under_way(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the plan in force, or one shortly before, begins with the stated action."""
    action = DOING[match["how"]]
    traces = said.ride.decided(said.now - 1.5, said.now)
    if not any(action in [step.action for step in trace.plan[:2]] for trace in traces):
        begun = [e for e in said.ride.events if e.sim_time <= said.now and e.action == action]
        if not begun or begun[-1].kind == "action-ended":
            yield Fault("manoeuvre now", match[0])


@claim(rf"I (?P<how>{'|'.join(DONE)})(?P<rest> at \d+:\d\d| about [\w. ]+? seconds? ago)")
def turned(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that we made the stated turn at the stated time."""
    at = said.told(match["rest"])
    if at is None:
        return
    done = [
        e for e in said.ride.events
        if e.action in DONE[match["how"]] and at[0] - 8.0 <= e.sim_time <= at[1] + 12.0
    ]  # fmt: skip
    if not done:
        yield Fault("manoeuvre", match[0])


@claim(r"(?P<who>I|V\d+) did not (?:brake|slow down)\.")
def did_not_brake(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle did not brake hard, as stated."""
    who = said.who(match["who"])
    span = said.ride.span(said.now - JUST, said.now)
    states = [s for v in who for t in span if (s := said.ride.state(v, t)) is not None]
    hard = [s.acceleration for s in states if s.acceleration < HARD]
    if len(hard) > 5 and len(who) == 1:
        yield Fault("did brake", f"{match[0]} {min(hard):.1f} m/s2")


@claim(r"(?P<who>V\d+|[Ii]t) overtook us(?P<rest> at \d+:\d\d| about [\w. ]+? seconds? ago|)")
def overtook(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle came past us from behind."""
    at = said.told(match["rest"]) or said.told() or (0.0, said.now)
    for vehicle in said.who(match["who"]):
        seen = [said.ride.offset(EGO, vehicle, t) for t in said.ride.span(at[0] - 8.0, at[1] + 8.0)]
        along = [s[0] for s in seen if s is not None]
        if along and min(along) < 1.0 and max(along[along.index(min(along)) :]) > -1.0:
            return
    yield Fault("overtaking", match[0])


@claim(r"(?P<who>V\d+|[Ii]t) is indicating (?P<side>left|right)")
def indicates(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the lights that a vehicle shows."""
    span = (said.now - 1.1, said.now)
    if not said.some(match["who"], span, lambda v, t: match["side"] in _lights(said, v, t)):
        yield Fault("indicating", match[0])


def _lights(said: Said, vehicle: int, time: float) -> tuple[str, ...]:
    state = said.ride.state(vehicle, time)
    return () if state is None else state.signals


@claim(r"[Ss]o far we have driven about (?P<far>\d+) metres in (?P<time>\d+) seconds")
def driven(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check how far and how long we have driven."""
    times = said.ride.span(0.0, said.now)
    spots = [s.position for t in times if (s := said.ride.state(EGO, t)) is not None]
    arc = sum(math.dist(a, b) for a, b in pairwise(spots))
    if not near(float(match["far"]), [arc], 3.0 + 0.1 * arc):
        yield Fault("distance driven", f"{match[0]}: {arc:.0f}")
    if not near(float(match["time"]), [said.now], 1.6):
        yield Fault("distance driven", f"{match[0]} at {said.now:.1f}")


@claim(r"[Tt]he (?P<which>highest|lowest) speed was (?P<speed>\d+) km/h, at (?P<clock>\d+:\d\d)")
def extreme(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the highest or lowest speed, and its time."""
    found = said.speeds("we", (0.0, said.now))
    value = max(found) if match["which"] == "highest" else min(found)
    at = said.told(match["clock"])
    if re.search(r"\b(we|you)\b", said.question) and not near(float(match["speed"]), [value]):
        yield Fault("highest speed", f"{match[0]}: {value:.0f}")
    elif at is not None and not near(float(match["speed"]), said.speeds("we", at)):
        yield Fault("highest speed", f"{match[0]}: not then")


@claim(r"I had to let (?P<who>V\d+) go first")
def let_go(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle had priority up to now, or that we gave way to it."""
    who = said.who(match["who"])
    gave = [e for e in said.ride.events if e.kind == "gave-way" and e.sim_time <= said.now]
    if any(e.vehicle in who for e in gave):
        return
    traces = said.ride.decided(0.0, said.now)
    first = [f for t in traces if t.road for f in t.road.priority if f.vehicle in who]
    held = [h for t in traces for r in t.rollouts for h in r.held_up if h.vehicle in who]
    if not any(f.who != "ego" for f in first) and not any(h.how == "right-of-way" for h in held):
        yield Fault("let go first", match[0])


@claim(
    r"[Ww]hen I planned it, I put the risk of a collision at "
    r"(?P<under>under |over )?(?P<chance>\d+) %"
)
def risk_planned(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the risk of the plan at the time of planning."""
    traces = [t for t in said.ride.decided(0.0, said.now) if t.plan]
    values = [x for t in traces for x in risks(t, frozenset({t.plan[0].action}), ())]
    if not any(told_as(match, value, 2.0) for value in values):
        yield Fault("risk of what I did", match[0])


@claim(r"I am following (?P<who>V\d+)(?: at (?P<speed>\d+) km/h)?")
def follows(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that we follow a vehicle ahead."""

    def leads(vehicle: int, time: float) -> bool:
        seen = said.ride.offset(EGO, vehicle, time)
        return seen is not None and seen[0] > 2.0 and abs(seen[2]) < 1.2

    if not said.some(match["who"], (said.now - 0.3, said.now), leads):
        yield Fault("following", match[0])
    speeds = said.speeds("we", (said.now - 0.15, said.now))
    if match["speed"] and not near(float(match["speed"]), speeds):
        yield Fault("speed now", f"{match[0]}: {rounded(speeds)}")


@claim(r"[Nn]o, there is no vehicle (?P<where>on our left|on our right|behind us|ahead of us)")
def nobody_there(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that nobody is right beside us, or in our lane behind or ahead."""
    for vehicle in said.ride.moments[said.ride.index(said.now)].scene.vehicles:
        seen = said.ride.offset(EGO, vehicle, said.now) if vehicle != EGO else None
        if seen is None:
            continue
        ahead, left, _ = seen
        side = left if "left" in match["where"] else -left
        beside = 2.0 < side < 5.0 and abs(ahead) < 4.0
        along = ahead if "ahead" in match["where"] else -ahead
        in_lane = abs(left) < 1.5 and 4.0 < along < 40.0
        if beside if "our" in match["where"] else in_lane:
            yield Fault("nobody", f"{match[0]}: vehicle {vehicle}, {ahead:.0f}, {left:.0f} m")


@claim(r"[Tt]he gap between us and (?P<who>V\d+) is about (?P<far>[\d.]+) metres?")
def gap_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the gap to a vehicle."""
    gaps = [g for v in said.who(match["who"]) if (g := said.ride.gap(EGO, v, said.now)) is not None]
    if not near(float(match["far"]), gaps, 1.5 + 0.15 * float(match["far"])):
        yield Fault("distance", f"{match[0]}: {rounded(gaps)}")


@claim(r"(?P<who>V\d+) is (?P<speed>\d+) km/h (?P<how>faster|slower) than us")
def faster_by(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check how much faster or slower than us a vehicle is."""
    ours = said.speeds("we", (said.now - 0.15, said.now))
    theirs = said.speeds(match["who"], (said.now - 0.15, said.now))
    sign = 1.0 if match["how"] == "faster" else -1.0
    gaps = [sign * (b - a) for a in ours for b in theirs]
    if not near(float(match["speed"]), gaps):
        yield Fault("speed now", f"{match[0]}: {rounded(gaps)}")


@claim(r"(?P<who>V\d+) (?:is|was) driving at only (?P<speed>\d+) km/h in that lane")
def slow_in_that_lane(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle is in a lane beside ours, and drives at the stated speed."""
    decided = said.now if said.decision is None else said.decision.trace.sim_time
    span = (decided - NEARLY, decided + NEARLY)

    def aside(vehicle: int, time: float) -> bool:
        seen = said.ride.offset(EGO, vehicle, time)
        return seen is not None and 1.5 < abs(seen[1]) < 6.0

    if not said.some(match["who"], span, aside):
        yield Fault("place", match[0])
    if not near(float(match["speed"]), speeds := said.speeds(match["who"], span)):
        yield Fault("speed", f"{match[0]}: {rounded(speeds)}")
