"""Reasons told, beside the decisions that they explain."""
