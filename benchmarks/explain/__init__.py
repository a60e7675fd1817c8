"""Time and correctness of explanations."""
