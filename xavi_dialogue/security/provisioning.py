"""`xavi keys`: certificates and Zenoh configurations for a bus with access control.

KeysError
├── KeysExist     the folder has keys, which are not overwritten
├── NotOnlyKeys   the folder has other files, which are not deleted
├── BadEndpoint   nothing to listen at or to connect to with certificates
└── KeysNotKept   the folder cannot be written
"""

import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

from xavi_dialogue.bus.access_control import (
    ROLES,
    ROUTER,
    BadName,
    Json,
    Member,
    access_control,
    member,
)
from xavi_dialogue.bus.certificates import Authority, Identity
from xavi_dialogue.bus.link import Mode, defaults
from xavi_dialogue.process.exit_status import RunFault, UsageFault

HUB = "service"  # the role of the hub's process
LISTEN = "tls/127.0.0.1:7447"
LOOPBACK = ("localhost", "127.0.0.1", "::1")
ANYWHERE = ("0.0.0.0", "::")  # an address to listen on, but not to connect to
PROTOCOLS = ("tls", "quic")  # those that carry certificates
ENDPOINT = re.compile(rf"({'|'.join(PROTOCOLS)})/(\[[0-9a-fA-F:.]+\]|[A-Za-z0-9.-]+):(\d{{1,5}})")
AUTHORITY = "ca"
SECRET, PUBLIC = 0o600, 0o644


class KeysError(RunFault):
    """No keys were made."""


class KeysExist(KeysError, UsageFault):
    """The folder has keys, which are not overwritten."""


class NotOnlyKeys(KeysError, UsageFault):
    """The folder has other files, which are not deleted."""


class BadEndpoint(KeysError, UsageFault):
    """Nothing to listen at or to connect to with certificates."""


class KeysNotKept(KeysError):
    """The folder cannot be written."""


@dataclass(frozen=True, slots=True)
class KeyOptions:
    """Options of making keys."""

    members: tuple[Member, ...]
    hosts: tuple[str, ...]  # names and addresses by which clients reach the hub
    listen: str  # endpoint of the hub
    connect: str  # the same, as seen by clients
    valid: timedelta
    routers: tuple[tuple[str, str], ...] = ()  # names, and endpoints at which they listen


def wanted(
    hosts: Iterable[str] = (),
    listen: str | None = None,
    connect: str | None = None,
    passengers: Iterable[str] = (),
    vehicles: Iterable[str] = (),
    days: int = 365,
    routers: Iterable[str] = (),
) -> KeyOptions:
    """Return the members to make keys for: every role once, and the named ones.

    With routers, given as NAME=ENDPOINT, nobody else is a hub.

    Raises:
        BadName: a name is not allowed.
        BadEndpoint: one cannot be used.
    """
    hosts, listen = tuple(hosts), listen or LISTEN
    at = _host(listen)
    if connect is None:
        connect = listen
        if at in ANYWHERE:
            if not hosts:
                raise BadEndpoint(
                    f"{listen} is every address of this machine; name with --host or --connect"
                    " the one that others connect to"
                )
            first = f"[{hosts[0]}]" if ":" in hosts[0] else hosts[0]
            connect = f"{listen.partition('/')[0]}/{first}:{listen.rpartition(':')[2]}"
    known = (*LOOPBACK, *hosts, *(host for host in (at, _host(connect)) if host not in ANYWHERE))
    named = (
        *(member("passenger", name) for name in passengers),
        *(member("car", name) for name in vehicles),
    )
    members = tuple(dict.fromkeys((*(member(role) for role in ROLES), *named)))
    return KeyOptions(
        members,
        tuple(dict.fromkeys(known)),
        listen,
        connect,
        timedelta(days=days),
        tuple(map(_router, routers)),
    )


def _router(text: str) -> tuple[str, str]:
    name, _, endpoint = text.partition("=")
    if not re.fullmatch(r"[A-Za-z0-9_-]{1,32}", name):
        raise BadName(f"{text!r} is no router; write one such as north=tls/north.example.org:7447")
    if _host(endpoint) in ANYWHERE:
        raise BadEndpoint(f"{endpoint} is every address; name the one that others connect to")
    return name, endpoint


def _host(endpoint: str) -> str:
    found = ENDPOINT.fullmatch(endpoint)
    if found is None or not 0 < int(found[3]) < 2**16:
        raise BadEndpoint(
            f"{endpoint!r} is not an endpoint for certificates;"
            " write one such as tls/127.0.0.1:7447"
        )
    return found[2].strip("[]")


def material(order: KeyOptions, folder: Path, now: datetime) -> dict[str, bytes]:
    """Return the files of a folder of keys, by their names.

    Args:
        order: the options.
        folder: the absolute path where they will be.
        now: start of their validity; with a time zone.

    Raises:
        BadHost: one of the hosts is neither a name nor an address.
    """
    authority = Authority.new(now, order.valid)
    files = _files(AUTHORITY, authority.identity)
    for one in order.members:
        name, hub = one.common_name, one.role == HUB and not order.routers
        files |= _files(name, authority.issue(name, order.hosts if hub else (), now))
        files |= _settings(name, configuration(one, order, folder))
    for number, (name, endpoint) in enumerate(order.routers):
        name = f"{ROUTER}.{name}"
        hosts = tuple(dict.fromkeys((*LOOPBACK, _host(endpoint))))
        files |= _files(name, authority.issue(name, hosts, now))
        files |= _settings(name, router_configuration(number, order, folder))
    return files


