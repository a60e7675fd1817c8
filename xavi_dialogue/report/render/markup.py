"""HTML and SVG as text; whatever is not markup already is escaped."""

from collections.abc import Iterable, Sequence
from html import escape


class Markup(str):
    """Text that is markup, and safe to insert."""

    __slots__ = ()


Part = Markup | str | None  # None: nothing

EMPTY = Markup("")
VOID = frozenset(("br", "col", "meta"))


def tag(name: str, /, *parts: Part, **attributes: str | float | None) -> Markup:
    """Return an element. A trailing underscore of an attribute's name is dropped.

    Args:
        name: of the element.
        parts: what it holds; plain text is escaped.
        attributes: underscores in their names stand for hyphens; None: left out.
    """
    stated = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(_value(value))}"'
        for key, value in attributes.items()
        if value is not None
    )
    if name in VOID:
        return Markup(f"<{name}{stated}>")
    return Markup(f"<{name}{stated}>{joined(parts)}</{name}>")


def joined(parts: Iterable[Part], between: str = "") -> Markup:
    """Return parts one after the other; plain text is escaped."""
    safe = (one if isinstance(one, Markup) else escape(one) for one in parts if one is not None)
    return Markup(escape(between).join(safe))


def table(head: Sequence[Part], rows: Iterable[Sequence[Part]], class_: str = "") -> Markup:
    """Return a table with a row of headings; a first cell heads its row."""
    above = tag("tr", *(tag("th", cell, scope="col") for cell in head))
    body = (
        tag("tr", tag("th", row[0], scope="row"), *(tag("td", cell) for cell in row[1:]))
        for row in rows
    )
    return tag("table", tag("thead", above), tag("tbody", *body), class_=class_ or None)


def listed(parts: Iterable[Part], class_: str | None = None) -> Markup:
    """Return a list."""
    return tag("ul", *(tag("li", part) for part in parts), class_=class_)


def _value(value: str | float | None) -> str:
    if isinstance(value, float):
        return f"{value:.2f}".rstrip("0").rstrip(".") or "0"
    return str(value)
