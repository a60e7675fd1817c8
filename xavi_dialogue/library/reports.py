"""Incident reports of rides, as values that write themselves."""

from dataclasses import dataclass, field
from pathlib import Path

from xavi_dialogue.library.errors import LibraryError
from xavi_dialogue.report.content import Incident, MomentKind, encode
from xavi_dialogue.report.render.page import html


@dataclass(frozen=True, slots=True)
class Report:
    """What the record of a ride shows of one moment."""

    content: Incident = field(repr=False)  # all that it says, as frozen values
    kind: MomentKind  # collision, hardest-braking, closest-approach, red-light or time
    time: float  # [s] the moment

    def html(self) -> str:
        """Return it as one HTML document, which needs no other file."""
        return html(self.content)

    def json(self) -> str:
        """Return its content as JSON."""
        return encode(self.content).decode()

    def save(self, path: str | Path, *, as_json: bool = False) -> Path:
        """Write it to a file, as HTML or as JSON.

        Raises:
            XaviError: it cannot be written.
        """
        file = Path(path)
        try:
            file.write_text(self.json() if as_json else self.html(), encoding="utf-8")
        except OSError as error:
            raise LibraryError(f"cannot write {file}: {error.strerror}; name another") from error
        return file


def report_of(found: Incident) -> Report:
    """Return a report by its content."""
    return Report(found, found.moment.kind, found.moment.time)
