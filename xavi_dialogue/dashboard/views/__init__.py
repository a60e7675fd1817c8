"""What browsers draw: map, decision, search tree, evidence."""
