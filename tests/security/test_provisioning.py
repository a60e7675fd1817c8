"""What each role can do on a bus with keys, and nothing else: tried with real sessions over TLS.

What is denied is silent, so that each test also has somebody do what is tried, who may.
"""

import json
import re
import shlex
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from datetime import timedelta
from pathlib import Path

import pytest
import zenoh

from xavi_dialogue.bus.access_control import BadName
from xavi_dialogue.bus.certificates import Authority, Identity, utc_now
from xavi_dialogue.bus.interface import (
    EVERY_CAR,
    Bus,
    Call,
    EndpointTaken,
    HubUnreachable,
    Keys,
    NobodyThere,
    Outcome,
    TooLate,
    call,
)
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host, join
from xavi_dialogue.security.provisioning import (
    BadEndpoint,
    KeyOptions,
    KeysExist,
    KeysNotKept,
    NotOnlyKeys,
    keep,
    material,
    wanted,
)

KEY, EACH = Keys("car").of, EVERY_CAR.of
PATIENCE = 10.0  # [s]
HUB = "hub"  # the process that hosts it: nobody keeps it from anything
# Who tries everything; `service` is one that is itself a client of the hub.
ROLES = ("car", "car.b", "service", "passenger", "dashboard", "observer")
READERS = {"service", "dashboard", "observer"}
ASKERS = {"passenger", "dashboard"}
PUBLISH = {
    "scene": {"car"},
    "trace": {"car"},
    "event": {"car"},
    "dialogue/s/turn": {"service"},
}
READ = {
    "scene": READERS | {"passenger"},
    "event": READERS | {"passenger"},
    "trace": READERS,
    "dialogue/s/turn": {"dashboard"},
}
ASK = {
    "@rpc/ask": ASKERS,
    "@rpc/history": ASKERS,
    "@rpc/forget": ASKERS,
    "@rpc/cancel": ASKERS,
    "@rpc/evidence": ASKERS,
    "@rpc/whatif": {"service"},
    "@rpc/drive": set(),
    "@schema/ask": set(ROLES),
    "alive/car": set(ROLES),
}
SERVE = {
    "@rpc/ask": {"service"},
    "@rpc/history": {"service"},
    "@rpc/forget": {"service"},
    "@rpc/cancel": {"service"},
    "@rpc/evidence": {"service"},
    "@rpc/whatif": {"car"},
    "@schema/scene": {"car"},
    "@schema/ask": {"service"},
    "alive/car": {"car"},
    "alive/service": {"service"},
    "alive/dashboard": {"dashboard"},
    "trace/@adv/pub/x/1/_": {"car"},
}
APPEAR = {
    "alive/car": {"car"},
    "alive/service": {"service"},
    "alive/dashboard": {"dashboard"},
    "alive/recorder": {"dashboard", "observer"},
}


def endpoint(kind: str = "tls") -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"{kind}/127.0.0.1:{probe.getsockname()[1]}"


def until(condition: Callable[[], bool]) -> bool:
    """Wait until something holds; whether it does."""
    give_up = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < give_up:
        time.sleep(0.01)
    return condition()


@dataclass(frozen=True)
class World:
    """A bus with keys, and one session of every role."""

    folder: Path
    order: KeyOptions
    hub: Bus
    members: dict[str, Bus]

    def settle(self) -> None:
        """Wait until the hub has seen what everybody sent, and they what it sent before."""
        for name, bus in self.members.items():
            assert call(bus, KEY("alive/hub"), b"", PATIENCE) == b"here", name

    def others(self, allowed: set[str]) -> list[str]:
        """Who may not, and then who may: what is denied is tried first."""
        return [name for name in ROLES if name not in allowed] + sorted(allowed)


def link(folder: Path, name: str) -> Link:
    if name != "service":
        return Link.to_hub(config=folder / f"{name}.json5")
    identity = Identity(*((folder / f"service.{kind}").read_bytes() for kind in ("pem", "key")))
    return linked(folder, "client", identity)


