"""Explainers: what can be seen, what cannot, and which lanes are free."""
