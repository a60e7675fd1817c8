"""Limits: what the record cannot show."""

from collections.abc import Iterator, Sequence

from planner.motion.road_users import road_users_in
from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.explain.causes.plans.ranges import table
from xavi_dialogue.inspection.completeness import gaps
from xavi_dialogue.report.content import Limitation
from xavi_dialogue.report.decisions.alternatives import Cases
from xavi_dialogue.report.figures import Figure, Source
from xavi_dialogue.report.ridden import Inquiry, predicted

AFTER = 7.0  # [s] after the moment up to which a report goes
BEFORE = 7.0  # [s] before it, from which on it begins


def limitations(
    inquiry: Inquiry,
    moment: float,
    window: tuple[float, float],
    involved: Sequence[int],
    cases: Sequence[Cases],
) -> tuple[Limitation, ...]:
    """Return what the record cannot show of a moment [s], what is special to it first."""
    return (
        *_of_ride(inquiry, moment, window),
        *_of_decisions(inquiry, window, involved),
        *_of_plans(inquiry, cases),
        *_always(inquiry),
    )


def _of_ride(inquiry: Inquiry, moment: float, window: tuple[float, float]) -> Iterator[Limitation]:
    ridden = inquiry.ridden
    traces = ridden.record.traces
    if ridden.network is None:
        yield Limitation("no-roads")
    elif ridden.network.hash != traces[0].network:
        yield Limitation("other-roads")
    if ridden.end < moment + AFTER - 1e-6:
        yield Limitation("ends-early", time=ridden.end)
    if ridden.begin > moment - BEFORE + 1e-6:
        yield Limitation("begins-late", time=ridden.begin)
    scenes = [s for s in ridden.scenes if window[0] <= s.time <= window[1]]
    if len(scenes) <= len(ridden.between(*window)):
        last = traces[-1].sim_time
        yield Limitation("no-scenes", time=last if last < moment else None)
    for begin, end in ridden.gaps:
        if begin <= window[1] and end >= window[0]:
            yield Limitation("lost", f"{begin:g} to {end:g} s")


def _of_decisions(
    inquiry: Inquiry, window: tuple[float, float], involved: Sequence[int]
) -> Iterator[Limitation]:
    traces = inquiry.ridden.between(*window)
    for gap in gaps(traces) if traces else ():
        if gap.part == "scene.colour":  # looks are listed as far as they are known
            continue
        yield Limitation("lacks", f"{gap.part}: {gap.lacks} ({gap.decisions} of {len(traces)} "
                         f"decisions); so not: {gap.answers}")  # fmt: skip
    known = {vehicle for trace in inquiry.ridden.record.traces for vehicle in trace.scene}
    known |= {vehicle for scene in inquiry.ridden.scenes for vehicle in road_users_in(scene)}
    unseen = tuple(vehicle for vehicle in involved if vehicle not in known)
    if unseen:
        yield Limitation("unseen", vehicles=unseen)
    for vehicle in involved:
        seen = [t for t in traces if vehicle in t.scene and vehicle != EGO]
        without = [t.decision for t in seen if predicted(t, vehicle) is None]
        if without:
            yield Limitation("not-predicted", vehicles=(vehicle,), decisions=tuple(without))
        hidden = [t.decision for t in seen if vehicle in t.unseen]
        if hidden:
            yield Limitation("hidden", vehicles=(vehicle,), decisions=tuple(hidden))
    bare = [t.decision for t in traces if _lineless(t)]
    if bare:
        yield Limitation("rollout-lines", decisions=tuple(bare))


def _lineless(trace: PlanTrace) -> bool:
    """Check whether some rollouts had no room for their lines."""
    return any(one.path is None and one.same_as is None for one in trace.rollouts)


def _of_plans(inquiry: Inquiry, cases: Sequence[Cases]) -> Iterator[Limitation]:
    """Yield what could not be planned again, by reason."""
    reasons: dict[str, set[int]] = {}
    numbers = {t.trace_id: t.decision for t in inquiry.ridden.record.traces}
    for need, reason in inquiry.reasons.items():
        reasons.setdefault(reason, set()).add(numbers[need.trace_id])
    for reason, decisions in sorted(reasons.items()):
        yield Limitation("not-planned", reason, decisions=tuple(sorted(decisions)))
    otherwise = tuple(case.decision for case in cases if case.reproduced is False)
    if otherwise:
        yield Limitation("other-program", decisions=otherwise)


def _always(inquiry: Inquiry) -> Iterator[Limitation]:
    """Yield what holds of every report."""
    known = table()
    source = Source("ride", "model_error", how="fitted to foils driven in SUMO, ranges.json")
    yield Limitation("model", figure=Figure(round(known.model_error, 4), "", source))
    yield Limitation("others-inside")
    yield Limitation("perfect-sight")
    yield Limitation("simulated")
