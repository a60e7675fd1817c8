"""Errors of the bus; all derive from `BusError`."""

from xavi_dialogue.errors import XaviError


class BusError(XaviError):
    """A message, a name or the connection cannot be used on the bus."""


class MessageError(BusError, ValueError):
    """A message that cannot be used."""


class TooLarge(MessageError):
    """More bytes than allowed for the message."""


class WrongSchema(MessageError):
    """Another message, or a version that is not known here."""


class Malformed(MessageError):
    """Not JSON, or a field is missing or wrong."""
