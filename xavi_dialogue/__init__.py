"""XAVI Dialogue: a car that answers its passengers from its own planner's record."""

__version__ = "0.1.0"
