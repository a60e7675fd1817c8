"""Annotated questions, read from folders of `.jsonl` files.

Errors::

    QuestionFileError   a folder or file is missing, or a line is broken; states the remedy
"""

from pathlib import Path

import msgspec

from benchmarks.errors import QuestionFileError
from benchmarks.language.scoring import Question

FOLDER = Path("tests/nlu/questions")
LEARN = "learn"  # folder of the questions for which rules and words may be written
BLIND = "blind"  # folder of the questions for which they may not
SHAPE = '{"id": .., "text": .., "style": .., "query": {"type": .., "actor": .., ..}}'


def read_folder(folder: Path) -> tuple[Question, ...]:
    """Return the questions of all files of a folder, files in the order of their names.

    Raises:
        QuestionFileError: there is no such folder, it holds no questions, or a line is broken.
    """
    files = sorted(folder.glob("*.jsonl"))
    if not files:
        raise QuestionFileError(
            f"{folder}: no .jsonl files there; put annotated questions there, or name with"
            f" --questions a folder that holds such folders as {LEARN} and {BLIND}; by default it"
            f" is {FOLDER}"
        )
    found = tuple(question for file in files for question in read(file))
    if not found:
        raise QuestionFileError(f"{folder}: its files hold no questions; each line is {SHAPE}")
    return found


def read(file: Path) -> tuple[Question, ...]:
    """Return the questions of a file, in order; empty lines are skipped.

    Raises:
        QuestionFileError: it cannot be read, or a line is broken.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise QuestionFileError(f"{file}: cannot be read as UTF-8 text: {error}") from error
    lines = enumerate(text.split("\n"), start=1)
    return tuple(_question(file, number, line) for number, line in lines if line.strip())


def _question(file: Path, number: int, line: str) -> Question:
    try:
        return msgspec.json.decode(line, type=Question)
    except (msgspec.DecodeError, UnicodeEncodeError) as error:
        raise QuestionFileError(
            f"{file}, line {number}: {error}; mend the line, which must be {SHAPE}"
        ) from error
