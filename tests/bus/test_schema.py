"""The JSON Schema of messages, and that the documentation says what the code does."""

import json
import re
from pathlib import Path

import msgspec
import pytest

from planner.record.trace_reading import decode
from xavi_dialogue.bus.access_control import ROLES
from xavi_dialogue.bus.catalogue import MESSAGES
from xavi_dialogue.bus.messages import KIB, schema_name, unpack
from xavi_dialogue.bus.schema import documents, schema_of, write


class Inner(msgspec.Struct):
    value: float


class Outer(msgspec.Struct):
    schema: str
    first: Inner
    others: dict[int, tuple[Inner, ...]]
    maybe: Inner | None = None


class Chain(msgspec.Struct):
    schema: str
    rest: "Chain | None" = None


def test_references_are_replaced_by_what_they_refer_to() -> None:
    schema = schema_of(Outer)
    inner = schema["properties"]["first"]
    assert inner["properties"] == {"value": {"type": "number"}}
    assert schema["properties"]["others"]["additionalProperties"]["items"] == inner
    assert inner in schema["properties"]["maybe"]["anyOf"]
    assert "$ref" not in json.dumps(schema)
    assert "$defs" not in schema


def test_a_named_schema_accepts_its_name_alone() -> None:
    assert schema_of(Outer, "outer/1")["properties"]["schema"] == {"const": "outer/1"}
    assert schema_of(Outer)["properties"]["schema"] == {"type": "string"}


def test_a_type_that_contains_itself_is_refused() -> None:
    with pytest.raises(ValueError, match="Chain contains itself"):
        schema_of(Chain)


def test_the_schemas_in_the_docs_are_current(root: Path) -> None:
    files = documents()
    found = {f"messages/{path.name}" for path in (root / "docs" / "messages").iterdir()}
    assert found == {name for name in files if "/" in name}, "run: make schema"
    for name, text in files.items():
        stored = (root / "docs" / name).read_text(encoding="utf-8")
        assert stored == text, f"docs/{name} is out of date; run: make schema"
        assert "$ref" not in stored


def test_schemas_that_are_of_no_message_any_more_go(tmp_path: Path) -> None:
    (tmp_path / "messages").mkdir()
    (tmp_path / "messages" / "old.schema.json").touch()
    (tmp_path / "README.md").touch()
    write(tmp_path)
    assert (tmp_path / "README.md").exists()
    written = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.schema.json")}
    assert written == set(documents())


def test_the_commented_example_in_the_docs_is_a_plan_trace(root: Path) -> None:
    page = (root / "docs" / "trace.md").read_text(encoding="utf-8")
    [example] = re.findall(r"^```jsonc\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    decoded = decode(re.sub(r"//.*", "", example).encode())
    assert decoded.rollouts
    assert {p.vehicle for p in decoded.predictions} == set(decoded.scene) - {0}
    for rollout in decoded.rollouts:
        assert {sample.vehicle for sample in rollout.samples} <= set(decoded.scene)
    for prediction in decoded.predictions:
        assert sum(goal.probability for goal in prediction.goals) == pytest.approx(1.0, abs=1e-5)


def examples(page: str) -> list[str]:
    """The commented examples of a page, without their comments."""
    found = re.findall(r"^```jsonc\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    return [re.sub(r"//.*", "", example) for example in found]


def test_every_message_has_an_example_in_the_docs_that_can_be_read(root: Path) -> None:
    page = (root / "docs" / "bus.md").read_text(encoding="utf-8")
    [trace_example] = examples((root / "docs" / "trace.md").read_text(encoding="utf-8"))
    shown = []
    for example in map(json.loads, examples(page)):
        name = example["schema"].removeprefix("xavi.").partition("/")[0]
        if name == "trace":
            example["trace"] = json.loads(trace_example)
        read = unpack(json.dumps(example).encode(), MESSAGES[name])
        assert set(example) <= set(read.__struct_fields__), name
        shown.append(name)
    assert shown == list(MESSAGES)


def test_the_limits_in_the_docs_are_those_of_the_messages(root: Path) -> None:
    page = (root / "docs" / "bus.md").read_text(encoding="utf-8")
    told = re.findall(r"^\| `(xavi\.\w+/\d+)` \| (\d+) KiB \|", page, flags=re.MULTILINE)
    limits = {schema_name(kind): kind.LIMIT for kind in MESSAGES.values()}
    assert {name: int(size) * KIB for name, size in told} == limits


def test_every_key_in_the_table_of_roles_is_in_the_docs(root: Path) -> None:
    page = (root / "docs" / "bus.md").read_text(encoding="utf-8")
    keys = set(re.findall(r"^\| `([^`]+)` \|", page, flags=re.MULTILINE))
    granted = {tail for role in ROLES.values() for grant in role.grants for tail in grant.tails}
    shown = {re.sub(r"^(@schema|alive)/.*", r"\1", key) for key in keys}
    for tail in granted:
        wanted = re.sub(r"^(@schema|alive)/.*", r"\1", tail).replace("/*/", "/<session>/")
        assert wanted in shown, tail
