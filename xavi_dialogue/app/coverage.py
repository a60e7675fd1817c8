"""`xavi transcripts --coverage`: what the golden conversations exercise, and what none does.

Counted are question types, reasons for refusals, the rules of the question grammar and of all
answer grammars, and, as a finer list, the alternatives of the latter; and only what was understood
and said. Which alternatives an answer was made of is watched from outside, as coverage tools do, so
that the realiser need not know.
"""

import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from types import FrameType
from typing import get_args

from xavi_dialogue.app.golden import Written, by_ride, recording, replay_recorded
from xavi_dialogue.app.local import make_mind
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.explain.explanation import Reason
from xavi_dialogue.explain.query import Query, QueryType
from xavi_dialogue.language.generator import choose
from xavi_dialogue.language.grammar import GRAMMAR_FILES, grammar, rules_of
from xavi_dialogue.language.orthography import capitalise
from xavi_dialogue.language.parse import NotUnderstood, ParseReport, explained
from xavi_dialogue.language.rules import Alternative, load_grammar

_RULE = re.compile(r"^[?!]?([a-z_]\w*)\s*:(?!:)")


@dataclass(frozen=True, slots=True, order=True)
class Item:
    """Something that a conversation may exercise."""

    group: str  # what it is one of
    name: str  # with the place in its file, where it stands in one
    fine: bool = False  # one of several that do for another item


@dataclass(frozen=True, slots=True)
class Coverage:
    """How often each item was exercised."""

    counts: dict[Item, int]

    @property
    def missing(self) -> tuple[Item, ...]:
        """What no conversation exercises, and one should."""
        return tuple(i for i, count in self.counts.items() if count == 0 and not i.fine)

    @property
    def unseen(self) -> tuple[Item, ...]:
        """The alternatives that no conversation exercises."""
        return tuple(i for i, count in self.counts.items() if count == 0 and i.fine)

    def table(self) -> str:
        """The figures of each group, then what is missing by name, the finer list last."""
        lines = []
        for group in dict.fromkeys(item.group for item in self.counts):
            counts = [count for item, count in self.counts.items() if item.group == group]
            lines.append(f"{group:40} {sum(map(bool, counts)):4} of {len(counts):4}")
        for title, items in (("not exercised:", self.missing), ("not seen:", self.unseen)):
            lines += ["", title] if items else []
            lines += [f"  {item.group}: {item.name}" for item in items]
        return "\n".join(lines)


def measure(written: Sequence[Written]) -> Coverage:
    """Replay transcripts from their recordings and count what they exercise.

    Raises:
        RideFileError: a recording is missing, or lacks a plan.
    """
    rules, alternatives = _answer_rules(), _alternatives()
    counts = dict.fromkeys(
        (
            *(Item("question types", name) for name in get_args(QueryType)),
            *(Item("reasons", name) for name in get_args(Reason)),
            *_question_rules().values(),
            *rules.values(),
            *alternatives.values(),
        ),
        0,
    )
    for path, about in by_ride(written).items():
        ride = recording(path)
        for one in about:
            ear = _Ear()
            with _watched() as mouth:
                played = replay_recorded(one.transcript, ride, ear.mind())
            for item in _exercised(played.replies, ear, mouth, (rules, alternatives)):
                counts[item] += 1
    return Coverage(counts)


def _exercised(
    replies: Iterable[Reply], ear: "_Ear", mouth: "_Mouth", answers: Sequence[dict[int, Item]]
) -> Iterator[Item]:
    """What one conversation exercises; each as often as it does."""
    said = tuple(reply.text.casefold() for reply in replies)
    for reply in replies:
        if reply.query is not None:
            yield Item("question types", reply.query.type)
        elif reply.kind == "clarification":
            yield Item("question types", "ambiguous")
        if reply.reason is not None:
            yield Item("reasons", reply.reason)
    for text, chosen in mouth.spoken:
        if any(text.casefold() in one for one in said):
            yield from (items[id(one)] for items in answers for one in chosen)
    rules = _question_rules()
    for report in ear.reports:
        if isinstance(report.result, Query) and report.readings:
            best = report.readings[0]
            if best.tree is not None and best.query == report.result:
                yield from (rules[name] for name in sorted(rules_of(best.tree) & rules.keys()))


@dataclass
class _Ear:
    """What the parser reported of all that it was asked about."""

    reports: list[ParseReport] = field(default_factory=list)

    def mind(self) -> Mind:
        """Our mind, hearing with this ear."""
        return replace(make_mind(), parse=self._parse)

    def _parse(
        self, text: str, vehicles: frozenset[int], previous: Query | None
    ) -> Query | NotUnderstood:
        self.reports.append(explained(text, previous, vehicles))
        return self.reports[-1].result


@dataclass
class _Mouth:
    """All texts that were finished, each with the alternatives chosen since the one before."""

    spoken: list[tuple[str, tuple[Alternative, ...]]] = field(default_factory=list)
    chosen: list[Alternative] = field(default_factory=list)

    def see(self, frame: FrameType, event: str, value: object) -> None:
        """Take note of a call that returns; to be called by the interpreter."""
        if event != "return":
            return
        if frame.f_code is choose.__code__ and isinstance(value, Alternative):
            self.chosen.append(value)
        elif frame.f_code is capitalise.__code__ and isinstance(value, str):
            self.spoken.append((value, tuple(self.chosen)))
            self.chosen.clear()


@contextmanager
def _watched() -> Iterator[_Mouth]:
    """Watch what the realiser does. A profiler that is at work has to wait."""
    mouth = _Mouth()
    before: Callable[..., object] | None = sys.getprofile()
    sys.setprofile(mouth.see)
    try:
        yield mouth
    finally:
        sys.setprofile(before)


def _answer_rules() -> dict[int, Item]:
    """The rules of the answer grammars, by the identity of each of their alternatives."""
    items: dict[int, Item] = {}
    for path in _grammars():
        for rule in load_grammar(path.name.removesuffix(".rules")).values():
            name = f"grammars/{path.name}:{rule.alternatives[0].line}: {rule.name}"
            item = Item(f"rules of {path.name}", name)
            items |= {id(one): item for one in rule.alternatives}
    return items


def _alternatives() -> dict[int, Item]:
    """All alternatives of the answer grammars, by identity: two may be alike."""
    items: dict[int, Item] = {}
    for path in _grammars():
        lines = path.read_text(encoding="utf-8").splitlines()
        for rule in load_grammar(path.name.removesuffix(".rules")).values():
            for number, one in enumerate(rule.alternatives, 1):
                text = re.sub(r"^[A-Z_]+\[.*?\]\s*->|^\s*\|", "", lines[one.line - 1]).strip()
                name = f"grammars/{path.name}:{one.line}: {rule.name} {number}: {text}"
                items[id(one)] = Item(f"alternatives of {path.name}", name, fine=True)
    return items


def _grammars() -> list[Traversable]:
    """The files of the answer grammars, by name."""
    paths = sorted(files("grammars").iterdir(), key=lambda path: path.name)
    return [path for path in paths if path.name.endswith(".rules")]


def _question_rules() -> dict[str, Item]:
    """The rules of the question grammar, by name."""
    made = {rule.origin.name for rule in grammar().rules}
    items: dict[str, Item] = {}
    for name in GRAMMAR_FILES:
        lines = (files("grammars") / name).read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines, 1):
            found = _RULE.match(line)
            if found is not None and found[1] in made:
                place = f"grammars/{name}:{number}: {found[1]}"
                items[found[1]] = Item(f"rules of {name}", place)
    return items
