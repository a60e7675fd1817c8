"""The chat at a terminal, driven by keystrokes."""

import asyncio
import io
import re
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from prompt_toolkit.application import create_app_session
from prompt_toolkit.data_structures import Size
from prompt_toolkit.history import History
from prompt_toolkit.input import PipeInput, create_pipe_input

from xavi_dialogue.bus.messages import MAX_TEXT
from xavi_dialogue.bus.sanitize import clean
from xavi_dialogue.storage.input_history import InputHistory, UnsavedInputHistory
from xavi_dialogue.terminal.prompt import KEPT, TerminalChat
from xavi_dialogue.terminal.screen import SilentScreen
from xavi_dialogue.terminal.slash_commands import CommandError

CTRL_C, CTRL_D, TAB, ENTER, UP = "\x03", "\x04", "\t", "\r", "\x1b[A"
SURE = "Erase all that was said"


class Broken(Exception):
    """What the ride rests on is gone."""


@dataclass
class FakeCabin:
    """Remembers what it was told; "slow" questions are answered when `answered` is set."""

    asked: list[str] = field(default_factory=list)
    did: list[object] = field(default_factory=list)
    broken: bool = False
    names: int = 0  # of requests
    forget_typed: Callable[[], None] = lambda: None
    answered: asyncio.Event = field(default_factory=asyncio.Event)

    def status(self) -> str:
        return "0:04 status"

    def vehicles(self) -> str:
        return "vehicle 1: the car ahead"

    def plan(self) -> str:
        return "I plan to go on."

    def words(self) -> tuple[str, ...]:
        return ("/help", "vehicle 1", "turning left")

    async def ask(self, text: str, request: str) -> str:
        self.asked.append(text)
        if text.startswith("slow"):
            await self.answered.wait()
        return f"answer to {text}"

    async def why(self) -> str:
        return f"Why, after {len(self.asked)}?"

    async def history(self) -> str:
        return "\n".join(f"said {text}" for text in self.asked)

    async def save(self, file: str) -> str:
        if file == "taken":
            raise CommandError("There is a file taken already.")
        self.did.append(f"save {file}")
        return f"Saved to {file}."

    async def forget(self) -> str:
        self.did.append("forget")
        self.forget_typed()
        return "Erased."

    def cancel(self, request: str) -> None:
        self.did.append(f"cancel {request}")

    def pause(self) -> None:
        self.did.append("pause")

    def resume(self) -> None:
        self.did.append("resume")

    def speed(self, factor: float) -> None:
        self.did.append(factor)

    def seek(self, time: float) -> None:
        if time > 100.0:
            raise CommandError("Only a recorded ride can.")
        self.did.append(f"seek {time}")

    def check(self) -> None:
        if self.broken:
            raise Broken("the car has ended")

    def new_request(self) -> str:
        self.names += 1
        return f"r{self.names}"


class Screen(SilentScreen):
    """Writes to paper; asked where the cursor is, it would answer through the keyboard."""

    def __init__(self, paper: io.StringIO, keyboard: PipeInput, columns: int = 80) -> None:
        super().__init__(paper, lambda: Size(24, self.columns))
        self.keyboard, self.columns = keyboard, columns

    def ask_for_cpr(self) -> None:
        self.keyboard.send_text("\x1b[1;1R")


@dataclass
class Terminal:
    """A chat that runs, its keyboard and its screen."""

    chat: TerminalChat
    controller: FakeCabin
    keyboard: PipeInput
    screen: Screen
    paper: io.StringIO
    task: "asyncio.Task[None]"

    @property
    def shown(self) -> str:
        return clean(self.paper.getvalue())

    async def type(self, *keys: str) -> None:
        self.keyboard.send_text("".join(keys))
        await asyncio.sleep(0.05)

    async def sees(self, text: str) -> None:
        for _ in range(200):
            if text in self.shown:
                return
            await asyncio.sleep(0.01)
        pytest.fail(f"{text!r} is not shown in:\n{self.shown}")


@asynccontextmanager
async def terminal(
    typed: History | None = None, *, colours: bool = False, halts: bool = True
) -> AsyncIterator[Terminal]:
    paper = io.StringIO()
    with (
        create_pipe_input() as keyboard,
        create_app_session(keyboard, screen := Screen(paper, keyboard)),
    ):
        controller = FakeCabin()
        chat = TerminalChat(controller, typed, colours=colours, halts=halts)
        task = asyncio.create_task(chat.run())
        await asyncio.sleep(0.05)
        try:
            yield Terminal(chat, controller, keyboard, screen, paper, task)
        finally:
            chat.end()
            await asyncio.wait([task], timeout=2.0)
            assert task.done()


def test_a_question_is_answered_above_the_line() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("why?", ENTER)
            await t.sees("answer to why?")
            assert "0:04 status" in t.shown

    asyncio.run(scene())


