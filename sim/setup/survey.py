"""A survey of where vehicles drive in a SUMO configuration, and how many others are near.

It helps to choose a ride.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from sim.engine import Engine
from sim.setup.departing import clock
from sim.setup.options import ALWAYS, listed

STEP = 1.0  # [s] of the simulation
NEAR = 50.0  # [m] greatest distance at which others count as company


@dataclass(frozen=True, slots=True)
class Stay:
    """One vehicle on one edge."""

    edge: str
    begin: float  # [s] of SUMO's clock when it was first seen there
    end: float  # [s] when it was first seen elsewhere, or gone
    company: float  # average number of vehicles near it


@dataclass(frozen=True, slots=True)
class Trail:
    """The edges that a vehicle drove along and left, without those inside junctions."""

    vehicle: str
    stays: tuple[Stay, ...]


@dataclass
class _Open:
    """A stay that has not ended."""

    edge: str
    begin: float
    company: list[int] = field(default_factory=list)


def survey(file: Path, seed: int, seconds: float) -> tuple[Trail, ...]:
    """Let SUMO run a configuration for a while, and watch its vehicles.

    Args:
        file: the configuration.
        seed: of SUMO's random numbers.
        seconds: [s] duration of the run, from the configuration's begin.

    Returns:
        The trails, by the vehicles' ids.

    Raises:
        SumoFailed: SUMO does not accept the configuration, or cannot go on.
        SimulationError: SUMO is not installed or runs in this process already.
    """
    options = {"--configuration-file": str(file), "--seed": str(seed), "--random": "false"}
    options |= {"--step-length": repr(STEP), **ALWAYS, "--no-warnings": "true"}
    with Engine() as engine:
        engine.start(listed(options), file)
        watched = _Watch(engine)
        return engine.guarded(file, lambda: watched.run(seconds))


class _Watch:
    """An observer of the vehicles in a running simulation."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._open: dict[str, _Open] = {}
        self._trails: dict[str, list[Stay]] = {}

    def run(self, seconds: float) -> tuple[Trail, ...]:
        call: Callable[..., Any] = self._engine.call
        for _ in range(math.ceil(seconds / STEP)):
            call(self._engine.api.simulationStep)
            self._look()
        return tuple(Trail(name, tuple(self._trails[name])) for name in sorted(self._trails))

    def _look(self) -> None:
        api, call = self._engine.api.vehicle, self._engine.call
        ids = tuple(call(api.getIDList))
        for vehicle in [x for x in self._open if x not in set(ids)]:
            self._close(vehicle)
        for vehicle, near in zip(ids, self._company(ids), strict=True):
            edge: str = call(api.getRoadID, vehicle)
            known = self._open.get(vehicle)
            if edge and not edge.startswith(":") and (known is None or known.edge != edge):
                if known is not None:
                    self._close(vehicle)
                known = self._open[vehicle] = _Open(edge, clock(self._engine))
            if known is not None:
                known.company.append(near)

    def _company(self, ids: tuple[str, ...]) -> list[int]:
        """Return the number of others near each vehicle."""
        api, call = self._engine.api.vehicle, self._engine.call
        places = np.array([call(api.getPosition, vehicle) for vehicle in ids]).reshape(-1, 2)
        apart = np.hypot(*(places[:, None] - places[None, :]).transpose(2, 0, 1))
        counts: list[int] = (np.sum(apart <= NEAR, axis=1) - 1).tolist()
        return counts

    def _close(self, vehicle: str) -> None:
        stay = self._open.pop(vehicle)
        company = sum(stay.company) / max(len(stay.company), 1)
        ended = Stay(stay.edge, stay.begin, clock(self._engine), company)
        self._trails.setdefault(vehicle, []).append(ended)
