"""Refusals, requests, clarifications and small talk in words."""
