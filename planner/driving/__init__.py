"""Driving: from scene to command, step by step."""
