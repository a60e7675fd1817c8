"""Road users in a report: where they were, who is involved, and what was observed of them."""
