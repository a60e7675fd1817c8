"""What would have come of something else, and what could have been done."""
