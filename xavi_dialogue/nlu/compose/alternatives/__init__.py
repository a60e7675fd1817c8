"""Yes or no questions, and questions that offer a choice."""
