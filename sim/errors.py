"""The root of the simulation's errors."""


class SimError(Exception):
    """SUMO, a road network or a scenario cannot be used."""
