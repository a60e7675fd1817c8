"""Search: MCTS over macro actions, and one decision."""
