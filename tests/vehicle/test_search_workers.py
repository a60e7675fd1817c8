"""Search trees grown in worker processes: the same decision, whatever becomes of the workers."""

import logging
import multiprocessing
import time
from collections.abc import Iterator

import pytest

from planner.record import trace as plan_trace
from planner.record.trace import Settings
from planner.search.decide import Elsewhere, decide
from planner.search.inputs import Frame, Moment
from tests.planner.worlds import before_end, frame, goal, moment, still
from xavi_dialogue.vehicle.search_workers import SearchedRide, search_workers

TWO = Settings(rollouts=12, min_rollouts=2, trees=2)
SCENE = moment(
    "s1",
    {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: still("s1", ("main_in_1",), before_end("s1", "main_in_1", 60.0)),
    },
)


def ride(settings: Settings) -> SearchedRide:
    own: Frame = frame("s1", settings)
    return SearchedRide(own.roads.network, goal("s1"), settings, own.seed, own.vehicle)


@pytest.fixture(scope="module")
def workers() -> Iterator[Elsewhere]:
    with search_workers(ride(TWO)) as elsewhere:
        assert elsewhere is not None
        yield elsewhere


def record(elsewhere: Elsewhere | None) -> bytes:
    return plan_trace.encode(decide(frame("s1", TWO), SCENE, elsewhere).trace)


def ready(elsewhere: Elsewhere, here: Moment = SCENE) -> None:
    """Wait until the workers grow trees."""
    while not (pending := elsewhere(here)):
        time.sleep(0.05)
    assert [wait() is None for wait in pending] == [False]


def test_one_tree_needs_no_worker() -> None:
    with search_workers(ride(Settings())) as elsewhere:
        assert elsewhere is None


def test_decisions_do_not_wait_for_workers_that_start(workers: Elsewhere) -> None:
    assert record(workers) == record(None)


def test_a_worker_grows_the_same_tree(workers: Elsewhere) -> None:
    ready(workers)
    assert record(workers) == record(None)


@pytest.mark.slow
def test_the_car_searches_alone_when_a_worker_has_died(caplog: pytest.LogCaptureFixture) -> None:
    others = multiprocessing.active_children()
    with search_workers(ride(TWO)) as elsewhere:
        assert elsewhere is not None
        ready(elsewhere)
        for child in multiprocessing.active_children():
            if child not in others:
                child.kill()
                child.join()
        with caplog.at_level(logging.WARNING):
            assert record(elsewhere) == record(None)
            assert record(elsewhere) == record(None)
    said = [one.message for one in caplog.records if one.name.endswith("search_workers")]
    assert said == ["a search worker has died: from now on, one process searches"]
