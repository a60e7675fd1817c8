"""Counts of the rides on one network, or on all of them."""

from collections.abc import Sequence

import msgspec

from benchmarks.figures import mean, quantile
from benchmarks.foreign import pdm
from benchmarks.foreign.riding import Driven, Ridden


class Counted(msgspec.Struct, frozen=True):
    """Counts of what one driver did in some rides."""

    arrived: int
    collisions: int  # rides that ended in one
    caused: int  # collisions that it caused
    lights: int  # traffic lights passed
    reds: int  # lights passed on red
    crossings: int  # driven over while somebody on foot was there
    violated: int  # crossings driven over against the rule
    limits: int  # times that a speed limit was violated
    off_road: int  # rides in which it left the road
    hard_brakes: int
    provoked: int  # hard brakes of others
    comfort: float | None  # share of the time within bounds
    score: float | None  # see `pdm`


class Tally(msgspec.Struct, frozen=True):
    """Rides in numbers."""

    site: str
    rides: int
    loaded: int  # rides that could be chosen
    failed: int  # rides that ended with an error
    ours: Counted
    sumo: Counted
    missed: int  # rides in which SUMO's driver arrives and we do not
    time_ratio: float | None  # our total time over that of SUMO's driver, where both arrive
    company: float | None  # average number of others in view
    decision_p50: float | None  # [ms]
    decision_p99: float | None  # [ms]
    start_up: float | None  # [s] mean


def tally(site: str, rides: Sequence[Ridden]) -> Tally:
    """Count some rides."""
    pairs = [(x.ours, x.sumo) for x in rides if x.ours is not None and x.sumo is not None]
    both = [(a.drive.time, b.drive.time) for a, b in pairs if arrived(a) and arrived(b)]
    taken = [one.ms for ride in rides for one in ride.decisions]
    started = [ride.start_up for ride in rides if ride.start_up is not None]
    longer = sum(b for _, b in both)
    return Tally(
        site=site,
        rides=len(rides),
        loaded=sum(ride.place is not None for ride in rides),
        failed=sum(ride.place is not None and ride.error is not None for ride in rides),
        ours=_counted(pairs),
        sumo=_counted([(b, a) for a, b in pairs]),
        missed=sum(arrived(b) and not arrived(a) for a, b in pairs),
        time_ratio=round(sum(a for a, _ in both) / longer, 3) if longer > 0.0 else None,
        company=_rounded(mean([a.conduct.company for a, _ in pairs]), 1),
        decision_p50=_rounded(quantile(taken, 50) if taken else None, 1),
        decision_p99=_rounded(quantile(taken, 99) if taken else None, 1),
        start_up=_rounded(mean(started), 2),
    )


def arrived(driven: Driven) -> bool:
    """Check whether a driver reached the goal."""
    return driven.drive.ended == "arrived"


def score(own: Driven, other: Driven) -> float:
    """Return the score of one driver, given another in the same ride."""
    parts = {
        "progress": pdm.progress(own.conduct.travelled, other.conduct.travelled),
        "time_to_collision": own.conduct.time_to_collision,
        "comfort": own.conduct.comfort,
    }
    off_road = bool(own.conduct.off_road)
    return pdm.score(collided=own.drive.caused, off_road=off_road, parts=parts)


def _counted(pairs: Sequence[tuple[Driven, Driven]]) -> Counted:
    """Return the counts of the first driver of each pair, given the second."""
    drives, conducts = [a.drive for a, _ in pairs], [a.conduct for a, _ in pairs]
    return Counted(
        arrived=sum(arrived(a) for a, _ in pairs),
        collisions=sum(bool(one.hits) for one in drives),
        caused=sum(one.caused for one in drives),
        lights=sum(one.lights for one in conducts),
        reds=sum(len(one.reds) for one in conducts),
        crossings=sum(one.crossings for one in conducts),
        violated=sum(len(one.violated) for one in conducts),
        limits=sum(len(one.limits) for one in conducts),
        off_road=sum(bool(one.off_road) for one in conducts),
        hard_brakes=sum(one.hard_brakes for one in drives),
        provoked=sum(one.provoked for one in drives),
        comfort=_rounded(mean([one.comfort for one in conducts]), 3),
        score=_rounded(mean([score(a, b) for a, b in pairs]), 3),
    )


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)
