"""A conversation at this process's terminal, over any backend."""

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
from xavi_dialogue.chat.backend import Backend
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.controller import ChatController
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.nlg.narration import RideNarrator
from xavi_dialogue.process.termination import let_asyncio_interrupt

if TYPE_CHECKING:  # importing takes a quarter of a second, and only a terminal needs it
    from xavi_dialogue.storage.input_history import InputHistory, UnsavedInputHistory

Write: TypeAlias = Callable[[str], None]


class Notices:
    """Notes above the input line; before the terminal is ready, plain notes."""

    def __init__(self, note: Write) -> None:
        self._note, self._teller = note, RideNarrator()
        self._tell: Write | None = None

    def show(self, tell: Write) -> None:
        """Write to a terminal from now on."""
        self._tell = tell

    def warn(self, text: str) -> None:
        """Write a warning."""
        (self._tell or warner(self._note))(text)

    def tell(self, text: str) -> None:
        """Write a note for the passenger."""
        (self._tell or self._note)(text)

    def on_event(self, report: EventReport) -> None:
        """Write what the car does; events before the conversation are not shown."""
        line = self._teller.tell(report.seq, report.event)
        if line is not None and self._tell is not None:
            self._tell(line)


@dataclass(frozen=True)
class InputHistoryOptions:
    """The file of typed lines, and for how long they are stored."""

    file: Path
    days: int | None  # days for which lines are stored; None: they are not


def warner(note: Write) -> Write:
    """Return a function that writes warnings as notes."""
    return lambda text: note(f"warning: {text}")


def talk(
    backend: Backend,
    client: Client,
    session_history: SessionHistory,
    typed: InputHistoryOptions,
    notices: Notices,
    begin: Callable[[], None],
) -> None:
    """Talk until the passenger or an error ends the conversation.

    Args:
        backend: the processes behind the conversation.
        client: on its bus.
        session_history: of the conversation.
        typed: whether and how long typed lines are stored.
        notices: notes between answers.
        begin: waits until everything is ready; called on a thread.

    Raises:
        ChildFailed: a process ended.
    """
    let_asyncio_interrupt()
    asyncio.run(_talk(backend, client, session_history, typed, notices, begin))


async def _talk(
    backend: Backend,
    client: Client,
    session_history: SessionHistory,
    typed: InputHistoryOptions,
    notices: Notices,
    begin: Callable[[], None],
) -> None:
    from prompt_toolkit.application import create_app_session

    from xavi_dialogue.terminal.prompt import TerminalChat
    from xavi_dialogue.terminal.screen import Keyboard, silent_screen

    try:
        await asyncio.to_thread(begin)
        lines = _lines(typed, session_history.session)
        controller = ChatController(
            backend, client, replace(session_history, forget_typed=lines.forget)
        )
        with create_app_session(output=silent_screen(sys.stdout, os.environ.get("TERM"))):
            keyboard = Keyboard(sys.stdin)
            chat = TerminalChat(controller, lines, keyboard=keyboard, halts=backend.paced)
            notices.show(chat.tell)
            loop = asyncio.get_running_loop()
            for number in (signal.SIGTERM, signal.SIGHUP):
                loop.add_signal_handler(number, chat.end)
            backend.set_off()
            await chat.run()
    finally:
        backend.over.set()


def _lines(typed: InputHistoryOptions, session: str) -> "InputHistory | UnsavedInputHistory":
    from xavi_dialogue.storage.input_history import InputHistory, UnsavedInputHistory, erase

    if typed.days is None:
        return UnsavedInputHistory()
    typed.file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    erase(typed.file, before=datetime.now() - timedelta(days=typed.days))
    return InputHistory(typed.file, session)
