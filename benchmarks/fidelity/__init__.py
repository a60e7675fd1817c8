"""What is said of foils, beside what SUMO makes of them."""
