"""The terminal: input line, screen and slash commands."""
