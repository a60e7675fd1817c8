"""Roads as the planner drives them: paths, ways through junctions, levels."""
