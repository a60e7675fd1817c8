"""Clauses and nouns: the parts that propositions are made of."""
