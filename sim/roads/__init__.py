"""The road network: lanes, links and maps read from files."""
