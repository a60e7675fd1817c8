"""History: the record of a ride, the motion in it, and what the ego carried out."""
