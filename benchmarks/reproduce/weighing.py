"""Our evidence from one decision on a row of the paper, whether it bears the row out or not."""

from collections.abc import Sequence

import msgspec

from benchmarks.reproduce.claims import Doing
from benchmarks.reproduce.rows import Row
from planner.counterfactuals.whatif import WhatIfError, replan
from planner.record.trace import Action, Outcome, PlanTrace, WhatIf
from sim.roads.network import Network
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.influence import influence
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.causal.paper import PaperNetwork


class Bearing(msgspec.Struct, frozen=True):
    """The effect on the foil of a vehicle that a row blames."""

    vehicle: int
    does: float  # probability of the actions that the row gives it, or of the last of them
    bits: float  # mutual information of its behaviour with the choice between fact and foil
    significant: bool  # whether that is more than chance
    held_up: float  # [s] expected, that it holds the ego up under the foil
    done_if: float | None  # p(done | do(foil), it does so); None if it never does
    done_else: float | None  # p(done | do(foil), it does otherwise)
    time_if: float | None  # [s] E[time | do(foil), it does so]; None if that never arrives
    time_else: float | None  # [s] likewise if it does otherwise
    decides: bool | None  # whether another action is chosen when planned again without it


class Weighed(msgspec.Struct, frozen=True):
    """The evidence of one decision on one foil."""

    outcomes: dict[Outcome, float]  # p(O | do(foil))
    collision: float  # the largest p(collision | do(foil)) of this decision and those before it
    decisions: int  # number of decisions with known foil and rollouts
    paper_done: float  # p(done | foil) as the paper factorises it, from the same rollouts
    later: float | None  # [s] E[time | do(foil)] - E[time | do(fact)]
    printed: float | None  # [s] E[time | fact] - E[time | foil]: Equation 8 as it is printed
    bearings: tuple[Bearing, ...] = ()


def weigh(
    trace: PlanTrace,
    before: Sequence[PlanTrace],
    fact: Actions,
    foil: Action,
    rows: Sequence[Row],
    network: Network,
) -> Weighed | None:
    """Return the evidence on a foil; None if no rollout begins with it.

    Args:
        trace: the decision.
        before: those before it in the same ride.
        fact: the plan, as far as there is evidence for it.
        foil: that was not done.
        rows: of the foil; the vehicles that they blame are looked at.
        network: of roads.
    """
    model = CausalModel(trace)
    there, here = model.intervene((foil,)), model.intervene(fact)
    if there is None or here is None:
        return None
    known = [found for one in before if (found := CausalModel(one).intervene((foil,)))]
    paper = PaperNetwork(trace)
    blamed = {cause.vehicle: cause for row in rows for cause in row.claim.causes}
    return Weighed(
        outcomes=there.outcomes,
        collision=max(found.outcomes["collision"] for found in (*known, there)),
        decisions=len(known) + 1,
        paper_done=paper.outcomes((foil,))["done"],
        later=next((e.delta for e in effects(there, here) if e.component == "time"), None),
        printed=paper.difference(fact, (foil,), "time"),
        bearings=tuple(
            _bearing(model, here, there, cause, network)
            for cause in blamed.values()
            if cause.vehicle in model.vehicles
        ),
    )


def _bearing(
    model: CausalModel,
    here: Intervention,
    there: Intervention,
    cause: Doing,
    network: Network,
) -> Bearing:
    vehicle = cause.vehicle
    measured = next(i for i in influence(model, (here, there)) if i.vehicle == vehicle)
    held = hold_ups(there).get(vehicle)
    chances = model.choices(vehicle)
    so = frozenset(choice for choice in chances if _goes(model.trace, cause, choice))
    given = _confined(model.trace, there, vehicle, so)
    other = _confined(model.trace, there, vehicle, frozenset(chances.keys() - so))
    return Bearing(
        vehicle=vehicle,
        does=sum(chances[choice] for choice in so),
        bits=measured.bits,
        significant=measured.significant,
        held_up=0.0 if held is None else held.expected,
        done_if=None if given is None else given.outcomes["done"],
        done_else=None if other is None else other.outcomes["done"],
        time_if=None if given is None else given.expectation("time"),
        time_else=None if other is None else other.expectation("time"),
        decides=_decides(model.trace, vehicle, network),
    )


def _goes(trace: PlanTrace, cause: Doing, choice: Choice) -> bool:
    """Check whether a choice ends with the actions; the first ones may be over already."""
    goals = next(p.goals for p in trace.predictions if p.vehicle == cause.vehicle)
    done = goals[choice[0]].trajectories[choice[1]].actions
    moves = tuple(action for action in done if action != "continue")
    return bool(moves) and cause.actions[-len(moves) :] == moves


def _confined(
    trace: PlanTrace, there: Intervention, vehicle: int, choices: frozenset[Choice]
) -> Intervention | None:
    """Return a plan limited to some choices of a vehicle; None if it never makes them."""
    if not choices:
        return None
    return CausalModel(trace, {vehicle: choices}).intervene(there.plan)


def _decides(trace: PlanTrace, vehicle: int, network: Network) -> bool | None:
    try:
        again = replan(trace, network, WhatIf(removed=vehicle))
    except WhatIfError:
        return None
    return again.plan[0].action != trace.plan[0].action
