"""Lateness: what can be known of the time of a plan that does not arrive while it is simulated.

Rollouts end after the time that is looked ahead (the horizon). If the rollouts of a plan end that
way, it is only known that the plan takes longer. The rollouts that arrive all the same are the
quick ones, and their mean time shows nothing about the rest (right censoring: Kaplan and Meier
1958).
"""

from collections.abc import Sequence

from xavi_dialogue.causal.effects import ComponentEffect
from xavi_dialogue.causal.model import Intervention

SURE = 0.995  # probability from which an outcome counts as that of all rollouts


def in_time(
    found: Sequence[ComponentEffect], there: Intervention, here: Intervention
) -> tuple[ComponentEffect, ...]:
    """Drop the effect on time if foil or fact is late: only few rollouts have a time then."""
    late = "termination" in (there.likeliest, here.likeliest)
    return tuple(e for e in found if not (late and e.component == "time"))


def exceeds(horizon: float, there: Intervention, here: Intervention) -> float | None:
    """Return the minimum time [s] by which a plan that never arrives in time takes longer.

    None unless one of the plans never arrives in time and the other always does.

    Args:
        horizon: [s] that rollouts look ahead.
        there: one plan.
        here: the other.
    """
    for late, other in ((there, here), (here, there)):
        time = other.expectation("time")
        sure = min(late.outcomes["termination"], other.outcomes["done"]) >= SURE
        if sure and time is not None:
            return max(horizon - time, 0.0)
    return None
