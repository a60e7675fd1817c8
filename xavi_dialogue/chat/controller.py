"""The chat of a passenger at a terminal, over the bus."""

import asyncio
from contextlib import suppress
from datetime import datetime

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.backend import Backend
from xavi_dialogue.chat.client import DEADLINE, GRACE, Client, ServiceLost, new_request
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.explain.facts.looks import look_in
from xavi_dialogue.nlg.narration import clock, plan_in_words
from xavi_dialogue.nlg.surface.referring import described
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.subprocesses import ChildFailed
from xavi_dialogue.terminal.slash_commands import forms

KMH = 3.6
PHRASES = (
    *("Why did you ", "Why didn't you ", "What if you had ", "What are you doing?"),
    *("instead of ", "changing left", "changing right", "turning left", "turning right"),
    *("change left", "change right", "turn left", "turn right", "stop", "slow down", "give way"),
)
COMMANDS = forms("terminal")
LOST = "I cannot answer now:"
ALONE = "There is no other vehicle in view."


class ChatController:
    """A chat over the bus; see terminal.chat_interface.ChatInterface."""

    def __init__(self, backend: Backend, client: Client, session_history: SessionHistory) -> None:
        self._backend, self._client, self._session_history = backend, client, session_history

    def status(self) -> str:
        """One line: time, speed, plan."""
        scene = self._client.scene
        if scene is None:
            return "waiting for the car"
        going = scene.state != "ended"
        speed = f"{scene.vehicles[0].speed * KMH:.0f} km/h" if going else ""
        parts = [clock(scene.sim_time), speed, plan_in_words(scene.plan) if going else ""]
        parts.append(self._backend.trouble() or _state(scene))
        return "  ·  ".join(filter(None, parts))

    def vehicles(self) -> str:
        """Describe the vehicles in view."""
        return vehicles_in_words(self._client.scene)

    def plan(self) -> str:
        """Describe the plan."""
        return plan_told(self._client.scene)

    def words(self) -> tuple[str, ...]:
        """Return the words that Tab can complete."""
        scene = self._client.scene
        names = () if scene is None else tuple(name for name in scene.vehicles if name != 0)
        commands = (f"{form.usage.split()[0]}{' ' if form.takes else ''}" for form in COMMANDS)
        return (*commands, *(f"vehicle {name}" for name in names), *PHRASES)

    async def ask(self, text: str, request: str) -> str:
        """Return the answer to a question; ask again if the service had to be restarted.

        It comes within the deadline of a question, even if the service fails.
        """
        give_up = asyncio.get_running_loop().time() + DEADLINE + GRACE
        reply = await self._sent(text, request)
        if isinstance(reply, ServiceLost):
            with suppress(ChildFailed, TimeoutError):  # the next check reports a failed child
                async with asyncio.timeout_at(give_up):
                    if await asyncio.to_thread(self._backend.recover, self._client):
                        reply = await self._sent(text, request)
        return f"{LOST} {reply}." if isinstance(reply, ServiceLost) else reply.text

    async def _sent(self, text: str, request: str) -> Reply | ServiceLost:
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[Reply | ServiceLost] = loop.create_future()

        def settle(reply: Reply | ServiceLost) -> None:
            if not answer.done():  # cancelled
                answer.set_result(reply)

        def done(reply: Reply | ServiceLost) -> None:
            with suppress(RuntimeError):  # the conversation is over
                loop.call_soon_threadsafe(settle, reply)

        self._client.send(text, done, at=self._backend.now(self._client), request=request)
        return await answer

    async def why(self) -> str:
        """Return the question why about the latest answer or action."""
        return await asyncio.to_thread(self._session_history.why)

    async def history(self) -> str:
        """Return the turns of this session as text."""
        return await asyncio.to_thread(self._session_history.told)

    async def save(self, file: str) -> str:
        """Write the session to a file; see SessionHistory.save."""
        return await asyncio.to_thread(
            self._session_history.save, file, datetime.now().astimezone()
        )

    async def forget(self) -> str:
        """Erase the session."""
        return await asyncio.to_thread(self._session_history.forget)

    def cancel(self, request: str) -> None:
        """Drop a question."""
        self._client.cancel(request)

    def pause(self) -> None:
        """Halt the ride."""
        self._backend.order(child_commands.Pause())

    def resume(self) -> None:
        """Go on."""
        self._backend.order(child_commands.Resume())

    def speed(self, factor: float) -> None:
        """Change the pace of the ride."""
        self._backend.order(child_commands.Speed(factor))

    def seek(self, time: float) -> None:
        """Go to a moment [s] of a recorded ride."""
        self._backend.order(child_commands.Seek(time))

    def check(self) -> None:
        """Raise an error if the ride has ended for the chat."""
        self._backend.check()

    def new_request(self) -> str:
        """A name for a question."""
        return new_request()


def vehicles_in_words(scene: SceneReport | None) -> str:
    """The other vehicles in view, a line each."""
    if scene is None:
        return ALONE
    looks = (look_in(scene.vehicles, name, scene.sim_time) for name in sorted(scene.vehicles))
    lines = (
        f"vehicle {look.vehicle}: {one_line(described(look))}, {look.speed * KMH:.0f} km/h"
        for look in looks
        if look is not None
    )
    return "\n".join(lines) or ALONE


def plan_told(scene: SceneReport | None) -> str:
    """Describe the next action of the car."""
    if scene is not None and scene.state == "ended":
        return "The ride is over."
    if scene is None or not scene.plan:
        return "I have no plan yet."
    return f"I plan to {plan_in_words(scene.plan)}."


def _state(scene: SceneReport) -> str:
    match scene.state:
        case "paused":
            return "paused: /resume goes on"
        case "ended":
            return "the ride is over; ask on"
        case "driving":
            return "" if scene.speed_factor == 1.0 else f"speed {scene.speed_factor:g}"
