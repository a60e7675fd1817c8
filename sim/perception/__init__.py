"""The perception of the ego: which road users, traffic lights and lanes it can see."""
