"""Worker processes that grow search trees, while the car grows the first one.

A worker gets the moment and recognises the goals of others itself, as beliefs are larger than what
they come from. What it does not deliver in time, the car grows, too: the decision is the same.
"""

import logging
import multiprocessing
import pickle
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

from planner.record.trace import EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.search.decide import Elsewhere, Pending, grown, predict
from planner.search.inputs import Frame, Moment
from planner.search.trees import GrownTree, trees_of
from sim.roads.network import Network
from xavi_dialogue.process.garbage import settle
from xavi_dialogue.process.pool_process import end_with_parent
from xavi_dialogue.vehicle.replan_worker import warm_up

PATIENCE = 1.0  # [s] after the car's own tree, up to which a worker may be late

_LOG = logging.getLogger(__name__)
_frames: list[Frame] = []  # of this process, if it is a worker


@dataclass(frozen=True, slots=True)
class SearchedRide:
    """The inputs that stay the same in a ride, as they are sent to its workers."""

    network: Network
    goal: EgoGoal
    settings: Settings
    seed: int
    vehicle: str


@contextmanager
def search_workers(ride: SearchedRide) -> Iterator[Elsewhere | None]:
    """Start a worker for each search tree after the first; None: there is only one tree."""
    count = trees_of(ride.settings) - 1
    if count == 0:
        yield None
        return
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_begin, initargs=(ride,))
    try:
        yield _Workers(pool, [pool.submit(_ready) for _ in range(count)]).begin
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


@dataclass
class _Workers:
    pool: ProcessPoolExecutor
    starting: Sequence[Future[None]]  # one for each worker
    broken: bool = False

    def begin(self, moment: Moment) -> Sequence[Pending]:
        """Begin to grow the trees after the first; () while the workers cannot."""
        if self.broken or not all(future.done() for future in self.starting):
            return ()
        data = pickle.dumps(moment)
        try:
            trees = range(1, len(self.starting) + 1)
            return [partial(self._result, self.pool.submit(_grow, data, k)) for k in trees]
        except BrokenProcessPool:
            self._lose()
            return ()

    def _result(self, future: Future[GrownTree]) -> GrownTree | None:
        """Wait for a tree; None: it comes too late, or the workers have died."""
        try:
            return future.result(PATIENCE)
        except TimeoutError:
            future.cancel()
        except BrokenProcessPool:
            self._lose()
        return None

    def _lose(self) -> None:
        if not self.broken:
            _LOG.warning("a search worker has died: from now on, one process searches")
        self.broken = True


def _begin(ride: SearchedRide) -> None:
    """Prepare this process for the decisions of a ride."""
    end_with_parent()
    warm_up(ride.network)
    roads = Roads(ride.network)
    _frames.append(Frame(roads, ride.goal, ride.settings, ride.seed, ride.vehicle))
    settle()


def _ready() -> None:
    """Do nothing; done once a worker is ready."""


def _grow(data: bytes, tree: int) -> GrownTree:
    """Grow a tree for a moment, which the car itself has sent."""
    moment: Moment = pickle.loads(data)
    frame = _frames[0]
    return grown(frame, moment, predict(frame, moment), tree)
