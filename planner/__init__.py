"""IGP2-style planner: scene history in, PlanTrace and commands out."""
