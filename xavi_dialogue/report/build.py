"""Building the content of a report from a ride. The same ride and moment give the same content."""

import hashlib
from itertools import pairwise

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue import __version__
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.process.program import program_hash
from xavi_dialogue.report.content import (
    SCHEMA,
    Chosen,
    Examined,
    Hashes,
    Incident,
    Subject,
    TraceHash,
)
from xavi_dialogue.report.decisions.alternatives import Avoidability
from xavi_dialogue.report.decisions.avoiding import avoidability
from xavi_dialogue.report.decisions.believed import beliefs
from xavi_dialogue.report.decisions.cases import cases
from xavi_dialogue.report.decisions.jumps import jumps
from xavi_dialogue.report.decisions.weighed import decided, row
from xavi_dialogue.report.limits import AFTER, BEFORE, limitations
from xavi_dialogue.report.moments import ReportError, choose
from xavi_dialogue.report.ridden import Inquiry, Ridden
from xavi_dialogue.report.road_users.maps import strip
from xavi_dialogue.report.road_users.observed import course, gaps, lights, precedence
from xavi_dialogue.report.road_users.parties import parties
from xavi_dialogue.report.road_users.tracks import tracks_of
from xavi_dialogue.report.timeline import timeline
from xavi_dialogue.storage.ride_file import RecordedRide, dump

SUPPOSED = 3  # of those involved, in how many the world is changed
TESTED = {"in-force", "last-change", "last-chance"}  # what is planned again with changes


def build(ridden: Ridden, at: float | str | None = None) -> Incident:
    """Make the report of a moment.

    Args:
        ridden: the ride.
        at: a time [s], or "collision", "hardest braking", "closest approach", "red light".
            Default: the most remarkable moment.

    Raises:
        ReportError: there is no such moment, or no decision in the ride.
    """
    moment = moment_of(ridden, at)
    since = max(moment.time - BEFORE, ridden.begin)
    until = min(moment.time + AFTER, ridden.end)
    window, inquiry = (since, until), Inquiry(ridden, until)
    tracks = tracks_of(ridden, _next_decision(ridden, until))
    involved = parties(inquiry, tracks, moment, window)
    others = tuple(party.vehicle for party in involved)
    lit = lights(ridden, window)
    avoided = avoidability(inquiry, tracks, moment, since)
    examined = _examined(ridden, moment, window, avoided)
    shown = [trace for trace, why in examined if TESTED.intersection(why)]
    believed = tuple(beliefs(inquiry, tracks, vehicle, window, shown) for vehicle in others)
    tested = tuple(cases(inquiry, trace, others[:SUPPOSED]) for trace in shown)
    traces = ridden.record.traces
    return Incident(
        schema=SCHEMA,
        subject=_subject(ridden),
        moment=moment,
        since=since,
        until=until,
        involved=involved,
        bystanders=_bystanders(ridden, window, others),
        timeline=timeline(inquiry, tracks, moment, window, lit, believed),
        map=strip(ridden, tracks, moment.time, window, others),
        motions=tuple(course(tracks, vehicle, window) for vehicle in (EGO, *others)),
        gaps=tuple(gaps(tracks, vehicle, window) for vehicle in others),
        lights=lit,
        precedence=precedence(ridden, window),
        beliefs=believed,
        jumps=jumps(ridden.between(*window), tracks, others),
        decisions=tuple(
            row(ridden, trace, traces[k - 1] if k else None)
            for k, trace in enumerate(traces)
            if since <= trace.sim_time <= until
        ),
        decided=tuple(decided(trace, why) for trace, why in examined),
        cases=tested,
        avoidability=avoided,
        limits=limitations(inquiry, moment.time, window, others, tested),
        hashes=_hashes(ridden, window),
    )


def moment_of(ridden: Ridden, at: float | str | None) -> Chosen:
    """Return the moment that a report is about.

    Raises:
        ReportError: as `build` says.
    """
    if not ridden.record.traces:
        raise ReportError("the ride holds no decision; drive it again, and longer")
    return choose(ridden, tracks_of(ridden, ridden.end), at)


def _next_decision(ridden: Ridden, until: float) -> float:
    """Return when [s] the next decision knows what was seen up to a time."""
    return next((t.sim_time for t in ridden.record.traces if t.sim_time >= until), until)


def _examined(
    ridden: Ridden, moment: Chosen, window: tuple[float, float], avoided: Avoidability | None
) -> list[tuple[PlanTrace, tuple[Examined, ...]]]:
    """Return the decisions that are shown in full, oldest first, with the reasons.

    They are the one in force, every one with another first action than the one before it, and
    the last ones from which the mishap could still be avoided, on the way to the goal or off it.
    """
    found: dict[int, list[Examined]] = {}
    known = ridden.between(window[0], moment.time)
    if known:
        found.setdefault(known[-1].decision, []).append("in-force")
    changed = [
        b
        for a, b in pairwise(ridden.record.traces)
        if planned(a)[:1] != planned(b)[:1] and window[0] <= b.sim_time <= window[1]
    ]
    before = [trace.decision for trace in changed if trace.sim_time <= moment.time + 1e-6]
    for trace in changed:
        last_one = trace.decision in before[-1:]
        found.setdefault(trace.decision, []).append("last-change" if last_one else "changed")
    if avoided is not None:
        on_route, last = avoided.last_on_route, avoided.last
        if on_route is not None:
            found.setdefault(on_route, []).append("last-chance")
        if last is not None and last != on_route:
            found.setdefault(last, []).append("last-way")
    return [(t, tuple(found[t.decision])) for t in ridden.record.traces if t.decision in found]


def _bystanders(
    ridden: Ridden, window: tuple[float, float], involved: tuple[int, ...]
) -> tuple[int, ...]:
    """Return the others that decisions of the window [s] had in view."""
    seen = {vehicle for trace in ridden.between(*window) for vehicle in trace.scene}
    return tuple(sorted(seen - {EGO, *involved}))


def _subject(ridden: Ridden) -> Subject:
    record, first = ridden.record, ridden.record.traces[0]
    return Subject(
        scenario=record.scenario,
        seed=record.seed,
        car=first.vehicle,
        begin=ridden.begin,
        end=ridden.end,
        decisions=len(record.traces),
        scenes=len(ridden.scenes),
        settings=first.settings,
    )


def _hashes(ridden: Ridden, window: tuple[float, float]) -> Hashes:
    record = ridden.record
    bare = RecordedRide(record.scenario, record.seed, record.halt, record.traces, record.events,
                        record.ended)  # fmt: skip
    return Hashes(
        ride=hashlib.sha256(dump(bare)).hexdigest(),
        file=ridden.file,
        network=record.traces[0].network,
        traces=tuple(
            TraceHash(trace.decision, trace.sim_time, trace.trace_id)
            for trace in ridden.between(*window)
        ),
        program=program_hash(),
        version=__version__,
    )
