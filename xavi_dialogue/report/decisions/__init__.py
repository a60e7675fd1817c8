"""Decisions in a report: what was believed and weighed, and what else might have been."""
