"""The wall clock jumps by an hour in the middle of a conversation, on all machines at once."""

from pathlib import Path

from tests.drills.processes import DEADLINE, Crew, until
from tests.drills.stage import HALT, WHERE, staged
from xavi_dialogue.storage.conversations import Store

HOUR = 3600
CLOCK = Path(__file__).parent / "clock"
QUESTIONS = (
    "Why did you change lanes?",
    "How fast are we going?",
    WHERE,
    "What are you doing?",
    WHERE,
)


class Clock:
    """The wall clock of processes."""

    def __init__(self, folder: Path) -> None:
        self.file = folder / "shift"
        self.environment = {"DRILL_CLOCK": str(self.file), "PYTHONPATH": str(CLOCK)}
        self.shift(0)

    def shift(self, seconds: int) -> None:
        """Let it differ by so much from now on."""
        new = self.file.with_suffix(".new")
        new.write_text(f"{seconds}")
        new.replace(self.file)


def test_a_conversation_goes_on_whatever_the_wall_clock_says(crew: Crew, tmp_path: Path) -> None:
    clock, store = Clock(tmp_path), tmp_path / "dialogue.sqlite3"
    begin = ("chat", "--scenario", "s1", "--store", str(store), "--keep-days", "1")
    answers: list[str] = []
    for first in (True, False):  # the second goes on with what is stored
        chat = crew.xavi(*begin, "--session", "ada", extra=clock.environment)
        chat.order(f"@ {HALT}s")
        for number, question in enumerate(QUESTIONS):
            clock.shift((0, HOUR, -HOUR)[number % 3])
            chat.order(question)
            answers.append(chat.hear(number + 1)[number])
        chat.popen.stdin.close()  # type: ignore[union-attr]
        assert chat.popen.wait(30.0) == 0, chat.said
        with Store(store) as file:
            turns = file.turns("ada", 100)
        asked = QUESTIONS if first else QUESTIONS * 2
        assert [(turn.text, turn.reply.text) for turn in turns] == list(
            zip(asked, answers, strict=True)
        )
        assert {turn.reply.reason for turn in turns} == {None}


def test_deadlines_are_kept_while_the_clock_jumps(crew: Crew, tmp_path: Path) -> None:
    clock = Clock(tmp_path)
    serve = ("--store", str(tmp_path / "dialogue.sqlite3"), "--keep-days", "1")
    with staged(crew, serve=serve, extra=clock.environment) as stage:
        ada = stage.passenger("ada")
        assert ada.ask(WHERE).kind == "answer"
        for shift in (HOUR, -HOUR):
            answer = ada.begin(WHERE, at=HALT + 30.0, deadline=3.0)  # it does not come
            assert until(lambda: stage.listener.fares("service")["waiting"] == 1.0)
            clock.shift(shift)
            told = answer.get(timeout=DEADLINE)
            assert told.reason == "timed-out"
            assert told.taken > 2.0
            assert ada.ask(WHERE).kind == "answer"
        clock.shift(0)
        assert len(ada.history()) == 5