def test_the_first_lines_say_how_to_halt_the_ride_and_that_one_can_ask_after_it() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.sees("Ask about the ride. /pause halts it for questions; once it is over, ask")
            await t.sees("/resume lets it go on")

    asyncio.run(scene())


def test_in_a_car_of_others_no_command_is_named_that_it_declines() -> None:
    async def scene() -> None:
        async with terminal(halts=False) as t:
            await t.sees("Ask about the ride, also once it is over.")
            await t.sees("/help")
            assert "/pause" not in t.shown
            assert "/resume" not in t.shown

    asyncio.run(scene())


def test_ctrl_d_ends_the_conversation() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type(CTRL_D)
            await asyncio.wait_for(t.task, 2.0)

    asyncio.run(scene())


def test_quit_ends_the_conversation() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/quit", ENTER)
            await asyncio.wait_for(t.task, 2.0)
            assert t.controller.asked == []

    asyncio.run(scene())


def test_ctrl_c_cancels_the_answer_and_not_the_program() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("slow one", ENTER)
            await t.sees("thinking")
            await t.type(CTRL_C)
            await t.sees("(cancelled)")
            assert t.controller.did == ["cancel r1"]
            await t.type("why?", ENTER)
            await t.sees("answer to why?")
            assert "answer to slow one" not in t.shown

    asyncio.run(scene())


def test_ctrl_c_clears_what_is_typed_and_else_gives_a_hint() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("rubbish", CTRL_C)
            await t.type("why?", ENTER)
            await t.sees("answer to why?")
            assert t.controller.asked == ["why?"]
            await t.type(CTRL_C)
            await t.sees("Ctrl-D or /quit")
            assert not t.task.done()

    asyncio.run(scene())


def test_commands() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/pause", ENTER, "/speed 2", ENTER, "/resume", ENTER)
            await t.type("/seek 2.5", ENTER)
            await t.type("/vehicles", ENTER, "/plan", ENTER, "/help", ENTER)
            await t.sees("the car ahead")
            await t.sees("I plan to go on.")
            await t.sees("/speed X")
            assert t.controller.did == ["pause", 2.0, "resume", "seek 2.5"]

    asyncio.run(scene())


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("/fly", "There is no command /fly. The nearest is /why; /help lists all."),
        ("/speed", "/speed is written /speed X."),
        ("/speed fast", "not 'fast'"),
        ("/speed nan", "not 'nan'"),
        ("/seek", "/seek is written /seek T."),
        ("/seek back", "not 'back'"),
        ("/seek 200", "Only a recorded ride can."),
    ],
)
def test_unknown_commands_are_errors(line: str, problem: str) -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type(line, ENTER)
            await t.sees(problem)
            assert (t.controller.did, t.controller.asked) == ([], [])

    asyncio.run(scene())


def test_tab_completes_from_what_is_there() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("what is veh", TAB)
            await asyncio.sleep(0.1)
            await t.type(ENTER)
            await t.sees("answer to what is vehicle 1")

    asyncio.run(scene())


def test_lines_of_the_car_come_in_between() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await asyncio.to_thread(t.chat.tell, "0:04 I change to the left lane.")
            await t.sees("0:04 I change to the left lane.")

    asyncio.run(scene())


def test_when_the_car_is_gone_the_conversation_ends_with_the_reason() -> None:
    async def scene() -> None:
        async with terminal() as t:
            t.controller.broken = True
            with pytest.raises(Broken, match="the car has ended"):
                await asyncio.wait_for(t.task, 3.0)

    asyncio.run(scene())


def test_empty_lines_ask_nothing() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type(ENTER, "   ", ENTER)
            assert t.controller.asked == []

    asyncio.run(scene())


def test_why_and_more_are_asked_like_questions() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/why", ENTER)
            await t.sees("answer to Why, after 0?")
            await t.type("/more", ENTER)
            await t.sees("answer to Tell me more.")
            assert t.controller.asked == ["Why, after 0?", "Tell me more."]

    asyncio.run(scene())


def test_what_was_said_is_listed() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("who?", ENTER, "/history", ENTER)
            await t.sees("said who?")
            assert t.controller.asked == ["who?"]

    asyncio.run(scene())


def test_what_was_said_is_saved_but_over_no_other_file() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/save taken", ENTER)
            await t.sees("There is a file taken already.")
            await t.type("/save  my file.txt", ENTER)
            await t.sees("Saved to my file.txt.")
            await t.type("/save", ENTER)
            await t.sees("Saved to .")
            assert t.controller.did == ["save my file.txt", "save "]

    asyncio.run(scene())


@pytest.mark.parametrize("yes", ["y", "Y", " yes "])
def test_what_was_said_is_erased_once_that_is_confirmed(yes: str) -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/forget", ENTER)
            await t.sees(SURE)
            assert t.controller.did == []
            await t.type(yes, ENTER)
            await t.sees("Erased.")
            assert (t.controller.did, t.controller.asked) == (["forget"], [])

    asyncio.run(scene())


