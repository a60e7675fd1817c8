"""What is told of a probability among rollouts, by hand."""

from planner.record.trace import Outcome
from xavi_dialogue.explain.causes.plans.ranges import table

ERROR = table().model_error  # probability that rollouts tell nothing of the outcome
UNFORESEEN = table().unforeseen or dict.fromkeys(("done", "collision", "termination", "dead"), 0.25)


def trusted(probability: float, outcome: Outcome = "collision") -> float:
    """How probable one of four outcomes is that has this probability among the rollouts."""
    return (1.0 - ERROR) * probability + ERROR * UNFORESEEN[outcome]
