"""Explainers: the consequences of suppositions, and what could have been done."""
