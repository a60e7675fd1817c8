"""`xavi parse`: the query that a question means."""

from collections.abc import Callable, Iterable, Iterator

import lark
import msgspec

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.parse import NotUnderstood, Parser, ParseReport, as_query
from xavi_dialogue.transports.text import one_line

MAX_VEHICLE = 10_000


class ParseUsageError(ValueError):
    """The command was used wrongly."""


def vehicle_names(text: str) -> frozenset[int]:
    """The names in "0-5" or "0,2,7".

    Raises:
        ParseUsageError: the text is neither.
    """
    names: set[int] = set()
    for part in text.split(","):
        first, _, last = part.strip().partition("-")
        if not first.isdecimal() or not (last or first).isdecimal():
            raise ParseUsageError(f"--vehicles takes names such as 0-5 or 0,2,7, not {text!r}")
        names.update(range(int(first), min(int(last or first), MAX_VEHICLE) + 1))
    return frozenset(names)


def parse_text(
    text: str, vehicles: frozenset[int], *, explain: bool, as_json: bool
) -> tuple[str, bool]:
    """What a question means, for people or as JSON, and whether it was understood."""
    report = Parser().explain(one_line(text), vehicles=vehicles)
    understood = isinstance(report.result, Query)
    told = report if explain else report.result
    shown = msgspec.json.encode(told, enc_hook=_tree).decode()
    if not as_json:
        shown = _steps(report) if explain else _lines(report.result)
    return shown, understood


class Line(msgspec.Struct, frozen=True):
    """A question line."""

    text: str
    id: str | int | float | None = None
    context: tuple[str, ...] | None = None  # the passenger's earlier turns, oldest first


def parse_lines(
    lines: Iterable[str], vehicles: frozenset[int], note: Callable[[str], None]
) -> Iterator[str]:
    """The answer line to each question line such as {"id": "q1", "text": "...", "context": []}.

    A line that is none is noted, and the others are answered all the same.

    Raises:
        ParseUsageError: at the end, where some lines were none.
    """
    parser = Parser()
    broken = count = 0
    for count, line in enumerate(lines, 1):
        try:
            question = msgspec.json.decode(line, type=Line)
        except (msgspec.MsgspecError, RecursionError, UnicodeEncodeError) as error:
            broken += 1
            shown = one_line(line)[:60]
            note(f'line {count} is not {{"id": .., "text": ..}} ({error}); it is: {shown}')
            continue
        context = question.context or ()
        query = as_query(parser.parse(question.text, vehicles=vehicles, context=context))
        yield msgspec.json.encode({"id": question.id, "query": query}).decode()
    if broken:
        raise ParseUsageError(f"{broken} of {count} lines hold no question")


def _tree(value: object) -> object:
    """What the grammar read, as JSON: a list of rule and parts, and words with their terminals."""
    if isinstance(value, lark.Tree):
        return [str(value.data), *value.children]
    if isinstance(value, lark.Token):
        return f"{value.type}={value}"
    raise NotImplementedError(type(value))


def _lines(result: Query | NotUnderstood) -> str:
    """The fields that say something, a line each."""
    if isinstance(result, NotUnderstood):
        unknown = f" ({', '.join(result.hints)})" if result.hints else ""
        return f"not understood: {result.cause}{unknown}"
    fields = msgspec.structs.asdict(result)
    return "\n".join(f"{name:20} {_word(value)}" for name, value in fields.items() if value)


def _word(value: object) -> str:
    return ", ".join(value) if isinstance(value, tuple) else str(value)


def _steps(report: ParseReport) -> str:
    corrected = ", ".join(f"{a} -> {b}" for a, b in report.corrections)
    lines = [
        "tokens      " + "  ".join(f"{token.terminal}={token.text}" for token in report.tokens),
        f"corrected   {corrected or '-'}",
    ]
    for reading in report.readings:
        query = msgspec.structs.asdict(reading.query)
        said = ", ".join(f"{name}={_word(value)}" for name, value in query.items() if value)
        manner = "loose " if reading.loose else ""
        lines.append(f"reading     {reading.score:6.2f}  {manner}{reading.rule}: {said}")
    for kind in report.kinds:
        lines.append(
            f"judged      {kind.probability:6.2f}  {kind.name}: {'; '.join(kind.telling) or '-'}"
        )
    return "\n".join((*lines, "result", _lines(report.result)))
