"""`xavi doctor` on machines and buses that are well, and on some that are really broken."""

import json
import os
import re
import resource
import socket
import sqlite3
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from xavi_dialogue import __version__
from xavi_dialogue.__main__ import app
from xavi_dialogue.bus.certificates import Authority
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import AliveReport, pack
from xavi_dialogue.bus.shards import Claim, Shard
from xavi_dialogue.bus.zenoh_bus import ZenohBus, host
from xavi_dialogue.cli import bus_checks, host_checks
from xavi_dialogue.cli.bus_checks import examine, keys, on_the_bus, port, roster, shards, told
from xavi_dialogue.cli.host_checks import CheckedSystem, Finding
from xavi_dialogue.process import kernel_cache
from xavi_dialogue.storage.conversations import Store

HUB = Link.to_hub("tcp/a:1")
NOW = datetime(2026, 6, 1, tzinfo=UTC)
MACHINE = [
    *("python", "packages", "sumo", "netconvert", "kernels", "folders", "store", "space", "files"),
    *("terminal", "settings"),
]


@pytest.fixture
def patient(tmp_path: Path) -> CheckedSystem:
    return CheckedSystem(tmp_path / "dialogue.sqlite3", tmp_path / "config.toml")


def free() -> str:
    """An endpoint at which nobody listens."""
    with socket.socket() as trial:
        trial.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{trial.getsockname()[1]}"


def examined(*arguments: str) -> tuple[Result, dict[str, Finding]]:
    done = CliRunner().invoke(app, [*arguments, "--json"])
    found = [Finding(**one) for one in json.loads(done.stdout)]
    return done, {one.check: one for one in found}


def test_a_machine_that_is_well(tmp_path: Path) -> None:
    store = str(tmp_path / "kept" / "dialogue.sqlite3")
    done, found = examined("doctor", "--store", store)
    assert list(found) == [*MACHINE, "port"]
    faults = {name for name, one in found.items() if one.verdict == "fault"}
    assert faults <= {"port"}  # whoever runs the tests may have something there
    assert done.exit_code == (1 if faults else 0)
    assert "SUMO" in found["sumo"].found
    assert __version__ in found["packages"].found
    assert not (tmp_path / "kept").exists(), "looking must not make anything"


def test_people_read_it_in_80_columns(patient: CheckedSystem) -> None:
    long = Finding("car-with-a-very-long-name/service", "fault", "word " * 40, "then " * 40)
    lines = list(told([*host_checks.on_this_machine(patient), long]))
    assert max(len(line) for text in lines for line in text.splitlines()) <= 80
    assert all(line.isascii() for line in lines)
    assert lines[-1].endswith("1 at fault")


def test_a_store_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    done, found = examined("doctor", "--store", str(tmp_path / "file" / "dialogue.sqlite3"))
    assert done.exit_code == 1
    assert found["store"].verdict == "fault"
    assert "--store" in found["store"].advice


def test_a_store_that_cannot_be_written(patient: CheckedSystem) -> None:
    Store(patient.store).close()
    holder = sqlite3.connect(patient.store, isolation_level=None)
    holder.execute("PRAGMA journal_mode = DELETE")
    holder.execute("BEGIN EXCLUSIVE")
    found = host_checks.store(patient)
    holder.close()
    assert found.verdict == "fault"
    assert "locked" in found.found


@pytest.mark.parametrize("content", [b"no database at all", b"SQLite format 3\0" + bytes(4096)])
def test_a_damaged_store_is_told_and_left_as_it_is(patient: CheckedSystem, content: bytes) -> None:
    patient.store.write_bytes(content)
    found = host_checks.store(patient)
    assert found.verdict == "fault"
    assert "move the file away" in found.advice
    assert patient.store.read_bytes() == content


def test_a_store_of_a_later_version(patient: CheckedSystem) -> None:
    Store(patient.store).close()
    with sqlite3.connect(patient.store) as later:
        later.execute("PRAGMA user_version = 99")
    later.close()
    assert (host_checks.store(patient).verdict, "99" in str(host_checks.store(patient))) == (
        "fault",
        True,
    )


def test_a_store_with_conversations(patient: CheckedSystem) -> None:
    Store(patient.store).close()
    found = host_checks.store(patient)
    assert (found.verdict, "conversations: 0" in found.found) == ("ok", True)


def test_settings_with_an_unknown_option_are_a_finding_here_and_stop_all_others(
    tmp_path: Path,
) -> None:
    file = tmp_path / "config.toml"
    file.write_text('[serve]\nlissen = "tcp/0.0.0.0:7447"\n')
    done, found = examined("--config", str(file), "doctor")
    assert done.exit_code == 1
    assert "lissen" in found["settings"].found
    assert str(file) in found["settings"].advice
    assert CliRunner().invoke(app, ["--config", str(file), "scenarios"]).exit_code == 2
    file.write_text('[serve]\nlisten = "tcp/0.0.0.0:7447"\n')
    assert examined("--config", str(file), "doctor")[1]["settings"].found == str(file)


