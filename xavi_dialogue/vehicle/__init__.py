"""The vehicle process: runs the ride, publishes reports and plans again on request."""
