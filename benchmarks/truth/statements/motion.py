"""Statements about speeds, distances, places and standing still."""

import math
import re
from collections.abc import Iterator

from benchmarks.truth.context import KMH, NUMBERS, WHO, Fault, Said, claim, near, rounded
from benchmarks.truth.mentions import placed
from sim.scene import EGO

BE = r"(?P<be>is|are|was|were)"
SPEED = r"(?P<speed>\d+) km/h"
FAR = r"(?:about )?(?P<far>\d+(?:\.\d+)?) metres?"


def past(match: re.Match[str]) -> bool:
    """Check whether a statement is about the past."""
    return match["be"] in ("was", "were")


@claim(
    rf"{WHO} {BE} (?:driving (?:steadily )?at|doing|speeding up, now at|braking, now at) {SPEED}",
    rf"{WHO} {BE} (?:driving )?(?:ahead of us|behind us)(?: on the \w+)?,? (?:at|doing|braking, now"
    rf" at|speeding up, now at) {SPEED}",
)
def speed_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check a speed, now or then."""
    then = past(match)
    found = said.speeds(match["who"], said.when(then))
    if not near(float(match["speed"]), found):
        kind = "speed then" if then else "speed now"
        yield Fault(kind, f"{match[0]}: {rounded(found)}")


@claim(rf"{WHO} {BE} driving ahead of us at {SPEED}")
def sets_the_pace(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle ahead, given as a reason, is near and not much faster than us."""
    if "because" not in said.text or not re.search(r"brak|slow|wait|stop|We are dr", said.text):
        return

    def paces(vehicle: int, time: float) -> bool:
        seen, ego = said.ride.offset(EGO, vehicle, time), said.ride.state(EGO, time)
        other = said.ride.state(vehicle, time)
        if seen is None or ego is None or other is None:
            return False
        near_enough = 0.0 < seen[0] <= max(25.0, 5.0 * ego.speed)
        return near_enough and abs(seen[2]) < 1.2 and other.speed <= ego.speed + 2.0

    span = said.when(past(match))
    if not said.some(match["who"], (span[0] - 0.5, span[1]), paces):
        yield Fault("leader no reason", match[0])


@claim(
    rf"{WHO} {BE} (?P<how>speeding up|braking) from (?P<low>\d+) to (?P<high>\d+) km/h",
    rf"{WHO} (?P<be>braked|sped up) from (?P<low>\d+) to (?P<high>\d+) km/h(?P<rest>[^;.]*)",
)
def change_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check a vehicle's change of speed."""
    low, high = float(match["low"]), float(match["high"])
    rest = match.groupdict().get("rest") or ""
    if match["be"] in ("is", "are", "am"):
        told: tuple[float, float] = (said.now - 15.0, said.now)
        if not near(high, said.speeds(match["who"], (said.now - 0.15, said.now))):
            yield Fault("speed now", f"{match[0]}")
    else:
        at = said.told(rest)
        told = (0.0, said.now) if at is None else (at[0] - 8.0, at[1] + 12.0)
    found = said.speeds(match["who"], told)
    if not (near(low, found) and near(high, found)):
        yield Fault("change of speed", f"{match[0]}: {rounded(found)}")
    if (low < high) == (match.groupdict().get("how") == "braking" or match["be"] == "braked"):
        yield Fault("change of speed", f"{match[0]}: the wrong way")


