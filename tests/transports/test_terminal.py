"""The chat at a terminal, driven by keystrokes."""

import asyncio
import io
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field

import pytest
from prompt_toolkit.application import create_app_session
from prompt_toolkit.data_structures import Size
from prompt_toolkit.input import PipeInput, create_pipe_input
from prompt_toolkit.output.vt100 import Vt100_Output

from xavi_dialogue.transports.commands import CommandError
from xavi_dialogue.transports.terminal import TerminalChat
from xavi_dialogue.transports.text import clean

CTRL_C, CTRL_D, TAB, ENTER = "\x03", "\x04", "\t", "\r"


class Broken(Exception):
    """What the ride rests on is gone."""


@dataclass
class FakeCabin:
    """Remembers what it was told; "slow" questions are answered when `answered` is set."""

    asked: list[str] = field(default_factory=list)
    did: list[object] = field(default_factory=list)
    broken: bool = False
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
        return "\n".join(f"> {text}" for text in self.asked)

    async def save(self, file: str) -> str:
        if file == "taken":
            raise CommandError("There is a file taken already.")
        self.did.append(f"save {file}")
        return f"Saved to {file}."

    async def forget(self) -> str:
        self.did.append("forget")
        return "Erased."

    def cancel(self, request: str) -> None:
        self.did.append("cancel")

    def pause(self) -> None:
        self.did.append("pause")

    def resume(self) -> None:
        self.did.append("resume")

    def speed(self, factor: float) -> None:
        self.did.append(factor)

    def check(self) -> None:
        if self.broken:
            raise Broken("the car has ended")

    def new_request(self) -> str:
        return "r1"


class Screen(Vt100_Output):
    """Writes to paper; asked where the cursor is, it answers through the keyboard."""

    def __init__(self, paper: io.StringIO, keyboard: PipeInput) -> None:
        super().__init__(paper, lambda: Size(24, 80))
        self.keyboard = keyboard

    @property
    def responds_to_cpr(self) -> bool:
        return True

    def ask_for_cpr(self) -> None:
        self.keyboard.send_text("\x1b[1;1R")


@dataclass
class Terminal:
    """A chat that runs, its keyboard and its screen."""

    chat: TerminalChat
    cabin: FakeCabin
    keyboard: PipeInput
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
async def terminal() -> AsyncIterator[Terminal]:
    paper = io.StringIO()
    with (
        create_pipe_input() as keyboard,
        create_app_session(keyboard, Screen(paper, keyboard)),
    ):
        cabin = FakeCabin()
        chat = TerminalChat(cabin)
        task = asyncio.create_task(chat.run())
        await asyncio.sleep(0.05)
        try:
            yield Terminal(chat, cabin, keyboard, paper, task)
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
            assert t.cabin.asked == []

    asyncio.run(scene())


def test_ctrl_c_cancels_the_answer_and_not_the_program() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("slow one", ENTER)
            await t.sees("thinking")
            await t.type(CTRL_C)
            await t.sees("(cancelled)")
            assert t.cabin.did == ["cancel"]
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
            assert t.cabin.asked == ["why?"]
            await t.type(CTRL_C)
            await t.sees("Ctrl-D or /quit")
            assert not t.task.done()

    asyncio.run(scene())


def test_commands() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type("/pause", ENTER, "/speed 2", ENTER, "/resume", ENTER)
            await t.type("/vehicles", ENTER, "/plan", ENTER, "/help", ENTER)
            await t.sees("the car ahead")
            await t.sees("I plan to go on.")
            await t.sees("/speed X")
            assert t.cabin.did == ["pause", 2.0, "resume"]

    asyncio.run(scene())


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("/fly", "There is no command /fly. The nearest is /why; /help lists all."),
        ("/speed", "/speed is written /speed X."),
        ("/speed fast", "not 'fast'"),
        ("/speed nan", "not 'nan'"),
    ],
)
def test_unknown_commands_are_errors(line: str, problem: str) -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type(line, ENTER)
            await t.sees(problem)
            assert (t.cabin.did, t.cabin.asked) == ([], [])

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
            t.cabin.broken = True
            with pytest.raises(Broken, match="the car has ended"):
                await asyncio.wait_for(t.task, 3.0)

    asyncio.run(scene())


def test_empty_lines_ask_nothing() -> None:
    async def scene() -> None:
        async with terminal() as t:
            await t.type(ENTER, "   ", ENTER)
            assert t.cabin.asked == []

    asyncio.run(scene())