def _settings(name: str, settings: Mapping[str, Json]) -> dict[str, bytes]:
    text = json.dumps(settings, indent=2)
    return {
        f"{name}.json5": f"// Zenoh configuration of {name}, by `xavi keys`.\n{text}\n".encode()
    }


def _files(name: str, identity: Identity) -> dict[str, bytes]:
    return {f"{name}.pem": identity.certificate, f"{name}.key": identity.key}


def configuration(one: Member, order: KeyOptions, folder: Path) -> dict[str, Json]:
    """Return the Zenoh configuration of a member: of the hub, or of one of its clients."""
    hub = one.role == HUB and not order.routers
    connect = [endpoint for _, endpoint in order.routers] or [order.connect]
    settings, link = _session("peer" if hub else "client", one.common_name, folder)
    settings |= {
        "listen/endpoints": [order.listen] if hub else [],
        "connect/endpoints": [] if hub else connect,
    }
    if hub:
        _host_with(settings, link, access_control(order.members))
    return _nested(settings)


def router_configuration(number: int, order: KeyOptions, folder: Path) -> dict[str, Json]:
    """Return the Zenoh configuration of a router, which links to those before it."""
    name, endpoint = order.routers[number]
    settings, link = _session("router", f"{ROUTER}.{name}", folder)
    settings |= {
        "listen/endpoints": [endpoint],
        "connect/endpoints": [there for _, there in order.routers[:number]],
    }
    names = [name for name, _ in order.routers]
    _host_with(settings, link, access_control(order.members, names))
    return _nested(settings)


def _session(mode: Mode, name: str, folder: Path) -> tuple[dict[str, object], dict[str, object]]:
    """Return the settings that all sessions of a mode share, and the part of them about TLS."""
    link: dict[str, object] = {
        "root_ca_certificate": str(folder / f"{AUTHORITY}.pem"),
        "connect_certificate": str(folder / f"{name}.pem"),
        "connect_private_key": str(folder / f"{name}.key"),
        "enable_mtls": True,
        "verify_name_on_connect": True,
        "close_link_on_expiration": True,
    }
    settings: dict[str, object] = {
        **defaults(mode),
        "transport/link/protocols": list(PROTOCOLS),
        "transport/link/tls": link,
    }
    return settings, link


def _host_with(
    settings: dict[str, object], link: dict[str, object], access: Mapping[str, Json]
) -> None:
    """Add what a session needs to which others connect."""
    link["listen_certificate"] = link["connect_certificate"]
    link["listen_private_key"] = link["connect_private_key"]
    settings["access_control"] = access


def _nested(settings: Mapping[str, object]) -> dict[str, Json]:
    """Turn settings by path into the tree that a file holds."""
    tree: dict[str, Json] = {}
    for path, value in settings.items():
        *parents, last = path.split("/")
        place = tree
        for parent in parents:
            inner = place.setdefault(parent, {})
            assert isinstance(inner, dict)
            place = inner
        place[last] = value  # type: ignore[assignment]  # what JSON can hold
    return tree


def keep(files: Mapping[str, bytes], folder: Path, *, force: bool = False) -> None:
    """Write a folder of keys completely, or not at all.

    Args:
        files: by their names; those that end in `.key` are secret.
        folder: target; absolute.
        force: replace existing keys.

    Raises:
        KeysExist: there are some, and `force` is not set.
        NotOnlyKeys: the folder has other files, so it is not replaced.
        KeysNotKept: it cannot be written.
    """
    try:
        _check(folder, force)
        folder.parent.mkdir(parents=True, exist_ok=True)
        place = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))  # 0700
        try:
            for name, data in files.items():
                mode = SECRET if name.endswith(".key") else PUBLIC
                flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL
                with os.fdopen(os.open(place / name, flags, mode), "wb") as file:
                    file.write(data)
            _swap(place, folder)
        finally:
            shutil.rmtree(place, ignore_errors=True)
    except OSError as error:
        raise KeysNotKept(f"the keys cannot be kept in {folder}: {error.strerror}") from error


def _check(folder: Path, force: bool) -> None:
    if not folder.exists():
        return
    there = sorted(path.name for path in folder.iterdir())
    foreign = [name for name in there if not _is_ours(name)]
    if foreign:
        raise NotOnlyKeys(
            f"{folder} holds other things, such as {foreign[0]}; name a folder for keys alone"
        )
    if there and not force:
        raise KeysExist(
            f"there are keys in {folder}; with --force all of them are replaced,"
            " and the old ones are no longer accepted"
        )


def _is_ours(name: str) -> bool:
    stem, _, ending = name.rpartition(".")
    role = stem.partition(".")[0]
    return ending in ("pem", "key", "json5") and (role in (*ROLES, ROUTER) or stem == AUTHORITY)


def _swap(place: Path, folder: Path) -> None:
    """Replace a folder by another; `place` then holds the old one."""
    if not folder.exists() or not any(folder.iterdir()):
        place.replace(folder)  # an empty folder may be replaced
        return
    aside = place.with_name(f"{place.name}.old")
    folder.rename(aside)
    try:
        place.rename(folder)
    except OSError:
        aside.rename(folder)
        raise
    shutil.rmtree(aside, ignore_errors=True)
