"""Whole propositions with their phrases."""
