"""Distances, durations, counts and extremes."""
