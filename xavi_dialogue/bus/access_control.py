"""Access control of the bus: a table of roles, and the configuration made from it.

A hub recognises its clients by the common names of their certificates: `passenger`, or
`passenger.NAME`. Everything and every client that is not in the table is denied.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from xavi_dialogue.bus.catalogue import CAR_MESSAGES, MESSAGES
from xavi_dialogue.bus.errors import BusError
from xavi_dialogue.bus.interface import DEFAULT_VEHICLE, EVERY_CAR, FLEET, VEHICLE_NAME, Keys

Deed: TypeAlias = Literal[
    "publish",
    "publish-kept",  # with the messages kept for late joiners
    "subscribe",
    "subscribe-kept",
    "serve",
    "ask",
    "appear",
    "watch",
]
Json: TypeAlias = "bool | str | list[Json] | dict[str, Json]"

DIALOGUE = ("@rpc/ask", "@rpc/history", "@rpc/forget", "@rpc/cancel", "@rpc/evidence")
TURNS = "dialogue/*/turn"
ROADS = "@blob/network"
ROUTER = "router"  # what the names of routers begin with; it is no role of a member
LONGEST = 64  # characters of a common name (RFC 5280, A.1)


class BadName(BusError, ValueError):
    """A name that is not allowed on the bus."""


@dataclass(frozen=True, slots=True)
class Grant:
    """A permission of a role."""

    deed: Deed
    tails: tuple[str, ...]  # ends of keys
    own: bool = False  # True: only under the keys of the member's own car
    fleet: bool = False  # True: under the keys of the fleet, and of no car


@dataclass(frozen=True, slots=True)
class Role:
    """A kind of component, with its permissions."""

    name: str
    grants: tuple[Grant, ...]


@dataclass(frozen=True, slots=True)
class Member:
    """The holder of a certificate: a role, and a name if the role has several members."""

    role: str
    name: str | None = None

    @property
    def common_name(self) -> str:
        """The common name in the certificate."""
        return self.role if self.name is None else f"{self.role}.{self.name}"

    @property
    def vehicle(self) -> str:
        """The name of the car, if the member is one."""
        return self.name or DEFAULT_VEHICLE


CLAIMS = "service/*"  # of the fleet: which service answers about which cars
_LOOKS = (
    Grant("watch", ("alive/*",)),
    Grant("watch", (CLAIMS,), fleet=True),
    Grant("ask", ("alive/*", "@schema/*")),
    Grant("ask", (CLAIMS,), fleet=True),
)
_SEES = (Grant("subscribe", ("scene",)), Grant("subscribe-kept", ("event",)))
_READS = (*_SEES, Grant("subscribe-kept", ("trace",)))

ROLES: Mapping[str, Role] = {
    role.name: role
    for role in (
        Role(
            "car",
            (
                Grant("publish", ("scene",), own=True),
                Grant("publish-kept", ("trace", "event"), own=True),
                Grant(
                    "serve",
                    (
                        *("@rpc/whatif", ROADS, "alive/car"),
                        *(f"@schema/{name}" for name in (*CAR_MESSAGES, "plan_trace")),
                    ),
                    own=True,
                ),
                Grant("appear", ("alive/car",), own=True),
                *_LOOKS,
            ),
        ),
        Role(
            "service",
            (
                *_READS,
                Grant("publish", (TURNS,)),
                Grant(
                    "serve",
                    (
                        *DIALOGUE,
                        "alive/service",
                        *(f"@schema/{name}" for name in MESSAGES if name not in CAR_MESSAGES),
                    ),
                ),
                Grant("ask", ("@rpc/whatif",)),
                Grant("appear", ("alive/service",)),
                Grant("serve", (CLAIMS,), fleet=True),
                Grant("appear", (CLAIMS,), fleet=True),
                *_LOOKS,
            ),
        ),
        Role("passenger", (*_SEES, Grant("ask", DIALOGUE), *_LOOKS)),
        Role(
            "dashboard",
            (
                *_READS,
                Grant("subscribe", (TURNS,)),
                Grant("ask", (*DIALOGUE, ROADS)),
                Grant("serve", ("alive/dashboard", "alive/recorder")),
                Grant("appear", ("alive/dashboard", "alive/recorder")),
                *_LOOKS,
            ),
        ),
        Role(
            "observer",
            (
                *_READS,
                Grant("ask", (ROADS,)),
                Grant("serve", ("alive/recorder",)),
                Grant("appear", ("alive/recorder",)),
                *_LOOKS,
            ),
        ),
    )
}

# The parts of each deed at the hub: the end of the key, the kinds of messages that come in from
# the member, and those that go out to it. A late joiner requests kept messages under a key of the
# publisher (_HISTORY), and gets the reply under the key of the messages.
_HISTORY = "/@adv/pub/**"
PARTS: Mapping[Deed, tuple[tuple[str, tuple[str, ...], tuple[str, ...]], ...]] = {
    "publish": (("", ("put",), ("declare_subscriber",)),),
    "publish-kept": (
        ("", ("put", "reply"), ("declare_subscriber",)),
        (
            _HISTORY,
            ("put", "declare_queryable", "liveliness_token"),
            ("query", "declare_subscriber"),
        ),
    ),
    "subscribe": (("", ("declare_subscriber",), ("put",)),),
    "subscribe-kept": (
        ("", ("declare_subscriber",), ("put", "reply")),
        (
            _HISTORY,
            ("query", "declare_subscriber", "declare_liveliness_subscriber"),
            ("put", "liveliness_token"),
        ),
    ),
    "serve": (("", ("declare_queryable", "reply"), ("query",)),),
    "ask": (("", ("query",), ("reply",)),),
    "appear": (("", ("liveliness_token",), ()),),
    "watch": (("", ("declare_liveliness_subscriber", "liveliness_query"), ("liveliness_token",)),),
}


def member(role: str, name: str | None = None) -> Member:
    """Return a member of the bus.

    Raises:
        BadName: there is no such role, or the name is not allowed.
    """
    if role not in ROLES:
        raise BadName(f"{role!r} is not a role; the roles are {', '.join(ROLES)}")
    found = Member(role, name)
    if name is not None and not re.fullmatch(VEHICLE_NAME, name):
        raise BadName(
            f"{name!r} cannot be a name: it has 1 to 64 letters, digits, dots, dashes, underscores"
        )
    if len(found.common_name) > LONGEST:
        raise BadName(
            f"{name!r} is too long: a certificate names at most {LONGEST} characters,"
            f" {found.common_name!r} has {len(found.common_name)}"
        )
    return found


def access_control(members: Iterable[Member], routers: Iterable[str] = ()) -> dict[str, Json]:
    """Return the part of a hub's Zenoh configuration that grants the table's permissions.

    Args:
        members: who is known.
        routers: names of routers that are linked to this one. They pass on what their own members
            may do, so that all that is granted to anybody is granted to them.
    """
    everybody = sorted(set(members), key=lambda one: one.common_name)
    rules: dict[str, Json] = {}
    policies: list[Json] = []
    for one in everybody:
        granted = [_rules(grant, one) for grant in ROLES[one.role].grants]
        rules.update({str(rule["id"]): rule for group in granted for rule in group})
        policies.append(
            {
                "rules": [rule["id"] for group in granted for rule in group],
                "subjects": [one.common_name],
            }
        )
    linked = sorted(f"{ROUTER}.{name}" for name in set(routers))
    if linked:
        passage = _passage()
        rules[str(passage["id"])] = passage
        policies.append({"rules": [passage["id"]], "subjects": [*linked]})
    subjects: list[Json] = [
        {"id": name, "cert_common_names": [name]}
        for name in (*(one.common_name for one in everybody), *linked)
    ]
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": list(rules.values()),
        "subjects": subjects,
        "policies": policies,
    }


def _rules(grant: Grant, one: Member) -> list[dict[str, Json]]:
    # Outgoing messages are requested by others, possibly with one pattern for every car.
    everywhere = FLEET if grant.fleet else EVERY_CAR
    own = Keys(one.vehicle) if grant.own else everywhere
    found: list[dict[str, Json]] = []
    for ending, incoming, outgoing in PARTS[grant.deed]:
        for flow, kinds, keys in (("ingress", incoming, own), ("egress", outgoing, everywhere)):
            places: list[Json] = [keys.of(tail + ending) for tail in grant.tails]
            if kinds:
                what = f"{grant.deed}{ending} {' '.join(map(str, places))}: {flow}"
                found.append(
                    {
                        "id": what,
                        "permission": "allow",
                        "flows": [flow],
                        "messages": list(kinds),
                        "key_exprs": places,
                    }
                )
    return found


def _passage() -> dict[str, Json]:
    """Return the rule by which a router lets pass what another one has let in."""
    places = {
        (FLEET if grant.fleet else EVERY_CAR).of(tail + ending)
        for role in ROLES.values()
        for grant in role.grants
        for tail in grant.tails
        for ending, _, _ in PARTS[grant.deed]
    }
    kinds = {
        kind
        for parts in PARTS.values()
        for _, incoming, outgoing in parts
        for kind in (*incoming, *outgoing)
    }
    return {
        "id": "what another router lets in",
        "permission": "allow",
        "flows": ["ingress", "egress"],
        "messages": [*sorted(kinds)],
        "key_exprs": [*sorted(places)],
    }


def table() -> str:
    """Return the roles as a table in Markdown."""
    titles: dict[str, tuple[Deed, ...]] = {
        "publishes": ("publish", "publish-kept"),
        "subscribes to": ("subscribe", "subscribe-kept"),
        "serves": ("serve",),
        "asks": ("ask",),
        "shows": ("appear",),
        "sees": ("watch",),
    }
    lines = [f"| role | {' | '.join(titles)} |", "|---" * (len(titles) + 1) + "|"]
    for role in ROLES.values():
        cells = [
            [
                f"{FLEET.vehicle}/{tail}" if grant.fleet else tail
                for grant in role.grants
                if grant.deed in deeds
                for tail in grant.tails
            ]
            for deeds in titles.values()
        ]
        lines.append(f"| {role.name} | {' | '.join(map(_cell, cells))} |")
    return "\n".join(lines)


def _cell(tails: list[str]) -> str:
    schemas = [tail for tail in tails if tail.startswith("@schema/") and tail != "@schema/*"]
    shown = [f"`{tail}`" for tail in tails if tail not in schemas]
    if schemas:
        shown.append("`@schema/` of its messages")
    return ", ".join(shown) or "-"
