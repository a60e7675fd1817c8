"""The chat at a terminal: one line to type in, answers above it while the car drives on."""

import asyncio
import contextlib
import contextvars
import os
from collections.abc import Awaitable, Callable, Coroutine
from dataclasses import dataclass
from typing import TypeAlias

from prompt_toolkit import PromptSession
from prompt_toolkit.application import get_app_session
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.history import History, InMemoryHistory
from prompt_toolkit.input import Input
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.patch_stdout import patch_stdout

from xavi_dialogue.bus.messages import MAX_TEXT
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.terminal import slash_commands
from xavi_dialogue.terminal.chat_interface import ChatInterface
from xavi_dialogue.terminal.completion import Words
from xavi_dialogue.terminal.screen import Screen, cut, has_colours
from xavi_dialogue.terminal.slash_commands import CommandError

PROMPT = "> "
THINKING = "thinking ... (Ctrl-C gives it up)"
SURE = "Erase all that was said in this session? [y/N] "
KEPT = "(nothing is erased)"
REFRESH = 0.25  # [s] between updates of the status line
WATCH = 0.5  # [s] between checks of the processes
NOTICED = 0.2  # [s] after which a passenger who waits gets a note
WELCOME = (
    "Ask about the ride. /pause halts it for questions; once it is over, ask on.",
    "/resume lets it go on, /help lists all commands.",
)
ALONG = (  # in a car that others drive
    "Ask about the ride, also once it is over.",
    "/help lists all commands.",
)
HINT = "Ctrl-C cancels an answer; Ctrl-D or /quit ends the ride."
HELP = "Ask anything about the ride, such as: Why did you change lanes?"
KEYS = "Tab completes. Ctrl-C cancels the answer that you wait for, Ctrl-D ends the ride."


_Job: TypeAlias = Callable[[str], Awaitable[str]]  # a request's name; the text to print


@dataclass(frozen=True)
class _Waiting:
    request: str
    task: "asyncio.Future[str]"


