"""Worlds with planted causes: scenario folders in which chosen vehicles matter to the ego."""
