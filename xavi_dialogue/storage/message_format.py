"""Formats of messages in recordings: their schemas, as viewers can read them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import msgspec

from xavi_dialogue.bus.messages import schema_name
from xavi_dialogue.bus.schema import schema_of


@dataclass(frozen=True, slots=True)
class MessageFormat:
    """The format of messages that are not of the bus."""

    name: str  # of the schema
    encoding: str  # of schema and messages: protobuf
    schema: bytes


def schema_to_view(kind: type[msgspec.Struct]) -> dict[str, Any]:
    """Return a JSON Schema of a message that viewers of MCAP files can read.

    They read a single `type` of a field, and a single type for the items of a list. Fields that
    may be null, and lists within lists, are therefore left undeclared. All messages fit this
    schema, but so do others; `schema_of` is exact.
    """
    schema = schema_of(kind, schema_name(kind))
    return {"$schema": schema["$schema"], **(_viewable(schema) or {})}


def _viewable(node: Mapping[str, Any]) -> dict[str, Any] | None:
    """Simplify a schema to one type, with `properties` for `object`; None if impossible."""
    if "const" in node or "enum" in node:
        values = [node["const"]] if "const" in node else node["enum"]
        texts = all(isinstance(value, str) for value in values)
        return {"type": "string", **node} if texts else None
    match node.get("type"):
        case "object":
            declared = {name: _viewable(one) for name, one in node.get("properties", {}).items()}
            properties = {name: one for name, one in declared.items() if one is not None}
            return {**node, "properties": properties}
        case "array":
            return _viewable_array(node)
        case "string" | "number" | "integer" | "boolean":
            return dict(node)
    return None


def _viewable_array(node: Mapping[str, Any]) -> dict[str, Any] | None:
    one = node.get("items")
    first = node.get("prefixItems", ())
    if first and all(item == first[0] for item in first):  # a pair of numbers
        one = first[0]
    items = _viewable(one) if isinstance(one, dict) else None
    if items is None or items["type"] == "array":
        return None
    kept = {name: value for name, value in node.items() if name != "prefixItems"}
    return {**kept, "items": items}
