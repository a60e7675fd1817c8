"""Involved: the vehicles that would have made a foil turn out as it would.

They depend on the foil. A vehicle is named if the foil collides with it more often than the fact,
if it holds the ego up longer under the foil and the foil is slower, or if what it does decides
between the two. Otherwise it is not named. If the foil leaves the way to the goal, no vehicle is
named: no vehicle causes that.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property

from planner.record.trace import HoldUp
from sim.scene import EGO
from xavi_dialogue.causal.effects import ComponentEffect
from xavi_dialogue.causal.holdups import VehicleHoldUp, colliding_choice, hold_ups
from xavi_dialogue.causal.influence import Influence, influence
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.domain.answers import Cause, Mechanism
from xavi_dialogue.explain.history.ride import prediction

MORE_OFTEN = 0.05  # difference in probability by which the foil must run out of time more often
COLLIDES = 0.01  # ... and by which it must collide more often: a collision weighs much
LONGER = 0.5  # [s] expected, by which the foil must be held up longer
LIKELY = 0.5  # minimum share of the rollouts in which somebody probably holds a plan up
AT_ONCE = 0.5  # [s] after a decision in which a hold-up begins that is going on already ...
SURELY = 0.9  # ... in this share of the rollouts that have it
SLOWER = 0.5  # [s] by which the foil must arrive later to be called slower


class _Measured:
    """The influence of each vehicle, measured when it is first asked for."""

    def __init__(self, measure: Callable[[], Sequence[Influence]]) -> None:
        self._measure = measure

    @cached_property
    def known(self) -> dict[int, Influence]:
        """The influence by vehicle."""
        return {found.vehicle: found for found in self._measure()}


NOTHING = _Measured(tuple)


def contrastive_causes(
    model: CausalModel,
    foil: Intervention,
    fact: Intervention,
    effects: Sequence[ComponentEffect],
) -> tuple[Cause, ...]:
    """Find the causes of a contrast, most important first, each vehicle once."""
    if foil.likeliest == "dead":
        return ()
    measured = _Measured(lambda: influence(model, (fact, foil)))
    struck = _struck(model, foil, fact, measured)
    slowed = _slowed(model, foil, fact, effects, measured)
    halts = foil.plan[:1] == ("stop",) and fact.plan[:1] != ("stop",)  # slower anyway
    decided = [] if halts else _deciding(model, measured.known.values())
    first, second = (struck, slowed) if foil.likeliest == "collision" else (slowed, struck)
    found: dict[int, Cause] = {}
    for cause in (*first, *second, *decided):
        found.setdefault(cause.vehicle, cause)
    return tuple(found.values())


def holding_up(
    model: CausalModel, plan: Intervention, window: tuple[float, float] | None = None
) -> tuple[Cause, ...]:
    """Find the vehicles that probably hold the ego up under its plan, longest first.

    Args:
        model: the causal model of the decision.
        plan: what the ego does.
        window: [s] simulation times that the hold-up must overlap.
    """
    found = [
        h for h in hold_ups(plan, window).values() if h.share >= LIKELY and h.expected >= LONGER
    ]
    found.sort(key=lambda h: (-h.expected, h.vehicle))
    return tuple(held_by(model, hold_up) for hold_up in found)


def held_by(model: CausalModel, held: VehicleHoldUp) -> Cause:
    """Return a vehicle that holds the ego up as a cause."""
    return _by_hold_up(model, held, None)


def slowing(model: CausalModel, foil: Intervention, fact: Intervention) -> tuple[int, ...]:
    """List who is hit, or holds the ego up longer, under a foil, most important first."""
    struck = _struck(model, foil, fact, NOTHING)
    return tuple(dict.fromkeys(c.vehicle for c in (*struck, *_longer(model, foil, fact, NOTHING))))


def against(model: CausalModel, vehicle: int) -> Cause:
    """Return as a cause a vehicle that is in the way of what the ego might do instead."""
    choices = model.choices(vehicle)
    likeliest = max(choices, key=lambda choice: choices[choice])
    actions, probability = expected_actions(model, vehicle, likeliest)
    return Cause(vehicle, actions, probability, Mechanism("collision", None, None, None, 0.0))


def expected_actions(model: CausalModel, vehicle: int, choice: Choice) -> tuple[Actions, float]:
    """Return the actions of a goal and trajectory, and the probability that they are taken.

    Of a vehicle without predicted goals, no actions: what it does is taken as given.
    """
    known = prediction(model.trace, vehicle)
    if known is None:
        return (), 1.0
    goal, way = choice
    actions = known.goals[goal].trajectories[way].actions
    probability = sum(
        chance
        for (g, t), chance in model.choices(vehicle).items()
        if known.goals[g].trajectories[t].actions == actions
    )
    return actions, min(probability, 1.0)


def _struck(
    model: CausalModel, foil: Intervention, fact: Intervention, measured: _Measured
) -> list[Cause]:
    before, found = fact.collisions(), []
    for vehicle, share in sorted(foil.collisions().items(), key=lambda item: -item[1]):
        choice = colliding_choice(foil, vehicle)
        if vehicle == EGO or choice is None or share - before.get(vehicle, 0.0) < COLLIDES:
            continue
        mechanism = Mechanism("collision", None, None, None, share)
        actions, probability = expected_actions(model, vehicle, choice)
        bits = _bits(measured.known.get(vehicle))
        found.append(Cause(vehicle, actions, probability, mechanism, bits, None))
    return found


def _slowed(
    model: CausalModel,
    foil: Intervention,
    fact: Intervention,
    effects: Sequence[ComponentEffect],
    measured: _Measured,
) -> list[Cause]:
    later = any(e.component == "time" and e.delta >= SLOWER for e in effects)
    stuck = foil.outcomes["termination"] - fact.outcomes["termination"] >= MORE_OFTEN
    return _longer(model, foil, fact, measured) if later or stuck else []


def _longer(
    model: CausalModel, foil: Intervention, fact: Intervention, measured: _Measured
) -> list[Cause]:
    """Return those who hold the ego up longer under the foil, longest first."""
    before = hold_ups(fact)
    gains = [
        (held.expected - (before[vehicle].expected if vehicle in before else 0.0), held)
        for vehicle, held in hold_ups(foil).items()
    ]
    gains = [(gain, held) for gain, held in gains if gain >= LONGER]
    gains.sort(key=lambda item: (-item[0], item[1].vehicle))
    return [_by_hold_up(model, held, measured.known.get(held.vehicle)) for _, held in gains]


def _deciding(model: CausalModel, measured: Iterable[Influence]) -> list[Cause]:
    """Return those whose behaviour decides between fact (option 0) and foil."""
    found = []
    for influenced in measured:
        if not influenced.significant:
            continue
        speaking = [c for c in influenced.choices if c.options[0] >= influenced.options[0]]
        choice = (speaking or list(influenced.choices))[0].choice
        actions, probability = expected_actions(model, influenced.vehicle, choice)
        bits = influenced.bits
        found.append(Cause(influenced.vehicle, actions, probability, None, bits, None))
    return found


def _by_hold_up(model: CausalModel, held: VehicleHoldUp, measured: Influence | None) -> Cause:
    actions, probability = expected_actions(model, held.vehicle, held.choice)
    present = held.began <= model.trace.sim_time + AT_ONCE and held.at_once >= SURELY
    mechanism = Mechanism(
        _how(held, actions), held.speed_from, held.speed_to, held.duration, held.share, present
    )
    return Cause(held.vehicle, actions, probability, mechanism, _bits(measured), None)


def _how(held: VehicleHoldUp, actions: Actions) -> HoldUp:
    """Return how a vehicle holds the ego up, as people put it: going straight on is no cutting in.

    Rollouts call it a cut-in, too, if the ego moves in behind the vehicle.
    """
    straight = bool(actions) and set(actions) <= {"continue", "exit-straight"}
    return "leader" if held.how == "cut-in" and straight else held.how


def _bits(measured: Influence | None) -> float | None:
    return measured.bits if measured is not None and measured.significant else None
