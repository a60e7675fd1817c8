"""Causes named, beside rides without them."""
