"""The checks of `xavi doctor` on the bus."""

import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from datetime import datetime, timedelta
from pathlib import Path
from textwrap import TextWrapper

from xavi_dialogue import __version__
from xavi_dialogue.bus.certificates import BadCertificate, CertificateInfo, read
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import EVERY_CAR, Bus, TransportError, call, vehicle_in
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import AliveReport, unpack
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.bus.shards import CLAIMED, Claim, holder, missing
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.cli.host_checks import CheckedSystem, Finding, on_this_machine, taken

SETTLED = 0.5  # [s] to find all components
HUB_PATIENCE = 2.0  # [s]
PATIENCE = 2.0  # [s] for a report
APART = 1.0  # [s] that clocks may differ
SOON = timedelta(days=30)
MAX_SEEN = 100  # components that are asked for their health
TROUBLE = ("rejected", "busy", "foreign", "dropped", "reports_dropped")  # counters best at 0
WIDTH = 80  # columns
NAMES = 28  # columns
NAMED = 10  # cars that are listed

SIGNS = {"ok": "ok", "warning": "warning", "fault": "FAULT"}


def examine(patient: CheckedSystem, link: Link | None, now: datetime) -> Iterator[Finding]:
    """Do all checks, in a fixed order.

    Args:
        patient: this machine.
        link: to a hub; None: check this machine only.
        now: with a zone.
    """
    yield from on_this_machine(patient)
    if link is None:
        yield port(patient.endpoint)
        return
    if link.config is not None:
        yield keys(link.config.absolute().parent, now)
    yield from on_the_bus(link)


def port(endpoint: str) -> Finding:
    """Check whether the endpoint of `xavi serve` is free, or already served."""
    if not taken(endpoint):
        return Finding("port", "ok", f"{endpoint} is free")
    try:
        with join(Link.to_hub(endpoint), HUB_PATIENCE) as bus:
            services = [key for key in alive(bus) if key.endswith("/alive/service")]
    except TransportError:
        found = f"another program listens at {endpoint}"
        return Finding("port", "fault", found, "end it, or: xavi serve --listen ENDPOINT")
    if services:
        return Finding("port", "ok", f"a service of ours is at {endpoint}")
    found = f"a hub without a service that is known to serve a car is at {endpoint}"
    return Finding("port", "ok", found, f"look closer: xavi doctor --connect {endpoint}")


def keys(folder: Path, now: datetime) -> Finding:
    """Check the certificates in a folder of `xavi keys`."""
    shown: list[tuple[str, CertificateInfo]] = []
    try:
        for path in sorted(folder.glob("*.pem")):
            shown.append((path.name, read(path.read_bytes())))
        bare = [path.name for path in sorted(folder.glob("*.key")) if path.stat().st_mode & 0o077]
    except (BadCertificate, OSError) as error:
        return Finding(
            "keys", "fault", f"{folder}: {error}", f"make keys anew: xavi keys {folder} --force"
        )
    if not shown:
        return Finding("keys", "ok", f"no certificates in {folder}")
    name, first = min(shown, key=lambda one: one[1].ends)
    over = f"{name} is valid until {first.ends:%Y-%m-%d %H:%M} UTC"
    if first.ends <= now or any(one.begins > now for _, one in shown):
        found = over if first.ends <= now else "some are not valid yet"
        return Finding("keys", "fault", found, f"see to the clock, or: xavi keys {folder} --force")
    if bare:
        found = f"others on this machine can read {', '.join(bare)}"
        return Finding("keys", "fault", found, f"run: chmod 600 {folder}/*.key")
    if first.ends <= now + SOON:
        return Finding("keys", "warning", over, f"make keys anew: xavi keys {folder} --force")
    return Finding("keys", "ok", f"{len(shown)} certificates; {over}")


def on_the_bus(link: Link) -> Iterator[Finding]:
    """Check which components are present, and their health."""
    try:
        bus = join(link, HUB_PATIENCE)
    except TransportError as error:
        found, _, advice = one_line(str(error)).partition("; ")
        yield Finding("hub", "fault", found, advice)
        return
    with bus:
        yield Finding("hub", "ok", "reachable")
        seen: dict[str, bool] = {}
        bus.watch(CLAIMED, seen.__setitem__)
        present = alive(bus)
        claims = claimed(key for key, there in dict(seen).items() if there)
        yield roster(present, link)
        if claims:
            yield shards(claims, _cars(present), link)
        for key in present[:MAX_SEEN]:
            yield component(bus, key)


def alive(bus: Bus) -> list[str]:
    """Return the keys of all components that are alive, sorted."""
    seen: dict[str, bool] = {}
    bus.watch(EVERY_CAR.of("alive/*"), seen.__setitem__)
    threading.Event().wait(SETTLED)
    return sorted(key for key, there in dict(seen).items() if there and vehicle_in(key))


def claimed(keys: Iterable[str]) -> list[Claim]:
    """Return what services answer for, by the keys that they show; the earliest first."""
    return sorted(claim for claim in map(Claim.read, keys) if claim is not None)


