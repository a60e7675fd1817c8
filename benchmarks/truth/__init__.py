"""Answers checked statement by statement against scenes and traces, without explain or nlg."""
