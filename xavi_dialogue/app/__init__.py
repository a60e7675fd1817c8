"""The composition root: the only package that knows the world, the planner and the bus."""