@pytest.mark.parametrize("keys", ["n\r", "\r", "no\r", "yess\r", "/plan\r", CTRL_C])
def test_nothing_is_erased_without_a_yes(keys: str) -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/forget", ENTER)
            await t.sees(SURE)
            await t.type(keys)
            await t.sees(KEPT)
            await t.type("y", ENTER)  # comes too late: a question
            await t.sees("answer to y")
            assert t.controller.did == []

    asyncio.run(scene())


def test_ctrl_d_instead_of_a_yes_ends_the_conversation_and_erases_nothing() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/forget", ENTER)
            await t.sees(SURE)
            await t.type(CTRL_D)
            await asyncio.wait_for(t.task, 2.0)
            assert t.controller.did == []

    asyncio.run(scene())


def test_a_question_in_place_of_a_yes_is_asked() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/forget", ENTER)
            await t.sees(SURE)
            await t.type("why?", ENTER)
            await t.sees("answer to why?")
            assert t.controller.did == []

    asyncio.run(scene())


def test_each_line_that_is_pasted_is_a_question() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("\x1b[200~one?\r\ntwo?\n\n  \nthree?\x1b[201~")
            assert t.controller.asked == []
            await t.type(ENTER)
            await t.sees("answer to three?")
            assert t.controller.asked == ["one?", "two?", "three?"]

    asyncio.run(scene())


def test_nothing_is_asked_after_a_pasted_quit() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("\x1b[200~/quit\none?\x1b[201~", ENTER)
            await asyncio.wait_for(t.task, 2.0)
            assert t.controller.asked == []

    asyncio.run(scene())


def test_no_more_is_asked_than_a_question_may_have() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type(f"\x1b[200~{'long ' * 1000}\x1b[201~", ENTER)
            await t.sees(f"(Only the first {MAX_TEXT} characters are asked.)")
            await t.sees("answer to long")
            assert t.controller.asked == [("long " * 1000)[:MAX_TEXT]]

    asyncio.run(scene())


def test_escape_sequences_that_are_pasted_stay_behind() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("\x1b[200~why \x1b[31mnot\x1b]0;evil\x07?\x1b[2J\x1b[201~", ENTER)
            await t.sees("answer to why not?")
            assert t.controller.asked == ["why not?"]
            assert "\x1b[2J" not in t.paper.getvalue()

    asyncio.run(scene())


def test_thinking_is_told_of_slow_answers_alone_and_questions_wait_for_their_turn() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("quick", ENTER)
            await t.sees("answer to quick")
            assert "thinking" not in t.shown
            await t.type("slow one", ENTER, "next", ENTER)
            await t.sees("thinking")
            assert t.controller.asked == ["quick", "slow one"]
            t.controller.answered.set()
            await t.sees("answer to next")
            assert t.shown.index("answer to slow one") < t.shown.index("answer to next")
            shown = len(t.shown)
            await t.type("x")
            assert "thinking" not in t.shown[shown:]

    asyncio.run(scene())


def test_ctrl_c_drops_one_question_and_the_next_is_asked() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("slow one", ENTER, "next", ENTER)
            await t.sees("thinking")
            await t.type(CTRL_C)
            await t.sees("answer to next")
            assert t.controller.did == ["cancel r1"]

    asyncio.run(scene())


def test_answers_wrap_at_the_width_that_the_terminal_has_when_they_come() -> None:
    async def scene() -> None:
        async with terminal() as t:
            words = "words " * 12
            await t.type(f"slow {words}", ENTER)
            await t.sees("thinking")
            t.screen.columns = 40
            t.controller.answered.set()
            await t.sees("answer to slow words words words words\n")

    asyncio.run(scene())


@pytest.mark.parametrize("colours", [False, True])
def test_colours_are_there_or_not(*, colours: bool) -> None:
    async def scene() -> None:
        async with terminal(colours=colours) as t:
            await t.type("why?", ENTER)
            await t.sees("answer to why?")
            styles = set(re.findall(r"\x1b\[([0-9;]*)m", t.paper.getvalue()))
            assert (styles <= {"", "0"}) is not colours

    asyncio.run(scene())


@pytest.mark.parametrize("kept", [False, True])
def test_lines_typed_before_come_back_with_the_arrow_until_they_are_erased(
    tmp_path: Path, *, kept: bool
) -> None:
    typed = InputHistory(tmp_path / "history", "ada") if kept else UnsavedInputHistory()

    async def scene() -> None:
        async with terminal(typed) as t:
            t.controller.forget_typed = typed.forget
            await t.type("why?", ENTER)
            await t.sees("answer to why?")
            await t.type(UP, " now", ENTER)
            await t.sees("answer to why? now")
            await t.type("/forget", ENTER, "y", ENTER)
            await t.sees("Erased.")
            await t.type(UP, UP, "new", ENTER)
            await t.sees("answer to new")
            assert t.controller.asked == ["why?", "why? now", "new"]

    asyncio.run(scene())