@claim(r"(?:I am|we are) (?P<how>braking|speeding up) from (?P<low>\d+) to (?P<high>\d+) km/h")
def own_change(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check our present change of speed."""
    found = said.speeds("we", (said.now - 0.15, said.now))
    if not near(float(match["high"]), found):
        yield Fault("speed now", f"{match[0]}: {rounded(found)}")
    if not near(float(match["low"]), said.speeds("we", (said.now - 15.0, said.now))):
        yield Fault("change of speed", match[0])


@claim(
    rf"(?P<first>[Ww]e) {BE} {FAR} away from (?P<who>V\d+|it)",
    rf"{WHO} {BE} (?:[^;:.]*, )?{FAR} away(?! from V)",
)
def distance_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check a distance to a vehicle."""
    if match["who"] in ("We", "we", "I"):
        return
    told = float(match["far"])
    span = said.when(past(match))
    times = said.ride.span(*span) or [said.now]
    found = [
        gap
        for v in said.who(match["who"])
        for time in times
        if (gap := said.ride.gap(EGO, v, time)) is not None
    ]
    if not near(told, found, 1.2 + 0.12 * told):
        yield Fault("distance", f"{match[0]}: {rounded(found)}")


@claim(
    r"[Ww]e came as close as (?P<far>[\d.]+) metres? to (?P<who>V\d+|it)(?P<rest>[^;.]*)",
    r"(?P<who>V\d+|[Ii]t) came (?:no closer than|as close as) (?P<far>[\d.]+) metres? to us"
    r"(?P<rest>[^;.]*)",
)
def closest_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check how close a vehicle came."""
    told, at = float(match["far"]), said.told(match["rest"])
    lowest = [
        min(
            (gap, time)
            for time in said.ride.span(0.0, said.now)
            if (gap := said.ride.gap(EGO, v, time)) is not None
        )
        for v in said.who(match["who"])
        if any(said.ride.gap(EGO, v, time) is not None for time in said.ride.span(0.0, said.now))
    ]
    gaps = [gap for gap, _ in lowest]
    if " then" in match["rest"]:
        gaps.append(told)
    if not near(told, gaps, 0.8 + 0.1 * told):
        yield Fault("closest", f"{match[0]}: {rounded(gaps)}")
    elif at is not None:
        then = [
            said.ride.gap(EGO, v, t) for v in said.who(match["who"]) for t in said.ride.span(*at)
        ]
        if not near(told, [gap for gap in then if gap is not None], 0.8 + 0.1 * told):
            yield Fault("closest", f"{match[0]}: not at that time")


@claim(
    r"(?P<who>V\d+|[Ii]t) (?P<be>is|was|has been)(?: still)? standing(?: still)?"
    r"(?P<way> in our way)?"
)
def stands(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle stands, and that it is in our way if so stated."""
    span = said.when(past(match))

    def still(vehicle: int, time: float) -> bool:
        state = said.ride.state(vehicle, time)
        return state is not None and state.speed < 0.7

    def in_way(vehicle: int, time: float) -> bool:
        seen = said.ride.offset(EGO, vehicle, time)
        return seen is not None and 0.0 < seen[0] < 70.0 and abs(seen[1]) < 25.0

    if not said.some(match["who"], span, still):
        yield Fault("standing", f"{match[0]}: {rounded(said.speeds(match['who'], span))} km/h")
    elif match["way"] and not said.some(match["who"], span, in_way):
        yield Fault("in our way", match[0])


@claim(
    rf"{WHO} (?P<be>is|are|am) (?P<not>not )?"
    r"(?P<how>braking|speeding up|standing still|driving steadily)"
)
def now_doing(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check what a vehicle does now."""
    span = (said.now - 0.8, said.now)
    if "whether" in said.text:
        return
    if (
        match["how"] == "standing still"
        and match["who"] not in ("We", "we", "I")
        and not match["not"]
    ):
        return

    def does(vehicle: int, time: float) -> bool:
        state = said.ride.state(vehicle, time)
        if state is None:
            return False
        return {
            "braking": state.acceleration < -0.25,
            "speeding up": state.acceleration > 0.1,
            "standing still": state.speed < 0.7,
            "driving steadily": abs(state.acceleration) < 0.8 and state.speed > 0.3,
        }[match["how"]]

    if said.some(match["who"], span, does) == bool(match["not"]):
        inside = said.some(match["who"], span, lambda v, t: not does(v, t))
        if not (match["not"] and inside):
            yield Fault("doing now", match[0])


@claim(r"\bV(?P<who>\d+)")
def place_of(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle is where its description says."""
    mention = said.mentions[int(match["who"])]
    if mention.place is None or not mention.numbered:
        return
    span = (0.0, said.now) if mention.past else (said.now - 0.15, said.now)
    if mention.past or not said.some(
        f"V{match['who']}", span, lambda v, _: said.ride.state(v, said.now) is not None
    ):
        span = (0.0, said.now)
    if not said.some(
        f"V{match['who']}", span, lambda v, t: placed(said.ride, v, mention.place or "", t)
    ):
        yield Fault("place", mention.text)


@claim(
    r"(?P<who>V\d+|[Ii]t) (?P<be>is|was) (?P<place>(?:right )?(?:ahead of|behind|beside) us"
    r"(?: on the \w+)?|on our \w+|coming from the \w+|coming towards us)"
)
def place_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the stated place of a vehicle."""
    span = said.when(past(match))
    if not said.some(match["who"], span, lambda v, t: placed(said.ride, v, match["place"], t)):
        yield Fault("place", match[0])


@claim(
    r"(?P<yes>Yes|No), V\d+ (?:is|was) (?:not )?faster than us: it (?:is|was) "
    r"(?:standing still|doing (?P<its>\d+) km/h), and we (?:are|were) "
    r"(?:standing still|doing (?P<ours>\d+) km/h)"
)
def faster(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check a yes or no about who is faster, by the speeds stated with it."""
    its, ours = int(match["its"] or 0), int(match["ours"] or 0)
    if (match["yes"] == "Yes") != (its > ours):
        yield Fault("yes and no", match[0])


@claim(
    r"[Ff]rom (?P<speed>\d+) km/h I need about (?P<need>[\d.]+) metres to stop, "
    r"and it is (?:only )?about (?P<far>[\d.]+) metres ahead"
)
def stopping(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the speed from which we have to stop, and the distance to the vehicle."""
    if not near(float(match["speed"]), said.speeds("we", (said.now - 0.15, said.now))):
        yield Fault("speed now", match[0])
    gaps = [g for v in said.last() if (g := said.ride.gap(EGO, v, said.now)) is not None]
    seen = [o for v in said.last() if (o := said.ride.offset(EGO, v, said.now)) is not None]
    gaps += [ahead - 5.0 for ahead, _, _ in seen]
    if not near(float(match["far"]), gaps, 2.5 + 0.15 * float(match["far"])):
        yield Fault("distance", f"{match[0]}: {rounded(gaps)}")


@claim(r"because the speed limit (?:here )?(?P<be>is|was|allows) (?P<limit>\d+) km/h")
def at_the_limit(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a speed limit, given as a reason, is about our speed."""
    ours = said.speeds("we", said.when(past(match)))
    if not near(float(match["limit"]), ours, 5.0):
        yield Fault("limit no reason", f"{match[0]}: {rounded(ours)}")


@claim(r"limit (?:here |there |of )?(?:(?:is|was|of|allows) )?(?P<limit>\d+) km/h")
def limit_told(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check a speed limit."""
    span = said.told() or (0.0 if "was" in match[0] else said.now - 1.5, said.now)
    places = [said.ride.place(v, t) for t in said.ride.span(*span) for v in (EGO, *said.last())]
    limits = [KMH * place.limit for place in places if place is not None]
    if limits and not any(abs(limit - float(match["limit"])) < 1.0 for limit in limits):
        yield Fault("limit", f"{match[0]}: {rounded(limits)}")


@claim(r"safe speed")
def bend(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the road bends where we slow down for a bend."""
    ahead = re.search(r"about (\d+) metres ahead", said.text)
    span = said.when("had to" in said.text or "took" in said.text)
    turns = []
    for time in said.ride.span(*span)[::3] or [said.now]:
        speed = max(3.0, (said.speeds("we", (time, time)) or [3.0])[0] / KMH)
        until = time + 3.0 + (float(ahead[1]) if ahead else 40.0) / speed * 1.6
        turns.append(abs(said.ride.turned(EGO, time - 1.0, until)))
    if turns and max(turns) < math.radians(12.0):
        yield Fault("no bend", f"{said.text}: {math.degrees(max(turns)):.0f} degrees")


@claim(r"(?P<count>one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve) vehicles?")
def count_seen(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the number of vehicles in view."""
    if not re.search(r"^I (?:can )?see", said.text):
        return
    visible = len(said.ride.moments[said.ride.index(said.now)].scene.vehicles) - 1
    if NUMBERS[match["count"]] != visible:
        yield Fault("count", f"{match[0]}: {visible}")
