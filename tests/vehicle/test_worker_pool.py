"""The pool of workers, tried with little programs in the place of the planner."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.vehicle.pool_jobs import PoolClient, remains, there, until
from xavi_dialogue.bus.messages import Failure
from xavi_dialogue.vehicle import worker_pool as pool
from xavi_dialogue.vehicle.worker_pool import LEAST, NICENESS, WorkerPool

#: Says that it is ready, then does what the orders say.
PROGRAM = """
import os, sys, time
print("ready", flush=True)
for line in sys.stdin:
    match line.split():
        case ["echo", word]:
            print(f'{{"planned":true,"message":"{word}"}}', flush=True)
        case ["refuse"]:
            failure = '{"schema":"xavi.failure/1","reason":"not-applicable","detail":"no"}'
            print(f'{{"planned":false,"message":{failure}}}', flush=True)
        case ["babble"]:
            print("la la la", flush=True)
        case ["sleep"]:
            time.sleep(600)
        case ["wait", path]:
            while not os.path.exists(path):
                time.sleep(0.01)
            print('{"planned":true,"message":"waited"}', flush=True)
        case ["die-once", path]:
            if not os.path.exists(path):
                open(path, "w").close()
                os._exit(1)
            print('{"planned":true,"message":"lives"}', flush=True)
        case ["die"]:
            os._exit(1)
"""
#: A process that has a pool of these.
PARENT = """
import sys, threading, time
from xavi_dialogue.vehicle.worker_pool import WorkerPool
pool = WorkerPool([sys.executable, "-c", sys.argv[1]])
while not pool.pids:
    time.sleep(0.01)
