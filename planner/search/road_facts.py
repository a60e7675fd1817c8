"""Facts of the road at one decision: places, the route, right of way, and lights ahead.

They follow from the network and from what can be seen. The others' routes are not known, so every
link that they may take from where they are counts.
"""

from collections.abc import Iterator, Mapping, Sequence

from planner.kernels.limits import OPEN, SHUT
from planner.manoeuvres.actions import expand
from planner.manoeuvres.plans import ActionPlan
from planner.motion.tracks import lanes_at
from planner.record.light_record import UNSEEN, LightPrediction
from planner.record.places import First, LightAhead, PriorityFact, RoadFacts, RoadPlace
from planner.record.trace import ON_FOOT, EgoGoal, PlannedAction
from planner.roads.classes import roads_of
from planner.roads.routes import approach, rest_of
from planner.roads.trajectory import Roads
from planner.rollouts.itinerary import Leg, is_junction, itinerary, rings_of, steps
from planner.search.inputs import Root
from planner.traffic_lights.signals import MEANING
from sim.roads.network import Link, Location, Network
from sim.scene import EGO, LightState, Signal, VehicleState

PROTECTED = LightState.GREEN.value
Places = Mapping[int, tuple[Location, ...]]  # possible places by number, likeliest first


def road_facts(
    roads: Roads,
    scene: Mapping[int, VehicleState],
    root: Root,
    plan: Sequence[PlannedAction],
    goal: EgoGoal,
    view: float,
    lights: Sequence[LightPrediction] = (),
) -> RoadFacts:
    """Work out the facts of the road for one decision.

    Args:
        roads: the road network.
        scene: all road users, the ego included, by number.
        root: the ego's situation, and the manoeuvre that it must finish.
        plan: the plan that was chosen.
        goal: the destination.
        view: [m] distance to a junction within which others count.
        lights: those in view.
    """
    here = root.here.location
    at = {v: _lanes_at(roads, state) for v, state in scene.items()}
    at[EGO] = (here,)
    planned = _planned(roads, root, plan, goal, view)
    way = itinerary(roads, here, planned, goal)
    meetings = _meetings(roads.network, here, way.legs, view)
    drivers = {v: where for v, where in at.items() if scene[v].kind not in ON_FOOT}
    return RoadFacts(
        places={v: place(roads.network, at[v][0]) for v in sorted(at) if at[v]},
        route=steps(roads, way.legs),
        distance=None if way.distance is None else round(way.distance, 1),
        free_time=None if way.free_time is None else round(way.free_time, 1),
        priority=_priority(roads, drivers, meetings, view, lights),
        lights=_ahead(way.legs or _beyond(roads.network, here, planned), lights),
    )


def _lanes_at(roads: Roads, state: VehicleState) -> tuple[Location, ...]:
    """Return the possible places of a vehicle on lanes for cars; none on a lane of its own kind."""
    own, lanes = roads_of(roads, state.kind), roads.network.lanes
    return tuple(x for x in lanes_at(own, state.position, state.heading) if x.lane in lanes)


def _beyond(network: Network, here: Location, planned: Sequence[str]) -> tuple[Leg, ...]:
    """Return the link at the end of the lane that the destination is on: its light may hold us.

    Of several, the planned one counts, or else the first.
    """
    lane = network.lanes[here.lane]
    links = network.links_from(here.lane)
    taken = [link for link in links if link.to_lane in planned or {*link.via} & {*planned}]
    return tuple(Leg(link, lane.length - here.offset) for link in (taken or [*links])[:1])


def _ahead(legs: Sequence[Leg], lights: Sequence[LightPrediction]) -> tuple[LightAhead, ...]:
    """Return the lights in view on the way, nearest first."""
    known = {one.controller: one for one in lights}
    found = []
    for leg in legs:
        control = leg.link.control
        if isinstance(control, Signal) and control.controller in known:
            one = known[control.controller]
            state = one.state(control.index)
            if state != UNSEEN:
                since, seen = one.since(control.index)
                place = LightAhead(
                    round(leg.distance, 1), control.controller, control.index, state, since, seen
                )
                found.append(place)
    return tuple(found)


def _planned(
    roads: Roads, root: Root, plan: Sequence[PlannedAction], goal: EgoGoal, view: float
) -> tuple[str, ...]:
    """Return the lanes of the action that is under way, or otherwise of the first one planned."""
    if root.under_way is not None:
        begun, motion = root.under_way
        current, _ = begun.path.lane_at(motion.arc)
        rows = [name for name, start in begun.path.lanes if start <= begun.end]
        return tuple(rows[rows.index(current) :]) if current in rows else ()
    first = expand(roads, root.here, plan[0].action, goal, view) if plan else None
    if not isinstance(first, ActionPlan):
        return ()
    return tuple(name for name, start in first.path.lanes if start <= first.end)


