"""Our planner beside IGP2's published one, in the same scenes."""
