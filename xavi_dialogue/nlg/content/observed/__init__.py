"""What was, is and is expected, in words."""
