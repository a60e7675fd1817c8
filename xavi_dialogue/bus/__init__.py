"""The bus: messages, who may send them, and what carries them."""
