"""Text to Query, and Explanation to text."""
