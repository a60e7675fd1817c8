"""Incident reports of rides, as values that write themselves.

What writes them is loaded when it is first used, as most of those who open rides want none.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from xavi_dialogue.library.arguments import path_of
from xavi_dialogue.library.errors import LibraryError, translated
from xavi_dialogue.library.html import framed

if TYPE_CHECKING:
    from xavi_dialogue.report.content import Incident, MomentKind
    from xavi_dialogue.report.ridden import Ridden


@dataclass(frozen=True, slots=True)
class Report:
    """What the record of a ride shows of one moment."""

    content: "Incident" = field(repr=False)  # all that it says, as frozen values
    kind: "MomentKind"  # collision, hardest-braking, closest-approach, red-light or time
    time: float  # [s] the moment

    def __hash__(self) -> int:
        return hash((self.kind, self.time, self.content.hashes.ride))

    def _repr_html_(self) -> str:
        return framed(self.html())

    def html(self) -> str:
        """Return it as one HTML document, which needs no other file."""
        from xavi_dialogue.report.render.page import html

        return html(self.content)

    def json(self) -> str:
        """Return its content as JSON."""
        from xavi_dialogue.report.content import encode

        return encode(self.content).decode()

    def save(self, path: str | Path, *, as_json: bool = False) -> Path:
        """Write it to a file, as HTML or as JSON, which a name that ends in .json asks for, too.

        Raises:
            XaviError: it cannot be written, or its name ends otherwise.
        """
        file = path_of(path)
        ending = file.suffix.lower()
        if not as_json and ending not in ("", ".html", ".htm", ".json"):
            raise LibraryError(f"{file} is no name of a report; end it with .html or .json")
        try:
            file.write_text(
                self.json() if as_json or ending == ".json" else self.html(), encoding="utf-8"
            )
        except OSError as error:
            raise LibraryError(f"cannot write {file}: {error.strerror}; name another") from error
        return file


def report_of(ridden: "Ridden", at: float | str | None) -> Report:
    """Return the report of a moment of a ride.

    Raises:
        XaviError: there is no such moment.
    """
    from xavi_dialogue.report.build import build

    with translated():
        found = build(ridden, at)
    return Report(found, found.moment.kind, found.moment.time)
