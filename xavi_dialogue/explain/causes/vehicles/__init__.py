"""Other vehicles as causes: who matters, by planning again without them."""
