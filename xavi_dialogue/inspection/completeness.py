"""What plan traces lack, and which kinds of answers cannot be given for want of it.

Any planner may write traces. Answers can use only what it records.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from planner.record.trace import PlanTrace
from sim.scene import EGO

RECENT: Final = 1.0  # [s] of track below which nothing can be said of what was just done


@dataclass(frozen=True, slots=True)
class Gap:
    """A part that traces lack."""

    part: str  # of the trace, as docs/trace.md names it
    lacks: str  # in words
    answers: str  # that cannot be given
    decisions: int  # that lack it


@dataclass(frozen=True, slots=True)
class _Rule:
    part: str
    lacks: str
    answers: str
    holds: Callable[[PlanTrace], bool]  # whether a trace has the part


def gaps(traces: Sequence[PlanTrace], *, ride: bool = True) -> tuple[Gap, ...]:
    """Return what traces lack, most important parts first.

    Args:
        traces: the traces.
        ride: whether events are recorded beside them, as in a saved ride.
    """
    found = []
    for rule in _RULES:
        count = sum(not rule.holds(trace) for trace in traces)
        if count:
            found.append(Gap(rule.part, rule.lacks, rule.answers, count))
    if not ride:
        found.append(Gap("events", *_EVENTS, len(traces)))
        if not any(trace.shows_deeds for trace in traces):
            found.append(Gap("under_way or road", *_DEEDS, len(traces)))
    return tuple(found)


def report(traces: Sequence[PlanTrace], *, ride: bool = True) -> str:
    """Return what traces lack as text; see `gaps`."""
    first, last = traces[0], traces[-1]
    span = f"at {first.sim_time:g} s"
    if len(traces) > 1:
        span = f"from {first.sim_time:g} to {last.sim_time:g} s"
    decisions = f"{len(traces)} decision{'s' * (len(traces) > 1)}"
    lines = [f"{decisions} of {first.vehicle!r}, {span}, {first.schema}"]
    found = gaps(traces, ride=ride)
    for gap in found:
        count = "" if len(traces) == 1 else f" ({gap.decisions} of {decisions})"
        lines += [f"{gap.part}: {gap.lacks}{count}", f"    not answered: {gap.answers}"]
    if not found:
        lines.append("complete: no kind of answer is lost")
    return "\n".join(lines)


def _others(trace: PlanTrace) -> set[int]:
    return set(trace.scene) - {EGO}


def _tried(trace: PlanTrace) -> set[str]:
    return {one.actions[0].action for one in trace.rollouts if one.actions}


def _compares(trace: PlanTrace) -> bool:
    refused = {one.action for one in trace.not_applicable if not one.node}
    return not trace.rollouts or len(_tried(trace)) > 1 or bool(refused)


def _foresees(trace: PlanTrace) -> bool:
    return bool(trace.predictions) or not _others(trace)


def _draws(trace: PlanTrace) -> bool:
    return not trace.predictions or any(one.samples for one in trace.rollouts)


def _names_partners(trace: PlanTrace) -> bool:
    collided = [one for one in trace.rollouts if one.outcome == "collision"]
    return all(one.collided_with is not None for one in collided)


def _remembers(trace: PlanTrace) -> bool:
    track = trace.history.get(EGO)
    return track is not None and trace.sim_time - track.start >= min(RECENT, trace.sim_time)


def _describes(trace: PlanTrace) -> bool:
    return all(trace.scene[vehicle].colour is not None for vehicle in _others(trace))


_EVENTS: Final = (
    "none, as traces alone have no place for them; a saved ride has",
    "whom we gave way to, halts at lights, what kept us from driving faster, arrival and collision,"
    " and when something was done to less than the time between decisions",
)
_DEEDS: Final = (
    "neither an action under way nor our place on the road, and no events",
    "which lane changes and turns were carried out, and why: only what was planned is known",
)
_RULES: Final = (
    _Rule(
        "rollouts", "no simulations",
        "why and why not, what would have happened otherwise, risks, options",
        lambda trace: bool(trace.rollouts),
    ),
    _Rule(
        "plan", "no chosen actions", "why, what comes next",
        lambda trace: bool(trace.plan),
    ),
    _Rule(
        "rollouts", "a single first action, and no reason against any other",
        "why rather than something else, what another action would have come to",
        _compares,
    ),
    _Rule(
        "predictions", "no goals of the road users in view",
        "where others are going, how sure that is, reasons by what they may do",
        _foresees,
    ),
    _Rule(
        "rollouts.samples", "no goals drawn for others",
        "which vehicle a decision hangs on, what if one did something else",
        _draws,
    ),
    _Rule(
        "rollouts.collided_with", "nobody named in collisions", "with whom we would collide",
        _names_partners,
    ),
    _Rule(
        "costs", "no costs, so that those of older traces are taken",
        "what time, comfort and effort each contribute, in the planner's own measure",
        lambda trace: trace.costs is not None,
    ),
    _Rule(
        "rollouts.weight", "no weights of the comparison", "how close a decision was",
        lambda t: len(_tried(t)) < 2 or any(r.weight is not None for r in t.rollouts),
    ),
    _Rule(
        "history", f"less than {RECENT:g} s of our own track",
        "how we braked, stopped or turned before", _remembers,
    ),
    _Rule(
        "road", "no places on the road network",
        "lanes, junctions, exits, rules and right of way, the distance to go",
        lambda trace: trace.road is not None,
    ),
    _Rule(
        "scene.colour", "no colours", "descriptions such as \"the blue car\"", _describes,
    ),
)  # fmt: skip