def linked(folder: Path, stem: str, identity: Identity | None) -> Link:
    """The link of a client with another certificate than those of the folder, or without."""
    config = json.loads((folder / "passenger.json5").read_text().partition("\n")[2])
    tls = config["transport"]["link"]["tls"]
    if identity is None:
        del tls["connect_certificate"], tls["connect_private_key"], tls["enable_mtls"]
    else:
        for ending, data in (("certificate", identity.certificate), ("private_key", identity.key)):
            file = folder / f"{stem}.{ending}"
            file.write_bytes(data)
            tls[f"connect_{ending}"] = str(file)
    path = folder / f"{stem}.json5"
    path.write_text(json.dumps(config))
    return Link.to_hub(config=path)


@contextmanager
def world_of(folder: Path) -> Iterator[World]:
    order = wanted(listen=endpoint(), vehicles=["b"])
    keep(material(order, folder, utc_now()), folder)
    with ExitStack() as stack:
        hub = stack.enter_context(host(Link.of_hub(config=folder / "service.json5")))
        hub.serve(KEY("alive/hub"), lambda asked: asked.reply(b"here"))
        members = {name: stack.enter_context(join(link(folder, name))) for name in ROLES}
        yield World(folder, order, hub, members)


@pytest.fixture
def world(tmp_path: Path) -> Iterator[World]:
    with world_of(tmp_path / "keys") as found:
        yield found


@pytest.mark.parametrize(("tail", "allowed"), PUBLISH.items(), ids=PUBLISH)
@pytest.mark.parametrize("kept", [False, True], ids=["dropped", "kept"])
def test_who_may_publish(world: World, tail: str, allowed: set[str], kept: bool) -> None:
    heard: list[bytes] = []
    ears = [world.hub, world.members["dashboard"]]
    for listener in ears:
        listener.subscribe(EACH(tail.replace("/s/", "/*/")), lambda _, said: heard.append(said))
    world.settle()
    for name in world.others(allowed):
        if name != "dashboard" or "dashboard" in allowed:  # it would hear itself
            world.members[name].publisher(KEY(tail), keep=3 if kept else 0).put(name.encode())
            world.settle()
    assert until(lambda: len(heard) >= len(ears) * len(allowed))
    assert sorted(heard) == sorted(name.encode() for name in allowed for _ in ears)


def test_a_dashboard_publishes_nothing(world: World) -> None:
    heard: list[bytes] = []
    for tail in PUBLISH:
        world.hub.subscribe(EACH(tail.replace("/s/", "/*/")), lambda _, said: heard.append(said))
    world.settle()
    for name in ("dashboard", "car"):
        for tail in PUBLISH:
            world.members[name].publisher(KEY(tail)).put(name.encode())
        world.settle()
    assert until(lambda: len(heard) >= 3)
    assert heard == [b"car"] * 3


@pytest.mark.parametrize("kept", [False, True], ids=["dropped", "kept"])
@pytest.mark.parametrize(("tail", "allowed"), READ.items(), ids=READ)
def test_who_may_read(world: World, tail: str, allowed: set[str], kept: bool) -> None:
    heard: dict[str, set[bytes]] = {name: set() for name in ROLES}
    if kept and tail in ("scene", "dialogue/s/turn"):
        kept = False  # nothing of it is kept
    source = world.hub if tail.startswith("dialogue") else world.members["car"]
    publisher = source.publisher(KEY(tail), keep=3 if kept else 0)
    publisher.put(b"early")
    for name, bus in world.members.items():
        if name == "car" and source is not world.hub:
            continue  # it would hear itself
        for pattern in {KEY(tail), EACH(tail.replace("/s/", "/*/")), "xavi/v1/**", "**"}:
            bus.subscribe(pattern, lambda _, said, n=name: heard[n].add(said), kept=kept)
    wants = {b"early", b"late"} if kept else {b"late"}
    if kept:
        assert until(lambda: all(b"early" in heard[name] for name in allowed))
    world.settle()
    publisher.put(b"late")
    assert until(lambda: all(heard[name] >= wants for name in allowed))
    world.settle()
    assert {name for name in ROLES if heard[name]} == allowed