class TerminalChat:
    """One conversation at a terminal."""

    def __init__(
        self,
        controller: ChatInterface,
        history: History | None = None,
        *,
        keyboard: Input | None = None,
        colours: bool | None = None,
        halts: bool = True,
    ) -> None:
        """Make a conversation.

        Args:
            controller: what it is about.
            history: of typed lines; None: none is kept.
            keyboard: what is typed at; None: that of the process.
            colours: whether to use them; None: as the environment says.
            halts: whether the passenger can halt the ride.
        """
        self._interface, self._welcome = controller, WELCOME if halts else ALONG
        self._screen = Screen(colours=has_colours(os.environ) if colours is None else colours)
        self._jobs: asyncio.Queue[_Job] = asyncio.Queue()  # one after another, as typed
        self._waiting: _Waiting | None = None
        self._thinking = False  # whether an answer takes so long that this is shown
        self._confirming = False  # whether to erase the conversation
        self._over = False
        self._loop: asyncio.AbstractEventLoop | None = None
        self._context = contextvars.copy_context()
        self._app_session = get_app_session()
        self._session: PromptSession[str] = PromptSession(
            self._prompt,
            input=keyboard,
            history=history or InMemoryHistory(),
            completer=Words(controller.words),
            complete_while_typing=False,
            bottom_toolbar=lambda: cut(f" {controller.status()}", self._screen.columns),
            key_bindings=self._bindings(),
            refresh_interval=REFRESH,
            color_depth=self._screen.depth,
            style=self._screen.style,
        )

    def tell(self, line: str) -> None:
        """Show a line from any thread; nothing happens before and after the conversation."""
        if self._loop is not None:
            with contextlib.suppress(RuntimeError):  # the loop is closed
                self._loop.call_soon_threadsafe(self._screen.dim, line, context=self._context)

    def end(self) -> None:
        """End the conversation, from the loop's thread."""
        self._over = True
        app = self._app_session.app
        if app is not None and app.is_running and not app.is_done:
            app.exit(exception=EOFError)

    async def run(self) -> None:
        """Run until the passenger ends the chat, or an error does.

        Raises:
            Exception: raised by `ChatInterface.check`.
        """
        self._loop = asyncio.get_running_loop()
        behind = [asyncio.create_task(self._ending(one())) for one in (self._work, self._watch)]
        try:
            with self._session.input.raw_mode(), patch_stdout():
                for line in self._welcome:
                    self._screen.dim(line)
                await self._talk()
                for task in behind:
                    if task.done():
                        task.result()
        finally:
            self._loop = None
            for task in behind:
                task.cancel()
            await asyncio.gather(*behind, return_exceptions=True)

    async def _talk(self) -> None:
        while not self._over:
            try:
                text = await self._session.prompt_async()
            except EOFError:
                return
            for line in text.splitlines() or ("",):  # several if they were pasted
                if not self._over:
                    self._take(line)

    def _take(self, line: str) -> None:
        """Handle a line that was typed: an assent, a command, or a question."""
        text = one_line(line)
        if self._confirming:
            self._confirming = False
            if text.lower() in ("y", "yes"):
                self._jobs.put_nowait(lambda _: self._forget())
                return
            self._screen.dim(KEPT)
            if text.lower() in ("n", "no"):
                return
        try:
            if text.startswith("/"):
                self._command(slash_commands.read(text, "terminal"))
            elif text:
                self._ask(text)
        except CommandError as error:
            self._screen.tell(str(error))

    def _ask(self, text: str) -> None:
        if len(text) > MAX_TEXT:
            self._screen.dim(f"(Only the first {MAX_TEXT} characters are asked.)")
        self._jobs.put_nowait(lambda request: self._interface.ask(text[:MAX_TEXT], request))

    def _command(self, command: slash_commands.Command) -> None:
        controller, screen, put = self._interface, self._screen, self._jobs.put_nowait
        match command.name:
            case "quit":
                self._over = True
            case "help":
                screen.tell(HELP)
                screen.lay_out(slash_commands.listed("terminal", screen.width))
                screen.tell(KEYS)
            case "vehicles":
                screen.tell(controller.vehicles())
            case "plan":
                screen.tell(controller.plan())
            case "pause":
                controller.pause()
            case "resume":
                controller.resume()
            case "speed":
                controller.speed(slash_commands.factor(command.argument))
            case "seek":
                controller.seek(slash_commands.moment(command.argument))
            case "why":
                put(self._why)
            case "more":
                put(lambda request: controller.ask(slash_commands.MORE, request))
            case "history":
                put(lambda _: controller.history())
            case "save":
                put(lambda _: controller.save(command.argument))
            case "forget":
                self._confirming = True

    async def _why(self, request: str) -> str:
        return await self._interface.ask(await self._interface.why(), request)

    async def _forget(self) -> str:
        told = await self._interface.forget()
        buffer = self._session.default_buffer
        buffer.reset(buffer.document)  # the lines typed before are read again
        return told

    async def _work(self) -> None:
        """Carry out one job after another."""
        while True:
            job = await self._jobs.get()
            request = self._interface.new_request()
            task = asyncio.ensure_future(job(request))
            self._waiting = _Waiting(request, task)
            notice = asyncio.get_running_loop().call_later(NOTICED, self._notice)
            await asyncio.wait([task])
            notice.cancel()
            self._waiting, self._thinking = None, False
            if not task.cancelled():
                self._tell_outcome(task)
            self._session.app.invalidate()

    def _tell_outcome(self, task: "asyncio.Future[str]") -> None:
        try:
            self._screen.say(task.result())
        except CommandError as error:
            self._screen.tell(str(error))

    def _notice(self) -> None:
        self._thinking = True
        self._session.app.invalidate()

    async def _watch(self) -> None:
        """Check the processes behind the conversation."""
        while True:
            await asyncio.sleep(WATCH)
            self._interface.check()

    async def _ending(self, work: Coroutine[None, None, None]) -> None:
        """End the conversation after an error."""
        try:
            await work
        except Exception:
            self.end()
            raise

    def _interrupt(self) -> None:
        """Handle Ctrl-C: cancel the pending answer, else clear the input, else show a hint."""
        waiting, buffer = self._waiting, self._session.default_buffer
        if self._confirming:
            self._confirming = False
            self._screen.dim(KEPT)
        elif waiting is not None:
            self._interface.cancel(waiting.request)
            waiting.task.cancel()
            self._screen.dim("(cancelled)")
        elif buffer.text:
            buffer.reset()
        else:
            self._screen.dim(HINT)

    def _bindings(self) -> KeyBindings:
        bindings = KeyBindings()

        @bindings.add("c-c")
        @bindings.add("<sigint>")
        def _(_: KeyPressEvent) -> None:
            self._interrupt()

        return bindings

    def _prompt(self) -> FormattedText:
        """Return the prompt, with the state of pending requests above it."""
        prompt = SURE if self._confirming else PROMPT
        if self._thinking and not self._session.app.is_done:
            return FormattedText([(self._screen.faint, f"{THINKING}\n"), ("", prompt)])
        return FormattedText([("", prompt)])
