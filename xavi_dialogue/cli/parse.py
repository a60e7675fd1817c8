"""`xavi parse`: the meaning of a question, for display."""

from collections.abc import Callable, Iterable, Iterator, Sequence

import msgspec

from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.domain.meaning import Act, Reading, TokenShare
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.notation import acts_line, reading_line
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.nlu.projection import QueryFields, project_readings
from xavi_dialogue.nlu.projection.fields import TALK
from xavi_dialogue.process.exit_status import UsageFault

MAX_VEHICLE = 10_000


def vehicle_names(text: str) -> frozenset[int]:
    """Return the names in "0-5" or "0,2,7".

    Raises:
        UsageFault: the text is neither.
    """
    names: set[int] = set()
    for part in text.split(","):
        first, _, last = part.strip().partition("-")
        if not first.isdecimal() or not (last or first).isdecimal():
            raise UsageFault(f"--vehicles takes numbers such as 0-5 or 0,2,7, not {text!r}")
        names.update(range(int(first), min(int(last or first), MAX_VEHICLE) + 1))
    return frozenset(names)


class Meaning(msgspec.Struct, frozen=True, omit_defaults=True):
    """The meaning of a question, as `xavi parse --json` prints it."""

    text: str
    query: QueryFields  # of the first act
    acts: tuple[Act, ...]
    unknown: tuple[str, ...]  # words without a part in the meaning
    strangers: tuple[int, ...]  # unknown vehicles
    readings: tuple[Reading, ...] = ()  # likeliest first, with the share of each word


def parse_text(
    text: str, vehicles: frozenset[int], *, explain: bool, as_json: bool
) -> tuple[str, bool]:
    """Return the meaning of a question as text or JSON, and whether it was understood."""
    typed = one_line(text)
    readings = interpret(typed)
    best = readings[0]
    meaning = Meaning(
        text=typed,
        query=project_readings(readings),
        acts=best.acts,
        unknown=best.unknown,
        strangers=_strangers(best.acts, vehicles),
        readings=readings if explain else (),
    )
    shown = msgspec.json.encode(meaning).decode() if as_json else _lines(meaning)
    return shown, bool(best.acts)


class Line(msgspec.Struct, frozen=True):
    """A question line."""

    text: str
    id: str | int | float | None = None
    context: tuple[str, ...] | None = None  # the passenger's earlier turns, oldest first


def parse_lines(
    lines: Iterable[str], vehicles: frozenset[int], note: Callable[[str], None]
) -> Iterator[str]:
    """Return the answer line to each question line such as {"id": "q1", "text": "..."}.

    A line that is none is noted, and the others are answered all the same.

    Args:
        lines: the question lines, with the earlier turns in `context` if there are any.
        vehicles: names of the vehicles; a question about another is noted.
        note: is called with notes.

    Raises:
        UsageFault: at the end, if some lines were invalid.
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
        for name in _strangers(parser.read(question.text)[0].acts, vehicles):
            note(f"line {count}: there is no vehicle {name}")
        query = query_of(parser, question.text, question.context or ())
        yield msgspec.json.encode({"id": question.id, "query": query}).decode()
    if broken:
        raise UsageFault(f"{broken} of {count} lines hold no question; see the notes above")


def query_of(parser: Parser, text: str, context: Sequence[str] = ()) -> QueryFields:
    """Return the query fields of a text after earlier turns, oldest first."""
    previous: QueryFields | None = None
    for turn in context:
        found = project_readings(parser.read(turn), previous)
        previous = previous if found.type in TALK else found
    return project_readings(parser.read(text), previous)


def _strangers(acts: tuple[Act, ...], vehicles: frozenset[int]) -> tuple[int, ...]:
    named = {vehicle.number for act in acts for vehicle in parts(act, Vehicle)}
    return tuple(sorted(named - vehicles))


def _lines(meaning: Meaning) -> str:
    """Format the meaning of a question, then its fields, a line each."""
    lines = [_shares(reading.shares) for reading in meaning.readings[:1]]
    lines += [f"{'reading':20} {reading_line(reading)}" for reading in meaning.readings]
    lines.append(f"{'meaning':20} {acts_line(meaning.acts) if meaning.acts else 'not understood'}")
    noted = {"unknown words": meaning.unknown, "no such vehicle": meaning.strangers}
    fields = {**noted, **(msgspec.structs.asdict(meaning.query) if meaning.acts else {})}
    lines += [f"{name:20} {_word(value)}" for name, value in fields.items() if value]
    return "\n".join(line for line in lines if line)


def _word(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def _shares(shares: tuple[TokenShare, ...]) -> str:
    """Format the share of each word, a line each."""
    return "\n".join(
        f"{share.text:20} {share.share:10} {share.read:20} {share.part}".rstrip()
        for share in shares
    )
