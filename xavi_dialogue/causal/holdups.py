"""Hold-ups: which vehicles were in the ego's way in the rollouts of an intervention, and how."""

from dataclasses import dataclass

from planner.trace import HeldUp, HoldUp
from xavi_dialogue.causal.model import Choice, Intervention, Result


@dataclass(frozen=True, slots=True)
class VehicleHoldUp:
    """How one vehicle holds the ego up under an intervention."""

    vehicle: int
    how: HoldUp  # the way in which it does so longest
    share: float  # weight of the results in which it does
    duration: float  # [s] mean over those results
    speed_from: float  # [m/s] its mean speed when the longest stretch of that kind begins
    speed_to: float  # [m/s] its mean lowest speed within it
    choice: Choice  # the goal and trajectory under which it does so most

    @property
    def expected(self) -> float:
        """Expected duration [s] over all results."""
        return self.share * self.duration


def hold_ups(intervention: Intervention) -> dict[int, VehicleHoldUp]:
    """The vehicles that hold the ego up under an intervention, by vehicle."""
    met: dict[int, list[tuple[Result, float]]] = {}
    for result, weight in zip(intervention.results, intervention.weights, strict=True):
        for vehicle in {stretch.vehicle: None for stretch in result.rollout.held_up}:
            met.setdefault(vehicle, []).append((result, weight))
    return {vehicle: _summary(vehicle, met[vehicle]) for vehicle in sorted(met)}


def colliding_choice(intervention: Intervention, vehicle: int) -> Choice | None:
    """The goal and trajectory under which a vehicle is collided with most."""
    met = [
        (result, weight)
        for result, weight in zip(intervention.results, intervention.weights, strict=True)
        if result.rollout.outcome == "collision" and result.rollout.collided_with == vehicle
    ]
    return _likeliest_choice(vehicle, met)


def _summary(vehicle: int, met: list[tuple[Result, float]]) -> VehicleHoldUp:
    share = sum(weight for _, weight in met)
    lasted: dict[HoldUp, float] = {}
    total = 0.0
    for result, weight in met:
        for stretch in _stretches(result, vehicle):
            length = weight * (stretch.until - stretch.since)
            lasted[stretch.how] = lasted.get(stretch.how, 0.0) + length
            total += length
    how = max(lasted, key=lambda kind: lasted[kind])
    longest = [
        (max(stretches, key=lambda s: s.until - s.since), weight)
        for result, weight in met
        if (stretches := [s for s in _stretches(result, vehicle) if s.how == how])
    ]
    mass = sum(weight for _, weight in longest)
    return VehicleHoldUp(
        vehicle=vehicle,
        how=how,
        share=min(share, 1.0),
        duration=total / share,
        speed_from=sum(weight * s.speed_from for s, weight in longest) / mass,
        speed_to=sum(weight * s.speed_to for s, weight in longest) / mass,
        choice=_likeliest_choice(vehicle, met) or (0, 0),
    )


def _stretches(result: Result, vehicle: int) -> list[HeldUp]:
    return [stretch for stretch in result.rollout.held_up if stretch.vehicle == vehicle]


def _likeliest_choice(vehicle: int, met: list[tuple[Result, float]]) -> Choice | None:
    mass: dict[Choice, float] = {}
    for result, weight in met:
        for name, goal, way in result.joint:
            if name == vehicle:
                mass[goal, way] = mass.get((goal, way), 0.0) + weight
    return max(mass, key=lambda choice: mass[choice], default=None)
