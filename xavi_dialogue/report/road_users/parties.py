"""Parties: which road users are involved at a moment, and in which way."""

from collections.abc import Iterator

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.explain.causes.plans.avoidance import SELDOM
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.causes.vehicles.necessity import SOMETIMES
from xavi_dialogue.explain.facts.measures.between import leader
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.report.content import Chosen, Party, Role
from xavi_dialogue.report.decisions.compared import compared, hits
from xavi_dialogue.report.figures import Figure, Source, rounded
from xavi_dialogue.report.ridden import Inquiry, Ridden
from xavi_dialogue.report.road_users.tracks import Tracks

MOST = 5  # road users that are listed as involved
RECENT = 3.0  # [s] before the moment, in which decisions show who is in the way
WAYS = 5.0  # [s] before it, in which the right of way counts
NEAR = 2.0  # [m] between bodies at the moment, within which somebody is involved
BEHIND = 20.0  # [m] within which somebody behind counts
ORDER: tuple[Role, ...] = (
    "collided", "near", "gave-way", "in-the-way", "held-up", "leader", "right-of-way", "follower",
)  # fmt: skip


def parties(
    inquiry: Inquiry, tracks: Tracks, moment: Chosen, window: tuple[float, float]
) -> tuple[Party, ...]:
    """Return the road users that are involved, most important first."""
    ridden, found = inquiry.ridden, _roles(inquiry, tracks, moment, window)
    ranked = sorted(found, key=lambda v: (min(ORDER.index(role) for role in found[v]), v))
    return tuple(
        party(ridden, tracks, vehicle, tuple(sorted(found[vehicle], key=ORDER.index)), window)
        for vehicle in ranked[:MOST]
    )


def party(
    ridden: Ridden,
    tracks: Tracks,
    vehicle: int,
    roles: tuple[Role, ...],
    window: tuple[float, float],
) -> Party:
    """Return a road user with its look and its least distance from the car."""
    shape = tracks.shapes.get(vehicle)
    if shape is None:
        return _unseen(ridden, vehicle, roles)
    gaps = [
        (gap, time)
        for time in tracks.times(EGO, *window)
        if (gap := tracks.gap(vehicle, time)) is not None
    ]
    nearest, at = min(gaps, default=(None, None))
    how = "least distance of bodies in the window"
    source = tracks.source("position", EGO, vehicle, how=how)
    for k, event in enumerate(ridden.record.events):
        if event.kind == "collided" and event.vehicle == vehicle and "collided" in roles:
            nearest, at, source = 0.0, event.sim_time, Source("event", "kind", k, event.sim_time)
    return Party(
        vehicle=vehicle,
        kind=shape.kind,
        colour=shape.colour,
        length=shape.length,
        width=shape.width,
        roles=roles,
        source=_seen_last(ridden, tracks, vehicle, window[1]),
        nearest=None
        if nearest is None or vehicle == EGO
        else Figure(
            rounded(nearest),
            "m",
            source,
        ),
        nearest_at=at,
    )


def _unseen(ridden: Ridden, vehicle: int, roles: tuple[Role, ...]) -> Party:
    """Return a road user that events alone name: it came after the last decision, say."""
    events = enumerate(ridden.record.events)
    k, event = next((k, one) for k, one in events if one.vehicle == vehicle)
    source = Source("event", "vehicle", k, event.sim_time)
    return Party(vehicle, "", None, None, None, roles, source)


def _seen_last(ridden: Ridden, tracks: Tracks, vehicle: int, until: float) -> Source:
    """Return where the look of a road user stands: in the last decision that has it."""
    for trace in reversed(ridden.between(0.0, until)):
        if vehicle in trace.scene:
            return of_trace(trace, f"scene.{vehicle}")
    return tracks.source("position", vehicle)


def of_trace(trace: PlanTrace, field: str, how: str = "") -> Source:
    """Return a place in a decision as a source."""
    return Source("decision", field, trace.decision, trace.sim_time, trace.trace_id, how)


def _roles(
    inquiry: Inquiry, tracks: Tracks, moment: Chosen, window: tuple[float, float]
) -> dict[int, set[Role]]:
    found: dict[int, set[Role]] = {}
    near = ((vehicle, _NEAR) for vehicle in _beside(inquiry, tracks, moment.time))
    for vehicle, role in (*_all_roles(inquiry, moment, window), *near):
        if vehicle != EGO:
            found.setdefault(vehicle, set()).add(role)
    return found


_NEAR: Role = "near"


def _beside(inquiry: Inquiry, tracks: Tracks, time: float) -> Iterator[int]:
    """Yield who was so close to the car at the moment that one would ask about it."""
    for vehicle in inquiry.world.vehicles:
        gap = tracks.gap(vehicle, time)
        if gap is not None and gap < NEAR:
            yield vehicle


def _all_roles(
    inquiry: Inquiry, moment: Chosen, window: tuple[float, float]
) -> Iterator[tuple[int, Role]]:
    if moment.vehicle is not None:
        yield moment.vehicle, "collided" if moment.kind == "collision" else "near"
    for event in inquiry.ridden.record.events:
        inside = window[0] <= event.sim_time <= window[1] and event.vehicle is not None
        if inside and event.kind in ("collided", "gave-way"):
            assert event.vehicle is not None
            yield event.vehicle, "collided" if event.kind == "collided" else "gave-way"
    here = inquiry.ridden.decision_at(moment.time)
    for trace in inquiry.ridden.between(moment.time - RECENT, moment.time):
        held = holding_up(inquiry, trace)
        yield from ((one, "held-up") for one in held if here is not None and one in here.scene)
        yield from ((vehicle, "in-the-way") for vehicle in _in_the_way(trace))
    for trace in inquiry.ridden.between(moment.time - WAYS, moment.time):
        facts = () if trace.road is None else trace.road.priority
        yield from ((fact.vehicle, "right-of-way") for fact in facts if fact.who == "vehicle")
    states = inquiry.world.states
    ahead = leader(states, EGO, moment.time)
    if ahead is not None:
        yield ahead, "leader"
    yield from ((vehicle, "follower") for vehicle in _followers(states, moment.time))


def _in_the_way(trace: PlanTrace) -> tuple[int, ...]:
    """Return those that an option of a decision would probably have hit."""
    options = compared(trace).values()
    return tuple(sorted({v for rows in options for v, p in hits(rows).items() if p > SELDOM}))


def holding_up(inquiry: Inquiry, trace: PlanTrace) -> tuple[int, ...]:
    """Return who is expected to hold the car up under the plan of a decision, longest first."""

    def work(ride: Ride) -> tuple[int, ...]:
        held = hold_ups(factual(ride.model(trace), trace)).values()
        known = [one for one in held if one.expected >= SOMETIMES]
        return tuple(h.vehicle for h in sorted(known, key=lambda h: (-h.expected, h.vehicle)))

    return inquiry.find(work) or () if trace.plan else ()


def _followers(states: States, time: float) -> Iterator[int]:
    """Yield who drives right behind the car."""
    for vehicle in states.ride.vehicles:
        seen = states.offset(EGO, vehicle, time)
        near = seen is not None and seen.same_way and -BEHIND - seen.clear <= seen.ahead < 0.0
        if near and leader(states, vehicle, time) == EGO:
            yield vehicle
