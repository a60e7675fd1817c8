"""Answers about traffic lights."""