def shards(claims: Sequence[Claim], cars: Sequence[str], link: Link) -> Finding:
    """Check whether there is one service for each car, and for each shard of the fleet.

    Args:
        claims: of the services, the earliest first; at least one.
        cars: that are there.
        link: to the hub.
    """
    found = "; ".join(
        f"{one.shard}: {_many(sum(holder(claims, car) == one for car in cars), 'car')}"
        for one in claims
    )
    gaps = [str(shard) for shard in missing(claims)]
    alone = [car for car in cars if holder(claims, car) is None]
    if alone or (gaps and len({one.shard.of for one in claims}) == 1):
        found += f"; nobody for {', '.join(gaps)}"
        found += f": {', '.join(alone[:NAMED])}" if alone else ""
        found += f" and {len(alone) - NAMED} more" if len(alone) > NAMED else ""
        advice = f"start: xavi serve --shard {gaps[0]} --mode client {_to(link)}"
        return Finding("shards", "fault", found, advice)
    if len({one.shard.of for one in claims}) > 1:
        advice = "let all services have one number of shards; of two for a car the earlier answers"
        return Finding("shards", "warning", f"{found}; these overlap", advice)
    if len({one.shard for one in claims}) < len(claims):
        twice = sorted({str(one.shard) for one in claims if _again(one, claims)})
        found += f"; {', '.join(twice)} more than once"
        advice = (
            "the later one is silent until the earlier one is gone; end it if that is not meant"
        )
        return Finding("shards", "warning", found, advice)
    return Finding("shards", "ok", found)


def _again(claim: Claim, claims: Iterable[Claim]) -> bool:
    return sum(one.shard == claim.shard for one in claims) > 1


def _to(link: Link) -> str:
    """Return the options with which another process joins the same hub."""
    keyed = () if link.config is None else ("--zenoh FILE",)
    return " ".join((*(f"--connect {place}" for place in link.connect), *keyed))


def _many(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"


def _cars(present: Iterable[str]) -> list[str]:
    return sorted(str(vehicle_in(key)) for key in present if key.endswith("/alive/car"))


def roster(present: Iterable[str], link: Link) -> Finding:
    """Check which cars there are, and whether each has a service.

    Args:
        present: keys of the components that are there.
        link: to the hub.
    """
    by_car: dict[str, list[str]] = {}
    for key in present:
        by_car.setdefault(str(vehicle_in(key)), []).append(key.rpartition("/")[2])
    found = "; ".join(f"{car}: {', '.join(parts)}" for car, parts in sorted(by_car.items()))
    cars = sorted(car for car, parts in by_car.items() if "car" in parts)
    if not cars:
        advice = f"start one with: xavi drive {_to(link)}"
        advice += "" if link.config is None else "; or this certificate may not look"
        return Finding("roster", "warning", f"no car is there; {found or 'nor anybody'}", advice)
    alone = [car for car in cars if "service" not in by_car[car]]
    if alone:
        advice = (
            f"nobody answers about {', '.join(alone)}; start: xavi serve --mode client {_to(link)}"
        )
        return Finding("roster", "warning", found, advice)
    return Finding("roster", "ok", found)


def component(bus: Bus, key: str) -> Finding:
    """Check one component: its version, its clock, and its counters."""
    name = f"{vehicle_in(key)}/{key.rpartition('/')[2]}"
    asked = time.time()
    try:
        report = unpack(call(bus, key, b"", PATIENCE), AliveReport)
    except TransportError:
        return Finding(name, "warning", "does not tell how it fares", "is it of another version?")
    except MessageError as error:
        return Finding(name, "warning", f"tells what is not understood: {error}")
    ahead = report.wall_time - (asked + time.time()) / 2.0
    trouble = [f"{one} {report.counters[one]:g}" for one in TROUBLE if report.counters.get(one)]
    found = f"version {one_line(report.version)[:32]}, up {report.uptime_s:.0f} s"
    found += f", clock {ahead:+.2f} s"
    advice = []
    if report.version != __version__:
        advice.append(f"this is version {__version__}: let all be of one")
    if abs(ahead) > APART:
        advice.append("set the clocks, as by NTP: times in records do not fit")
    if trouble:
        advice.append("its log says why: --log-level info")
        found += ", " + ", ".join(trouble)
    return Finding(name, "warning" if advice else "ok", found, "; ".join(advice))


def told(findings: Iterable[Finding]) -> Iterator[str]:
    """Yield the findings as lines for people, 80 columns wide."""
    counted = dict.fromkeys(SIGNS, 0)
    for finding in findings:
        counted[finding.verdict] += 1
        head = f"{SIGNS[finding.verdict]:8}{finding.check:{NAMES - 8}} "
        yield _wrapped(head, finding.found)
        if finding.advice:
            yield _wrapped(" " * (NAMES + 1) + "-> ", finding.advice)
    yield f"{counted['ok']} ok, {counted['warning']} warnings, {counted['fault']} at fault"


def _wrapped(head: str, text: str) -> str:
    later = " " * max(NAMES + 1, len(head) if head.isspace() else 0)
    wrapper = TextWrapper(
        WIDTH, initial_indent=head, subsequent_indent=later, break_on_hyphens=False
    )
    return wrapper.fill(text)
