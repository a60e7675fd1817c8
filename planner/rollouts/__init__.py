"""Rollouts: the ego drives macro actions; what is gained, and up to where."""
