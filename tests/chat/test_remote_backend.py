"""Riding along with a car and a service that others have started, on a bus within one process."""

from pathlib import Path

import msgspec
import pytest

from tests.chat.test_history import FakeService, scene
from xavi_dialogue.bus.interface import HubUnreachable, Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.memory_bus import MemoryBus, MemoryHub
from xavi_dialogue.bus.messages import CancelReply, CancelRequest, pack, unpack
from xavi_dialogue.chat import remote_backend
from xavi_dialogue.chat.controller import ChatController
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.chat.remote_backend import (
    GONE,
    NamesOnBus,
    NotOnBus,
    RemoteCar,
    ask_there,
    meet,
    through_pipe,
)
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.exit_status import ExitStatus, status_of
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.terminal.slash_commands import CommandError

ADA = Passenger("ada", "t" * 43)
THERE = RemoteCar(Link.to_hub(), "car")


class Town:
    """A bus with whoever is on it; None: there is no hub."""

    def __init__(self) -> None:
        self.hub: MemoryHub | None = MemoryHub()
        self.service = FakeService(self.hub)

    def join(self, link: Link, patience: float) -> MemoryBus:
        if self.hub is None:
            raise HubUnreachable("there is no hub at tcp/127.0.0.1:7447")
        bus = self.hub.connect()
        request = bus.request

        def shown(*arguments: object) -> None:
            request(*arguments)  # type: ignore[arg-type]
            self.show()

        bus.request = shown  # type: ignore[assignment, method-assign]
        return bus

    def serve(self) -> None:
        self.service.appear()
        bus = self.service.hub.connect()
        bus.serve("xavi/v1/*/@rpc/cancel", lambda call: call.reply(nothing(call.payload)))

    def drive(self, *names: str) -> None:
        for name in names:
            self.service.hub.connect().appear(Keys(name).of("alive/car"))

    def show(self) -> None:
        publisher = self.service.hub.connect().publisher(Keys().of("scene"))
        publisher.put(pack(scene(4.0, "paused")))


def nothing(payload: bytes) -> bytes:
    request = unpack(payload, CancelRequest).request
    return pack(CancelReply(request=request, cancelled=False))


@pytest.fixture
def town(monkeypatch: pytest.MonkeyPatch) -> Town:
    made = Town()
    monkeypatch.setattr(remote_backend, "join", made.join)
    monkeypatch.setattr(remote_backend, "PATIENCE", 0.2)
    monkeypatch.setattr(remote_backend, "BRIEFLY", 0.2)
    monkeypatch.setattr(remote_backend, "BACK", 0.2)
    return made


def missing(town: Town) -> str:
    with pytest.raises(NotOnBus) as caught, meet(THERE, ADA, 0.2):
        pytest.fail("nobody is there")
    return str(caught.value)


def test_what_is_missing_is_named(town: Town) -> None:
    town.drive("car")
    assert "no dialogue service" in missing(town)
    town.serve()
    with meet(THERE, ADA, 0.2) as (_, client):
        assert client.scene is not None
    town.hub = None
    with pytest.raises(HubUnreachable), meet(THERE, ADA, 0.2):
        pytest.fail("there is no hub")


def test_a_service_that_is_there_and_does_not_answer_is_not_said_to_be_missing(
    town: Town, tmp_path: Path
) -> None:
    town.drive("car")
    town.service.hub.connect().appear(Keys("bus-7").of("alive/service"))
    assert "none answers about the car 'car'; xavi doctor tells" in missing(town)
    town.service.hub.connect().appear(Keys("car").of("alive/service"))
    assert missing(town) == "the dialogue service is there, but does not answer"
    reply = ask_there(THERE, ADA, "One?", 2.0, "passenger")
    assert "is there, but does not answer" in reply.text
    keyed = RemoteCar(Link.to_hub(config=tmp_path / "observer.json5"), "car")
    reply = ask_there(keyed, ADA, "One?", 2.0, "passenger")
    assert "but this key may not ask it; a passenger's may" in reply.text


def test_who_is_there_in_place_of_the_car_is_named(town: Town) -> None:
    town.serve()
    assert "no car at all" in missing(town)
    town.drive("bus-7")
    assert missing(town) == "there is no car 'car'; there is bus-7"
    town.drive(*(f"taxi-{number:02d}" for number in range(30)), "evil\x1b[2Jname")
    assert missing(town) == (
        "there is no car 'car'; there are bus-7, "
        + ", ".join(f"taxi-{number:02d}" for number in range(9))
        + " and 21 more"
    )


def test_a_car_that_says_nothing_is_told_from_one_that_is_not_there(
    town: Town, monkeypatch: pytest.MonkeyPatch
) -> None:
    town.serve()
    town.drive("car")
    monkeypatch.setattr(Town, "show", lambda _: None)
    assert missing(town) == "the car 'car' is there, but says nothing"


def test_cars_come_and_go() -> None:
    cars, key = NamesOnBus(), Keys("bus-7").of("alive/car")
    cars.see(key, True)
    cars.see("nothing/of/ours", True)
    assert cars.told() == "there is bus-7"
    cars.see(key, False)
    cars.see(key, False)
    assert "no car at all" in cars.told()


def test_one_question_is_answered_or_it_is_said_who_is_missing(town: Town) -> None:
    reply = ask_there(THERE, ADA, "One?", 2.0, "passenger")
    assert status_of(reply) is ExitStatus.PLANNER_UNAVAILABLE
    assert "no dialogue service" in reply.text
    town.serve()
    town.drive("car")
    reply = ask_there(THERE, ADA, "One?", 2.0, "passenger")
    assert (reply.text, reply.sim_time) == ("Answer to One?", 2.0)
    town.hub = None
    reply = ask_there(THERE, ADA, "One?", 2.0, "passenger")
    assert status_of(reply) is ExitStatus.PLANNER_UNAVAILABLE


def test_through_a_pipe_moments_are_asked_about_and_nothing_is_moved(town: Town) -> None:
    town.serve()
    town.drive("car")
    out: list[str] = []
    notes: list[str] = []
    lines = ["One?", "@ 2.0s", "Two?", "/plan", "/quit", "Three?"]
    through_pipe(THERE, ADA, lines, out.append, notes.append, as_json=True)
    replies = [msgspec.json.decode(line) for line in out]
    assert [(one["text"], one["sim_time"]) for one in replies] == [
        ("Answer to One?", 4.0),
        ("Answer to Two?", 2.0),
    ]
    assert notes == ["riding along with car", "this is how it is at 4.0 s", "I plan to go on."]


def test_who_rides_along_sets_no_pace_and_sees_when_the_car_is_gone(town: Town) -> None:
    town.serve()
    town.drive("car")
    with meet(THERE, ADA, 0.2) as (along, client):
        controller = ChatController(along, client, SessionHistory(client, "ada", THERE.header))
        for order in (controller.pause, controller.resume, lambda: controller.speed(2.0)):
            with pytest.raises(CommandError, match="Only the program that started the car"):
                order()
        with pytest.raises(CommandError):
            along.drive(client, child_commands.Until(8.0))
        along.set_off()
        along.check()
        assert GONE not in controller.status()
        along.cars.see(Keys().of("alive/car"), False)
        assert GONE in controller.status()


def test_a_service_that_is_away_for_a_moment_is_waited_for(town: Town) -> None:
    town.serve()
    town.drive("car")
    with meet(THERE, ADA, 0.2) as (along, client):
        assert along.recover(client)
        town.service.vanish()
        assert not along.recover(client)
