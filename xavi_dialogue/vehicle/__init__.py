"""The vehicle process: the ride, its reports, and planning again beside the driving."""
