"""The dashboard: a client of the bus that shows a car, its decisions and the conversation."""
