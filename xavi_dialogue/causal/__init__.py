"""Exact inference over the Bayesian network of one PlanTrace."""
