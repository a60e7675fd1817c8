"""The source of a scenario's traffic, and which vehicle of it is the ego."""

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class FromRoutes:
    """A route file of the scenario's folder, in which the ego departs at 0 s."""


@dataclass(frozen=True, slots=True)
class Departing:
    """A vehicle of SUMO's configuration, as the ego from its departure on."""

    id: str


@dataclass(frozen=True, slots=True)
class Added:
    """A car that is added to those of SUMO's configuration, as the ego."""

    origin: str  # the edge where it starts
    destination: str  # the edge where it wants to go
    begin: float | None  # [s] of SUMO's clock when it departs; None: when the configuration begins


Rider: TypeAlias = Departing | Added


@dataclass(frozen=True, slots=True)
class FromConfiguration:
    """A SUMO configuration with all that it loads; the ride begins when the ego departs."""

    rider: Rider
    sublane: bool  # whether its vehicles move sideways within lanes by SUMO's sublane model


Source: TypeAlias = FromRoutes | FromConfiguration
FROM_ROUTES = FromRoutes()
EGO_ID = "ego"  # id of a car that is added; a number is appended if the id is taken


def told(rider: Rider) -> str:
    """Return words for the ego."""
    match rider:
        case Departing(name):
            return f"vehicle {name!r}"
        case Added(origin, destination):
            return f"a car from {origin!r} to {destination!r}"
