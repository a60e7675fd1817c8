"""Documents that browsers draw: map, decision, search tree, evidence."""
