"""A worker process that plans decisions again on request, separate from the driving.

It reads one order per line from its standard input and writes one result per line to its standard
output; the first line says that it is ready. It ends when its input ends, even in the middle of
planning, so that it does not outlive its car.

    python -m xavi_dialogue.vehicle.replan_worker s1.net.xml
"""

import os
import queue
import sys
import threading
from pathlib import Path
from typing import IO

import msgspec
import numpy as np

from planner.counterfactuals.whatif import Inapplicable, NotInView, WhatIfError, replan
from planner.driving.driver import Driver
from planner.errors import TraceError
from planner.kernels.elementary import power
from planner.record import trace as plan_trace
from planner.record import trace_reading
from planner.record.trace import EgoGoal, Settings, WhatIf
from planner.roads.levels import load_kernels
from planner.roads.trajectory import Roads
from planner.search.inputs import root_at
from sim.roads.netfile import read_network
from sim.roads.network import Network, point_at
from sim.scene import EGO, Scene, VehicleState
from xavi_dialogue.bus.messages import Failure
from xavi_dialogue.domain.answers import Reason

READY = b"ready\n"
ROOM = 40.0  # [m] least length of the lane for the decision that warms up
STEP = 0.1  # [s] duration of the step that is driven then


class ReplanOrder(msgspec.Struct, frozen=True):
    """A decision to plan again, with the change to apply."""

    trace: msgspec.Raw
    what_if: WhatIf


class Result(msgspec.Struct, frozen=True):
    """The result: a PlanTrace, or a Failure with the reason."""

    planned: bool
    message: msgspec.Raw


def obey(order: ReplanOrder, network: Network) -> Result:
    """Plan again as ordered."""
    try:
        trace = replan(trace_reading.decode(bytes(order.trace)), network, order.what_if)
    except (WhatIfError, TraceError) as error:
        failure = Failure(reason=_reason(error), detail=str(error))
        return Result(False, msgspec.Raw(msgspec.json.encode(failure)))
    return Result(True, msgspec.Raw(plan_trace.encode(trace)))


def _reason(error: Exception) -> Reason:
    match error:
        case NotInView():
            return "unknown-vehicle"
        case Inapplicable():
            return "not-applicable"
    return "planner-failed"


def warm_up(network: Network) -> None:
    """Decide once behind another car, and drive a step, so that all kernels are loaded."""
    power(np.ones(1), 1.5)  # of ways beside the middle of a lane, which that decision has none of
    load_kernels()
    for lane in network.lanes.values():
        links = network.links_from(lane.id)
        if lane.internal or lane.length < ROOM or not links:
            continue
        roads, scene = Roads(network), {}
        for vehicle, offset in ((EGO, 0.1 * lane.length), (1, 0.6 * lane.length)):
            position, heading = point_at(lane.centreline, offset)
            scene[vehicle] = VehicleState(position, heading, 5.0, 0.0, 4.8, 1.8)
        if root_at(roads, scene[EGO], 0.0) is None:
            continue
        goal = EgoGoal(network.lanes[links[0].to_lane].edge, 1.0, None)
        settings = Settings(rollouts=4, min_rollouts=1, comparisons=1, reacting=True)
        Driver(network, goal, settings, 0).step(Scene(0.0, scene), STEP)
        return


def work(network: Network, orders: "queue.SimpleQueue[bytes]", out: IO[bytes]) -> None:
    """Warm up, report readiness, and carry out orders until input ends."""
    warm_up(network)
    line = READY
    while True:
        try:
            out.write(line)
            out.flush()
        except BrokenPipeError:
            return
        order = msgspec.json.decode(orders.get(), type=ReplanOrder)
        line = msgspec.json.encode(obey(order, network)) + b"\n"


def _listen(stream: IO[bytes], orders: "queue.SimpleQueue[bytes]") -> None:
    """Queue the orders that arrive; end the process when the stream ends."""
    for line in stream:
        if line.endswith(b"\n"):  # else the process that wrote it died while writing
            orders.put(line)
    os._exit(os.EX_OK)


def main() -> None:
    """Work on the road network whose file is named on the command line."""
    out, sys.stdout = sys.stdout.buffer, sys.stderr  # nothing else may be written between results
    orders: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, orders), daemon=True).start()
    work(read_network(Path(sys.argv[1])), orders, out)


if __name__ == "__main__":
    main()
