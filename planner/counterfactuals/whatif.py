"""Replanning of a recorded decision with a change.

A request may force actions of the ego, remove vehicles, suppose that a vehicle has a goal, takes
actions or drives faster, and suppose other states of lights. The trace contains everything needed,
so this works for replayed rides as well as for live ones. The same request gives the same trace.

Beliefs about the remaining vehicles are inferred from the world as it was, with all vehicles in
it. Only then is the world changed (abduction, action, prediction: Pearl 2009, Causality, 7.1). So
the goals keep their probabilities, and a vehicle that was slow behind a removed one is not assumed
to want to drive slowly.

    WhatIfError        the question cannot be planned from this trace
    ├── NotInView      the vehicle, or the light, is not in the trace's scene
    └── Inapplicable   the supposition is impossible
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import msgspec

from planner.counterfactuals.resume import resume
from planner.counterfactuals.suppose import edge_of, suppose
from planner.errors import PlannerError
from planner.motion.tracks import Observed, leads
from planner.prediction.recognise import Belief
from planner.record.fitting import fitted
from planner.record.hidden_record import Phantom
from planner.record.light_record import LightPrediction, LightSupposed
from planner.record.trace import PlanTrace, Settings, Track, VehiclePrediction, WhatIf
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.search.decide import decide, observed, predict, prepare, searched
from planner.search.inputs import Frame, Moment, Root, root_at
from planner.search.recording import record, rollouts
from planner.traffic_lights.cycles import supposed
from sim.roads.network import Network
from sim.scene import EGO, LightState, VehicleState

__all__ = ["Inapplicable", "NotInView", "WhatIf", "WhatIfError", "decide_again", "replan"]

HEADWAY, GAP = 1.5, 5.0  # [s], [m] greatest distance to a vehicle ahead that holds one up
RECOGNISED = 0.5  # minimum recorded probability of goals still possible, to keep beliefs


class WhatIfError(PlannerError):
    """An error: the request cannot be planned from this trace."""


class NotInView(WhatIfError):
    """An error: the vehicle, or the light, is not in the trace's scene."""


class Inapplicable(WhatIfError):
    """An error: the supposition is impossible."""


def replan(trace: PlanTrace, network: Network, request: WhatIf) -> PlanTrace:
    """Plan again from the scene of a trace; `what_if` of the result records the change.

    With forced actions alone, the result is the trace with more rollouts, marked as forced; where
    an action does not apply, none is added, and the reason is recorded. With a vehicle removed
    or supposed to act differently, it is the decision in that world, with the budget of the trace's
    settings, before any forced actions are added. A manoeuvre that was under way is finished
    first, forced or not; see planner.counterfactuals.resume for how exactly.

    Raises:
        WhatIfError: the request contradicts itself, the trace is of another network or of a
            what-if itself, or the ego's place is not clear from it.
        NotInView: a vehicle is not in the trace.
        Inapplicable: a vehicle cannot have that goal or take those actions.
    """
    _check(trace, network, request)
    frame, moment = restore(trace, Roads(network), request)
    beliefs = _beliefs(frame, moment, request, trace.predictions)
    changed = bool(request.gone or supposed_lights(request) or seen_past(request))
    changed = changed or request.vehicle is not None
    if changed:
        search = searched(frame, moment, beliefs)
        trace = record(frame, moment, beliefs, search)
    trace = msgspec.structs.replace(trace, what_if=request)
    if not changed or request.actions:
        trace = _with_more(trace, frame, moment, beliefs, request)
    return fitted(trace)


def decide_again(trace: PlanTrace, network: Network, settings: Settings) -> PlanTrace:
    """Take the decision of a trace again with other settings, from the same scene.

    Raises:
        WhatIfError: as for `replan`.
    """
    _check(trace, network, WhatIf())
    there = msgspec.structs.replace(trace, settings=settings)
    frame, moment = restore(there, Roads(network), WhatIf())
    return decide(frame, moment).trace


def _with_more(
    trace: PlanTrace,
    frame: Frame,
    moment: Moment,
    beliefs: Mapping[int, Sequence[Belief]],
    request: WhatIf,
) -> PlanTrace:
    """Return the trace with rollouts that begin with the forced actions."""
    search = prepare(frame, moment, beliefs, salt="/" + ",".join(request.actions))
    search.force(request.actions, request.rollouts)
    known = {(entry.node, entry.action) for entry in trace.not_applicable}
    fresh = (e for e in search.not_applicable() if (e.node, e.action) not in known)
    more = rollouts(search.rollouts, moment.time, offset=len(trace.rollouts))
    return msgspec.structs.replace(
        trace,
        rollouts=trace.rollouts + more,
        not_applicable=trace.not_applicable + tuple(fresh),
    )


