"""The chat without a terminal, which reads one line and writes one answer at a time."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import TypeAlias

from xavi_dialogue.bus.messages import MAX_TEXT, SceneReport
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.backend import Backend
from xavi_dialogue.chat.client import Client, ServiceLost, new_request
from xavi_dialogue.chat.controller import plan_told, vehicles_in_words
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.dialogue.reply import Reply, encode
from xavi_dialogue.process import child_commands
from xavi_dialogue.terminal import slash_commands
from xavi_dialogue.terminal.slash_commands import Command, CommandError
from xavi_dialogue.transcripts.transcript import moment

Write: TypeAlias = Callable[[str], None]
SHOWN = 40  # characters of an invalid line that are shown
WIDTH = 100  # columns of the list of /help
HELP = (
    "A line is a question, a moment that moves time such as @ 8.0s, or one of these commands.\n"
    "Answers go to the standard output; with --json nothing else does."
)


def reached(scene: SceneReport, wanted: float) -> float:
    """Return the time [s] that can be asked about after a recording went to `wanted`.

    That is the wanted time, or the time of the scene if the recording stops before the wanted one.
    """
    return min(wanted, scene.sim_time) if scene.state == "paused" else wanted


@dataclass
class BatchChat:
    """A conversation line by line, about a ride that halts between questions unless it is live."""

    backend: Backend
    client: Client
    session_history: SessionHistory
    write: Write  # writes answers
    note: Write  # writes everything else
    as_json: bool  # whether replies are written as JSON
    scene: SceneReport  # at which the ride has halted
    at: float | None  # [s] that questions are about; None: the time at which they are asked
    live: bool = False  # whether the ride continues by itself
    seeks: bool = False  # whether it is a recording, which can go to any moment

    def take(self, raw: str) -> bool:
        """Handle a line; return whether to go on.

        Raises:
            ChildFailed: car or service ended.
            ServiceLost: a question was not answered.
        """
        self.backend.check()
        try:
            return self._take(one_line(raw))
        except CommandError as error:
            self.note(str(error))
        return True

    def _take(self, line: str) -> bool:
        moved = moment(line)
        if moved is not None:
            self._move(moved)
        elif line.startswith("/"):
            return self._obey(slash_commands.read(line, "pipe"))
        elif line.startswith("@"):
            self.note(f"a moment is written @ 8.0s, not {line[:SHOWN]!r}")
        elif line:
            self._ask(line)
        return True

    def _move(self, at: float) -> None:
        if self.seeks:
            self.scene = self.backend.drive(self.client, child_commands.Seek(at), halt=True)
            at = reached(self.scene, at)
        elif not self.live and self.scene.sim_time < at and self.scene.state != "ended":
            self.scene = self.backend.drive(self.client, child_commands.Until(at), halt=True)
        if not self.live and self.scene.state == "ended" and self.scene.sim_time < at:
            at = self.scene.sim_time
            self.note(f"the ride ended at {at:.1f} s: questions are about then")
        self.at = at  # set only after the ride went there: other times are unknown

    def _ask(self, text: str) -> None:
        if len(text) > MAX_TEXT:
            self.note(f"only the first {MAX_TEXT} characters of a question are asked")
        reply = self._reply(text[:MAX_TEXT])
        self.write(encode(reply) if self.as_json else reply.text)

    def _reply(self, text: str) -> Reply:
        at = self.backend.now(self.client) if self.at is None else self.at
        request = new_request()  # the same again: it may have been answered and stored already
        try:
            return self.client.ask(text, at, request=request)
        except ServiceLost:
            if not self.backend.recover(self.client):
                raise
        return self.client.ask(text, at, request=request)

    def _obey(self, command: Command) -> bool:
        match command.name:
            case "quit":
                return False
            case "help":
                self._tell(f"{HELP}\n{slash_commands.listed('pipe', WIDTH)}")
            case "why":
                self._ask(self.session_history.why())
            case "more":
                self._ask(slash_commands.MORE)
            case "vehicles":
                self._tell_now(vehicles_in_words)
            case "plan":
                self._tell_now(plan_told)
            case "history":
                self._tell(self.session_history.told())
            case "save":
                self.note(self.session_history.save(command.argument, datetime.now().astimezone()))
            case "forget":
                self.note(self.session_history.forget())
        return True

    def _tell_now(self, told: Callable[[SceneReport], str]) -> None:
        """Print a description of the latest scene, the only one that is known."""
        scene = self.client.scene if self.live and self.client.scene else self.scene
        if self.at is not None and self.at < scene.sim_time:
            self.note(f"this is how it is at {scene.sim_time:.1f} s")
        self._tell(told(scene))

    def _tell(self, text: str) -> None:
        """Print the result of a command; JSON output holds answers only."""
        (self.note if self.as_json else self.write)(text)
