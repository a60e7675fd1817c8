"""A worker process that grows one search tree of each decision of a ride.

It reads frames from its standard input, and writes frames to its standard output: first what stays
the same in the ride, answered by an empty frame, then a moment for each decision, answered by the
tree. It ends when its input ends, even in the middle of a tree, so that it does not outlive its
car.

    python -m xavi_dialogue.vehicle.search_worker s1.net.xml
"""

import os
import pickle
import queue
import sys
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from planner.record.trace import EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.search.decide import grown, predict
from planner.search.inputs import Frame, Moment
from sim.roads.netfile import read_network
from sim.roads.network import Network
from xavi_dialogue.process.garbage import settled
from xavi_dialogue.vehicle.replan_worker import warm_up

HEADER = 8  # bytes before a frame: its length, the highest byte first


@dataclass(frozen=True, slots=True)
class TreeOfRide:
    """The inputs of a worker that stay the same in a ride."""

    goal: EgoGoal
    settings: Settings
    seed: int
    vehicle: str
    tree: int = 1  # number of the tree that it grows, from 1 on


def write_frame(stream: IO[bytes], data: bytes) -> None:
    """Write a frame.

    Raises:
        OSError: nobody reads it.
        ValueError: the stream is closed.
    """
    stream.write(len(data).to_bytes(HEADER, "big") + data)
    stream.flush()


def read_frame(stream: IO[bytes]) -> bytes | None:
    """Read a frame; None: the stream has ended, if need be within a frame."""
    header = stream.read(HEADER)
    length = int.from_bytes(header, "big")
    data = stream.read(length) if len(header) == HEADER else b""
    return data if len(header) == HEADER and len(data) == length else None


def work(network: Network, orders: "queue.SimpleQueue[bytes]", out: IO[bytes]) -> None:
    """Grow a tree for each moment, until input ends. Both come from the car itself."""
    ride: TreeOfRide = pickle.loads(orders.get())
    warm_up(network)
    frame = Frame(Roads(network), ride.goal, ride.settings, ride.seed, ride.vehicle)
    data = b""
    with settled():
        while True:
            try:
                write_frame(out, data)
            except OSError:
                return
            moment: Moment = pickle.loads(orders.get())
            found = grown(frame, moment, predict(frame, moment), ride.tree)
            data = pickle.dumps(found)


def _listen(stream: IO[bytes], orders: "queue.SimpleQueue[bytes]") -> None:
    """Queue the frames that arrive; end the process when the stream ends."""
    while (data := read_frame(stream)) is not None:
        orders.put(data)
    os._exit(os.EX_OK)


def main() -> None:
    """Work on the road network whose file is named on the command line."""
    out, sys.stdout = sys.stdout.buffer, sys.stderr  # nothing else may be written between frames
    orders: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, orders), daemon=True).start()
    work(read_network(Path(sys.argv[1])), orders, out)


if __name__ == "__main__":
    main()
