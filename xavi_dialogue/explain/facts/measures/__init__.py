"""Measures: the value of each attribute, or why it has none."""
