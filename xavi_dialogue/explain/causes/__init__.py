"""Causes: why things came about, and what would have come of others; from traces."""
