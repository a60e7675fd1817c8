"""What a question refers to: moments, vehicles, episodes, and what was not done."""
