"""Ask the questions of a panel: python -m tests.panels.ask QUESTIONS.jsonl ANSWERS.jsonl.

Each conversation is one `xavi chat --json` without a terminal: the ride is driven, and each
question is put at its moment. Every line of the input is written again with `answer`,
`answer_kind` and `answer_reason` beside it. See README.md for the protocol.
"""

import json
import subprocess
import sys
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

XAVI = Path(sys.executable).with_name("xavi")
WORLDS = Path(__file__).with_name("worlds")
Line = dict[str, object]


def ask(conversation: list[Line]) -> list[Line]:
    """Hold one conversation and return its lines with answers.

    Raises:
        RuntimeError: the chat ended early; carries its error output.
    """
    first = conversation[0]
    name = Path(str(first["scenario"])).name
    scenario = str(WORLDS / name) if (WORLDS / name).is_dir() else str(first["scenario"])
    rows = [row for line in conversation for row in (f"@ {line['at']}s", str(line["question"]))]
    command = [str(XAVI), "chat", "--json", "--scenario", scenario, "--seed", str(first["seed"])]
    done = subprocess.run(
        command, input="\n".join(rows) + "\n", capture_output=True, text=True, check=False
    )
    replies = [json.loads(row) for row in done.stdout.splitlines() if row.startswith("{")]
    if len(replies) != len(conversation):
        raise RuntimeError(
            f"{first['conversation']}: {len(replies)} replies\n{done.stderr[-2000:]}"
        )
    return [
        {**line, "answer": r["text"], "answer_kind": r["kind"], "answer_reason": r["reason"]}
        for line, r in zip(conversation, replies, strict=True)
    ]


def conversations(lines: Iterable[Line]) -> list[list[Line]]:
    """Group the lines of a panel by conversation, in order."""
    return [list(group) for _, group in groupby(lines, key=lambda line: line["conversation"])]


def main(questions: Path, answers: Path) -> None:
    """Ask all questions of a file and write the answers to another."""
    lines = [json.loads(row) for row in questions.read_text(encoding="utf-8").splitlines() if row]
    with answers.open("w", encoding="utf-8") as out:
        for conversation in conversations(lines):
            for line in ask(conversation):
                out.write(json.dumps(line, ensure_ascii=False) + "\n")
            out.flush()
            sys.stderr.write(conversation[0]["conversation"] + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
