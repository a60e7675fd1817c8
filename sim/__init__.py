"""The world: scenes, road network, SUMO and scenario folders."""
