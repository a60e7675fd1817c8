"""Checks of what is on the screen: contrast, size of what is touched, width, motion, names."""

from pathlib import Path
from typing import Any

from tests.browser.screen import Screen

CHECKS = Path(__file__).with_name("audit.js").read_text(encoding="utf-8")
NAMED = {
    *("button", "link", "textbox", "slider", "tab", "checkbox", "treeitem", "tree", "table"),
    *("dialog", "image", "img", "region", "tabpanel", "listbox", "combobox", "log", "application"),
}


def wrong(screen: Screen, check: str) -> list[str]:
    """What a check of audit.js finds."""
    found: list[str] = screen.page.evaluate(f"({CHECKS}).{check}()")
    return found


def heard(screen: Screen) -> list[tuple[str, str]]:
    """Role and name of everything that a screen reader is told of."""
    session = screen.page.context.new_cdp_session(screen.page)
    nodes: list[dict[str, Any]] = session.send("Accessibility.getFullAXTree")["nodes"]
    session.detach()
    return [
        (str(node["role"]["value"]), str(node.get("name", {}).get("value", "")).strip())
        for node in nodes
        if not node.get("ignored") and "role" in node
    ]


def nameless(screen: Screen) -> list[str]:
    """Roles of what should have a name and has none."""
    return [role for role, name in heard(screen) if role in NAMED and not name]
