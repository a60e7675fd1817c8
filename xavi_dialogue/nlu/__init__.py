"""Language understanding: a text becomes readings, each a sequence of typed acts."""
