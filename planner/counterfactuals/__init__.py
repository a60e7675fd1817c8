"""Counterfactuals: a recorded decision planned again with something changed."""
