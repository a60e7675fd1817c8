"""One ride of an audit: driven or opened, its facts, and its answers."""
