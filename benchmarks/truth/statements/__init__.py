"""Statements of answers, by what they are about: what to check of each, by its wording."""
