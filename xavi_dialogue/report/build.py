"""Building the content of a report from a ride. The same ride and moment give the same content."""

import hashlib

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue import __version__
from xavi_dialogue.process.program import program_hash
from xavi_dialogue.report.avoiding import avoidability
from xavi_dialogue.report.believed import beliefs
from xavi_dialogue.report.cases import cases
from xavi_dialogue.report.content import (
    SCHEMA,
    Avoidability,
    Chosen,
    Hashes,
    Report,
    Subject,
    TraceHash,
)
from xavi_dialogue.report.limits import AFTER, BEFORE, limitations
from xavi_dialogue.report.maps import strip
from xavi_dialogue.report.moments import ReportError, choose
from xavi_dialogue.report.observed import course, gaps, lights, precedence
from xavi_dialogue.report.parties import parties
from xavi_dialogue.report.ridden import Inquiry, Ridden
from xavi_dialogue.report.timeline import timeline
from xavi_dialogue.report.tracks import tracks_of
from xavi_dialogue.report.weighed import decided, row
from xavi_dialogue.storage.ride_file import RecordedRide, dump

SUPPOSED = 3  # of those involved, in how many the world is changed


def build(ridden: Ridden, at: float | str | None = None) -> Report:
    """Make the report of a moment.

    Args:
        ridden: the ride.
        at: a time [s], or "collision", "hardest braking", "closest approach", "red light".
            Default: the most remarkable moment.

    Raises:
        ReportError: there is no such moment, or no decision in the ride.
    """
    if not ridden.record.traces:
        raise ReportError("the ride holds no decision; drive it again, and longer")
    moment = choose(ridden, tracks_of(ridden, ridden.end), at)
    since = max(moment.time - BEFORE, ridden.begin)
    until = min(moment.time + AFTER, ridden.end)
    window, inquiry = (since, until), Inquiry(ridden, until)
    tracks = tracks_of(ridden, until)
    involved = parties(inquiry, tracks, moment, window)
    others = tuple(party.vehicle for party in involved)
    lit = lights(ridden, window)
    believed = tuple(beliefs(ridden, vehicle, window) for vehicle in others)
    avoided = avoidability(inquiry, tracks, moment, since)
    here = ridden.decision_at(moment.time)
    tested = tuple(
        cases(inquiry, trace, others[:SUPPOSED])
        for trace in _examined(ridden, here, moment, avoided)
    )
    traces = ridden.record.traces
    return Report(
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
        decisions=tuple(
            row(ridden, trace, traces[k - 1] if k else None)
            for k, trace in enumerate(traces)
            if since <= trace.sim_time <= until
        ),
        decided=None if here is None else decided(here),
        cases=tested,
        avoidability=avoided,
        limits=limitations(inquiry, moment.time, window, others, tested),
        hashes=_hashes(ridden, window),
    )


def _examined(
    ridden: Ridden, here: PlanTrace | None, moment: Chosen, avoided: Avoidability | None
) -> list[PlanTrace]:
    """Return the decisions at which the world is changed: the one in force, and the turning point.

    That is the last one from which the mishap could still be avoided.
    """
    found = [] if here is None else [here]
    last = None if avoided is None else avoided.last
    found += [t for t in ridden.record.traces if t.decision == last and t is not here]
    return sorted(found, key=lambda trace: trace.sim_time)


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
