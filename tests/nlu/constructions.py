"""Constructions: the same question said in many ways, each read like its plainest way.

    python -m tests.nlu.constructions [GROUP] [-v]

`constructions.toml` has frames for spoken English, each with a plain frame of the same meaning;
here they are filled with verbs, measures and road users. A text holds if it has the acts of the
plain texts, apart from tense and from acts that ask nothing, and no word without a part in it.
"""

import sys
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from msgspec import structs

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Elliptic,
    Feel,
    Reading,
    Repair,
    Social,
    Whether,
)
from xavi_dialogue.domain.terms import Believed, Described, Pronoun, Thing, Vehicle
from xavi_dialogue.nlu.notation import acts_line, compact
from xavi_dialogue.nlu.parse import Parser

TABLE = Path(__file__).with_suffix(".toml")
DEEDS = (
    ("brake", "brakes", "braked", "braked", "braking"),
    ("slow down", "slows down", "slowed down", "slowed down", "slowing down"),
    ("stop", "stops", "stopped", "stopped", "stopping"),
    ("turn left", "turns left", "turned left", "turned left", "turning left"),
    ("change lanes", "changes lanes", "changed lanes", "changed lanes", "changing lanes"),
    ("overtake the bus", "overtakes the bus", "overtook the bus", "overtaken the bus",
     "overtaking the bus"),
    ("cut in", "cuts in", "cut in", "cut in", "cutting in"),
    ("pull out", "pulls out", "pulled out", "pulled out", "pulling out"),
    ("wait", "waits", "waited", "waited", "waiting"),
    ("give way", "gives way", "gave way", "given way", "giving way"),
    ("go straight on", "goes straight on", "went straight on", "gone straight on",
     "going straight on"),
    ("speed up", "speeds up", "sped up", "sped up", "speeding up"),
)  # fmt: skip
# A question and the same as a clause; {s} is our car or another, {v} always another.
QUESTIONS = (
    ("how fast {is} {s} going", "how fast {s} {is} going"),
    ("how fast {was} {s} going", "how fast {s} {was} going"),
    ("how far away is {v}", "how far away {v} is"),
    ("how far behind was {v}", "how far behind {v} was"),
    ("which lane {is} {s} in", "which lane {s} {is} in"),
    ("what is the speed limit", "what the speed limit is"),
    ("how far is it to the destination", "how far it is to the destination"),
    ("who has priority", "who has priority"),
    ("how hard did {s} brake", "how hard {s} braked"),
    ("will {v} turn left", "whether {v} will turn left"),
    ("how likely is it that {v} turns left", "how likely it is that {v} turns left"),
    ("can you see {v}", "if you can see {v}"),
    ("is {v} indicating left", "if {v} is indicating left"),
    ("how close did {v} come to us", "how close {v} came to us"),
    ("how much time did we lose", "how much time we lost"),
    ("what {was} {s} waiting for", "what {s} {was} waiting for"),
    ("why did {s} brake", "why {s} braked"),
    ("where is {v} going", "where {v} is going"),
    ("does {v} have to give way to us", "whether {v} has to give way to us"),
    ("how long did {s} wait", "how long {s} waited"),
)
ROAD_USERS = ("vehicle 7", "the red car", "he")
HIM = {"vehicle 7": "it", "the red car": "it", "he": "he", "the white van": "he"}
SILENT = (Social, Feel)  # acts that ask nothing
SAME = Pronoun("it")  # what stands for the road user in question in comparing
DECLINED, WRONG = "declined", "wrong"


@dataclass(frozen=True, slots=True)
class Case:
    """A text, its construction, and plain texts of the same meaning."""

    group: str
    frame: str
    text: str
    plain: tuple[str, ...]
    who: str


def cases() -> Iterator[Case]:
    """Fill each frame with each predicate, of us and of another road user."""
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    turn = 0
    for sort, fill in (("deeds", _deeds), ("questions", _questions), ("pairs", _pairs)):
        for group, frames in table[sort].items():
            for frame, plain in frames.items():
                turn += 1
                for who, slots in fill(frame + plain, turn):
                    rows = tuple(part.strip().format(**slots) for part in plain.split("||"))
                    yield Case(group, frame, frame.format(**slots), rows, who)


def _deeds(frame: str, turn: int) -> Iterator[tuple[str, dict[str, str]]]:
    for index, forms in enumerate(DEEDS):
        for who in ("you", ROAD_USERS[(index + turn) % len(ROAD_USERS)]):
            if who == "he" and "{he}" in frame and "{s}" in frame.split("?")[0].lower():
                who = "the red car"
            slots = _slots(who)
            if who == "you" and any(word in frame for word in ("{S}, {he}", ", {s}?", "{o}, ")):
                continue
            base, third, past, part, ing = forms
            fin = base if who == "you" else third
            yield who, slots | {
                "base": base, "past": past, "part": part, "ing": ing, "fin": fin,
            }  # fmt: skip


def _questions(frame: str, turn: int) -> Iterator[tuple[str, dict[str, str]]]:
    for index, (direct, clause) in enumerate(QUESTIONS):
        for who in ("you", ROAD_USERS[(index + turn) % len(ROAD_USERS)]):
            if who == "you" and "{s}" not in direct and "{v}" in direct:
                continue
            if who != "you" and "{s}" not in direct and "{v}" not in direct:
                continue
            slots = _slots(who)
            asked = direct.format(**slots)
            yield who, {"q": asked, "Q": _capital(asked), "e": clause.format(**slots)}


