"""What clauses with "be", and others of states and places, say."""
