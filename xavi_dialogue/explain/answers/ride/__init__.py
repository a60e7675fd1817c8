"""Explainers of the ride: its way, places, delays, comfort and right of way."""
