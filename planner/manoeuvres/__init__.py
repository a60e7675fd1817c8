"""Macro actions and the manoeuvres that they consist of."""
