"""The chat at a terminal: one line to type in, answers above it while the car drives on."""

import asyncio
import contextlib
import shutil
import textwrap
from collections.abc import Awaitable, Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol

from prompt_toolkit import PromptSession, print_formatted_text
from prompt_toolkit.completion import CompleteEvent, Completer, Completion
from prompt_toolkit.document import Document
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.history import History, InMemoryHistory
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.patch_stdout import patch_stdout

PROMPT = "> "
REFRESH = 0.25  # [s] of the status line
WATCH = 0.5  # [s] between looks at whether all is well
MAX_WIDTH = 100  # columns of an answer
WELCOME = "Ask about the ride at any time. /help lists what else there is."
HINT = "Ctrl-C cancels an answer; Ctrl-D or /quit ends the ride."

HELP = """\
Ask anything about the ride, such as: Why did you change lanes?
/pause  /resume     halt the ride, and go on
/speed X            X simulated seconds per second; 0 is as fast as possible
/vehicles  /plan    who is there, and what I am about to do
/help  /quit        this list, and the end (also Ctrl-D)
Tab completes. Ctrl-C cancels the answer that you wait for."""


class CommandError(Exception):
    """A slash command that does not exist, or is used wrongly."""


class Cabin(Protocol):
    """What the terminal talks to."""

    def status(self) -> str:
        """One line: time, speed, plan."""

    def vehicles(self) -> tuple[str, ...]:
        """The vehicles in view, in words."""

    def plan(self) -> str:
        """The plan in words."""

    def words(self) -> tuple[str, ...]:
        """What can be completed to."""

    def ask(self, text: str, request: str) -> Awaitable[str]:
        """The answer to a question."""

    def cancel(self, request: str) -> None: ...

    def pause(self) -> None: ...

    def resume(self) -> None: ...

    def speed(self, factor: float) -> None: ...

    def check(self) -> None:
        """Raise where the ride cannot be talked about any more."""

    def new_request(self) -> str: ...


@dataclass(frozen=True)
class _Waiting:
    request: str
    task: "asyncio.Task[None]"


class TerminalChat:
    """One conversation at a terminal."""

    def __init__(self, cabin: Cabin, history: History | None = None) -> None:
        self._cabin = cabin
        self._questions: asyncio.Queue[str] = asyncio.Queue()
        self._waiting: _Waiting | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._session: PromptSession[str] = PromptSession(
            PROMPT,
            history=history or InMemoryHistory(),
            completer=_Words(cabin.words),
            complete_while_typing=False,
            bottom_toolbar=self._toolbar,
            key_bindings=self._bindings(),
            refresh_interval=REFRESH,
        )

    def tell(self, line: str) -> None:
        """Show a line from any thread; nothing happens before and after the conversation."""
        if self._loop is not None:
            with contextlib.suppress(RuntimeError):  # the loop is closed
                self._loop.call_soon_threadsafe(_dim, line)

    def end(self) -> None:
        """End the conversation, from the loop's thread."""
        if self._session.app.is_running:
            self._session.app.exit(exception=EOFError)

    async def run(self) -> None:
        """Talk until the passenger, or something that went wrong, ends it.

        Raises:
            Exception: what `Cabin.check` raised.
        """
        self._loop = asyncio.get_running_loop()
        tasks = [asyncio.create_task(self._answer_all()), asyncio.create_task(self._watch())]
        try:
            with patch_stdout():
                _dim(WELCOME)
                await self._talk(tasks[1])
        finally:
            self._loop = None
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _talk(self, watch: "asyncio.Task[None]") -> None:
        while True:
            try:
                text = (await self._session.prompt_async()).strip()
            except EOFError:
                if watch.done():
                    watch.result()
                return
            if text == "/quit":
                return
            try:
                if text.startswith("/"):
                    self._command(text)
                elif text:
                    self._questions.put_nowait(text)
            except CommandError as error:
                _show(str(error))

    def _command(self, text: str) -> None:
        match text.split():
            case ["/help"]:
                _show(HELP)
            case ["/pause"]:
                self._cabin.pause()
            case ["/resume"]:
                self._cabin.resume()
            case ["/vehicles"]:
                _show("\n".join(self._cabin.vehicles()) or "There is no other vehicle in view.")
            case ["/plan"]:
                _show(self._cabin.plan())
            case ["/speed", factor]:
                self._cabin.speed(_factor(factor))
            case ["/speed", *_]:
                raise CommandError("/speed takes one number: /speed 2")
            case [command, *_]:
                raise CommandError(f"There is no command {command}. /help lists them.")

    async def _answer_all(self) -> None:
        while True:
            text = await self._questions.get()
            request = self._cabin.new_request()
            task = asyncio.create_task(self._answer(text, request))
            self._waiting = _Waiting(request, task)
            await asyncio.wait([task])
            self._waiting = None

    async def _answer(self, text: str, request: str) -> None:
        _say(await self._cabin.ask(text, request))

    async def _watch(self) -> None:
        """End the conversation when what it rests on is gone."""
        while True:
            await asyncio.sleep(WATCH)
            try:
                self._cabin.check()
            except Exception:
                self.end()
                raise

    def _interrupt(self) -> None:
        """Ctrl-C: the answer that is waited for, else what is typed, else a hint."""
        waiting, buffer = self._waiting, self._session.default_buffer
        if waiting is not None:
            self._cabin.cancel(waiting.request)
            waiting.task.cancel()
            _dim("(cancelled)")
        elif buffer.text:
            buffer.reset()
        else:
            _dim(HINT)

    def _bindings(self) -> KeyBindings:
        bindings = KeyBindings()

        @bindings.add("c-c")
        @bindings.add("<sigint>")
        def _(_: KeyPressEvent) -> None:
            self._interrupt()

        return bindings

    def _toolbar(self) -> str:
        thinking = "  ·  thinking" if self._waiting is not None else ""
        return f" {self._cabin.status()}{thinking}"


class _Words(Completer):
    """Completes the last words of the line to what the live scene offers."""

    def __init__(self, words: Callable[[], tuple[str, ...]]) -> None:
        self._words = words

    def get_completions(self, document: Document, _: CompleteEvent) -> Iterable[Completion]:
        """See Completer."""
        line = document.text_before_cursor.lstrip()
        for word in self._words():
            for typed in _tails(line):
                if word.lower().startswith(typed.lower()) and word.lower() != typed.lower():
                    yield Completion(word, start_position=-len(typed))
                    break


def _tails(line: str) -> Iterator[str]:
    """The last words of the line, from all of them to one."""
    words = line.split(" ")
    for first in range(len(words)):
        tail = " ".join(words[first:])
        if tail:
            yield tail


def _factor(text: str) -> float:
    try:
        factor = float(text)
    except ValueError:
        factor = -1.0
    if not 0.0 <= factor <= 1000.0:
        raise CommandError(f"/speed takes a number from 0 to 1000, not {text!r}.")
    return factor


def _wrap(text: str) -> str:
    width = min(shutil.get_terminal_size().columns, MAX_WIDTH)
    return "\n".join(textwrap.fill(line, width) for line in text.splitlines())


def _say(text: str) -> None:
    print_formatted_text(_wrap(text) + "\n")


def _show(text: str) -> None:
    print_formatted_text(text)


def _dim(text: str) -> None:
    print_formatted_text(FormattedText([("fg:ansibrightblack", text)]))
