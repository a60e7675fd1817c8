"""What the components do on the bus is what their roles grant, and a car takes no orders there."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest
import zenoh

from sim.setup.scenario import load
from tests.dialogue.scripted import scripted_pipeline
from tests.security.test_provisioning import PATIENCE, until, world_of
from xavi_dialogue.bus.access_control import ROLES, Grant
from xavi_dialogue.bus.catalogue import CAR_MESSAGES
from xavi_dialogue.bus.interface import EVERY_CAR, FLEET, Bus, Keys, NoAnswer, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host, join
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.process.child_commands import Signals
from xavi_dialogue.recording.recorder import Recorder
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.mcap_file import McapWriter
from xavi_dialogue.vehicle import bus_session
from xavi_dialogue.vehicle.bus_session import ReplanningOptions, join_bus
from xavi_dialogue.vehicle.telemetry import Reporter

DECLARES = {
    "publisher": "publish",
    "subscribe": "subscribe",
    "serve": "serve",
    "request": "ask",
    "appear": "appear",
    "watch": "watch",
}
CAR = Keys("car")


class Watched:
    """A bus that takes down what is done on it, and does it."""

    def __init__(self, bus: Bus) -> None:
        self.done: set[tuple[str, str]] = set()  # deed, key
        self.bus = bus

    def __getattr__(self, name: str) -> object:
        found = getattr(self.bus, name)
        if name not in DECLARES:
            return found

        def do(key: str, *rest: object, **named: object) -> object:
            kept = bool(
                named.get("keep") or named.get("kept") or (name == "publisher" and any(rest))
            )
            self.done.add((DECLARES[name] + "-kept" * kept, key))
            return found(key, *rest, **named)

        return do


@contextmanager
def on_a_bus_with_keys(folder: Path, role: str) -> Iterator[Watched]:
    with world_of(folder) as world:
        yield Watched(world.members[role])


def granted(role: str) -> list[tuple[str, zenoh.KeyExpr]]:
    return [
        (grant.deed, zenoh.KeyExpr(_place(grant).of(tail)))
        for grant in ROLES[role].grants
        for tail in grant.tails
    ]


def _place(grant: Grant) -> Keys:
    if grant.fleet:
        return FLEET
    return CAR if grant.own else EVERY_CAR


def beyond(role: str, done: set[tuple[str, str]]) -> list[tuple[str, str]]:
    """What was done that the role does not grant: in silence it would come to nothing."""
    return [
        (deed, key)
        for deed, key in sorted(done)
        if not any(deed == may and keys.includes(zenoh.KeyExpr(key)) for may, keys in granted(role))
    ]


@pytest.mark.slow
def test_a_car_does_what_it_may_and_takes_no_orders(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Watched] = []

    def watched(link: Link, patience: float) -> Watched:
        seen.append(Watched(join(link, patience)))
        return seen[-1]

    monkeypatch.setattr(bus_session, "join", watched)
    with world_of(tmp_path / "keys") as world:
        link = Link.to_hub(config=world.folder / "car.json5")
        with join_bus(link, CAR, load("s1").network, ReplanningOptions(), Signals()) as others:
            Reporter(others.outbox, CAR)
    done = set.union(*(one.done for one in seen))
    assert beyond("car", done) == []
    served = {key for deed, key in done if deed == "serve"}
    facts = {CAR.of("alive/car"), CAR.of("@blob/network")}
    facts |= {CAR.of(f"@schema/{name}") for name in (*CAR_MESSAGES, "plan_trace")}
    assert served - facts == {CAR.of("@rpc/whatif")}
    assert {deed for deed, _ in done if deed.startswith("subscribe")} == set()


def test_the_service_does_what_it_may(tmp_path: Path) -> None:
    with on_a_bus_with_keys(tmp_path / "keys", "service") as bus:
        Service(bus, scripted_pipeline()).open()  # type: ignore[arg-type]
        assert len(bus.done) > 20
        assert beyond("service", bus.done) == []


def test_a_passenger_does_what_they_may(tmp_path: Path) -> None:
    with on_a_bus_with_keys(tmp_path / "keys", "passenger") as bus:
        client = Client(bus, CAR, "ada", lambda _: None)  # type: ignore[arg-type]
        evidence = partial(client.evidence, "7a4060ed094b8bf3")
        why = partial(client.ask, "why?")
        for wanted in (client.probe, client.history, client.forget, evidence, why):
            with pytest.raises(ServiceLost):
                wanted()
        client.cancel("q1")
        assert {key for deed, key in bus.done if deed == "ask"} >= {
            CAR.of(f"@rpc/{name}") for name in ("ask", "history", "forget", "cancel", "evidence")
        }
        assert beyond("passenger", bus.done) == []


def test_a_conversation_is_for_those_who_have_its_token(tmp_path: Path) -> None:
    over = threading.Event()
    with world_of(tmp_path / "keys") as world:
        service = Service(world.hub, scripted_pipeline())
        service.open()
        thread = threading.Thread(target=service.run, args=(over.is_set,), daemon=True)
        thread.start()
        turns: dict[str, list[bytes]] = {"passenger": [], "dashboard": []}
        for name, heard in turns.items():
            pattern = EVERY_CAR.of("dialogue/*/turn")
            world.members[name].subscribe(pattern, lambda _, said, to=heard: to.append(said))  # type: ignore[misc]
        world.settle()
        other = world.members["passenger"]
        with join(Link.to_hub(config=world.folder / "passenger.json5")) as own:
            Client(own, CAR, "ada", token="a" * 43, share=True).ask("why did we stop?")
            for token in ("b" * 43, None):
                stranger = Client(other, CAR, "ada", token=token)
                for wanted in (stranger.history, stranger.forget):
                    with pytest.raises(ServiceLost, match="belongs to somebody else"):
                        wanted()
            assert len(Client(own, CAR, "ada", token="a" * 43).history()) == 1
        assert until(lambda: len(turns["dashboard"]) == 1)
        world.settle()
        over.set()
        thread.join()
    assert turns["passenger"] == []


def test_a_dashboard_may_record_and_an_observer_what_is_not_said(tmp_path: Path) -> None:
    for role, refused in (
        ("dashboard", []),
        ("observer", [("subscribe", CAR.of("dialogue/*/turn"))]),
    ):
        file = McapWriter(tmp_path / f"{role}.mcap", "0")
        with on_a_bus_with_keys(tmp_path / role, role) as bus, file:
            Recorder(bus, CAR, file, lambda _: None).open()  # type: ignore[arg-type]
            assert beyond(role, bus.done) == refused


def test_a_hub_that_returns_is_told_what_it_missed(tmp_path: Path) -> None:
    with world_of(tmp_path / "keys") as world:
        heard: list[bytes] = []
        observer, car = world.members["observer"], world.members["car"]
        observer.subscribe(EVERY_CAR.of("trace"), lambda _, said: heard.append(said), kept=True)
        publisher = car.publisher(CAR.of("trace"), keep=9)
        publisher.put(b"0")
        assert until(lambda: heard == [b"0"])
        world.hub.close()
        publisher.put(b"1")
        with host(Link.of_hub(config=world.folder / "service.json5")) as hub:
            hub.serve(CAR.of("alive/hub"), lambda asked: asked.reply(b"here"))
            assert until(lambda: reached(observer) and reached(car))
            publisher.put(b"2")
            assert until(lambda: len(heard) == 3)
        assert heard == [b"0", b"1", b"2"]


def reached(bus: Bus) -> bool:
    """Whether the hub answers."""
    try:
        return call(bus, CAR.of("alive/hub"), b"", PATIENCE) == b"here"
    except NoAnswer:
        time.sleep(0.05)
        return False
