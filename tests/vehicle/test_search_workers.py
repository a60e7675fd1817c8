"""Search trees grown in worker processes: the same decision, whatever becomes of the workers."""

import logging
import os
import signal
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path

import pytest

from planner.record import trace as plan_trace
from planner.record.trace import Settings
from planner.search.decide import Elsewhere, decide
from sim.setup.scenario import load
from tests.planner.worlds import before_end, frame, moment, still
from xavi_dialogue.vehicle.search_worker import TreeOfRide
from xavi_dialogue.vehicle.search_workers import search_workers

TWO = Settings(rollouts=12, min_rollouts=2, trees=2)
SCENE = moment(
    "s1",
    {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: still("s1", ("main_in_1",), before_end("s1", "main_in_1", 60.0)),
    },
)


def ride(settings: Settings = TWO) -> AbstractContextManager[Elsewhere | None]:
    """The workers of a ride through s1."""
    own = frame("s1", settings)
    known = TreeOfRide(own.goal, settings, own.seed, own.vehicle)
    return search_workers(load("s1").network, known)


@pytest.fixture(scope="module")
def workers() -> Iterator[Elsewhere]:
    with ride() as elsewhere:
        assert elsewhere is not None
        yield elsewhere


def record(elsewhere: Elsewhere | None) -> bytes:
    return plan_trace.encode(decide(frame("s1", TWO), SCENE, elsewhere).trace)


def ready(elsewhere: Elsewhere) -> None:
    """Wait until the worker grows trees."""
    while not all(wait() for wait in elsewhere(SCENE)):
        time.sleep(0.05)


def children() -> set[int]:
    """The processes that were started here and run now."""
    lists = Path(f"/proc/{os.getpid()}/task").glob("*/children")
    return {int(pid) for each in lists for pid in each.read_text().split()}


def test_one_tree_needs_no_worker() -> None:
    with ride(Settings()) as elsewhere:
        assert elsewhere is None


def test_decisions_do_not_wait_for_workers_that_start(workers: Elsewhere) -> None:
    assert record(workers) == record(None)


def test_a_worker_grows_the_same_tree(workers: Elsewhere) -> None:
    ready(workers)
    assert record(workers) == record(None)


@pytest.mark.slow
def test_the_car_searches_alone_when_a_worker_has_died(caplog: pytest.LogCaptureFixture) -> None:
    before = children()
    with ride() as elsewhere, caplog.at_level(logging.WARNING):
        assert elsewhere is not None
        ready(elsewhere)
        [worker] = children() - before
        os.kill(worker, signal.SIGKILL)
        assert record(elsewhere) == record(None)
        assert record(elsewhere) == record(None)
    said = [one.message for one in caplog.records if one.name.endswith("search_workers")]
    assert said == ["a search worker has died: the car grows its search trees from now on"]


@pytest.mark.slow
def test_a_worker_that_hangs_is_waited_for_once_and_ends_with_the_ride() -> None:
    before = children()
    with ride() as elsewhere:
        assert elsewhere is not None
        ready(elsewhere)
        [worker] = children() - before
        os.kill(worker, signal.SIGSTOP)
        assert [wait() for wait in elsewhere(SCENE)] == [None]
        assert record(elsewhere) == record(None)
        os.kill(worker, signal.SIGCONT)
        ready(elsewhere)  # what it owed is not taken for the tree of a later moment
        assert record(elsewhere) == record(None)
        os.kill(worker, signal.SIGSTOP)
    assert not Path(f"/proc/{worker}").exists()
