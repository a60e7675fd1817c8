"""Facts: what the record of a ride shows, as relations with times."""
