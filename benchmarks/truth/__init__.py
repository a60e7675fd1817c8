"""Checks of answers, statement by statement, against scenes and traces without explain or nlg."""
