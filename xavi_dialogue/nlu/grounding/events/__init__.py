"""Events: what happened, to whom and when, found in the record."""
