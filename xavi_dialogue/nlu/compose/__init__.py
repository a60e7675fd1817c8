"""Composition: the parse of an utterance becomes typed terms of the domain."""
