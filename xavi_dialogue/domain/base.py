"""Base: the base class of all values of the domain."""

import msgspec


class Value(msgspec.Struct, frozen=True, tag_field="is", tag=True, omit_defaults=True):
    """A frozen value; its class name is its tag in JSON."""
