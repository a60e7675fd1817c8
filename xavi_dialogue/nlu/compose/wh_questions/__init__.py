"""Questions with a question word."""
