"""Surface: messages to text by context-free grammars, morphology and orthography."""
