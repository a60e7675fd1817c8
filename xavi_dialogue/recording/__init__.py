"""Recording messages of the bus, and replaying them."""
