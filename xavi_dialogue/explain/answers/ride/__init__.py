"""What the ride was like: its way, places, delays, comfort and right of way."""
