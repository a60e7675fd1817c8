"""Nonsense of every kind, some hundred a second, while a passenger talks."""

import time

from tests.drills.bus_clients import Passenger
from tests.drills.processes import ENDED, LATE, Crew, resident_bytes
from tests.drills.stage import HALT, WHERE, WHY, staged
from xavi_dialogue.chat.client import new_request

MOST = 300.0  # [s] until the flood has done its worst
ROOM = 256 * 1024 * 1024  # bytes that a flood may take up at most
ENOUGH = {"sessions": 500.0, "rejected": 500.0, "foreign": 500.0}  # counted by the service
TOKEN = "t" * 43
QUESTIONS = (WHERE, WHY, "What if you had stopped?", "How fast are we going?")


def test_whoever_floods_the_bus_nobody_else_suffers(crew: Crew) -> None:
    with staged(crew) as stage:
        ada = Passenger(stage.bus, "ada", token=TOKEN)
        calm = [ada.ask(question, HALT).told for question in QUESTIONS]
        before = resident_bytes(stage.service.pid), resident_bytes(stage.car.pid)
        flood = crew.python("-m", "tests.drills.flood", stage.endpoint, "1")
        flood.hear(1)
        over = time.monotonic() + MOST
        fares = stage.listener.fares("service")
        while any(fares[name] < least for name, least in ENOUGH.items()):
            assert time.monotonic() < over, fares
            passenger = Passenger(stage.bus, new_request(), token=TOKEN)
            for question, wanted in zip(QUESTIONS, calm, strict=True):
                answer = passenger.insist(question, HALT)  # "busy" is told in time, too
                assert answer.taken < LATE
                assert answer.told == wanted
            time.sleep(0.3)
            fares = stage.listener.fares("service")
        flood.popen.stdin.close()  # type: ignore[union-attr]
        assert flood.popen.wait(3.0 * ENDED) == 0, flood.said
        after = resident_bytes(stage.service.pid), resident_bytes(stage.car.pid)
        assert max(now - then for now, then in zip(after, before, strict=True)) < ROOM
        assert len(ada.history()) == len(QUESTIONS)  # nobody took it, or erased it
        assert ada.ask(WHERE, HALT).kind == "answer"
        assert "\x1b" not in stage.service.said + stage.car.said
