"""Where the rides of an audit are worked on: local processes, or a cluster."""
