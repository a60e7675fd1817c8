"""The bus: messages, access control, and transport."""
