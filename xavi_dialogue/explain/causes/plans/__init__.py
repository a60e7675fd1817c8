"""Plans compared: what speaks for one, how it may end, and how sure that is."""
