"""Answers: one explainer for each kind of question, and the engine that picks it."""