@pytest.mark.parametrize(("tail", "allowed"), ASK.items(), ids=ASK)
def test_who_may_ask(world: World, tail: str, allowed: set[str]) -> None:
    asked: list[str] = []

    def answer(came: Call) -> None:
        asked.append(came.payload.decode())
        came.reply(b"yes")

    server = world.members["car"] if tail in ("@rpc/whatif", "alive/car") else world.hub
    server.serve(KEY(tail), answer)
    world.settle()
    for name in [*world.others(allowed), HUB]:
        bus = world.hub if name == HUB else world.members[name]
        if name in {*allowed, HUB}:
            assert call(bus, KEY(tail), name.encode(), PATIENCE) == b"yes", name
        elif bus is not server:
            for pattern in (KEY(tail), EACH(tail), "xavi/v1/car/**", f"xavi/v1/**/{tail}"):
                with pytest.raises(NobodyThere):
                    call(bus, pattern, name.encode(), PATIENCE)
    assert sorted(set(asked)) == sorted({*allowed, HUB})


@pytest.mark.parametrize(("tail", "allowed"), SERVE.items(), ids=SERVE)
def test_who_may_serve(world: World, tail: str, allowed: set[str]) -> None:
    reached: list[str] = []

    def server(name: str) -> Callable[[Call], None]:
        def answer(came: Call) -> None:
            reached.append(name)
            came.reply(name.encode())

        return answer

    asker = HUB
    for name in world.others(allowed):
        for pattern in (KEY(tail), EACH(tail)):
            world.members[name].serve(pattern, server(name))
        world.settle()
    wanted_by = world.hub if asker == HUB else world.members[asker]
    outcomes: list[Outcome] = []
    done = threading.Event()

    def end(outcome: Outcome) -> None:
        outcomes.append(outcome)
        done.set()

    wanted_by.request(KEY(tail), b"", PATIENCE, end)
    assert done.wait(PATIENCE)
    world.settle()
    assert set(reached) == allowed
    assert {outcome for outcome in outcomes if isinstance(outcome, bytes)} <= {
        name.encode() for name in allowed
    }


@pytest.mark.parametrize(("tail", "allowed"), APPEAR.items(), ids=APPEAR)
def test_who_may_show_signs_of_life(world: World, tail: str, allowed: set[str]) -> None:
    seen: list[bool] = []
    world.hub.watch(EACH("alive/*"), lambda _, alive: seen.append(alive))
    for count, name in enumerate(sorted(allowed)):
        for other in ROLES:
            if other not in allowed:
                world.members[other].appear(KEY(tail))
        world.settle()
        presence = world.members[name].appear(KEY(tail))
        assert until(lambda: len(seen) == 2 * count + 1), name  # noqa: B023 - used at once
        presence.withdraw()
        assert until(lambda: len(seen) == 2 * count + 2), name  # noqa: B023 - used at once
    assert seen == [True, False] * len(allowed)


def test_everybody_sees_who_is_alive(world: World) -> None:
    seen: dict[str, list[str]] = {name: [] for name in ROLES}
    for name, bus in world.members.items():
        bus.watch(EACH("alive/*"), lambda key, _, n=name: seen[n].append(key))
    world.members["car.b"].appear("xavi/v1/b/alive/car")
    assert until(lambda: all(keys == ["xavi/v1/b/alive/car"] for keys in seen.values()))


def test_a_car_is_no_other_car(world: World) -> None:
    heard: list[tuple[str, bytes]] = []
    world.hub.subscribe(EACH("scene"), lambda key, said: heard.append((key, said)))
    world.settle()
    other = world.members["car.b"]
    for key in (KEY("scene"), EACH("scene"), "xavi/v1/**", "xavi/v1/b$*/scene", "xavi/v1/c/scene"):
        other.publisher(key).put(b"forged")
    other.publisher("xavi/v1/b/scene").put(b"own")
    world.settle()
    assert until(lambda: len(heard) > 0)
    assert heard == [("xavi/v1/b/scene", b"own")]