def _check(trace: PlanTrace, network: Network, request: WhatIf) -> None:
    """Check that the request makes sense, and is about this trace."""
    if network.hash != trace.network:
        raise WhatIfError(f"the trace is of network {trace.network}, not of {network.hash}")
    if trace.what_if is not None:
        raise WhatIfError("the trace is of a what-if itself; ask about the decision behind it")
    _check_record(trace, network)
    depth = trace.settings.depth
    if max(len(request.actions), len(request.vehicle_actions)) > depth:
        raise WhatIfError(f"at most {depth} actions in a row are possible; give fewer")
    faster = isinstance(request.faster, float)
    supposed = request.goal is not None or bool(request.vehicle_actions) or faster
    if supposed and request.vehicle is None:
        raise WhatIfError("a goal, actions or a speed need a vehicle; name it")
    if request.vehicle is not None and not supposed:
        problem = f"nothing is supposed of vehicle {request.vehicle}"
        raise WhatIfError(f"{problem}; give a goal, actions or a speed")
    if EGO in request.gone:
        raise WhatIfError("the ego cannot be removed; name another vehicle")
    if request.vehicle == EGO:
        raise WhatIfError("the ego's goal cannot be changed; give its actions instead")
    if request.vehicle in request.gone:
        raise WhatIfError(f"vehicle {request.vehicle} cannot be removed and act; choose one")
    for vehicle in (*sorted(request.gone), request.vehicle):
        if vehicle is not None and vehicle not in trace.scene:
            raise NotInView(f"vehicle {vehicle} was not in view at {trace.sim_time} s")
    for light in supposed_lights(request):
        if light.state not in {state.value for state in LightState}:
            raise WhatIfError(f"{light.state!r} is not a state of a traffic light")
        places = (known.places for known in trace.lights if known.controller == light.controller)
        if light.place not in next(places, ()):
            where = f"place {light.place} of the light {light.controller!r}"
            raise NotInView(f"{where} was not in view at {trace.sim_time} s")
    if not seen_past(request) <= frozenset(range(len(trace.phantoms))):
        raise NotInView(f"no phantom of that number was recorded at {trace.sim_time} s")


def _check_record(trace: PlanTrace, network: Network) -> None:
    """Check that a trace, which any planner may have written, holds what planning begins with."""
    edge = trace.goal.edge
    if all(lane.internal or lane.edge != edge for lane in network.lanes.values()):
        raise WhatIfError(f"the goal is the edge {edge!r}, which is not in the roads")
    missing = sorted(trace.scene.keys() - trace.history.keys())
    if missing:
        raise WhatIfError(f"`history` lacks vehicle {missing[0]}, which is in `scene`")


def changes_world(request: WhatIf) -> bool:
    """Check whether a request changes the world, but keeps the beliefs about the others."""
    hastened = isinstance(request.faster, float)
    return bool(request.gone or hastened or supposed_lights(request) or seen_past(request))


def supposed_lights(request: WhatIf) -> tuple[LightSupposed, ...]:
    """Return the supposed states of lights."""
    return request.lights if isinstance(request.lights, tuple) else ()


def restore(trace: PlanTrace, roads: Roads, request: WhatIf) -> tuple[Frame, Moment]:
    """Return the frame and moment of a recorded decision, with what is changed in its scene.

    Raises:
        WhatIfError: the ego's place is not clear from the trace.
    """
    here = root_at(roads, trace.scene[EGO], trace.sim_time)
    if here is None:
        raise WhatIfError(f"the ego was on no lane at {trace.sim_time} s")
    rest = resume(roads, trace)
    if isinstance(rest, Refusal):
        action = "" if trace.under_way is None else trace.under_way.action
        raise WhatIfError(f"{action} was under way at {trace.sim_time} s; {rest.reason}")
    frame = Frame(roads, trace.goal, trace.settings, trace.seed, trace.vehicle)
    gone = request.gone
    scene = {vehicle: state for vehicle, state in trace.scene.items() if vehicle not in gone}
    history = {vehicle: track for vehicle, track in trace.history.items() if vehicle not in gone}
    one = request.vehicle
    if one is not None and isinstance(request.faster, float):
        scene[one], history[one] = _hastened(scene[one], history[one], request.faster)
    moment = Moment(
        trace.decision,
        trace.sim_time,
        scene,
        history,
        Root(here, rest, trace.driving),
        {vehicle: since for vehicle, since in trace.unseen.items() if vehicle not in gone},
        frozenset(_followers(trace, gone)),
        _lit(roads, trace, request),
        _imagined(trace, request),
    )
    return frame, moment


