"""The dialogue service: requests of passengers, scheduled and answered."""
