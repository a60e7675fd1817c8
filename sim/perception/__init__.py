"""What the ego can see, and how it looks."""
