"""Yielding: vehicles that stay reasons although planning without them makes no difference.

Planning without one vehicle shows nothing of a duty: we let a vehicle with right of way go first
even if another would take its place. Likewise, a vehicle in our way stays a reason if without it
others would be in our way. If nobody would be, and nothing changes, it is no reason.
"""

from collections.abc import Sequence

from msgspec.structs import replace

from planner.record.trace import PlanTrace
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.answers import Cause
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.explain.causes.vehicles.involved import LIKELY, held_by
from xavi_dialogue.explain.causes.vehicles.necessity import Proven
from xavi_dialogue.explain.facts.world import World

ASIDE = 2.0  # [m] maximum offset sideways of somebody in front of us
HEADWAY, NEAR = 3.0, 12.0  # [s] and [m] within which somebody in front is close


def kept(
    tried: Proven,
    suspects: Sequence[Cause],
    trace: PlanTrace,
    waited: int | None = None,
    *,
    alone: bool = False,
) -> Proven:
    """Keep the vehicles that we must let go; if no cause is left, the first that is in our way.

    Args:
        tried: what planning without the suspects shows.
        suspects: most important first.
        trace: the decision.
        waited: the vehicle that we gave way to, as the events show; it comes first.
        alone: nothing in the road is a reason, so a vehicle that will be in our way may be one.
    """
    due = [c for c in suspects if c.vehicle == waited or _owed(trace, c)]
    if not due and not tried.causes:
        likewise = [c for c in suspects if c.vehicle in tried.replaced]
        present = [c for c in likewise if c.mechanism is not None and c.mechanism.present]
        due = (present or (likewise if alone else []))[:1]
    known = {cause.vehicle for cause in tried.causes}
    found = [*tried.causes, *(cause for cause in due if cause.vehicle not in known)]
    found.sort(key=lambda cause: cause.vehicle != waited)
    return Proven(tuple(found), _consistent(tried.causation, found))


def _consistent(causation: Causation | None, found: Sequence[Cause]) -> Causation | None:
    """Remove the vehicles that are stated as causes from those that make no difference."""
    told = {cause.vehicle for cause in found}
    if causation is None or not told & set(causation.cleared):
        return causation
    rest = tuple(v for v in causation.cleared if v not in told)
    kind = "open" if causation.kind == "none" else causation.kind
    return replace(causation, kind=kind, cleared=rest)


def _owed(trace: PlanTrace, cause: Cause) -> bool:
    """Check whether a vehicle holds us up because we have to let it go first."""
    how = None if cause.mechanism is None else cause.mechanism.how
    return how == "right-of-way" and goes_first(trace, cause.vehicle)


def close_leader(
    world: World, model: CausalModel, plan: Intervention, time: float, speed: float | None
) -> Cause | None:
    """Find who is close ahead in our lane at a time [s] and probably holds the plan up.

    Args:
        world: the facts of the record.
        model: the causal model of the decision.
        plan: what the ego does.
        time: [s] the moment.
        speed: [m/s] the ego's speed then.
    """
    reach = max(NEAR, HEADWAY * (speed or 0.0))
    for vehicle, held in sorted(hold_ups(plan).items(), key=lambda item: -item[1].expected):
        look = world.look(vehicle, time)
        close = look is not None and look.distance <= reach and leads(world, vehicle, time)
        if held.how == "leader" and held.share >= LIKELY and close:
            return held_by(model, held)
    return None


def goes_first(trace: PlanTrace, vehicle: int) -> bool:
    """Check whether a vehicle whose way crosses ours has right of way."""
    facts = () if trace.road is None else trace.road.priority
    return any(fact.vehicle == vehicle and fact.who == "vehicle" for fact in facts)


def leads(world: World, vehicle: int | None, time: float) -> bool:
    """Check whether a vehicle drives ahead of us in our lane at a time [s]."""
    look = None if vehicle is None else world.look(vehicle, time)
    return look is not None and look.ahead > 0.0 and abs(look.left) <= ASIDE and not look.oncoming
