"""Clauses: facts, propositions, measures and manoeuvres in words."""
