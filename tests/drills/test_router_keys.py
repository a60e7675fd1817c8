"""Keys hold on a fleet of three routers: each role does what it may, wherever it is joined."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from tests.drills.bus_clients import Passenger
from tests.drills.cars import StandIn
from tests.drills.processes import Crew, free_endpoint, until
from tests.drills.stage import WHERE
from xavi_dialogue.bus.certificates import utc_now
from xavi_dialogue.bus.interface import EVERY_CAR, Bus, HubUnreachable, Keys, NobodyThere, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import TraceReport, unpack
from xavi_dialogue.bus.shards import CLAIMED, Claim
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.security.provisioning import keep, material, wanted

NAMES = ("north", "south", "west")
CAR = Keys("shuttle")
FORGED = b"forged"
SETTLED = 1.0  # [s] in which what is not denied would arrive
Join = Callable[[str, int], Bus]  # by the name of a key, and the number of a router


@contextmanager
def routed(crew: Crew, folder: Path) -> Iterator[tuple[Join, list[str]]]:
    """Three routers with keys, and how to join them."""
    endpoints = [free_endpoint().replace("tcp/", "tls/") for _ in NAMES]
    routers = [f"{name}={place}" for name, place in zip(NAMES, endpoints, strict=True)]
    order = wanted(vehicles=["shuttle"], routers=routers)
    keep(material(order, folder, utc_now()), folder)
    for name in NAMES:
        crew.python("-m", "tests.drills.router", str(folder / f"router.{name}.json5")).hear(1)
    with ExitStack() as stack:

        def joined(key: str, number: int) -> Bus:
            link = Link("client", connect=(endpoints[number],), config=folder / f"{key}.json5")
            return stack.enter_context(join(link))

        yield joined, endpoints


def serve(crew: Crew, folder: Path, endpoint: str) -> None:
    process = crew.xavi(
        *("serve", "--zenoh", str(folder / "service.json5")),
        *("--mode", "client", "--connect", endpoint, "--keep-days", "0"),
    )
    assert process.says("serving through"), process.said


def test_everybody_does_what_they_may_over_routers(crew: Crew, tmp_path: Path) -> None:
    with routed(crew, tmp_path / "keys") as (joined, endpoints):
        serve(crew, tmp_path / "keys", endpoints[0])
        car = StandIn(joined("car.shuttle", 1), "shuttle")
        car.drive()
        ada = Passenger(joined("passenger", 2), "ada", "shuttle", token="a" * 43)
        assert until(lambda: ada.ask(WHERE).kind == "answer")
        assert ada.history()[0] == WHERE
        late: list[bytes] = []
        observer = joined("observer", 2)
        observer.subscribe(EVERY_CAR.of("trace"), lambda _, said: late.append(said), kept=True)
        assert until(lambda: late)
        assert unpack(late[0], TraceReport).trace.vehicle


def test_nobody_does_what_they_may_not_over_routers(crew: Crew, tmp_path: Path) -> None:
    with routed(crew, tmp_path / "keys") as (joined, endpoints):
        serve(crew, tmp_path / "keys", endpoints[0])
        StandIn(joined("car.shuttle", 1), "shuttle").drive()
        other, passenger = joined("car", 2), joined("passenger", 2)
        ada = Passenger(passenger, "ada", "shuttle")
        assert until(lambda: ada.ask(WHERE).kind == "answer")
        dashboard, heard = joined("dashboard", 1), list[bytes]()
        claims: dict[str, bool] = {}
        dashboard.watch(CLAIMED, claims.__setitem__)
        for tail in ("scene", "event", "trace", "dialogue/ada/turn"):
            dashboard.subscribe(
                EVERY_CAR.of(tail.replace("ada", "*")), lambda _, said: heard.append(said)
            )
        told: list[bytes] = []
        passenger.subscribe(EVERY_CAR.of("trace"), lambda _, said: told.append(said), kept=True)
        for intruder in (other, passenger):
            intruder.appear(Claim(0, "intruder").key)
            intruder.serve(CAR.of("@rpc/ask"), lambda asked: asked.reply(FORGED))
            intruder.serve(CAR.of("@rpc/whatif"), lambda asked: asked.reply(FORGED))
            for tail in ("scene", "event", "trace", "dialogue/ada/turn"):
                intruder.publisher(CAR.of(tail), keep=3).put(FORGED)
        time.sleep(SETTLED)
        assert FORGED not in heard
        assert told in ([], [FORGED])  # it hears itself, and nobody else
        assert [claim.rank for claim in map(Claim.read, claims) if claim] == [1]
        assert Passenger(dashboard, "bob", "shuttle").ask(WHERE).kind == "answer"
        for asker in (dashboard, joined("observer", 0)):
            with pytest.raises(NobodyThere):
                call(asker, CAR.of("@rpc/whatif"), b"", 5.0)
        with pytest.raises(NobodyThere):
            call(joined("observer", 0), CAR.of("@rpc/ask"), b"", 5.0)


def test_a_key_of_another_authority_joins_no_router(crew: Crew, tmp_path: Path) -> None:
    with routed(crew, tmp_path / "keys") as (joined, endpoints):
        joined("passenger", 0)
        foreign = tmp_path / "foreign"
        keep(material(wanted(), foreign, utc_now()), foreign)
        for key in ("service", "passenger"):
            link = Link("client", connect=(endpoints[0],), config=foreign / f"{key}.json5")
            with pytest.raises(HubUnreachable):
                join(link, 0.5)
