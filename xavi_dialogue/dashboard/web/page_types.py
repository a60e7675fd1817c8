"""TypeScript declarations of what the page receives, from the JSON schemas of the same structs.

Scripts of the page name them in JSDoc. Run as a program it writes them anew:

    python -m xavi_dialogue.dashboard.web.page_types
"""

import json
from pathlib import Path
from typing import Any

import msgspec

from xavi_dialogue.dashboard.web import http_documents, websocket_messages

FILE = Path(__file__).with_name("page.d.ts")
HEAD = "// Written by page_types.py: what the page receives. SI units, radians, seconds.\n"
POINTER = "#/$defs/"
PLAIN = {
    "integer": "number",
    "number": "number",
    "string": "string",
    "boolean": "boolean",
    "null": "null",
}
DOCUMENTS = (
    http_documents.Roads,
    http_documents.Past,
    http_documents.DecisionShown,
    http_documents.EvidenceShown,
)


def declarations() -> str:
    """Return the text of the declarations."""
    messages = websocket_messages.Outgoing.__subclasses__()
    _, components = msgspec.json.schema_components(
        (*messages, *DOCUMENTS), ref_template=POINTER + "{name}"
    )
    return HEAD + "".join(_declaration(name, components[name]) for name in sorted(components))


def _declaration(name: str, schema: dict[str, Any]) -> str:
    about = schema.get("description", "").partition("\n")[0]
    comment = f"\n/** {about} */\n" if about else "\n"
    if "properties" not in schema:
        return f"{comment}type {name} = {_type(schema)};\n"
    required = set(schema.get("required", ()))
    fields = [
        f"  {field}{'' if field in required else '?'}: {_type(kind)};\n"
        for field, kind in schema["properties"].items()
    ]
    return f"{comment}interface {name} {{\n{''.join(fields)}}}\n"


def _type(schema: dict[str, Any]) -> str:
    """Return the type that a schema describes."""
    if "$ref" in schema:
        return str(schema["$ref"]).removeprefix(POINTER)
    if "anyOf" in schema:
        return " | ".join(_type(one) for one in schema["anyOf"])
    if "enum" in schema:
        return " | ".join(json.dumps(value) for value in schema["enum"])
    if "const" in schema:
        return json.dumps(schema["const"])
    kind = schema.get("type")
    if kind == "array":
        return _array(schema)
    if kind == "object":
        return f"Record<string, {_type(schema.get('additionalProperties') or {})}>"
    return PLAIN.get(str(kind), "any")


def _array(schema: dict[str, Any]) -> str:
    if "prefixItems" in schema:
        return f"[{', '.join(_type(one) for one in schema['prefixItems'])}]"
    item = _type(schema.get("items") or {})
    return f"({item})[]" if " | " in item else f"{item}[]"


if __name__ == "__main__":
    FILE.write_text(declarations(), encoding="utf-8")
