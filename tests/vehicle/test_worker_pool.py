"""The pool of workers, tried with little programs in the place of the planner."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.service.desk import Desk, remains, there, until
from xavi_dialogue.bus.messages import Failure
from xavi_dialogue.vehicle import worker_pool as pool
from xavi_dialogue.vehicle.worker_pool import LEAST, NICENESS, Pool

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
from xavi_dialogue.vehicle.worker_pool import Pool
pool = Pool([sys.executable, "-c", sys.argv[1]])
while not pool.pids:
    time.sleep(0.01)
print(*pool.pids, flush=True)
threading.Event().wait()
"""


@pytest.fixture
def desk() -> Iterator[Desk]:
    with Pool([sys.executable, "-c", PROGRAM], waiting=2) as pool:
        yield Desk(pool)


def test_a_job_is_done(desk: Desk) -> None:
    desk.ask("echo one")
    desk.ask("echo two")
    assert desk.answer("echo one") == b'"one"'
    assert desk.answer("echo two") == b'"two"'


def test_a_refusal_comes_through(desk: Desk) -> None:
    desk.ask("refuse")
    assert desk.answer("refuse") == Failure(reason="not-applicable", detail="no")


def test_who_is_late_is_given_up_and_replaced(desk: Desk) -> None:
    desk.ask("echo before")
    desk.answer("echo before")
    late = desk.pid()
    desk.ask("sleep", within=0.2)
    assert desk.reason("sleep") == "timed-out"
    desk.ask("echo after")
    assert desk.answer("echo after") == b'"after"'
    assert not remains(late)
    assert desk.pid() != late


def test_a_job_that_waits_is_answered_at_its_own_deadline(desk: Desk) -> None:
    desk.ask("sleep")
    desk.ask("echo waiting", within=0.2)
    assert desk.reason("echo waiting") == "timed-out"
    assert desk.answers["sleep"].empty()


def test_a_deadline_in_the_past_is_never_begun(desk: Desk) -> None:
    desk.ask("die", within=-1.0)
    assert desk.reason("die") == "timed-out"
    desk.ask("echo on")
    assert desk.answer("echo on") == b'"on"'


@pytest.mark.parametrize("within", [-1.0, 0.001, 0.5 * LEAST])
def test_a_deadline_that_cannot_be_met_costs_no_worker(desk: Desk, within: float) -> None:
    desk.ask("echo before")
    desk.answer("echo before")
    warm = desk.pid()
    desk.ask("sleep", within=within)
    assert desk.reason("sleep") == "timed-out"
    desk.ask("echo after")
    assert desk.answer("echo after") == b'"after"'
    assert desk.pid() == warm


def test_who_is_late_may_finish_while_nobody_waits(
    desk: Desk, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "GRACE", 600.0)
    desk.ask("echo before")
    desk.answer("echo before")
    warm, door = desk.pid(), tmp_path / "door"
    desk.ask(f"wait {door}", within=0.2, name="late")
    assert desk.reason("late") == "timed-out"
    door.touch()
    assert until(lambda: desk.pool.idle == 1)
    desk.ask("echo after")
    assert desk.answer("echo after") == b'"after"'
    assert desk.pid() == warm
    assert desk.answers["late"].empty()


def test_who_is_late_beyond_the_grace_is_killed(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "GRACE", 0.1)
    desk.ask("echo before")
    desk.answer("echo before")
    late = desk.pid()
    desk.ask("sleep", within=0.2)
    assert desk.reason("sleep") == "timed-out"
    assert until(lambda: not remains(late))
    assert until(lambda: desk.pool.idle == 1)


def test_who_waits_for_one_that_is_late_gets_its_successor(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "GRACE", 600.0)
    desk.ask("echo before")
    desk.answer("echo before")
    late = desk.pid()
    desk.ask("sleep", within=0.2)
    assert desk.reason("sleep") == "timed-out"
    desk.ask("echo after")
    assert desk.answer("echo after") == b'"after"'
    assert not remains(late)