def place(network: Network, location: Location) -> RoadPlace:
    """Return a place on a lane in the terms in which passengers see it."""
    lane, link = network.lanes[location.lane], network.link_via(location.lane)
    inside = link is not None and is_junction(network, link)
    on_ring = link is not None and any(ring is not None for ring in rings_of(network, link))
    if link is not None:
        lane = network.lanes[link.to_lane]
    beside = network.edge_lanes(lane.edge)
    return RoadPlace(
        edge=lane.edge,
        lane=None if inside else beside.index(lane),
        lanes=len(beside),
        limit=lane.speed_limit,
        in_junction=inside,
        roundabout=on_ring or network.roundabout(lane.edge) is not None,
    )


def _meetings(
    network: Network, here: Location, legs: Sequence[Leg], view: float
) -> tuple[Link, ...]:
    """Return the links where the ego next meets others: at a junction, or on the rest of a ring."""
    inside = network.link_via(here.lane)
    ahead = [] if inside is None else [inside]
    ahead += [leg.link for leg in legs if leg.distance <= view]
    ahead = [link for link in ahead if is_junction(network, link)]
    if not ahead:
        return ()
    own = network.lanes[rest_of(network, here.lane)[-1] if inside else here.lane].edge
    ring = network.roundabout(own)
    if ring is None:
        return (ahead[0],)
    return tuple(link for link in ahead if ring in rings_of(network, link))


def _priority(
    roads: Roads,
    at: Places,
    meetings: Sequence[Link],
    view: float,
    lights: Sequence[LightPrediction],
) -> tuple[PriorityFact, ...]:
    """Return who goes first, for each of the others whose way may cross the ego's at a meeting."""
    found = []
    for vehicle in sorted(at.keys() - {EGO}):
        answers = {
            first
            for mine in meetings
            for location in at[vehicle]
            for theirs in _ways(roads, location, mine, view)
            if (first := _first_now(roads, location, mine, theirs, lights)) is not None
        }
        if answers:
            who = answers.pop() if len(answers) == 1 else "depends"
            found.append(PriorityFact(vehicle, who))
    return tuple(found)


def _first_now(
    roads: Roads, where: Location, mine: Link, theirs: Link, lights: Sequence[LightPrediction]
) -> First | None:
    """Return who goes first under the present lights; at red, there is no right of way."""
    first = goes_first(mine, theirs)
    inside = roads.network.lanes[where.lane].internal
    if first is None or not lights:
        return first
    ours, other = (_state(link, lights) for link in (mine, theirs))
    i_stop, they_stop = (MEANING.get(x, OPEN) >= SHUT for x in (ours, other))
    if i_stop or (they_stop and not inside):
        return ("depends" if they_stop else "vehicle") if i_stop else "ego"
    if ours == PROTECTED and not inside:
        return "depends" if other == PROTECTED else "ego"
    return "vehicle" if other == PROTECTED else first


def _state(link: Link, lights: Sequence[LightPrediction]) -> str:
    control = link.control
    if not isinstance(control, Signal):
        return UNSEEN
    known = (one for one in lights if one.controller == control.controller)
    return next((one.state(control.index) for one in known), UNSEEN)


def goes_first(mine: Link, theirs: Link) -> First | None:
    """Return who goes first at a junction, ego or other; None if their links do not conflict."""
    if theirs.index not in mine.foes and mine.index not in theirs.foes:
        return None
    i_yield, they_yield = theirs.index in mine.yields_to, mine.index in theirs.yields_to
    if i_yield == they_yield:
        return "depends"
    return "vehicle" if i_yield else "ego"


def _ways(roads: Roads, location: Location, mine: Link, view: float) -> Iterator[Link]:
    """Yield links by which a vehicle from another road may cross the junction of the ego's link."""
    network = roads.network
    own = network.lanes[mine.from_lane].edge
    for link in _reached(roads, location, mine.junction, view):
        if network.lanes[link.from_lane].edge != own:
            yield link


def _reached(roads: Roads, location: Location, junction: str, view: float) -> list[Link]:
    """Return the links of a junction that a vehicle is driving along or may come to."""
    network = roads.network
    inside = network.link_via(location.lane)
    if inside is not None and inside.junction == junction:
        return [inside]
    lane = location.lane if inside is None else inside.to_lane
    ring = network.roundabout(network.lanes[lane].edge)
    if ring is not None:  # it may go round to this junction
        links = network.junction_links(junction).values()
        return [link for link in links if network.lanes[link.from_lane].edge in ring]
    ahead = approach(roads, location, view)
    links_on = [
        link
        for name in ahead.lanes[:-1]
        for link in network.links_from(name)
        if link.to_lane in ahead.lanes
    ]
    last = network.lanes[ahead.lanes[-1]]
    if ahead.distance <= view and not last.internal:
        lanes = [last] if network.links_from(last.id) else network.edge_lanes(last.edge)
        links_on += [link for other in lanes for link in network.links_from(other.id)]
    known = [link for link in links_on if link.junction == junction]
    return [link for link in known if link.direction != "turnaround"] or known
