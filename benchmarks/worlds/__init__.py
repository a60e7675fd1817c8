"""Worlds with one planted cause: scenario folders in which one vehicle alone matters to the ego."""
