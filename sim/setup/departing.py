"""The departure of the ego of a SUMO configuration.

The only error besides those of the engine is NeverDeparts.
"""

from itertools import chain, count
from pathlib import Path

from sim.engine import EgoGone, Engine
from sim.setup.source import EGO_ID, Added, Departing, Rider

PATIENCE = 300.0  # [s] greatest wait for a gap in which an added car can depart
LONGEST = 86400.0  # [s] end of a configuration that states none
LOOKED = 3600.0  # [s] for which departures are looked for, to propose an ego
LISTED = 8  # greatest number of vehicles in a message


class NeverDeparts(EgoGone):
    """The ego does not get onto the road."""

    def __init__(self, file: Path, problem: str, remedy: str) -> None:
        self.problem, self.remedy = problem, remedy
        super().__init__(f"{file}: {problem}; {remedy}")


def depart(engine: Engine, file: Path, rider: Rider) -> str:
    """Run a simulation that has started until the ego is on the road.

    Args:
        engine: of the simulation.
        file: the configuration, for errors.
        rider: the vehicle that is the ego.

    Returns:
        The ego's id.

    Raises:
        NeverDeparts: the ego does not depart, or no way leads to its destination.
        SumoFailed: SUMO cannot go on.
    """
    match rider:
        case Departing(name):
            _await(engine, file, name)
            return name
        case Added():
            return _add(engine, file, rider)


def forget_stops(engine: Engine, name: str) -> None:
    """Remove a vehicle's stops: SUMO would hold the ego there in spite of commands.

    Raises:
        SumoFailed: SUMO cannot do it.
    """
    api = engine.api.vehicle
    while engine.call(api.getStops, name):
        engine.call(api.replaceStop, name, 0, "")


def first_departures(engine: Engine) -> list[str]:
    """Return the ids of the cars that depart first, within LOOKED; this advances the simulation."""
    found: list[str] = []
    until = clock(engine) + LOOKED
    while len(found) < LISTED and clock(engine) < until and not _over(engine):
        step(engine)
        api = engine.api.vehicle
        for name in engine.call(engine.api.simulation.getDepartedIDList):
            if engine.call(api.getVehicleClass, name) == "passenger":
                found.append(name)
    return found[:LISTED]


def step(engine: Engine) -> None:
    """Advance by one step.

    Raises:
        SumoFailed: SUMO cannot go on.
    """
    engine.call(engine.api.simulationStep)


def clock(engine: Engine) -> float:
    """Return SUMO's time [s]."""
    return float(engine.call(engine.api.simulation.getTime))


def _await(engine: Engine, file: Path, name: str) -> None:
    seen: list[str] = []
    while not _over(engine):
        step(engine)
        departed = engine.call(engine.api.simulation.getDepartedIDList)
        if name in departed:
            return
        seen += departed[: max(0, LISTED - len(seen))]
    left = engine.call(engine.api.simulation.getMinExpectedNumber)
    until = f"{clock(engine):g} s, when {'it ends' if left else 'nobody is left'}"
    problem = f"no vehicle {name!r} departs before {until}"
    remedy = f"choose one of those that do, such as {', '.join(seen)}" if seen else "nobody does"
    raise NeverDeparts(file, problem, remedy)


def _over(engine: Engine) -> bool:
    """Check whether the simulation is at its end, or has no vehicles left."""
    api = engine.api.simulation
    end = float(engine.call(api.getEndTime))
    late = clock(engine) >= (end if end >= 0.0 else LONGEST)
    return late or engine.call(api.getMinExpectedNumber) == 0


def _add(engine: Engine, file: Path, rider: Added) -> str:
    api = engine.api
    begin = clock(engine) if rider.begin is None else rider.begin
    step(engine)
    while clock(engine) < begin:
        step(engine)
    taken = {*engine.call(api.vehicle.getIDList), *engine.call(api.simulation.getLoadedIDList)}
    name = _free(taken)
    kind, when, lane, place, speed = "DEFAULT_VEHTYPE", "now", "best", "base", "max"
    way = engine.call(api.simulation.findRoute, rider.origin, rider.destination, kind).edges
    if not way:
        problem = f"no way for cars leads from {rider.origin!r} to {rider.destination!r}"
        raise NeverDeparts(file, problem, "choose other edges")
    engine.call(api.route.add, f"route of {name}", way)
    engine.call(api.vehicle.add, name, f"route of {name}", kind, when, lane, place, speed)
    engine.call(api.vehicle.setSpeedFactor, name, 1.0)  # SUMO would draw a random one
    for _ in range(round(PATIENCE / engine.call(api.simulation.getDeltaT))):
        if name in engine.call(api.vehicle.getIDList):
            return name
        step(engine)
    problem = f"there is no gap on {rider.origin!r} within {PATIENCE:g} s of {begin:g} s"
    raise NeverDeparts(file, problem, "begin earlier, or choose another edge")


def _free(taken: set[str]) -> str:
    """Return an id that is not taken."""
    return next(x for x in chain([EGO_ID], (f"{EGO_ID}_{k}" for k in count(1))) if x not in taken)
