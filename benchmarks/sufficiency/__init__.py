"""Stated reasons, compared with the decisions that they explain."""
