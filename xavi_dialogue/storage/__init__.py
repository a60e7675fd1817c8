"""Files: conversations, typed lines, recordings, rides."""
