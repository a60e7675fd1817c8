"""Scenarios: read, checked, and brought into SUMO."""
