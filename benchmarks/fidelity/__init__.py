"""Statements about foils, compared with what happens in SUMO."""
