"""What a passenger at a terminal can see and do, over the bus."""

import asyncio
from collections.abc import Iterable
from contextlib import suppress

from planner.trace import Action
from xavi_dialogue.app import control
from xavi_dialogue.app.client import Client, ServiceLost, new_request
from xavi_dialogue.app.convoy import Convoy
from xavi_dialogue.app.narration import clock, plan_in_words
from xavi_dialogue.dialogue.referents import vehicle_words
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.transports.messages import SceneReport

KMH = 3.6
PHRASES = (
    *("Why did you ", "Why didn't you ", "What if you had ", "What are you doing?"),
    *("instead of ", "changing left", "changing right", "turning left", "turning right"),
    *("change left", "change right", "turn left", "turn right", "stop", "slow down", "give way"),
)
COMMANDS = ("/help", "/pause", "/resume", "/speed ", "/vehicles", "/plan", "/quit")


class RemoteCabin:
    """See transports.terminal.Cabin."""

    def __init__(self, behind: Convoy, client: Client) -> None:
        self._behind, self._client = behind, client

    def status(self) -> str:
        """One line: time, speed, plan."""
        scene = self._client.scene
        if scene is None:
            return "waiting for the car"
        speed = f"{scene.vehicles[0].speed * KMH:.0f} km/h"
        parts = [clock(scene.sim_time), speed, plan_in_words(scene.plan), _state(scene)]
        return "  ·  ".join(filter(None, parts))

    def vehicles(self) -> tuple[str, ...]:
        """The vehicles in view, in words."""
        scene = self._client.scene
        if scene is None:
            return ()
        return tuple(
            f"vehicle {name}: {words.description or 'a ' + scene.vehicles[name].kind},"
            f" {scene.vehicles[name].speed * KMH:.0f} km/h"
            for name, words in vehicle_words(scene.vehicles).items()
        )

    def plan(self) -> str:
        """The plan in words."""
        scene = self._client.scene
        plan: Iterable[Action] = () if scene is None else scene.plan
        return f"I plan to {plan_in_words(plan)}." if plan else "I have no plan yet."

    def words(self) -> tuple[str, ...]:
        """What can be completed to."""
        scene = self._client.scene
        names = () if scene is None else tuple(name for name in scene.vehicles if name != 0)
        return (*COMMANDS, *(f"vehicle {name}" for name in names), *PHRASES)

    async def ask(self, text: str, request: str) -> str:
        """The answer to a question."""
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[Reply | ServiceLost] = loop.create_future()

        def settle(reply: Reply | ServiceLost) -> None:
            if not answer.done():  # cancelled
                answer.set_result(reply)

        def done(reply: Reply | ServiceLost) -> None:
            with suppress(RuntimeError):  # the conversation is over
                loop.call_soon_threadsafe(settle, reply)

        scene = self._client.scene
        at = None if scene is None else scene.sim_time
        self._client.send(text, done, at=at, request=request)
        reply = await answer
        return f"({reply}.)" if isinstance(reply, ServiceLost) else reply.text

    def cancel(self, request: str) -> None:
        """Drop a question."""
        self._client.cancel(request)

    def pause(self) -> None:
        """Halt the ride."""
        self._behind.car.order(control.Pause())

    def resume(self) -> None:
        """Go on."""
        self._behind.car.order(control.Resume())

    def speed(self, factor: float) -> None:
        """Change how fast the ride goes."""
        self._behind.car.order(control.Speed(factor))

    def check(self) -> None:
        """Raise where the ride cannot be talked about any more."""
        self._behind.check()

    def new_request(self) -> str:
        """A name for a question."""
        return new_request()


def _state(scene: SceneReport) -> str:
    match scene.state:
        case "paused":
            return "paused: /resume goes on"
        case "ended":
            return "the ride is over; ask on"
        case "driving":
            return "" if scene.speed_factor == 1.0 else f"speed {scene.speed_factor:g}"
