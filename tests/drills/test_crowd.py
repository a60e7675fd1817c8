"""A hundred questions at once: each gets one reply in time, an answer or that it is too much."""

from pathlib import Path

import pytest

from tests.drills.bus_clients import Answer, Passenger
from tests.drills.processes import DEADLINE, Crew, until
from tests.drills.stage import HALT, WHERE, WHY, staged
from xavi_dialogue.storage.conversations import Store

MANY = 100
IN_TIME = DEADLINE + 1.0  # [s]
TEXTS = (WHERE, WHY, "What if you had stopped?", "How fast are we going?", "Hello!")


@pytest.mark.parametrize("sessions", [MANY, 1])
def test_each_of_many_questions_gets_one_reply_in_time(
    crew: Crew, tmp_path: Path, sessions: int
) -> None:
    store = tmp_path / "dialogue.sqlite3"
    with staged(crew, serve=("--store", str(store))) as stage:
        everybody = [stage.passenger(f"p{number % sessions}") for number in range(MANY)]
        texts = [TEXTS[number % len(TEXTS)] for number in range(MANY)]
        begun = [
            passenger.begin(text, HALT) for passenger, text in zip(everybody, texts, strict=True)
        ]
        told = [queue.get(timeout=3.0 * DEADLINE) for queue in begun]
        assert all(queue.empty() for queue in begun)
        assert max(answer.taken for answer in told) < IN_TIME
        answered = [answer for answer in told if answer.reason != "busy"]
        assert answered
        assert {answer.kind for answer in answered} == {"answer"}
        too_much = MANY - len(answered)  # counted once they have been told so
        assert until(lambda: stage.listener.fares("service")["busy"] == too_much)
        assert stage.listener.fares("service")["waiting"] == 0.0
        _same_within(everybody, texts, told, store)
        assert stage.passenger("last").ask(WHERE, HALT).kind == "answer"


def _same_within(
    everybody: list[Passenger], texts: list[str], told: list[Answer], store: Path
) -> None:
    """Of each session, what was answered is on disk, in the order in which it was asked."""
    answers: dict[str, list[tuple[float, str, str]]] = {}
    for passenger, text, answer in zip(everybody, texts, told, strict=True):
        if answer.reply is not None:
            answers.setdefault(passenger.session, []).append((answer.came, text, answer.text))
    with Store(store) as file:
        assert set(file.names()) == set(answers)
        for session, said in answers.items():
            assert [came for came, _, _ in said] == sorted(came for came, _, _ in said)
            turns = [(turn.text, turn.reply.text) for turn in file.turns(session, 2 * MANY)]
            assert turns == [(text, reply) for _, text, reply in said]
