"""Language data: question and answer grammars, lexicon, rewrites."""
