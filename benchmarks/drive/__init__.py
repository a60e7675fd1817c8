"""Driving, beside SUMO's own driver."""
