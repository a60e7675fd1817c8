"""Errors of the planner; all derive from `PlannerError`."""


class PlannerError(Exception):
    """An error of the planner: it, or its record, cannot be used as requested."""


class TraceError(PlannerError, ValueError):
    """A PlanTrace that cannot be read or written."""
