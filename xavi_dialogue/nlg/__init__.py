"""Natural language generation: answers into English. Content planning, then surface form."""
