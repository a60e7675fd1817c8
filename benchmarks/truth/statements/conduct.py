"""Statements about giving way, lanes, manoeuvres and delays."""

import re
from collections.abc import Iterator

from benchmarks.truth.context import Fault, Said, claim, near, rounded
from planner.record.trace import PlanTrace
from sim.scene import EGO


@claim(
    r"(?P<who>V\d+|[Ii]t) (?P<be>is|was|has been)(?: still)? (?:giving way to|waiting for)"
    r" (?P<whom>V\d+|us|it)\b"
)
def gives_way(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle gives way: slow or braking, with the other near and not past."""
    span = said.when(match["be"] == "was")

    def yields(vehicle: int, time: float) -> bool:
        state = said.ride.state(vehicle, time)
        if state is None or (state.speed > 4.0 and state.acceleration > -0.3):
            return False
        return any(_party(said, vehicle, other, time) for other in said.who(match["whom"]))

    if not said.some(match["who"], span, yields):
        speeds = rounded(said.speeds(match["who"], span))
        yield Fault("gives way", f"{match[0]}: {speeds} km/h")


def _party(said: Said, vehicle: int, other: int, time: float) -> bool:
    """Check whether another vehicle is ahead of a vehicle and near, and has not passed."""
    seen, theirs = said.ride.offset(vehicle, other, time), said.ride.offset(other, vehicle, time)
    if seen is None or theirs is None:
        return False
    gap = said.ride.gap(vehicle, other, time)
    return seen[0] > 0.0 and gap is not None and gap < 80.0 and (theirs[0] > -6.0 or gap < 12.0)


@claim(r"I am waiting for (?P<whom>V\d+)", r"I (?:have to|am ready to) let (?P<whom>V\d+) go first")
def we_wait(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle that we wait for has not passed, and that we are slow."""
    known = [v for v in said.who(match["whom"]) if _party(said, EGO, v, said.now)]
    speed = min(said.speeds("we", (said.now - 1.0, said.now)), default=0.0)
    if not known:
        yield Fault("we wait for one past", match[0])
    elif "waiting" in match[0] and speed > 20.0:
        yield Fault("we wait at speed", f"{match[0]}: {speed:.0f} km/h")


@claim(r"ready to give way(?: to (?P<whom>V\d+|it))?(?: that came from the \w+)? ?(?:at|to) ")
def ready_to_give_way(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a junction with a duty to give way was near."""
    past = "had to" in said.text
    start, end = said.when(past)

    def near_junction(trace: PlanTrace) -> bool:
        steps = () if trace.road is None else trace.road.route[:1]
        inside = trace.road is not None and EGO in trace.road.places
        inside = inside and trace.road is not None and trace.road.places[EGO].in_junction
        return inside or any(s.rule != "priority" and s.distance < 70.0 for s in steps)

    if not any(near_junction(t) for t in said.ride.decided(start - 1.0, end)):
        yield Fault("no junction to give way at", said.text)


@claim(
    r"(?P<yes>[Ww]e ha(?:ve|d)) right of way, and (?P<who>V\d+) ha(?:s|d) to give way",
    r"(?P<who>V\d+) ha(?P<be>s|d) right of way, so I ha(?:ve|d) to give way",
)
def right_of_way(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the statement of who goes first, by the roads."""
    first = "ego" if "yes" in match.groupdict() else "vehicle"
    past = "had" in match[0]
    traces = said.ride.decided(0.0 if past else said.now, said.now)
    facts = [
        f.who
        for t in traces
        if t.road
        for f in t.road.priority
        if f.vehicle in said.who(match["who"])
    ]
    if first not in facts and "depends" not in facts:
        yield Fault("right of way", f"{match[0]}: {sorted(set(facts))}")


@claim(r"there (?P<be>is|was) no lane to the (?P<side>left|right)")
def no_lane(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that there is no lane on that side."""
    past = match["be"] == "was"
    start = 0.0 if past else said.now
    reasons = [f"no lane to the {match['side']}", "only lane"]
    places = [
        p for t in said.ride.decided(start, said.now) if t.road and (p := t.road.places.get(EGO))
    ]
    free = [
        p for p in places
        if p.lane is not None and (p.lane + 1 < p.lanes if match["side"] == "left" else p.lane > 0)
    ]  # fmt: skip
    if places and len(free) == len(places) and reasons:
        yield Fault("lanes", f"{match[0]}: lane {places[-1].lane} of {places[-1].lanes}")


@claim(r"[Ww]e are in the (?P<lane>right|left|middle|only) lane(?: of (?P<count>\w+))?")
def lane_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check which lane we are in."""
    place = said.ride.place(EGO, said.now)
    if place is None or place.lane is None:
        return
    rank = {"right": 0, "left": place.lanes - 1, "only": 0}.get(match["lane"])
    if rank is not None and place.lane != rank:
        yield Fault("lanes", f"{match[0]}: lane {place.lane} of {place.lanes}")


MANOEUVRES = {"moved to the left": "change-left", "moved to the right": "change-right"}


@claim(r"I (?P<did>moved to the left|moved to the right)(?: lane)?(?P<rest>[^.;]*)")
def lane_change(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that we made the stated manoeuvre."""
    action, at = MANOEUVRES[match["did"]], said.told(match["rest"])
    start, end = (0.0, said.now) if at is None else (at[0] - 6.0, at[1] + 6.0)
    done = [e for e in said.ride.events if e.action == action and start <= e.sim_time <= end]
    if not done and not re.search(r"did not|would|if I", said.text):
        yield Fault("manoeuvre", match[0])


@claim(r"I (?P<did>braked|stopped)(?: hard)?(?P<rest> at \d+:\d\d| about [\w. ]+? seconds? ago)")
def braked_at(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that we braked or stood at the stated time."""
    at = said.told(match["rest"])
    if at is None:
        return
    start, end = at[0] - 1.5, at[1] + 1.5
    found = [b for b in said.ride.brakings(said.now) if b[0] <= end and b[1] >= start]
    if match["did"] == "stopped":
        held = said.speeds("we", (start, end + 2.0))
        if not held or min(held) > 3.0:
            yield Fault("manoeuvre", f"{match[0]}: {rounded(held)}")
    elif not found:
        yield Fault("manoeuvre", match[0])


@claim(
    r"[Tt]hat cost us (?:about )?(?P<time>half a|[\d.]+) seconds?",
    r"[Tt]hat made no difference to the time",
)
def delay_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a stated delay is below the time lost, and not "none" after a long halt."""
    lost, stood = 0.0, 0.0
    for a, b in zip(said.ride.span(0.0, said.now), said.ride.span(0.0, said.now)[1:], strict=False):
        state, place = said.ride.state(EGO, a), said.ride.place(EGO, a)
        if state is not None and place is not None:
            lost += (b - a) * max(0.0, 1.0 - state.speed / place.limit)
            stood += (b - a) * (state.speed < 0.5)
    told = match.groupdict().get("time")
    value = 0.0 if told is None else 0.5 if told == "half a" else float(told)
    if value > lost + 3.0:
        yield Fault("delay", f"{match[0]}: at most {lost:.0f} s")
    if re.search(r"have we lost|cost us time", said.question) and value + 3.0 < 0.5 * stood:
        yield Fault("delay", f"{match[0]}: stood for {stood:.0f} s")


@claim(r"(?:doing|driving at|driving steadily at) (?P<speed>\d+) km/h, over the limit")
def over_limit(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a speed is over the limit."""
    limit = re.search(r"limit of (\d+)", said.text)
    if limit and float(match["speed"]) <= float(limit[1]):
        yield Fault("yes and no", match[0])


@claim(r"there is nobody (?P<where>ahead of|behind) us|[Nn]obody is (?P<also>ahead of|behind) us")
def nobody(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that nobody is ahead of us, or behind us, in our lane."""
    where = match["where"] or match["also"]
    for vehicle in said.ride.moments[said.ride.index(said.now)].scene.vehicles:
        seen = said.ride.offset(EGO, vehicle, said.now) if vehicle != EGO else None
        if seen is None or abs(seen[1]) > 1.5 or abs(seen[2]) > 0.4 or abs(seen[0]) > 50.0:
            continue
        if (seen[0] > 4.0) == (where == "ahead of") and abs(seen[0]) > 4.0:
            yield Fault("nobody", f"{match[0]}: vehicle {vehicle} at {seen[0]:.0f} m")


@claim(r"(?:about )?(?P<time>\d+(?:\.\d+)?) seconds?, at (?P<clock>\d+:\d\d)")
def arrival(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the clock time of the arrival fits the time until then."""
    minute, second = match["clock"].split(":")
    at = 60.0 * int(minute) + int(second)
    if not near(at, [said.now + float(match["time"])], 2.6):
        yield Fault("arrival", f"{match[0]} at {said.now:.1f}")
