"""Errors of the bus; all derive from `BusError`."""

from xavi_dialogue.errors import XaviError


class BusError(XaviError):
    """A message, a name or the connection cannot be used on the bus."""


class MessageError(BusError, ValueError):
    """A message that cannot be used."""


class TooLarge(MessageError):
    """It has more bytes than its kind allows."""


class WrongSchema(MessageError):
    """It is another message, or of an unknown version."""


class Malformed(MessageError):
    """It is not JSON, or a field is missing or wrong."""
