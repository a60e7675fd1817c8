"""JSON Schema of the messages, for readers in other languages.

Run as a program it writes the schema of the plan trace:

    python -m xavi_dialogue.transports.schema docs/plan_trace.schema.json
"""

import json
import sys
from pathlib import Path
from typing import Any

import msgspec

from planner import trace

DIALECT = "https://json-schema.org/draft/2020-12/schema"
POINTER = "#/$defs/"


def schema_of(message: type, name: str | None = None) -> dict[str, Any]:
    """The JSON Schema of a message type, complete in itself: without `$ref` and `$defs`.

    Args:
        message: a msgspec Struct or a dataclass.
        name: what its field `schema` must say, such as `xavi.plan_trace/1`; None leaves it open.

    Raises:
        ValueError: the type contains itself, which a schema without references cannot say.
    """
    document = msgspec.json.schema(message)
    inlined = _inline(document, document.pop("$defs", {}), ())
    if name is not None:
        inlined["properties"]["schema"] = {"const": name}
    return {"$schema": DIALECT, **inlined}


def _inline(node: Any, definitions: dict[str, Any], within: tuple[str, ...]) -> Any:
    """Replace every reference below a node by what it refers to."""
    if isinstance(node, list):
        return [_inline(item, definitions, within) for item in node]
    if not isinstance(node, dict):
        return node
    if "$ref" in node:
        target = node["$ref"].removeprefix(POINTER)
        if target in within:
            raise ValueError(f"{target} contains itself; such a message has no flat schema")
        return _inline(definitions[target], definitions, (*within, target))
    return {key: _inline(value, definitions, within) for key, value in node.items()}


def plan_trace() -> str:
    """The schema of the plan trace as the text of a file."""
    return json.dumps(schema_of(trace.PlanTrace, trace.SCHEMA), indent=2, sort_keys=True) + "\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(plan_trace(), encoding="utf-8")