def seen_past(request: WhatIf) -> frozenset[int]:
    """Return the indices of the phantoms that a request removes."""
    return frozenset(request.seen_past if isinstance(request.seen_past, tuple) else ())


def _imagined(trace: PlanTrace, request: WhatIf) -> tuple[Phantom, ...]:
    """Return the phantoms that remain: not those removed, nor in areas that become visible."""
    away, gone = seen_past(request), request.gone
    return tuple(
        one for k, one in enumerate(trace.phantoms) if k not in away and not one.seen_without(gone)
    )


def _lit(roads: Roads, trace: PlanTrace, request: WhatIf) -> tuple[LightPrediction, ...]:
    """Return the possible courses of the lights, with supposed states of some."""
    found = {known.controller: known for known in trace.lights}
    for light in supposed_lights(request):
        known = found[light.controller]
        now = supposed(roads, known, light.place, light.state, trace.sim_time)
        found[light.controller] = now
    return tuple(found.values())


def _hastened(state: VehicleState, track: Track, faster: float) -> tuple[VehicleState, Track]:
    """Return a vehicle at its place that drives, and has driven, faster by some speed [m/s]."""
    speeds = tuple(max(speed + faster, 0.0) for speed in track.speed)
    return (
        replace(state, speed=max(state.speed + faster, 0.0)),
        msgspec.structs.replace(track, speed=speeds),
    )


def _followers(trace: PlanTrace, gone: frozenset[int]) -> Iterator[int]:
    """Yield vehicles whose speed a removed one limited: its followers, and theirs in turn."""
    if not gone:
        return
    tracks = {v: observed(v, trace.history[v], state) for v, state in trace.scene.items()}
    before, rest = set(gone), set(tracks) - gone - {EGO}
    while True:
        found = {v for v in rest if any(_follows(tracks[v], tracks[w]) for w in before)}
        if not found:
            return
        yield from sorted(found)
        before, rest = found, rest - found


def _follows(track: Observed, other: Observed) -> bool:
    """Check whether a vehicle follows another so closely that it is held up."""
    dx, dy = other.position[-1] - track.position[-1]
    gap = float((dx * dx + dy * dy) ** 0.5) - other.length
    return leads(track, other) and gap <= HEADWAY * float(track.speed[-1]) + GAP


def _beliefs(
    frame: Frame, moment: Moment, request: WhatIf, recorded: Sequence[VehiclePrediction]
) -> dict[int, Sequence[Belief]]:
    """Return the beliefs about the others, with suppositions about one of them."""
    beliefs: dict[int, Sequence[Belief]] = dict(predict(frame, moment))
    if changes_world(request):
        known_goals = {known.vehicle: known for known in recorded}
        beliefs = {
            one: _as_inferred(found, known_goals[one]) if one in known_goals else found
            for one, found in beliefs.items()
        }
    vehicle = request.vehicle
    if vehicle is None or isinstance(request.faster, float):
        return beliefs
    known = beliefs.get(vehicle, ())
    supposed = suppose(frame, moment, known, vehicle, request.goal, request.vehicle_actions)
    if isinstance(supposed, Refusal):
        raise Inapplicable(f"vehicle {vehicle}: {supposed.reason}")
    return {**beliefs, vehicle: (supposed,)}


def _as_inferred(found: Sequence[Belief], recorded: VehiclePrediction) -> Sequence[Belief]:
    """Return beliefs with the recorded probabilities of goals, if most of the goals remain."""
    chances = {(goal.kind, goal.edge): goal.probability for goal in recorded.goals}
    known = [chances.get((b.goal.kind, edge_of(b.goal)), 0.0) for b in found]
    mass = sum(known)
    if mass < RECOGNISED:
        return found
    pairs = zip(found, known, strict=True)
    return tuple(replace(b, probability=chance / mass) for b, chance in pairs if chance > 0.0)
