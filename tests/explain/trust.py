"""What is told of a probability among rollouts, by hand."""

from xavi_dialogue.explain.causes.ranges import table

ERROR = table().model_error  # probability that rollouts tell nothing of the outcome


def trusted(probability: float) -> float:
    """How probable one of four outcomes is that has this probability among the rollouts."""
    return (1.0 - ERROR) * probability + ERROR * 0.25
