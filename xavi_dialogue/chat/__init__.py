"""The chat of a passenger at a terminal."""