def test_a_car_cannot_answer_for_another(world: World) -> None:
    world.members["car"].serve(KEY("@rpc/whatif"), lambda asked: asked.reply(b"car"))
    for pattern in (KEY("@rpc/whatif"), EACH("@rpc/whatif"), "xavi/v1/**/@rpc/whatif"):
        world.members["car.b"].serve(pattern, lambda asked: asked.reply(b"forged"))
    world.settle()
    asker = world.members["service"]
    assert [call(asker, KEY("@rpc/whatif"), b"", PATIENCE) for _ in range(5)] == [b"car"] * 5


def test_the_service_hears_every_car_with_one_pattern(world: World) -> None:
    heard: set[tuple[str, bytes]] = set()
    for bus in (world.hub, world.members["service"]):
        bus.subscribe(EACH("trace"), lambda key, said: heard.add((key, said)), kept=True)
        bus.subscribe(EACH("scene"), lambda key, said: heard.add((key, said)))
    world.settle()
    expected = set()
    for name, vehicle in (("car", "car"), ("car.b", "b")):
        for tail, kept in (("trace", 5), ("scene", 0)):
            key = Keys(vehicle).of(tail)
            publisher = world.members[name].publisher(key, keep=kept)
            expected |= {(key, b"%d" % k) for k in range(3)}
            for k in range(3):
                publisher.put(b"%d" % k)
    assert until(lambda: heard >= expected)
    assert heard == expected


def test_what_is_lost_is_noticed_by_those_who_may_read_it(world: World) -> None:
    """A publisher of what is kept says now and then how far it is."""
    readers = ("service", "observer", "passenger")
    heard: dict[str, list[str]] = {name: [] for name in readers}
    for name in readers:
        world.members[name].subscribe(
            EACH("trace/@adv/pub/**"), lambda key, _, n=name: heard[n].append(key)
        )
    world.settle()
    world.members["car"].publisher(KEY("trace"), keep=3).put(b"0")
    assert until(lambda: bool(heard["service"] and heard["observer"]))
    world.settle()
    assert heard["passenger"] == []


def test_a_service_that_is_a_client_is_asked(world: World) -> None:
    world.members["service"].serve(EACH("@rpc/ask"), lambda asked: asked.reply(asked.payload))
    world.settle()
    assert call(world.members["passenger"], KEY("@rpc/ask"), b"why?", PATIENCE) == b"why?"
    with pytest.raises(NobodyThere):
        call(world.members["observer"], KEY("@rpc/ask"), b"why?", PATIENCE)


def ours(world: World) -> Authority:
    return Authority.load(
        Identity((world.folder / "ca.pem").read_bytes(), (world.folder / "ca.key").read_bytes())
    )


def refused(world: World, tried: Link) -> bool:
    """Whether a link is shut out, while the same with a good certificate is not."""
    good = linked(world.folder, "good", ours(world).issue("passenger", (), utc_now()))
    join(good).close()
    try:
        with join(tried, patience=0.0) as bus:
            call(bus, KEY("alive/hub"), b"", 2.0)
    except (HubUnreachable, NobodyThere):
        return True
    return False


def test_without_a_certificate_nobody_comes_in(world: World) -> None:
    assert refused(world, linked(world.folder, "none", None))
    assert refused(world, Link.to_hub(world.order.connect.replace("tls/", "tcp/")))


def test_a_certificate_of_another_authority_is_refused(world: World) -> None:
    other = Authority.new(utc_now(), timedelta(days=1))
    tried = linked(world.folder, "other", other.issue("service", (), utc_now()))
    assert refused(world, tried)


