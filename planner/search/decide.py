"""One decision: recognition of the others' goals, the search, and the record as a PlanTrace."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from planner.hidden_areas.caution import cautious
from planner.manoeuvres.footways import crossings_along
from planner.motion.forward import DT
from planner.motion.tracks import Observed, indicating, lanes_at
from planner.prediction.people import concerned
from planner.prediction.recognise import Belief, recognise
from planner.prediction.relevance import relevant
from planner.record.trace import ON_FOOT, PlanTrace, Track
from planner.rollouts.rollout import Task
from planner.rollouts.waypoints import way, waypoint
from planner.search.inputs import Frame, Moment
from planner.search.mcts import Search
from planner.search.recording import record
from planner.search.trees import GrownTree, detached, share, trees_of
from sim.roads.network import Crossing
from sim.scene import EGO, VehicleState

CROWD = 16  # maximum number of vehicles whose goals are recognised

#: Waits for a tree that is grown elsewhere; None: it was not grown, or takes too long.
Pending: TypeAlias = Callable[[], GrownTree | None]
#: Begins to grow all trees of a decision but the first elsewhere, such as in other processes.
Elsewhere: TypeAlias = Callable[[Moment], Sequence[Pending]]


@dataclass(frozen=True, slots=True, eq=False)
class Decision:
    """A decision: its record, and the beliefs, which the driver needs besides."""

    trace: PlanTrace
    beliefs: Mapping[int, Sequence[Belief]]


def decide(frame: Frame, moment: Moment, elsewhere: Elsewhere | None = None) -> Decision:
    """Decide what to do next.

    Args:
        frame, moment: the inputs.
        elsewhere: grows trees in parallel; None: all are grown here. The decision is the same.
    """
    pending = elsewhere(moment) if elsewhere is not None else ()
    beliefs = predict(frame, moment)
    search = searched(frame, moment, beliefs, pending)
    return Decision(record(frame, moment, beliefs, search), beliefs)


def searched(
    frame: Frame,
    moment: Moment,
    beliefs: Mapping[int, Sequence[Belief]],
    pending: Sequence[Pending] = (),
) -> Search:
    """Search, in as many trees as the settings say, and return the search.

    Args:
        frame, moment: the inputs.
        beliefs: those about every other road user.
        pending: the trees after the first that are grown elsewhere; () if none are.
    """
    search = prepare(frame, moment, beliefs)
    count = trees_of(frame.settings)
    search.grow(share(frame.settings.rollouts, count, 0))
    for tree in range(1, count):
        found = pending[tree - 1]() if pending else None
        search.join(grown(frame, moment, beliefs, tree) if found is None else found)
    search.conclude()
    return search


def grown(
    frame: Frame, moment: Moment, beliefs: Mapping[int, Sequence[Belief]], tree: int
) -> GrownTree:
    """Grow one of the trees after the first, and return it."""
    search = prepare(frame, moment, beliefs, salt=f"/tree {tree}")
    search.grow(share(frame.settings.rollouts, trees_of(frame.settings), tree))
    return detached(search.rollouts, search.refusals)


def predict(frame: Frame, moment: Moment) -> dict[int, tuple[Belief, ...]]:
    """Recognise the goals of vehicles that may meet the ego, and of people who may get in its way.

    In a crowd, this covers only the nearest CROWD of these vehicles. Others that are near the ego
    count only as obstacles to them.
    """
    ego, view = moment.scene[EGO], frame.settings.view_radius
    nearest = sorted(
        (vehicle for vehicle, state in moment.scene.items() if state.kind not in ON_FOOT),
        key=lambda vehicle: math.dist(moment.scene[vehicle].position, ego.position),
    )
    people = concerned(frame.roads, moment.scene, _crossings_ahead(frame, moment), view)
    others = {vehicle: moment.scene[vehicle] for vehicle in nearest if vehicle != EGO}
    here = moment.root.here.location
    may_meet = relevant(frame.roads, others, here, frame.goal, frame.settings)
    planned = [vehicle for vehicle in nearest if vehicle in may_meet][:CROWD]
    tracks = [
        replace(
            observed(vehicle, moment.history[vehicle], moment.scene[vehicle]),
            paced=vehicle not in moment.unpaced,
        )
        for vehicle in sorted({*nearest[: 1 + CROWD], *planned, *people})
    ]
    apart = frozenset(others).difference(planned)
    found = lanes_at(frame.roads, ego.position, ego.heading)  # as recorded
    bound = waypoint(frame.roads, found[0], frame.goal) if found else None
    time, outlook = moment.time, moment.outlook
    return recognise(frame.roads, tracks, frame.settings, time, EGO, outlook, apart, bound)


def _crossings_ahead(frame: Frame, moment: Moment) -> tuple[Crossing, ...]:
    """Return the crossings for people on foot that lie on the ego's way."""
    here, under_way = moment.root.here.location.lane, moment.root.under_way
    lanes: tuple[str, ...] = (here,)
    if under_way is not None:
        plan, _ = under_way
        row = [lane for lane, start in plan.path.lanes if start <= plan.end]
        lanes = tuple(row[row.index(here) :]) if here in row else lanes
    edges = way(frame.roads, lanes, frame.goal)
    return crossings_along(frame.roads, here, edges, frame.settings.view_radius)


def prepare(
    frame: Frame, moment: Moment, beliefs: Mapping[int, Sequence[Belief]], salt: str = ""
) -> Search:
    """Return a search that has not been run yet; another `salt` gives it other random draws."""
    ego = moment.scene[EGO]
    task = Task(
        frame.roads,
        waypoint(frame.roads, moment.root.here.location, frame.goal),
        (ego.length, ego.width),
        moment.time,
        round(frame.settings.horizon / DT),
        frame.settings.view_radius,
        reacting=frame.settings.reacting is True,
        slow=cautious(moment.phantoms),
    )
    seed = f"{frame.seed}/{moment.number}{salt}"
    outlook, phantoms = moment.outlook, moment.phantoms
    return Search(task, moment.root, beliefs, frame.settings, seed, outlook, phantoms)


def observed(vehicle: int, track: Track, state: VehicleState) -> Observed:
    """Return a recorded track, ready for recognition."""
    return Observed(
        vehicle,
        state.length,
        state.width,
        np.array(track.position),
        np.array(track.heading),
        np.array(track.speed),
        indicating(state),
        kind=state.kind,
    )
