"""Motion: others as moving obstacles, tracks, and forward simulation."""
