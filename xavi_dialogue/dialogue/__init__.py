"""The sans-I/O dialogue manager: events in, events out."""
