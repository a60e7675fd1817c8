"""Things: descriptions, pronouns and places, resolved against the world."""
