"""Recording what the bus carries, and playing it back."""