def test_an_expired_certificate_is_refused(world: World) -> None:
    identity = ours(world).issue("passenger", (), utc_now() - timedelta(days=2), timedelta(days=1))
    assert refused(world, linked(world.folder, "expired", identity))


def test_who_is_connected_is_shut_out_when_the_certificate_expires(world: World) -> None:
    identity = ours(world).issue("passenger", (), utc_now(), timedelta(seconds=3))

    def shut_out(bus: Bus) -> bool:
        try:
            return call(bus, KEY("alive/hub"), b"", PATIENCE) != b"here"
        except (NobodyThere, TooLate):  # too late: asked while the link was being cut
            return True

    with join(linked(world.folder, "short", identity)) as bus:
        assert not shut_out(bus)
        assert until(lambda: shut_out(bus))
    assert not shut_out(world.members["passenger"])


def test_who_is_of_no_role_may_nothing(world: World) -> None:
    for name in ("admin", "car.c", "car.*", "passenger.", "Service", "hub"):
        identity = ours(world).issue(name, (), utc_now())
        assert refused(world, linked(world.folder, "stranger", identity)), name


def test_a_clients_certificate_is_none_of_a_hub(world: World, tmp_path: Path) -> None:
    """Else a passenger could stand between the car and the service."""
    config = json.loads((world.folder / "service.json5").read_text().partition("\n")[2])
    tls, place = config["transport"]["link"]["tls"], endpoint()
    config["listen"]["endpoints"] = [place]
    honest, forged = tmp_path / "honest.json5", tmp_path / "forged.json5"
    honest.write_text(json.dumps(config))
    tls["listen_certificate"] = str(world.folder / "passenger.pem")
    tls["listen_private_key"] = str(world.folder / "passenger.key")
    forged.write_text(json.dumps(config))
    with host(Link.of_hub(config=honest)):
        join(link(world.folder, "car").at(place)).close()
    with host(Link.of_hub(config=forged)), pytest.raises(HubUnreachable):
        join(link(world.folder, "car").at(place), patience=0.5)


def test_plain_zenoh_reads_the_configurations(world: World) -> None:
    world.hub.serve(KEY("@rpc/ask"), lambda asked: asked.reply(b"because"))
    world.members["car"].appear(KEY("alive/car"))
    world.settle()
    config = zenoh.Config.from_file(str(world.folder / "passenger.json5"))
    with zenoh.open(config) as session:
        replies = list(session.get(KEY("@rpc/ask"), payload=b"why?", timeout=PATIENCE))
        roster = list(session.liveliness().get(EACH("alive/*"), timeout=PATIENCE))
    assert [reply.ok.payload.to_bytes() for reply in replies if reply.ok] == [b"because"]
    assert [str(one.ok.key_expr) for one in roster if one.ok] == [KEY("alive/car")]


def test_the_folder_is_private_and_holds_what_is_named(tmp_path: Path) -> None:
    folder = tmp_path / "deep" / "keys"
    order = wanted(passengers=["anna", "anna"], vehicles=["shuttle-3"])
    keep(material(order, folder, utc_now()), folder)
    names = [one.common_name for one in order.members]
    assert names == [
        *("car", "service", "passenger", "dashboard", "observer"),
        *("passenger.anna", "car.shuttle-3"),
    ]
    endings = {f"{name}.{ending}" for name in names for ending in ("pem", "key", "json5")}
    assert {path.name for path in folder.iterdir()} == endings | {"ca.pem", "ca.key"}
    assert folder.stat().st_mode & 0o777 == 0o700
    assert {path.stat().st_mode & 0o777 for path in folder.glob("*.key")} == {0o600}
    assert [path.name for path in folder.parent.iterdir()] == ["keys"]


