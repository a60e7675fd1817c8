"""Inspection of a decision: its search tree as text."""