def _pairs(frame: str, turn: int) -> Iterator[tuple[str, dict[str, str]]]:
    for who in ("vehicle 7", "the red car", "the white van"):
        yield who, _slots(who) | {"him": HIM[who]}
        if "{v}" not in frame:
            return


def _slots(who: str) -> dict[str, str]:
    us = who == "you"
    slots = {
        "s": who, "v": who, "o": {"you": "you", "he": "him"}.get(who, who),
        "he": "you" if us else HIM[who], "did": "did", "does": "do" if us else "does",
        "is": "are" if us else "is", "was": "were" if us else "was",
        "has": "have" if us else "has",
    }  # fmt: skip
    return slots | {_capital(key): _capital(slots[key]) for key in ("s", "v", "is", "was")}


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]


@cache
def _parser() -> Parser:
    return Parser()


def outcome(case: Case) -> str:
    """Say whether a text is read as it is meant: "" if so, else declined or wrong."""
    best = _parser().read(case.text)[0]
    wanted = [act for text in case.plain for act in _parser().read(text)[0].acts]
    got, gold = _row(best.acts, case.who), _row(tuple(wanted), case.who)
    if not got or best.unknown or best.unread:
        return DECLINED
    return "" if got == gold else WRONG


def _row(acts: tuple[Act, ...], who: str) -> list[str]:
    """Write acts for comparing."""
    named = _named(who)
    return [compact(_plain(act, named)) for act in acts if not isinstance(act, SILENT)]


@cache
def _named(who: str) -> Thing | None:
    if who in ("you", "he"):
        return None
    if who == "vehicle 7":
        return Vehicle(7)
    (act,) = _parser().read(f"Did {who} stop?")[0].acts
    return act.question.that.event.actor  # type: ignore[union-attr]


def _is_named(value: Any, named: Thing | None) -> bool:
    """Say whether a thing is the road user in question, whatever else is said of it."""
    if isinstance(value, Described) and isinstance(named, Described):
        return (value.kind, value.colour) == (named.kind, named.colour)
    return named is not None and bool(value == named)


def _plain(value: Any, named: Thing | None) -> Any:
    """Leave out of a term what does not count: tense, tags, how the road user is named."""
    if isinstance(value, tuple):
        return tuple(_plain(one, named) for one in value)
    if _is_named(value, named) or (isinstance(value, Pronoun) and value.form in ("he", "she")):
        return SAME
    match value:
        case Claim(that=that):
            return _plain(Ask(Whether(that)), named)
        case Believed(content=content, tense="present"):  # what we think, we say
            return _plain(content, named)
        case Repair(kind="why"):  # beside a question, it asks why that is so
            return Elliptic(form="why")
    if not isinstance(value, Value):
        return value
    inner = {name: _plain(getattr(value, name), named) for name in value.__struct_fields__}
    inner |= {"tense": "present"} if "tense" in inner else {}
    inner |= {"tag": False} if "tag" in inner else {}
    inner |= {"modal": None} if inner.get("modal") in ("will", "must", "would") else {}
    return structs.replace(value, **inner)


Found = list[tuple[Case, str]]


def report(found: Found, *, verbose: bool) -> str:
    """Write the shares read as meant, by group, and what is not, by construction."""
    groups = dict.fromkeys(case.group for case, _ in found)
    lines = [_line(group, [row for row in found if row[0].group == group]) for group in groups]
    lines.append(_line("all", found))
    if not verbose:
        return "\n".join(lines)
    frames: dict[tuple[str, str], Found] = {}
    for case, end in found:
        frames.setdefault((case.group, case.frame), []).append((case, end))
    for (group, frame), rows in sorted(frames.items(), key=lambda entry: _share(entry[1])):
        bad = [row for row in rows if row[1]]
        if bad:
            lines.append(f"\n{group}: {frame}   {len(rows) - len(bad)} of {len(rows)}")
            lines += [_told(case, end) for case, end in bad[:3]]
    return "\n".join(lines)


def _share(rows: Found) -> float:
    return sum(not end for _, end in rows) / len(rows)


def _line(name: str, rows: Found) -> str:
    ends = Counter(end for _, end in rows)
    return (
        f"{name:14} {100 * _share(rows):5.1f} % of {len(rows):4}   "
        f"declined {ends[DECLINED]:4}   wrong {ends[WRONG]:4}"
    )


def _told(case: Case, end: str) -> str:
    best: Reading = _parser().read(case.text)[0]
    gold = "; ".join(acts_line(_parser().read(text)[0].acts) for text in case.plain)
    unknown = " ".join(best.unknown)
    return (
        f"  {end:8} {case.text}\n      got  {acts_line(best.acts)} ?{unknown} {best.cost}\n"
        f"      want {gold}"
    )


def main() -> None:
    """Write the report for the groups that are named."""
    only = [word for word in sys.argv[1:] if word != "-v"]
    found = [(case, outcome(case)) for case in cases() if not only or case.group in only]
    sys.stdout.write(report(found, verbose="-v" in sys.argv) + "\n")


if __name__ == "__main__":
    main()