def test_keys_are_not_overwritten(tmp_path: Path) -> None:
    folder = tmp_path / "keys"
    folder.mkdir()  # an empty one is as good as none
    for force in (False, True):
        keep(material(wanted(), folder, utc_now()), folder, force=force)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    with pytest.raises(KeysExist, match="--force"):
        keep(material(wanted(), folder, utc_now()), folder)
    (folder / "thesis.txt").write_text("years of work")
    with pytest.raises(NotOnlyKeys, match=re.escape("thesis.txt")):
        keep(material(wanted(), folder, utc_now()), folder, force=True)
    (folder / "thesis.txt").unlink()
    with pytest.raises(KeysNotKept):  # half way through
        keep({**material(wanted(), folder, utc_now()), "x/y.pem": b""}, folder, force=True)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert [path.name for path in tmp_path.iterdir()] == ["keys"]


def test_new_keys_replace_all_the_old_ones(tmp_path: Path) -> None:
    folder = tmp_path / "keys"
    keep(material(wanted(vehicles=["old"]), folder, utc_now()), folder)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    keep(material(wanted(), folder, utc_now()), folder, force=True)
    after = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert "car.old.pem" not in after
    assert all(after[name] != before[name] for name in after if not name.endswith(".json5"))


@pytest.mark.parametrize("name", ["*", "**", "a/b", "@rpc", "$*", "", "a b", "a\n", "x" * 61, "é"])
def test_a_name_cannot_widen_what_is_granted(name: str) -> None:
    with pytest.raises(BadName):
        wanted(vehicles=[name])
    with pytest.raises(BadName):
        wanted(passengers=[name])


@pytest.mark.parametrize(
    "place", ["tcp/127.0.0.1:7447", "tls/127.0.0.1", "tls/h:0", "tls/h:70000", "h:1", "tls/a b:1"]
)
def test_endpoints_without_certificates_are_refused(place: str) -> None:
    with pytest.raises(BadEndpoint, match=re.escape(repr(place))):
        wanted(listen=place)
    with pytest.raises(BadEndpoint, match=re.escape(repr(place))):
        wanted(connect=place)


def test_a_hub_at_every_address_is_connected_to_by_one(tmp_path: Path) -> None:
    with pytest.raises(BadEndpoint, match="--host or --connect"):
        wanted(listen="tls/0.0.0.0:7000")
    order = wanted(["fe80::1", "hub.example"], "tls/[::]:7000")
    assert order.connect == "tls/[fe80::1]:7000"
    assert replace(order, hosts=()).hosts == ()
    assert order.hosts == ("localhost", "127.0.0.1", "::1", "fe80::1", "hub.example")
    assert wanted(connect="quic/other.example:1").hosts[-1] == "other.example"


def test_the_hub_with_keys_says_where_it_is_taken(world: World) -> None:
    with pytest.raises(EndpointTaken, match=re.escape(world.order.listen)):
        host(Link.of_hub(config=world.folder / "service.json5"))


def run(*words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "xavi_dialogue", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)


@pytest.mark.slow
def test_the_command_says_what_it_wrote_and_what_to_run_next(tmp_path: Path) -> None:
    folder = tmp_path / "my keys"
    first = run("keys", str(folder), "--vehicle", "shuttle-3", "--days", "7")
    assert (first.returncode, first.stderr) == (0, "")
    assert {path.name for path in folder.glob("*.json5")} == set(
        re.findall(r"(\S+\.json5) \(with", first.stdout)
    )
    commands = [shlex.split(line) for line in first.stdout.splitlines() if "  xavi " in line]
    assert [words[1] for words in commands] == ["serve", "drive", "chat"]
    for words in commands:
        assert Path(words[words.index("--zenoh") + 1]).is_file()
        assert set(re.findall(r"--[a-z]+", run(words[1], "--help").stdout)) >= {
            word for word in words if word.startswith("--")
        }
    again = run("keys", str(folder))
    assert (again.returncode, again.stdout) == (2, "")
    assert "--force" in again.stderr
    assert again.stderr.count("\n") == 1
    assert run("keys", str(folder), "--force", "--days", "0").returncode == 2
    assert run("keys", str(folder), "--force").returncode == 0
    assert not (folder / "car.shuttle-3.json5").exists()