print(*pool.pids, flush=True)
threading.Event().wait()
"""


@pytest.fixture
def client() -> Iterator[PoolClient]:
    with WorkerPool([sys.executable, "-c", PROGRAM], waiting=2) as pool:
        yield PoolClient(pool)


def test_a_job_is_done(client: PoolClient) -> None:
    client.ask("echo one")
    client.ask("echo two")
    assert client.answer("echo one") == b'"one"'
    assert client.answer("echo two") == b'"two"'


def test_a_refusal_comes_through(client: PoolClient) -> None:
    client.ask("refuse")
    assert client.answer("refuse") == Failure(reason="not-applicable", detail="no")


def test_who_is_late_is_given_up_and_replaced(client: PoolClient) -> None:
    client.ask("echo before")
    client.answer("echo before")
    late = client.pid()
    client.ask("sleep", within=0.2)
    assert client.reason("sleep") == "timed-out"
    client.ask("echo after")
    assert client.answer("echo after") == b'"after"'
    assert not remains(late)
    assert client.pid() != late


def test_a_job_that_waits_is_answered_at_its_own_deadline(client: PoolClient) -> None:
    client.ask("sleep")
    client.ask("echo waiting", within=0.2)
    assert client.reason("echo waiting") == "timed-out"
    assert client.answers["sleep"].empty()


def test_a_deadline_in_the_past_is_never_begun(client: PoolClient) -> None:
    client.ask("die", within=-1.0)
    assert client.reason("die") == "timed-out"
    client.ask("echo on")
    assert client.answer("echo on") == b'"on"'


@pytest.mark.parametrize("within", [-1.0, 0.001, 0.5 * LEAST])
def test_a_deadline_that_cannot_be_met_costs_no_worker(client: PoolClient, within: float) -> None:
    client.ask("echo before")
    client.answer("echo before")
    warm = client.pid()
    client.ask("sleep", within=within)
    assert client.reason("sleep") == "timed-out"
    client.ask("echo after")
    assert client.answer("echo after") == b'"after"'
    assert client.pid() == warm


def test_who_is_late_may_finish_while_nobody_waits(
    client: PoolClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "GRACE", 600.0)
    client.ask("echo before")
    client.answer("echo before")
    warm, door = client.pid(), tmp_path / "door"
    client.ask(f"wait {door}", within=0.2, name="late")
    assert client.reason("late") == "timed-out"
    door.touch()
    assert until(lambda: client.pool.idle == 1)
    client.ask("echo after")
    assert client.answer("echo after") == b'"after"'
    assert client.pid() == warm
    assert client.answers["late"].empty()


def test_who_is_late_beyond_the_grace_is_killed(
    client: PoolClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "GRACE", 0.1)
    client.ask("echo before")
    client.answer("echo before")
    late = client.pid()
    client.ask("sleep", within=0.2)
    assert client.reason("sleep") == "timed-out"
    assert until(lambda: not remains(late))
    assert until(lambda: client.pool.idle == 1)


def test_who_waits_for_one_that_is_late_gets_its_successor(
    client: PoolClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "GRACE", 600.0)
    client.ask("echo before")
    client.answer("echo before")
    late = client.pid()
    client.ask("sleep", within=0.2)
    assert client.reason("sleep") == "timed-out"
    client.ask("echo after")
    assert client.answer("echo after") == b'"after"'
    assert not remains(late)


def test_several_workers_work_at_once_and_are_as_many_as_there_should_be(tmp_path: Path) -> None:
    door = tmp_path / "door"
    with WorkerPool([sys.executable, "-c", PROGRAM], count=2) as two:
        client = PoolClient(two)
        client.ask(f"wait {door}", within=0.3, name="late")
        client.ask("echo one")
        assert client.answer("echo one") == b'"one"'
        assert client.reason("late") == "timed-out"
        for number in range(6):
            client.ask(f"echo {number}")
        for number in range(6):
            assert client.answer(f"echo {number}") == f'"{number}"'.encode()
        door.touch()
        assert until(lambda: two.idle == len(two.pids) == 2)


def test_a_job_whose_worker_is_killed_is_tried_once_more(
    client: PoolClient, tmp_path: Path
) -> None:
    client.ask(f"die-once {tmp_path / 'died'}", name="again")
    assert client.answer("again") == b'"lives"'


def test_beyond_the_cap_the_pool_is_busy(client: PoolClient) -> None:
    client.ask("echo ready")
    client.answer("echo ready")
    client.ask("sleep")
    for name in ("one", "two", "three"):
        client.ask(f"echo {name}")
    assert client.reason("echo three") == "busy"
    assert client.answers["echo one"].empty()


def test_a_worker_that_dies_fails_its_job_alone(client: PoolClient) -> None:
    client.ask("echo before")
    client.answer("echo before")
    dead = client.pid()
    client.ask("die")
    client.ask("echo after")
    assert client.reason("die") == "planner-failed"
    assert client.answer("echo after") == b'"after"'
    assert not remains(dead)


def test_an_idle_worker_that_is_killed_is_replaced_before_anybody_asks(client: PoolClient) -> None:
    client.ask("echo before")
    client.answer("echo before")
    killed = client.pid()
    os.kill(killed, signal.SIGKILL)
    assert until(lambda: bool(client.pool.pids) and client.pool.pids[0] != killed)
    assert not remains(killed)
    client.ask("echo after")
    assert client.answer("echo after") == b'"after"'


def test_a_worker_that_takes_nothing_in_holds_up_nobody(client: PoolClient) -> None:
    """A stopped process leaves its pipe full: the deadline holds all the same."""
    client.ask("echo before")
    client.answer("echo before")
    os.kill(client.pid(), signal.SIGSTOP)
    client.ask("echo " + "x" * 1_000_000, within=0.2, name="large")
    assert client.reason("large") == "timed-out"
    client.ask("echo after")
    assert client.answer("echo after") == b'"after"'


def test_what_is_no_result_is_a_failure(client: PoolClient) -> None:
    client.ask("babble")
    assert client.reason("babble") == "planner-failed"
    client.ask("echo on")
    assert client.answer("echo on") == b'"on"'


def test_a_worker_that_does_not_start_is_tried_once_for_every_job(tmp_path: Path) -> None:
    starts = tmp_path / "starts"
    program = f"open({str(starts)!r}, 'a').write('.')"
    with WorkerPool([sys.executable, "-c", program]) as pool:
        client = PoolClient(pool)
        assert until(lambda: starts.exists() and not pool.pids)
        for number in range(1, 3):
            client.ask("echo", name=str(number))
            assert client.reason(str(number)) == "planner-failed"
            assert starts.read_text() == "." * (number + 1)


def test_workers_stand_back_behind_the_driving(client: PoolClient) -> None:
    assert os.getpriority(os.PRIO_PROCESS, client.pid()) == min(os.nice(0) + NICENESS, 19)


def test_at_the_end_nothing_is_left_and_nobody_waits() -> None:
    with WorkerPool([sys.executable, "-c", PROGRAM]) as pool:
        client = PoolClient(pool)
        client.ask("sleep")
        client.ask("echo")
        worker = client.pid()
    assert [client.reason("sleep"), client.reason("echo")] == ["planner-unavailable"] * 2
    assert not remains(worker)


def test_no_worker_outlives_a_car_that_is_killed() -> None:
    car = subprocess.Popen([sys.executable, "-c", PARENT, PROGRAM], stdout=subprocess.PIPE)
    assert car.stdout is not None
    worker = int(car.stdout.readline())
    assert there(worker)
    car.kill()
    car.communicate()
    assert until(lambda: not there(worker))
