"""Predictions of others, beside what they did."""
