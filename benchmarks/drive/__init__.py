"""Driving, compared with SUMO's own driver."""
