"""The thread behind the page: it ends at once, whatever it waits for."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from xavi_dialogue.bus.interface import Bus, HubUnreachable
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.chat import local_backend
from xavi_dialogue.chat.local_backend import OVER, LocalBackend, LocalOptions
from xavi_dialogue.chat.main import ChatOptions
from xavi_dialogue.dashboard import main
from xavi_dialogue.dashboard.main import BusThread, DashboardOptions
from xavi_dialogue.dashboard.web.address import ListenOptions
from xavi_dialogue.process.subprocesses import ChildFailed
from xavi_dialogue.security.client_token import Passenger

ADA = Passenger("ada")
PATIENCE = 10.0  # [s] before a test gives up


class FakeCar:
    """A car, or a service, that runs and says nothing."""

    failure: ChildFailed | None = None
    catching_up = False

    def check(self) -> None:
        if self.failure is not None:
            raise self.failure

    def hope(self) -> None:
        pass


class Stage:
    """Processes as the thread starts them."""

    def __init__(self) -> None:
        self.car, self.service, self.hub = FakeCar(), FakeCar(), MemoryHub()
        self.joined, self.failed, self.ended = threading.Event(), threading.Event(), False

    @contextmanager
    def start(self, _: ChatOptions, __: float, options: LocalOptions) -> Iterator[LocalBackend]:
        car: Any = self.car
        service: Any = self.service
        bus: Any = self.hub.connect()
        yield LocalBackend(car, service, bus, over=options.over)

    def begin(self) -> BusThread:
        ride = ChatOptions("s1", "s1", 4, ADA)
        task = DashboardOptions(ListenOptions(), "car", ADA, ride)

        def joined(_: Bus) -> None:
            self.joined.set()

        return BusThread(task, lambda _: None, joined, self.failed.set)


@pytest.fixture
def stage(monkeypatch: pytest.MonkeyPatch) -> Stage:
    made = Stage()
    monkeypatch.setattr(main, "start_backend", made.start)
    return made


def over(thread: BusThread) -> bool:
    return not thread._thread.is_alive()


def test_it_ends_while_the_car_has_not_been_seen_yet(stage: Stage) -> None:
    thread = stage.begin()
    assert stage.joined.wait(PATIENCE)
    thread.end()
    assert over(thread)
    assert thread.failure is None
    assert not stage.failed.is_set()


def test_what_fails_before_the_end_is_told(stage: Stage) -> None:
    stage.car.failure = ChildFailed("the car has ended (signal 9)")
    thread = stage.begin()
    assert stage.failed.wait(PATIENCE)
    thread.end()
    assert over(thread)
    assert thread.failure is stage.car.failure


def test_a_service_that_is_not_there_yet_is_not_waited_for_after_the_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ended, tries = threading.Event(), 0

    def join(*_: object, **__: object) -> None:
        nonlocal tries
        tries += 1
        if tries == 2:
            ended.set()
        raise HubUnreachable("there is no hub")

    monkeypatch.setattr(local_backend, "join", join)
    monkeypatch.setattr(local_backend, "START_PATIENCE", PATIENCE)
    service: Any = FakeCar()
    with pytest.raises(ChildFailed, match=OVER):
        local_backend._join(service, "tcp/127.0.0.1:1", ended)
    assert tries == 2


def test_a_recorder_that_is_not_there_yet_is_not_waited_for_after_the_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(local_backend, "START_PATIENCE", PATIENCE)
    ended = threading.Event()
    recorder: Any = FakeCar()
    bus: Any = MemoryHub().connect()
    threading.Timer(0.05, ended.set).start()
    with pytest.raises(ChildFailed, match=OVER):
        local_backend._await(recorder, bus, ended)
