"""What a passenger at a terminal can see and do, over the bus."""

import asyncio
from contextlib import suppress
from datetime import datetime

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.backend import Behind
from xavi_dialogue.chat.client import DEADLINE, GRACE, Client, ServiceLost, new_request
from xavi_dialogue.chat.history import Minutes
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


class RemoteCabin:
    """See terminal.chat_interface.Cabin."""

    def __init__(self, behind: Behind, client: Client, minutes: Minutes) -> None:
        self._behind, self._client, self._minutes = behind, client, minutes

    def status(self) -> str:
        """One line: time, speed, plan."""
        scene = self._client.scene
        if scene is None:
            return "waiting for the car"
        going = scene.state != "ended"
        speed = f"{scene.vehicles[0].speed * KMH:.0f} km/h" if going else ""
        parts = [clock(scene.sim_time), speed, plan_in_words(scene.plan) if going else ""]
        parts.append(self._behind.trouble() or _state(scene))
        return "  ·  ".join(filter(None, parts))

    def vehicles(self) -> str:
        """The vehicles in view, in words."""
        return vehicles_in_words(self._client.scene)

    def plan(self) -> str:
        """The plan in words."""
        return plan_told(self._client.scene)

    def words(self) -> tuple[str, ...]:
        """What can be completed to."""
        scene = self._client.scene
        names = () if scene is None else tuple(name for name in scene.vehicles if name != 0)
        commands = (f"{form.usage.split()[0]}{' ' if form.takes else ''}" for form in COMMANDS)
        return (*commands, *(f"vehicle {name}" for name in names), *PHRASES)

    async def ask(self, text: str, request: str) -> str:
        """The answer to a question; asked once more where the service had to be started anew.

        It comes within the deadline of a question, whatever becomes of the service.
        """
        give_up = asyncio.get_running_loop().time() + DEADLINE + GRACE
        reply = await self._sent(text, request)
        if isinstance(reply, ServiceLost):
            with suppress(ChildFailed, TimeoutError):  # the next check tells of a failed child
                async with asyncio.timeout_at(give_up):
                    if await asyncio.to_thread(self._behind.recover, self._client):
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

        self._client.send(text, done, at=self._behind.now(self._client), request=request)
        return await answer

    async def why(self) -> str:
        """The question why, as it has to be asked now."""
        return await asyncio.to_thread(self._minutes.why)

    async def history(self) -> str:
        """What was said in this session."""
        return await asyncio.to_thread(self._minutes.told)

    async def save(self, file: str) -> str:
        """Write what was said into a file; see Minutes.save."""
        return await asyncio.to_thread(self._minutes.save, file, datetime.now().astimezone())

    async def forget(self) -> str:
        """Erase what was said."""
        return await asyncio.to_thread(self._minutes.forget)

    def cancel(self, request: str) -> None:
        """Drop a question."""
        self._client.cancel(request)

    def pause(self) -> None:
        """Halt the ride."""
        self._behind.order(child_commands.Pause())

    def resume(self) -> None:
        """Go on."""
        self._behind.order(child_commands.Resume())

    def speed(self, factor: float) -> None:
        """Change how fast the ride goes."""
        self._behind.order(child_commands.Speed(factor))

    def seek(self, time: float) -> None:
        """Go to a moment [s] of a recorded ride."""
        self._behind.order(child_commands.Seek(time))

    def check(self) -> None:
        """Raise where the ride cannot be talked about any more."""
        self._behind.check()

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
    """What the car is about to do."""
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
