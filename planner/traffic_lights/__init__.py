"""Traffic lights: what they mean over time, and how they may go on."""
