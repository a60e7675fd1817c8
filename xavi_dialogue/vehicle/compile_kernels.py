"""Compilation of the planner's kernels, so that the first ride starts at once.

It is fast if they are cached.

python -m xavi_dialogue.vehicle.compile_kernels
"""

from sim.roads.netfile import read_network
from sim.setup.scenario import load
from xavi_dialogue.vehicle.replan_worker import warm_up

SCENARIO = "s1"  # scenario whose roads are used for the decision that compiles them

if __name__ == "__main__":
    warm_up(read_network(load(SCENARIO).network))
