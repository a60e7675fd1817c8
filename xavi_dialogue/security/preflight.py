"""Whether a key fits what it is used for: a hub denies silently, so that it is said here at once.

Only certificates by `xavi keys` are looked at. What those of others are for is known to their hub.

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

#: By what one can tell in the table of roles who may do it.
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
    """Whose key a link shows; None where it shows none, or one that is not by `xavi keys`.

    Raises:
        BadLink: the configuration, or the certificate that it names, cannot be used.
    """
    if link.config is None:
        return None
    path = certificate_of(link)
    if path is None:
        return None
    # Deferred: a tenth of a second that only keys need.
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
    """Whether a role may do something."""
    deed, tail = SHOWN_BY[doing]
    return any(grant.deed == deed and tail in grant.tails for grant in ROLES[role].grants)


def check(link: Link, doing: Doing) -> Member | None:
    """Make sure that the key of a link, if it shows one, is for what is to be done.

    Returns:
        See `holder`.

    Raises:
        WrongKey: it is not.
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
    """The name of a car that is to report a ride.

    Args:
        link: to the hub.
        named: how the car shall be called; None: as its key says.

    Returns:
        The name; None where nobody says one.

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