def test_packages_that_are_missing_or_old(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, patient: CheckedSystem
) -> None:
    info = tmp_path / "xavi_dialogue-0.0.9.dist-info"
    info.mkdir()
    required = ("nowhere-to-be-found>=1.0", "numpy>=9999.1", "msgspec>=0.1", 'x; extra == "maps"')
    lines = ["Metadata-Version: 2.1", "Name: xavi-dialogue", "Version: 0.0.9"]
    lines += [f"Requires-Dist: {one}" for one in required]
    (info / "METADATA").write_text("\n".join(lines) + "\n")
    monkeypatch.syspath_prepend(tmp_path)
    found = host_checks.packages(patient)
    assert found.verdict == "fault"
    missing, old = found.found.split("; ")
    assert missing == "nowhere-to-be-found is not installed"
    assert old.endswith("is older than 9999.1")


@pytest.mark.parametrize(
    ("older", "newer"), [("1.9", "1.10"), ("2.4.9", "3"), ("0.66.0", "0.68"), ("1.28rc1", "2")]
)
def test_versions_are_compared_by_their_numbers(older: str, newer: str) -> None:
    assert host_checks._numbers(older) < host_checks._numbers(newer)
    assert host_checks._numbers("2.0.0") == host_checks._numbers("2")


def test_a_machine_that_is_ill(tmp_path: Path) -> None:
    """A library of the system is gone, few files may be open, and the terminal speaks ASCII."""
    (tmp_path / "libsumo.py").write_text(
        'raise ImportError("libXrender.so.1: cannot open shared object file")'
    )
    file = tmp_path / "file"
    file.touch()
    done = subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", "doctor"],
        capture_output=True,
        text=True,
        check=False,
        env={
            **os.environ,
            "PYTHONPATH": str(tmp_path),
            "PYTHONIOENCODING": "ascii",
            "XDG_DATA_HOME": str(file / "dätä"),
            "XDG_CACHE_HOME": str(file),
            kernel_cache.PLACE: str(tmp_path / "xavi-kernels-lent"),
        },
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (100, 100)),
    )
    assert done.returncode == 1, done.stderr
    words = " ".join(done.stdout.split())
    for part in (
        "FAULT sumo SUMO lacks a system library (libXrender.so.1:",
        "-> run: apt-get install -y libgl1",
        "FAULT folders",
        "FAULT store",
        "warning kernels nowhere to keep them",
        "FAULT files 100 may be open at once",
        "warning terminal encoding ascii",
    ):
        assert part in words, done.stdout
    assert "Traceback" not in done.stderr


def test_a_check_that_breaks_off_does_not_keep_the_others_from_being_done(
    monkeypatch: pytest.MonkeyPatch, patient: CheckedSystem
) -> None:
    def broken(_: CheckedSystem) -> Finding:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(host_checks, "CHECKS", (broken, host_checks.python))
    first, second = host_checks.on_this_machine(patient)
    assert (first.verdict, "by zero" in first.found) == ("fault", True)
    assert second.check == "python"


def test_a_port_taken_by_a_foreign_program() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:

        def hang_up() -> None:
            while True:
                try:
                    server.accept()[0].close()
                except OSError:
                    return

        threading.Thread(target=hang_up, daemon=True).start()
        endpoint = f"tcp/127.0.0.1:{server.getsockname()[1]}"
        found, (joined,) = port(endpoint), on_the_bus(Link.to_hub(endpoint))
        server.shutdown(socket.SHUT_RDWR)
    assert found.verdict == "fault"
    assert "--listen" in found.advice
    assert joined.advice == "another program listens there; end it, or name the endpoint of a hub"


@pytest.fixture
def hub() -> Iterator[ZenohBus]:
    with host(Link.of_hub(free())) as bus:
        yield bus


def test_a_port_at_which_our_service_is(hub: ZenohBus) -> None:
    assert "without a service" in port(hub.places[0]).found
    hub.appear(Keys("shuttle").of("alive/service"))
    assert port(hub.places[0]) == Finding("port", "ok", f"a service of ours is at {hub.places[0]}")
    assert port(free()).found.endswith("is free")


def test_a_bus_that_is_well(hub: ZenohBus, patient: CheckedSystem) -> None:
    for name in ("car", "service"):
        HealthReporter(name, ("rejected",)).serve(hub, Keys("shuttle"))
    found = list(examine(patient, Link.to_hub(hub.places[0]), NOW))
    assert [one.check for one in found] == [
        *(*MACHINE, "hub", "roster", "shuttle/car", "shuttle/service")
    ]
    assert found[-3] == Finding("roster", "ok", "shuttle: car, service")
    assert {one.verdict for one in found[-4:]} == {"ok"}
    done = CliRunner().invoke(app, ["doctor", "--connect", hub.places[0]])
    assert done.exit_code == 0, done.stdout
    assert f"ok      shuttle/service      version {__version__}," in done.stdout


