"""Rides as recordings that viewers of robots show: Foxglove and Lichtblick."""

#: The message where the packages of the schemas are missing.
MISSING = "viewers need more packages: pip install 'xavi-dialogue[viewers]'"
