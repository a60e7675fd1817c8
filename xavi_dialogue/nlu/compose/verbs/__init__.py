"""What verbs of motion, change and light say."""
