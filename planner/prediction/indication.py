"""The probability of a vehicle's indicators, given its goal.

Drivers who turn usually indicate it, the more surely the nearer the turn is. Those who do not turn
hardly ever indicate, except before a lane change. Turn signals are used in about three of four
turns on the road (Ponziani 2012, SAE 2012-01-0261), and nearly always in SUMO; the shares here lie
between.
On roundabouts habits differ too much, so indicators are ignored there.
"""

from collections.abc import Sequence

from planner.manoeuvres.actions import Situation
from planner.motion.tracks import Observed, Side
from planner.prediction.goals import BACK, BRANCHES, Goal
from planner.roads.routes import approach
from planner.roads.trajectory import Roads

SOON = 4.0  # [s] to the turn, at the speed limit, within which nearly everybody indicates
RAMP = 1.0  # [s] before that, over which their share grows
SHOWN = (0.9, 0.6)  # share of those who indicate a turn: soon, and early
BRANCHING = 0.4  # ... and a turn into a road that branches off, which some take without it
WRONG = 0.02  # share of those who indicate the other side
MEANT = {False: 0.03, True: 0.2}  # ... and who do not turn; True: to a side with a lane


def indicated(
    roads: Roads, observed: Observed, here: Situation, goals: Sequence[Goal], view: float
) -> list[float]:
    """Return the probability of the indicators shown, given each goal.

    Args:
        roads: the road network.
        observed: the vehicle, with what it indicates now.
        here: where it is.
        goals: its possible goals.
        view: [m] how far ahead junctions are looked for.
    """
    if len(observed.indicating) > 1 or any("roundabout" in goal.place for goal in goals):
        return [1.0] * len(goals)
    shown = next(iter(observed.indicating), None)
    lane = roads.network.lanes[here.location.lane]
    ahead = approach(roads, here.location, view).distance / lane.speed_limit
    soon = min(max((SOON + RAMP - ahead) / RAMP, 0.0), 1.0)
    beside = shown is not None and _lane_beside(roads, here, shown)
    return [_share(_side(goal), shown, soon=soon, beside=beside) for goal in goals]


def _share(
    side: tuple[Side, bool] | None, shown: Side | None, *, soon: float, beside: bool
) -> float:
    """Return the share of the drivers with a goal on one side who indicate as observed.

    Args:
        side: the side to which the goal turns, and whether it only branches off; None: straight.
        shown: the side indicated.
        soon: how near the turn is, from 0 (early) to 1 (soon). Shares change linearly between,
            so that a metre more or less does not change what is believed.
        beside: whether there is a lane on the side indicated.
    """
    if side is None:
        return 1.0 - 2.0 * MEANT[False] if shown is None else MEANT[beside]
    usual = BRANCHING if side[1] else _between(SHOWN[1], SHOWN[0], soon)
    if shown is None:
        return 1.0 - usual - WRONG
    if shown == side[0]:
        return usual
    return _between(MEANT[True], WRONG, soon) if beside else WRONG


def _between(early: float, late: float, soon: float) -> float:
    """Return a share between those early and late before a turn, by how near the turn is."""
    return early + soon * (late - early)


def _side(goal: Goal) -> tuple[Side, bool] | None:
    """Return the side to which a goal turns off, and whether it only branches off there."""
    if goal.place == BRANCHES["left"]:
        return "left", True
    if goal.place == BRANCHES["right"]:
        return "right", True
    if goal.kind == "exit-left" or goal.place == BACK:
        return "left", False
    return ("right", False) if goal.kind == "exit-right" else None


def _lane_beside(roads: Roads, here: Situation, side: Side) -> bool:
    """Check whether there is a lane of the same road on a side of a vehicle."""
    lane = roads.network.lanes[here.location.lane]
    lanes = () if lane.internal else roads.network.edge_lanes(lane.edge)
    return lane.index + (1 if side == "left" else -1) in {one.index for one in lanes}
