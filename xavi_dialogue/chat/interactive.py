"""A conversation at this process's terminal, whatever it rests on."""

import asyncio
import os
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from xavi_dialogue.bus.messages import EventReport
from xavi_dialogue.chat.backend import Behind
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.controller import RemoteCabin
from xavi_dialogue.chat.history import Minutes
from xavi_dialogue.nlg.narration import Teller

if TYPE_CHECKING:  # a quarter of a second that only a terminal needs
    from xavi_dialogue.storage.input_history import TypedLines, UnkeptLines

Write: TypeAlias = Callable[[str], None]


class Unasked:
    """Lines that nobody asked for: above what is typed, and notes as long as nothing can be."""

    def __init__(self, note: Write) -> None:
        self._note, self._teller = note, Teller()
        self._tell: Write | None = None

    def show(self, tell: Write) -> None:
        """From now on, tell on a terminal."""
        self._tell = tell

    def warn(self, text: str) -> None:
        """Something that looks wrong."""
        (self._tell or warner(self._note))(text)

    def tell(self, text: str) -> None:
        """Something that the passenger should know."""
        (self._tell or self._note)(text)

    def on_event(self, report: EventReport) -> None:
        """What the car does; what it did before the conversation is not told."""
        line = self._teller.tell(report.seq, report.event)
        if line is not None and self._tell is not None:
            self._tell(line)


@dataclass(frozen=True)
class Typed:
    """What is kept of what is typed."""

    file: Path
    days: int | None  # for so long; None: nothing is


def warner(note: Write) -> Write:
    """Takes warnings down as notes."""
    return lambda text: note(f"warning: {text}")


def talk(
    behind: Behind,
    client: Client,
    minutes: Minutes,
    typed: Typed,
    unasked: Unasked,
    begin: Callable[[], None],
) -> None:
    """Talk until the passenger, or what goes wrong, ends it.

    Args:
        behind: what the conversation rests on.
        client: on its bus.
        minutes: of the conversation.
        typed: what is kept of what is typed.
        unasked: lines that come in between.
        begin: waits until all is there; called on a thread.

    Raises:
        ChildFailed: a process ended.
    """
    asyncio.run(_talk(behind, client, minutes, typed, unasked, begin))


async def _talk(
    behind: Behind,
    client: Client,
    minutes: Minutes,
    typed: Typed,
    unasked: Unasked,
    begin: Callable[[], None],
) -> None:
    from prompt_toolkit.application import create_app_session

    from xavi_dialogue.terminal.prompt import TerminalChat
    from xavi_dialogue.terminal.screen import Keyboard, silent_screen

    try:
        await asyncio.to_thread(begin)
        lines = _lines(typed, minutes.session)
        cabin = RemoteCabin(behind, client, replace(minutes, forget_typed=lines.forget))
        with create_app_session(output=silent_screen(sys.stdout, os.environ.get("TERM"))):
            chat = TerminalChat(cabin, lines, keyboard=Keyboard(sys.stdin))
            unasked.show(chat.tell)
            loop = asyncio.get_running_loop()
            for number in (signal.SIGTERM, signal.SIGHUP):
                loop.add_signal_handler(number, chat.end)
            behind.set_off()
            await chat.run()
    finally:
        behind.over.set()


def _lines(typed: Typed, session: str) -> "TypedLines | UnkeptLines":
    from xavi_dialogue.storage.input_history import TypedLines, UnkeptLines, erase

    if typed.days is None:
        return UnkeptLines()
    typed.file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    erase(typed.file, before=datetime.now() - timedelta(days=typed.days))
    return TypedLines(typed.file, session)
