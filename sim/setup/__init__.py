"""Scenarios: how they are read, checked, and started in SUMO."""
