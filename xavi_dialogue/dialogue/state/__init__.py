"""The state of a conversation: its turns, and what later turns depend on."""
