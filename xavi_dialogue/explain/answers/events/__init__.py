"""What happened, what was believed and decided, and how the ride is stated."""
