"""Compile the planner's kernels so that the first ride starts at once; fast if they are cached.

python -m xavi_dialogue.vehicle.compile_kernels
"""

from sim.roads.netfile import read_network
from sim.setup.scenario import load
from xavi_dialogue.vehicle.replan_worker import warm_up

SCENARIO = "s1"  # the roads of the decision that compiles them

if __name__ == "__main__":
    warm_up(read_network(load(SCENARIO).network))