def test_a_bus_on_which_something_is_amiss(hub: ZenohBus, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bus_checks, "PATIENCE", 0.5)
    late = AliveReport(
        component="car",
        version="0.0.1",
        seq=0,
        sim_time=0.0,
        wall_time=time.time() - 100.0,
        uptime_s=5.0,
        counters={"rejected": 3.0, "answered": 9.0},
    )
    hub.serve(Keys("a").of("alive/car"), lambda call: call.reply(pack(late)))
    hub.serve(Keys("b").of("alive/car"), lambda call: call.reply(b"{}"))
    for name in ("a", "b", "c"):
        hub.appear(Keys(name).of("alive/car"))
    reachable, there, old, garbled, silent = on_the_bus(Link.to_hub(hub.places[0]))
    assert reachable.verdict == "ok"
    assert there.advice.startswith("nobody answers about a, b, c; start: xavi serve --mode client")
    assert "clock -100" in old.found
    assert old.found.endswith("rejected 3")
    assert all(word in old.advice for word in (__version__, "NTP", "log"))
    assert "not understood" in garbled.found
    assert "does not tell" in silent.found
    assert {one.verdict for one in (there, old, garbled, silent)} == {"warning"}


@pytest.mark.parametrize(
    ("link", "advice"),
    [
        (HUB, "start one with: xavi drive --connect tcp/a:1"),
        (Link.to_hub(None, Path("key.json5")), "xavi drive --zenoh FILE; or this certificate may"),
    ],
)
def test_nobody_is_on_the_bus(link: Link, advice: str) -> None:
    found = roster([], link)
    assert found.verdict == "warning"
    assert advice in found.advice


def test_without_a_hub_that_is_the_last_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bus_checks, "HUB_PATIENCE", 0.1)
    endpoint = free()
    done, found = examined("doctor", "--connect", endpoint)
    assert done.exit_code == 1
    assert list(found)[-1] == "hub"
    assert found["hub"] == Finding(
        "hub",
        "fault",
        f"there is no hub at {endpoint}",
        f"start one with: xavi serve --listen {endpoint}",
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Keys that are valid for a year."""
    authority = Authority.new(NOW, timedelta(days=365))
    for name, identity in {
        "ca": authority.identity,
        "car": authority.issue("car", (), NOW, timedelta(days=100)),
    }.items():
        (tmp_path / f"{name}.pem").write_bytes(identity.certificate)
        (tmp_path / f"{name}.key").write_bytes(identity.key)
        (tmp_path / f"{name}.key").chmod(0o600)
    return tmp_path


@pytest.mark.parametrize(
    ("days", "verdict", "words"),
    [
        (0, "ok", "2 certificates; car.pem is valid until 2026-09-09"),
        (80, "warning", "car.pem is valid until 2026-09-09"),
        (101, "fault", "car.pem is valid until 2026-09-09"),
        (-1, "fault", "some are not valid yet"),
    ],
)
def test_certificates_end(folder: Path, days: int, verdict: str, words: str) -> None:
    found = keys(folder, NOW + timedelta(days=days))
    assert (found.verdict, words in found.found) == (verdict, True)


def test_secret_keys_that_others_can_read(folder: Path) -> None:
    (folder / "car.key").chmod(0o644)
    found = keys(folder, NOW)
    assert (found.verdict, found.found) == (
        "fault",
        "others on this machine can read car.key",
    )


def test_a_certificate_that_is_none(folder: Path) -> None:
    (folder / "car.pem").write_text("no certificate")
    assert keys(folder, NOW).verdict == "fault"


CARS = ("a", "b", "c", "d", "e", "f", "g", "h")


def test_shards_that_share_a_fleet_are_well() -> None:
    found = shards([Claim(1, "x", Shard(1, 2)), Claim(2, "y", Shard(2, 2))], CARS, HUB)
    assert found.verdict == "ok"
    sizes = re.fullmatch(r"1/2: (\d) cars; 2/2: (\d) cars", found.found)
    assert sizes is not None
    assert int(sizes[1]) + int(sizes[2]) == len(CARS)


def test_a_shard_without_a_service_is_found() -> None:
    found = shards([Claim(1, "x", Shard(1, 2))], CARS, HUB)
    assert found.verdict == "fault"
    assert "nobody for 2/2: " in found.found
    assert found.advice == "start: xavi serve --shard 2/2 --mode client --connect tcp/a:1"
    assert shards([Claim(1, "x", Shard(1, 2))], (), HUB).verdict == "fault"


def test_a_shard_with_two_services_is_found() -> None:
    claims = [Claim(1, "x", Shard(1, 1)), Claim(2, "y", Shard(1, 1))]
    found = shards(claims, CARS, HUB)
    assert (found.verdict, found.found) == (
        "warning",
        "1/1: 8 cars; 1/1: 0 cars; 1/1 more than once",
    )


def test_services_that_count_shards_differently_are_found() -> None:
    claims = [Claim(1, "x", Shard(1, 2)), Claim(2, "y", Shard(1, 1))]
    found = shards(claims, CARS, HUB)
    assert found.verdict == "warning"
    assert found.found.endswith("these overlap")
