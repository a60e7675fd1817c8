"""Predictions of other vehicles, compared with what they did."""
