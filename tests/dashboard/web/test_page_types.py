"""The declarations that scripts of the page are typed by."""

import re

from xavi_dialogue.dashboard.web.page_types import FILE, declarations

NAME = re.compile(r"@(?:param|returns|type) \{(?:Promise<)?([A-Z]\w*)\b")


def test_they_are_those_of_the_structs() -> None:
    assert FILE.read_text(encoding="utf-8") == declarations()


def test_scripts_name_none_that_is_not_there() -> None:
    known = set(re.findall(r"(?:interface|type) (\w+)", declarations()))
    platform = {
        "Object",
        "Array",
        "Set",
        "Map",
        "Promise",
        "EventTarget",
        "Element",
        "SVGElement",
        "T",
    }
    scripts = "".join(path.read_text(encoding="utf-8") for path in FILE.parent.rglob("*.js"))
    own = set(re.findall(r"(?:class|@typedef \{.*\}) (\w+)", scripts))
    named = {name for name in NAME.findall(scripts) if not name.startswith("HTML")}
    assert named & known
    assert named <= known | own | platform
