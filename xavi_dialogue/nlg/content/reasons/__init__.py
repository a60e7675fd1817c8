"""Reasons, causes and suppositions in words."""
