"""Checks that a key fits its use before connecting, because a hub denies silently.

Only certificates made by `xavi keys` are checked; the permissions of others are unknown here.

BadLink
└── WrongKey   the key is for something else
"""

from collections.abc import Mapping
from typing import Literal, TypeAlias

from xavi_dialogue.bus.access_control import ROLES, BadName, Deed, Member, member
from xavi_dialogue.bus.interface import BadLink
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import certificate_of

Doing: TypeAlias = Literal["report a ride", "answer passengers", "ask", "record", "show a car"]

#: A permission that only this role has in the table.
SHOWN_BY: Mapping[Doing, tuple[Deed, str]] = {
    "report a ride": ("publish", "scene"),
    "answer passengers": ("serve", "@rpc/ask"),
    "ask": ("ask", "@rpc/ask"),
    "record": ("appear", "alive/recorder"),
    "show a car": ("appear", "alive/dashboard"),
}


class WrongKey(BadLink):
    """The key is for something else."""


def holder(link: Link) -> Member | None:
    """Return the member whose key a link uses; None: no key, or one not made by `xavi keys`.

    Raises:
        BadLink: the configuration, or the certificate that it names, cannot be used.
    """
    if link.config is None:
        return None
    path = certificate_of(link)
    if path is None:
        return None
    # Imported late: it takes a tenth of a second, and only links with keys need it.
    from xavi_dialogue.bus.certificates import AUTHORITY, BadCertificate, read

    try:
        shown = read(path.read_bytes())
    except (OSError, BadCertificate) as error:
        why = error.strerror if isinstance(error, OSError) else error
        raise BadLink(f"{link.config} names the certificate {path}: {why}") from error
    role, _, name = shown.name.partition(".")
    if shown.issuer != AUTHORITY:
        return None
    try:
        return member(role, name or None)
    except BadName:
        return None


def may(role: str, doing: Doing) -> bool:
    """Check whether a role has a permission."""
    deed, tail = SHOWN_BY[doing]
    return any(grant.deed == deed and tail in grant.tails for grant in ROLES[role].grants)


def check(link: Link, doing: Doing) -> Member | None:
    """Check that the key of a link, if it has one, permits an action.

    Returns:
        See `holder`.

    Raises:
        WrongKey: it does not permit that.
        BadLink: see `holder`.
    """
    found = holder(link)
    if found is None or may(found.role, doing):
        return found
    allowed = " and ".join(one for one in SHOWN_BY if may(found.role, one))
    others = " or ".join(role for role in ROLES if may(role, doing))
    raise WrongKey(
        f"{link.config} holds the key of {found.common_name!r}, which may {allowed},"
        f" but not {doing}; that takes the key of a {others}"
    )


def own_name(link: Link, named: str | None) -> str | None:
    """Return the name of a car that is to report a ride.

    Args:
        link: to the hub.
        named: the wanted name of the car; None: as in its key.

    Returns:
        The name; None if neither gives one.

    Raises:
        WrongKey: the key is not for a car of this name.
        BadLink: see `holder`.
    """
    found = check(link, "report a ride")
    if found is None or named in (None, found.vehicle):
        return named if found is None else found.vehicle
    raise WrongKey(
        f"{link.config} holds the key of {found.common_name!r}, which may report a ride as"
        f" {found.vehicle!r}, but not as {named!r}; leave --vehicle out, or take that car's key"
    )
