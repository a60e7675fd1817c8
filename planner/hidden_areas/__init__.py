"""Hidden areas: imagined road users, and caution before them."""
