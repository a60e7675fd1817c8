"""Which faults are planted: lines drawn by a seed from every line that an edit could change."""

import ast
import random
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from tests.mutants import rooms
from tests.mutants.edits import Edit, edits

LEAST = 30  # faults of a room, where it has as many lines


@dataclass(frozen=True)
class Fault:
    """One edit of one module."""

    room: str
    path: str  # from the top folder
    number: int  # of the edit, in its module
    kind: str
    owner: str
    in_function: bool
    line: int
    statement: tuple[int, int]
    before: str
    after: str

    @property
    def name(self) -> str:
        """What the fault is, without the line, which changes with any other change of the file."""
        where = f"{self.path}:{self.owner or 'module'}"
        return f"{where}: {_shorter(self.before)} → {_shorter(self.after)}"


def _shorter(text: str, most: int = 70) -> str:
    """One line of a text, cut at its end, that can stand in a table."""
    line = " ".join(text.split()).replace("|", "¦")
    return line if len(line) <= most else line[: most - 1] + "…"


def faults_of(path: str, source: str, room: str) -> list[Fault]:
    """Every fault of a module, in the order of its edits."""
    return [_fault(room, path, k, edit) for k, edit in enumerate(edits(ast.parse(source)))]


def _fault(room: str, path: str, number: int, edit: Edit) -> Fault:
    place = edit.place
    return Fault(
        room,
        path,
        number,
        edit.kind,
        place.owner,
        place.in_function,
        edit.line,
        place.statement,
        edit.before,
        edit.after,
    )


def shares(lines: Mapping[str, int], count: int, least: int = LEAST) -> dict[str, int]:
    """Share a number of faults out to rooms: by their lines, but at least `least` to each."""
    found: dict[str, int] = {}
    left, rest = count, sum(lines.values())
    for room in sorted(lines, key=lambda room: (lines[room], room)):
        wanted = max(least, round(left * lines[room] / rest)) if rest else 0
        found[room] = min(wanted, lines[room], left)
        left, rest = left - found[room], rest - lines[room]
    return found


def drawn(found: Sequence[Fault], count: int, seed: int) -> list[Fault]:
    """Draw lines uniformly within each room, and of every line one of its faults."""
    chance = random.Random(seed)
    by_line: dict[str, dict[tuple[str, int], list[Fault]]] = defaultdict(lambda: defaultdict(list))
    for fault in found:
        by_line[fault.room][fault.path, fault.line].append(fault)
    wanted = shares({room: len(lines) for room, lines in by_line.items()}, count)
    return [
        chance.choice(by_line[room][line])
        for room in sorted(by_line)
        for line in sorted(chance.sample(sorted(by_line[room]), wanted[room]))
    ]


def every() -> list[Fault]:
    """Every fault of every room."""
    return [
        fault
        for room, path in rooms.modules()
        for fault in faults_of(path, (rooms.ROOT / path).read_text(encoding="utf-8"), room)
    ]
