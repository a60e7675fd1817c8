"""Lateness: what can be known of the time of a plan that does not arrive while it is simulated.

Rollouts end after the time that is looked ahead (the horizon). How long a plan takes whose
rollouts end so is not known, only that it is longer; those that arrive all the same are the quick
ones, and the mean of their times says nothing of the rest (right censoring: Kaplan and Meier 1958).
"""

from collections.abc import Sequence

from xavi_dialogue.causal.effects import ComponentEffect
from xavi_dialogue.causal.model import Intervention

SURE = 0.995  # probability from which an outcome is that of all rollouts


def in_time(
    found: Sequence[ComponentEffect], there: Intervention, here: Intervention
) -> tuple[ComponentEffect, ...]:
    """Leave the time out where foil or fact is late: that of the few that arrive tells nothing."""
    late = "termination" in (there.likeliest, here.likeliest)
    return tuple(e for e in found if not (late and e.component == "time"))


def exceeds(horizon: float, there: Intervention, here: Intervention) -> float | None:
    """Give how much longer [s] the one of two plans takes that never arrives in time, at least.

    None where neither always does so while the other always arrives, or nothing is known of it.

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
