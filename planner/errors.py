"""Errors of the planner; all derive from `PlannerError`."""


class PlannerError(Exception):
    """The planner, or its record, cannot be used as asked."""


class TraceError(PlannerError, ValueError):
    """A PlanTrace that cannot be read or written."""
