"""The diagram of the conversation's states, drawn from their table and written into a document.

python -m xavi_dialogue.transcripts.state_diagram ARCHITECTURE.md
"""

import sys
from pathlib import Path

from xavi_dialogue.dialogue.state.states import diagram

BEGIN, END = "<!-- conversation: begin -->\n", "<!-- conversation: end -->"


def drawn(document: str) -> str:
    """Return the document with the diagram as it is now between its marks.

    Raises:
        ValueError: the marks are missing.
    """
    head, begin, rest = document.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the document lacks the lines {BEGIN.strip()!r} and {END!r}")
    return f"{head}{begin}{diagram()}{end}{tail}"


if __name__ == "__main__":
    path = Path(sys.argv[1])
    path.write_text(drawn(path.read_text(encoding="utf-8")), encoding="utf-8")
