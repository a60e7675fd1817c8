"""The same behaviour of both buses: within the process, and over Zenoh on loopback."""

import socket
import threading
import time
from collections.abc import Callable, Iterator

import pytest

from xavi_dialogue.bus.interface import (
    Bus,
    BusFailed,
    Call,
    EndpointTaken,
    HubUnreachable,
    Keys,
    NobodyThere,
    Refused,
    TooLate,
    TransportError,
    call,
)
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.zenoh_bus import host, join

KEY = Keys("car").of


def free_endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


@pytest.fixture(params=["memory", "zenoh"])
def buses(request: pytest.FixtureRequest) -> Iterator[tuple[Bus, Bus]]:
    """Two connections that hear each other."""
    if request.param == "memory":
        hub = MemoryHub()
        with hub.connect() as one, hub.connect() as other:
            yield one, other
        return
    endpoint = free_endpoint()
    with (
        host(Link.of_hub(endpoint)),
        join(Link.to_hub(endpoint)) as one,
        join(Link.to_hub(endpoint)) as other,
    ):
        yield one, other


def until(condition: Callable[[], bool]) -> bool:
    """Wait until something holds; whether it does."""
    for _ in range(500):
        if condition():
            return True
        time.sleep(0.01)
    return False


def test_what_is_kept_reaches_late_joiners_in_order(buses: tuple[Bus, Bus]) -> None:
    one, other = buses
    heard: list[bytes] = []
    publisher = one.publisher(KEY("trace"), keep=10)
    for k in range(5):
        publisher.put(b"%d" % k)
    other.subscribe(KEY("trace"), lambda _, payload: heard.append(payload), kept=True)
    assert until(lambda: len(heard) == 5)
    publisher.put(b"5")
    assert until(lambda: len(heard) == 6)
    assert heard == [b"%d" % k for k in range(6)]


def test_what_is_not_kept_reaches_who_is_there(buses: tuple[Bus, Bus]) -> None:
    one, other = buses
    heard: list[tuple[str, bytes]] = []
    other.subscribe(KEY("scene"), lambda key, payload: heard.append((key, payload)))
    publisher = one.publisher(KEY("scene"))

    def arrives() -> bool:
        publisher.put(b"now")
        return bool(heard)

    assert until(arrives)
    assert heard[0] == ("xavi/v1/car/scene", b"now")


def test_a_request_gets_its_reply(buses: tuple[Bus, Bus]) -> None:
    one, other = buses
    one.serve(KEY("@rpc/ask"), lambda asked: asked.reply(b"re: " + asked.payload))

    def answered() -> bool:
        try:
            return call(other, KEY("@rpc/ask"), b"hello", 2.0) == b"re: hello"
        except NobodyThere:  # the declaration is on its way
            return False

    assert until(answered)


def test_a_reply_may_come_from_another_thread_later(buses: tuple[Bus, Bus]) -> None:
    one, other = buses
    one.serve(KEY("@rpc/ask"), lambda asked: threading.Timer(0.05, asked.reply, (b"late",)).start())
    outcomes: list[object] = []

    def asks() -> bool:
        other.request(KEY("@rpc/ask"), b"", 2.0, outcomes.append)
        return until(lambda: bool(outcomes)) and outcomes.pop() == b"late"

    assert until(asks)


def test_a_refusal_carries_its_message(buses: tuple[Bus, Bus]) -> None:
    one, other = buses
    one.serve(KEY("@rpc/ask"), lambda asked: asked.refuse(b"no"))

    def refused() -> bool:
        try:
            call(other, KEY("@rpc/ask"), b"", 2.0)
        except Refused as error:
            return error.payload == b"no"
        except NobodyThere:
            return False
        return False

    assert until(refused)


def test_where_nobody_serves_nobody_answers(buses: tuple[Bus, Bus]) -> None:
    with pytest.raises(NobodyThere):
        call(buses[0], KEY("@rpc/ask"), b"", 2.0)


def test_the_living_are_known_and_the_gone_are_missed(buses: tuple[Bus, Bus]) -> None:
    one, other = buses
    seen: list[bool] = []
    one.appear(KEY("alive/car"))
    other.watch(KEY("alive/car"), lambda _, alive: seen.append(alive))
    assert until(lambda: seen == [True])
    one.close()
    assert until(lambda: seen == [True, False])


def test_over_zenoh_a_request_has_its_own_deadline() -> None:
    endpoint = free_endpoint()
    held: list[Call] = []
    with host(Link.of_hub(endpoint)) as hub, join(Link.to_hub(endpoint)) as client:
        hub.serve(KEY("@rpc/ask"), held.append)

        def kept_waiting() -> bool:
            try:
                call(client, KEY("@rpc/ask"), b"", 0.2)
            except TooLate:
                return True
            except NobodyThere:
                return False
            return False

        assert until(kept_waiting)
        for one in held:
            one.drop()


def test_a_reply_that_zenoh_refuses_is_an_error_of_ours() -> None:
    endpoint = free_endpoint()
    held: list[Call] = []
    with host(Link.of_hub(endpoint)) as hub, join(Link.to_hub(endpoint)) as client:
        hub.serve(KEY("@rpc/ask"), held.append)

        def asked() -> bool:
            client.request(KEY("@rpc/ask"), b"", 2.0, lambda _: None)
            return bool(held)

        assert until(asked)
        answered = held[0]
        answered.reply(b"once")
        for again in (answered.reply, answered.refuse):
            with pytest.raises(BusFailed, match="not sent"):
                again(b"twice")


@pytest.mark.parametrize("keep", [0, 5])
def test_nothing_is_sent_on_a_bus_that_is_closed(keep: int) -> None:
    with host(Link.of_hub(free_endpoint())) as bus:
        publisher = bus.publisher(KEY("trace"), keep)
        publisher.put(b"sent")
    with pytest.raises(BusFailed, match="the message was not sent"):
        publisher.put(b"late")


def test_zenoh_errors_are_ours() -> None:
    endpoint = free_endpoint()
    with pytest.raises(HubUnreachable, match="xavi serve"):
        join(Link.to_hub(endpoint), patience=0.0)
    with host(Link.of_hub(endpoint)), pytest.raises(EndpointTaken, match="in use"):
        host(Link.of_hub(endpoint))
    assert issubclass(HubUnreachable, TransportError)
