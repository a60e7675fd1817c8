"""Causes that answers name, compared with rides without these vehicles."""
