"""Surface: messages into text by context-free grammars, morphology and orthography."""
