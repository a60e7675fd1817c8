"""Checks of the statements in answers, by subject; each is found by its wording."""
