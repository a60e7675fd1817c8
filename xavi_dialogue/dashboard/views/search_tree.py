"""The search tree of a decision for browsers."""

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.dashboard.views.labels import deed, has_lane_change, hold_up_words, refusals
from xavi_dialogue.dashboard.views.trajectories import chance
from xavi_dialogue.dashboard.web.http_documents import Branch
from xavi_dialogue.inspection import search_tree

DIGITS = 3  # of values and times


def branches(trace: PlanTrace) -> tuple[Branch, ...]:
    """Return the branches of the root, the chosen one first; none without a search."""
    try:
        root = search_tree.grow(trace)
    except search_tree.TreeError:
        return ()
    return _beneath(root, arrives=trace.waypoint is None)


def rounded(value: float | None) -> float | None:
    """Return a value or a time, rounded."""
    return None if value is None else round(value, DIGITS)


def _beneath(branch: search_tree.Branch, *, arrives: bool) -> tuple[Branch, ...]:
    in_lane = has_lane_change(child.actions[-1] for child in branch.children)
    return tuple(_branch(child, in_lane, arrives) for child in branch.children)


def _branch(branch: search_tree.Branch, in_lane: bool, arrives: bool) -> Branch:
    """Return one branch; `arrives`: rollouts aim for the goal, not for a waypoint."""
    action, total = branch.actions[-1], branch.visits + branch.forced
    value = next((v for v in (branch.alike, branch.value, branch.mean) if v is not None), None)
    return Branch(
        action=action,
        words=deed(action, in_lane=in_lane),
        chosen=branch.chosen,
        visits=branch.visits,
        forced=branch.forced,
        value=rounded(value),
        arrival=rounded(branch.time) if arrives else None,
        outcomes={name: chance(count / total) for name, count in branch.outcomes.items()},
        held_up=tuple(
            (one.vehicle, hold_up_words(one.how), chance(one.share)) for one in branch.held_up
        ),
        children=_beneath(branch, arrives=arrives),
        refused=_refused(branch),
    )


def _refused(branch: search_tree.Branch) -> tuple[tuple[Action, str], ...]:
    refused = ((action, reason) for reason, actions in branch.refused for action in actions)
    return refusals(refused, (child.actions[-1] for child in branch.children))
