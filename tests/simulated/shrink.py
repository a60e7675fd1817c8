"""A failing run made shorter: the fewest and simplest faults with which it still fails."""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace

from tests.simulated.plan import Fault, Plan
from tests.simulated.world import Outcome

Run = Callable[[Plan], Outcome]


def kinds(problems: tuple[str, ...]) -> frozenset[str]:
    """Return what kinds of problems these are: their first lines without names and numbers."""
    return frozenset(re.sub(r"'[^']*'|[\d.]+", "", p.split("\n")[0])[:60] for p in problems)


def shrink(plan: Plan, run: Run) -> tuple[Plan, Outcome]:
    """Return a shorter plan that fails in one of the same ways, and what comes of it."""
    best, outcome = plan, run(plan)
    wanted = kinds(outcome.problems)
    going = bool(wanted)
    while going:
        going = False
        for simpler in _simpler(best):
            tried = run(simpler)
            if kinds(tried.problems) & wanted:
                best, outcome, going = simpler, tried, True
                break
    return best, outcome


def _simpler(plan: Plan) -> Iterator[Plan]:
    """Yield plans with a fault less, or with one that is smaller."""
    for fault in plan.faults:
        yield plan.without(frozenset((fault,)))
    for fault in plan.faults:
        for smaller in _smaller(fault):
            faults = tuple(smaller if one is fault else one for one in plan.faults)
            yield replace(plan, faults=faults)


def _smaller(fault: Fault) -> Iterator[Fault]:
    if fault.lasts > 0.2:
        yield replace(fault, lasts=round(fault.lasts / 2.0, 2))
    if fault.kind == "crash" and fault.amount > 4.0:
        yield replace(fault, amount=float(int(fault.amount / 2.0)))
