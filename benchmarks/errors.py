"""What can be wrong with what is given to a benchmark, or found by it."""


class FaultFound(ValueError):
    """A text makes the parser fail."""


class QuestionFileError(ValueError):
    """A folder or file of annotated questions cannot be used."""


class ForeignUnusable(ValueError):
    """A file of rides, or the name of a network, cannot be used."""
