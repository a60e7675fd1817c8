"""Answers about what was, is and is expected, in words."""
