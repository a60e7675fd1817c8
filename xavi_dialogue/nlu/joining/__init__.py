"""What units of an utterance that stand beside each other say together."""
