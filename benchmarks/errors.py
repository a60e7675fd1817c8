"""Errors of benchmarks, in their input or found by them."""

from xavi_dialogue.process.exit_status import RunFault, UsageFault


class FaultFound(RunFault):
    """A text makes the parser fail."""


class QuestionFileError(UsageFault):
    """A folder or file of annotated questions cannot be used."""


class ForeignUnusable(UsageFault):
    """A file of rides, or the name of a network, cannot be used."""


class Igp2Unusable(UsageFault):
    """A checkout of IGP2 cannot be run beside our planner."""
