"""What happened, what was believed and decided, and summaries of the ride."""
