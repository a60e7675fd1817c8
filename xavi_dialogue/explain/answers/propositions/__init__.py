"""Explainers: whether something holds, what value it has, and who or what it is."""
