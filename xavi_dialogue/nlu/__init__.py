"""Language understanding: text becomes readings, each a row of typed acts."""
