"""Episodes: what happened, from when to when."""
