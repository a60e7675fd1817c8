"""Hold-ups: which vehicles were in the ego's way in the rollouts of an intervention, and how."""

from dataclasses import dataclass

from planner.record.trace import HeldUp, HoldUp
from xavi_dialogue.causal.mixtures import Result
from xavi_dialogue.causal.model import Choice, Intervention


@dataclass(frozen=True, slots=True)
class VehicleHoldUp:
    """The hold-ups of the ego by one vehicle under an intervention."""

    vehicle: int
    how: HoldUp  # the way in which it does so longest
    share: float  # weight of the results in which it does
    duration: float  # [s] mean over those results
    speed_from: float  # [m/s] its speed when the longest stretch of that kind begins, ...
    speed_to: float  # [m/s] ... and its lowest within it: both where the lowest is the median
    choice: Choice  # the goal and trajectory under which it does so most
    began: float  # [s] when the first stretch begins, at the earliest
    at_once: float  # share of the weight of those results in which it begins then

    @property
    def expected(self) -> float:
        """Expected duration [s] over all results."""
        return self.share * self.duration


def hold_ups(
    intervention: Intervention, window: tuple[float, float] | None = None
) -> dict[int, VehicleHoldUp]:
    """Return the vehicles that hold the ego up under an intervention, by vehicle.

    Args:
        intervention: what the ego does.
        window: [s] simulation times between which a hold-up must lie at least in part.
    """
    met: dict[int, list[_Meeting]] = {}
    for result, weight in zip(intervention.results, intervention.weights, strict=True):
        stretches: dict[int, list[HeldUp]] = {}
        if weight <= 0.0:
            continue
        for stretch in result.rollout.held_up:
            if window is None or (stretch.since <= window[1] and stretch.until >= window[0]):
                stretches.setdefault(stretch.vehicle, []).append(stretch)
        for vehicle, found in stretches.items():
            met.setdefault(vehicle, []).append(_Meeting(result, weight, found))
    return {vehicle: _summary(vehicle, met[vehicle]) for vehicle in sorted(met)}


def colliding_choice(intervention: Intervention, vehicle: int) -> Choice | None:
    """Return the goal and trajectory under which a vehicle is collided with most."""
    met = [
        _Meeting(result, weight, [])
        for result, weight in zip(intervention.results, intervention.weights, strict=True)
        if result.rollout.outcome == "collision" and result.rollout.collided_with == vehicle
    ]
    return _likeliest_choice(vehicle, met)


@dataclass(frozen=True, slots=True)
class _Meeting:
    """A result in which a vehicle is in the way."""

    result: Result
    weight: float
    stretches: list[HeldUp]


def _summary(vehicle: int, met: list[_Meeting]) -> VehicleHoldUp:
    share = sum(one.weight for one in met)
    lasted: dict[HoldUp, float] = {}
    for one in met:
        for stretch in one.stretches:
            length = one.weight * (stretch.until - stretch.since)
            lasted[stretch.how] = lasted.get(stretch.how, 0.0) + length
    how = max(lasted, key=lambda kind: lasted[kind])
    longest = [
        (max(alike, key=lambda s: s.until - s.since), one.weight)
        for one in met
        if (alike := [stretch for stretch in one.stretches if stretch.how == how])
    ]
    typical = _typical(longest)
    firsts = [(min(s.since for s in one.stretches), one.weight) for one in met]
    began = min(since for since, _ in firsts)
    return VehicleHoldUp(
        vehicle=vehicle,
        how=how,
        share=min(share, 1.0),
        duration=sum(lasted.values()) / share,
        speed_from=typical.speed_from,
        speed_to=typical.speed_to,
        choice=_likeliest_choice(vehicle, met) or (0, 0),
        began=began,
        at_once=sum(weight for since, weight in firsts if since <= began) / share,
    )


def _typical(stretches: list[tuple[HeldUp, float]]) -> HeldUp:
    """Return the stretch whose lowest speed is the weighted median: a mean may be nobody's."""
    slowest = sorted(stretches, key=lambda one: (one[0].speed_to, one[0].speed_from))
    half, known = sum(weight for _, weight in slowest) / 2.0, 0.0
    for stretch, weight in slowest:
        known += weight
        if known >= half - 1e-9:
            return stretch
    return slowest[-1][0]


def _likeliest_choice(vehicle: int, met: list[_Meeting]) -> Choice | None:
    mass: dict[Choice, float] = {}
    for one in met:
        for name, goal, way in one.result.joint:
            if name == vehicle:
                mass[goal, way] = mass.get((goal, way), 0.0) + one.weight
    return max(mass, key=lambda choice: mass[choice], default=None)
