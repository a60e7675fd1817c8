"""Golden conversations: read, replayed, compared and counted."""
