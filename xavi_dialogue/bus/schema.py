"""JSON Schema of the messages, for readers in other languages.

Run as a program it writes the schemas of the plan trace and of every message into a folder:

    python -m xavi_dialogue.bus.schema docs
"""

import json
import sys
from pathlib import Path
from typing import Any

import msgspec

from planner.record import trace
from xavi_dialogue.bus.catalogue import MESSAGES
from xavi_dialogue.bus.messages import schema_name

DIALECT = "https://json-schema.org/draft/2020-12/schema"
POINTER = "#/$defs/"


def schema_of(message: type, name: str | None = None) -> dict[str, Any]:
    """The JSON Schema of a message type, complete in itself: without `$ref` and `$defs`.

    Args:
        message: a msgspec Struct or a dataclass.
        name: the required value of `schema`, such as `xavi.plan_trace/1`; None: any.

    Raises:
        ValueError: the type contains itself, which needs references.
    """
    document = msgspec.json.schema(message)
    inlined = _inline(document, document.pop("$defs", {}), ())
    if name is not None:
        inlined["properties"]["schema"] = {"const": name}
    return {"$schema": DIALECT, **inlined}


def _inline(node: Any, definitions: dict[str, Any], within: tuple[str, ...]) -> Any:
    """Replace every reference below a node by its target."""
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


def documents() -> dict[str, str]:
    """Return the texts of the schema files by path."""
    files = {"plan_trace.schema.json": _text(schema_of(trace.PlanTrace, trace.SCHEMA))}
    for name, kind in MESSAGES.items():
        files[f"messages/{name}.schema.json"] = _text(schema_of(kind, schema_name(kind)))
    return files


def _text(schema: dict[str, Any]) -> str:
    return json.dumps(schema, indent=2, sort_keys=True) + "\n"


def write(folder: Path) -> None:
    """Write all schema files; delete other files in the folder of messages."""
    files = documents()
    (folder / "messages").mkdir(parents=True, exist_ok=True)
    for path in (folder / "messages").glob("*.schema.json"):
        if path.relative_to(folder).as_posix() not in files:
            path.unlink()
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]))
