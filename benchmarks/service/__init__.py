"""Answers and the dashboard under load."""
