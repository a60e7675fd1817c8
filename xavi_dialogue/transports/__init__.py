"""Shells: Zenoh, terminal, wire formats."""
