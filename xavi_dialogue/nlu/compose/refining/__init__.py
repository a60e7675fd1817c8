"""Refining: what the slots of a clause say beyond the question that is made of them."""
