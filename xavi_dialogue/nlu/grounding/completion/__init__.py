"""Completion: turns that take a part of their meaning from the turns before."""
