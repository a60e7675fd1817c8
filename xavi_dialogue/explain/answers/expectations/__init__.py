"""What the car expected and planned at a decision."""
