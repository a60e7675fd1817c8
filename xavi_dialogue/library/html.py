"""HTML for notebooks; every text is escaped."""

from collections.abc import Iterable, Sequence
from html import escape


def element(name: str, text: str) -> str:
    """Return an element that holds a text."""
    return f"<{name}>{escape(text)}</{name}>"


def listed(texts: Iterable[str]) -> str:
    """Return a list."""
    return f"<ul>{''.join(element('li', text) for text in texts)}</ul>"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table with a row of headings."""
    above = "".join(element("th", text) for text in head)
    body = "".join(f"<tr>{''.join(element('td', text) for text in row)}</tr>" for row in rows)
    return f"<table><thead><tr>{above}</tr></thead><tbody>{body}</tbody></table>"


def framed(document: str) -> str:
    """Return a whole document in a frame, apart from the style of the page around it."""
    style = "width: 100%; height: 40em; border: 1px solid #999"
    return f'<iframe srcdoc="{escape(document)}" style="{style}" sandbox></iframe>'
