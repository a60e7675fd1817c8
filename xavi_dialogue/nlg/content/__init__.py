"""Content: one function for each type of answer, which plans the messages that state it."""