def test_several_workers_work_at_once_and_are_as_many_as_there_should_be(tmp_path: Path) -> None:
    door = tmp_path / "door"
    with Pool([sys.executable, "-c", PROGRAM], count=2) as two:
        desk = Desk(two)
        desk.ask(f"wait {door}", within=0.3, name="late")
        desk.ask("echo one")
        assert desk.answer("echo one") == b'"one"'
        assert desk.reason("late") == "timed-out"
        for number in range(6):
            desk.ask(f"echo {number}")
        for number in range(6):
            assert desk.answer(f"echo {number}") == f'"{number}"'.encode()
        door.touch()
        assert until(lambda: two.idle == len(two.pids) == 2)


def test_a_job_whose_worker_is_killed_is_tried_once_more(desk: Desk, tmp_path: Path) -> None:
    desk.ask(f"die-once {tmp_path / 'died'}", name="again")
    assert desk.answer("again") == b'"lives"'


def test_beyond_the_cap_the_pool_is_busy(desk: Desk) -> None:
    desk.ask("echo ready")
    desk.answer("echo ready")
    desk.ask("sleep")
    for name in ("one", "two", "three"):
        desk.ask(f"echo {name}")
    assert desk.reason("echo three") == "busy"
    assert desk.answers["echo one"].empty()


def test_a_worker_that_dies_fails_its_job_alone(desk: Desk) -> None:
    desk.ask("echo before")
    desk.answer("echo before")
    dead = desk.pid()
    desk.ask("die")
    desk.ask("echo after")
    assert desk.reason("die") == "planner-failed"
    assert desk.answer("echo after") == b'"after"'
    assert not remains(dead)


def test_an_idle_worker_that_is_killed_is_replaced_before_anybody_asks(desk: Desk) -> None:
    desk.ask("echo before")
    desk.answer("echo before")
    killed = desk.pid()
    os.kill(killed, signal.SIGKILL)
    assert until(lambda: bool(desk.pool.pids) and desk.pool.pids[0] != killed)
    assert not remains(killed)
    desk.ask("echo after")
    assert desk.answer("echo after") == b'"after"'


def test_a_worker_that_takes_nothing_in_holds_up_nobody(desk: Desk) -> None:
    """A stopped process leaves its pipe full: the deadline holds all the same."""
    desk.ask("echo before")
    desk.answer("echo before")
    os.kill(desk.pid(), signal.SIGSTOP)
    desk.ask("echo " + "x" * 1_000_000, within=0.2, name="large")
    assert desk.reason("large") == "timed-out"
    desk.ask("echo after")
    assert desk.answer("echo after") == b'"after"'


def test_what_is_no_result_is_a_failure(desk: Desk) -> None:
    desk.ask("babble")
    assert desk.reason("babble") == "planner-failed"
    desk.ask("echo on")
    assert desk.answer("echo on") == b'"on"'


def test_a_worker_that_does_not_start_is_tried_once_for_every_job(tmp_path: Path) -> None:
    starts = tmp_path / "starts"
    program = f"open({str(starts)!r}, 'a').write('.')"
    with Pool([sys.executable, "-c", program]) as pool:
        desk = Desk(pool)
        assert until(lambda: starts.exists() and not pool.pids)
        for number in range(1, 3):
            desk.ask("echo", name=str(number))
            assert desk.reason(str(number)) == "planner-failed"
            assert starts.read_text() == "." * (number + 1)


def test_workers_stand_back_behind_the_driving(desk: Desk) -> None:
    assert os.getpriority(os.PRIO_PROCESS, desk.pid()) == min(os.nice(0) + NICENESS, 19)


def test_at_the_end_nothing_is_left_and_nobody_waits() -> None:
    with Pool([sys.executable, "-c", PROGRAM]) as pool:
        desk = Desk(pool)
        desk.ask("sleep")
        desk.ask("echo")
        worker = desk.pid()
    assert [desk.reason("sleep"), desk.reason("echo")] == ["planner-unavailable"] * 2
    assert not remains(worker)


def test_no_worker_outlives_a_car_that_is_killed() -> None:
    car = subprocess.Popen([sys.executable, "-c", PARENT, PROGRAM], stdout=subprocess.PIPE)
    assert car.stdout is not None
    worker = int(car.stdout.readline())
    assert there(worker)
    car.kill()
    car.communicate()
    assert until(lambda: not there(worker))
