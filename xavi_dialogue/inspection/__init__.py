"""Looking into a decision: its search tree as text."""
