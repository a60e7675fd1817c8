"""Time per decision."""
