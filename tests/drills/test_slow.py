"""Somebody on the bus stops reading while a ride goes on as fast as it can."""

import os
import signal
import time

from tests.drills.processes import DEADLINE, ENDED, Crew, state_of, until
from tests.drills.stage import WHERE, staged

IN_TIME = DEADLINE + 1.0  # [s]
HALT = 20.0  # [s] of the ride; some megabytes of decisions, far beyond what waits unread


def test_who_stops_reading_holds_up_nobody(crew: Crew) -> None:
    with staged(crew, at=None, drive=("--scenario", "town")) as stage:
        slow = crew.python("-m", "tests.drills.listener", stage.endpoint)
        slow.hear(1)
        os.kill(slow.pid, signal.SIGSTOP)
        assert until(lambda: state_of(slow.pid) == "T")
        ada = stage.passenger("ada")
        stage.car.order(f"until {HALT}")
        answers = []
        while not (stage.listener.now >= HALT and stage.listener.state != "driving"):
            answers.append(ada.ask(WHERE))
            time.sleep(0.2)
            assert stage.car.popen.poll() is None
        assert until(stage.listener.whole)
        assert len(stage.listener.traces) >= HALT
        assert {answer.kind for answer in answers} == {"answer"}
        assert max(answer.taken for answer in answers) < IN_TIME
        assert stage.listener.fares()["reports_dropped"] == 0.0
        os.kill(slow.pid, signal.SIGCONT)
        slow.popen.stdin.close()  # type: ignore[union-attr]
        assert slow.popen.wait(ENDED) == 0, slow.said
        assert ada.ask(WHERE).kind == "answer"
