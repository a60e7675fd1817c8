"""The planner's process, or the car itself, is killed while an answer needs it."""

import os
import signal
import threading
from contextlib import suppress

from tests.drills.processes import DEADLINE, Crew, until
from tests.drills.stage import HALT, WHERE, WHY, Stage, staged

IN_TIME = DEADLINE + 1.0  # [s] and the way back


def kill(pids: list[int], number: int = signal.SIGKILL) -> None:
    for pid in pids:
        with suppress(ProcessLookupError):
            os.kill(pid, number)


def at_work(stage: Stage) -> bool:
    """Whether the planner is at something."""
    return until(lambda: stage.listener.fares()["workers_idle"] == 0.0)


def test_a_planner_that_dies_once_costs_nothing_and_one_that_keeps_dying_its_evidence(
    crew: Crew,
) -> None:
    with staged(crew) as stage:
        assert stage.ready()
        kill(stage.planners(), signal.SIGSTOP)
        answer = stage.passenger("ada").begin(WHY, HALT)
        assert at_work(stage)
        kill(stage.planners())
        first = answer.get(timeout=IN_TIME)
        assert stage.ready()

        kill(stage.planners(), signal.SIGSTOP)
        answer = stage.passenger("ben").begin(WHY, HALT)
        over = threading.Event()
        hunt = threading.Thread(target=_hunt, args=(stage, over))
        hunt.start()
        try:
            second = answer.get(timeout=IN_TIME)
        finally:
            over.set()
            hunt.join()
        assert second.kind == "answer" or second.reason in ("planner-failed", "timed-out")

        third = stage.passenger("cy").ask(WHY, HALT)
        assert (first.kind, first.told) == ("answer", third.told)


def _hunt(stage: Stage, over: threading.Event) -> None:
    """Kill every planner that appears."""
    while not over.wait(0.05):
        kill(stage.planners())


def test_a_car_that_is_killed_while_it_plans_leaves_no_question_open(crew: Crew) -> None:
    with staged(crew) as stage:
        assert stage.ready()
        kill(stage.planners(), signal.SIGSTOP)
        answer = stage.passenger("ada").begin(WHY, HALT)
        assert at_work(stage)
        planners = stage.planners()
        stage.car.kill()
        kill(planners, signal.SIGCONT)
        first = answer.get(timeout=IN_TIME)
        assert first.kind == "answer" or first.reason in ("planner-unavailable", "timed-out")
        assert until(lambda: not stage.planners())
        assert stage.passenger("ada").ask(WHERE, HALT).kind == "answer"  # from the record
