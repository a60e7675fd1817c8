"""Incident reports: what a ride's record shows of a moment, as values and as one HTML file."""
