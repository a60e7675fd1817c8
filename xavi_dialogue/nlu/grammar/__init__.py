"""Grammar: words have senses, senses form phrases and clauses; rules and lexicon are data."""
