"""From one PlanTrace to its Bayesian network: outcomes, effects, influence, hold-ups."""
