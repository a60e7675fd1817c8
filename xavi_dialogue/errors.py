"""The root of the errors of this package."""


class XaviError(Exception):
    """A part of XAVI Dialogue cannot fulfil a request."""
