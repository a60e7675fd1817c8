"""`xavi transcripts --coverage`: what the golden conversations exercise, and what none does.

Counted are types of acts, questions, answers and refusals, reasons, and, as a finer list, the rules
of the question grammar and of all answer grammars, and the alternatives of the latter; and only
what was understood and said. Of which rules and alternatives a question was read and an answer was
made is watched from outside, as coverage tools do, so that parser and realiser need not know.
"""

import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from importlib.resources import files
from types import FrameType
from typing import TypeAlias, get_args

from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Answer, Reason, Refusal
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import Act, Question, Quizzing, Reading
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlg.surface.generator import filled
from xavi_dialogue.nlg.surface.orthography import capitalise
from xavi_dialogue.nlg.surface.realiser import GRAMMARS
from xavi_dialogue.nlg.surface.realiser import grammar as passenger_grammar
from xavi_dialogue.nlg.surface.rules import Alternative, Grammar, load_grammar
from xavi_dialogue.nlu.compose.acts import Composer
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.rules import GRAMMAR_FILES
from xavi_dialogue.nlu.grammar.rules import grammar as question_grammar
from xavi_dialogue.nlu.grounding.result import Grounding
from xavi_dialogue.process.caches import forget
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.transcripts.replay import Written, by_ride, recording, replay_recorded

_RULE = re.compile(r"(?:^!?|->\s*)([a-z]\w*)(?=(?:\.-?\d+)?\s*:|\s*$)")
PAPER = "answer_paper"
RULES_OF, ALTERNATIVES_OF = "rules of {}", "alternatives of {}"
NOT_GIVEN = ("effect-too-small", "no-influence")  # reasons of the contract that no code gives
ACTS, QUESTIONS, ANSWERS, REFUSALS = "types of acts", "questions", "answers", "refusals"
#: An alternative beside its file and its line there.
Placed: TypeAlias = tuple[str, int, str, Alternative]


@dataclass(frozen=True, slots=True, order=True)
class Item:
    """Something that a conversation can exercise."""

    group: str  # the kind of item
    name: str  # with its place in a file, if it has one
    fine: bool = False  # whether it is of the finer list, which is shown but not required


@dataclass(frozen=True, slots=True)
class Coverage:
    """The counts of how often each item was exercised."""

    counts: dict[Item, int]

    @property
    def missing(self) -> tuple[Item, ...]:
        """The items that no conversation exercises, although one should."""
        return tuple(i for i, count in self.counts.items() if count == 0 and not i.fine)

    @property
    def unseen(self) -> tuple[Item, ...]:
        """The rules and alternatives that no conversation exercises."""
        return tuple(i for i, count in self.counts.items() if count == 0 and i.fine)

    def share(self, groups: str) -> float:
        """Return the exercised share of all items in groups with this prefix."""
        counts = [n for item, n in self.counts.items() if item.group.startswith(groups)]
        return sum(map(bool, counts)) / len(counts)

    def table(self) -> str:
        """Format the figures of each group, then the missing items by name, the finer list last."""
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
            *_types(ACTS, Act),
            *_types(QUESTIONS, Question),
            *_types(ANSWERS, Answer),
            *_types(REFUSALS, Refusal),
            *(Item("reasons", name) for name in get_args(Reason) if name not in NOT_GIVEN),
            *_question_rules().values(),
            *rules.values(),
            *alternatives.values(),
        ),
        0,
    )
    for path, about in by_ride(written).items():
        ride = recording(path)
        for one in about:
            readings = _ReadingRecorder()
            forget()
            with _watched(readings) as texts:
                played = replay_recorded(one.transcript, ride, readings.pipeline())
            for item in _exercised(played.replies, readings, texts, (rules, alternatives)):
                counts[item] = counts.get(item, 0) + 1
    return Coverage(counts)


def _types(group: str, union: object) -> Iterator[Item]:
    yield from (Item(group, one.__name__) for one in get_args(union))


def _exercised(
    replies: Iterable[Reply],
    readings: "_ReadingRecorder",
    texts: "_TextRecorder",
    answers: Sequence[dict[int, Item]],
) -> Iterator[Item]:
    """Yield each item that one conversation exercises, as often as it does."""
    said = tuple(reply.text.casefold() for reply in replies)
    for reply in replies:
        yield from _typed(reply)
        if reply.reason is not None:
            yield Item("reasons", reply.reason)
    for text, chosen in texts.spoken:
        if any(text.casefold().rstrip(".?!") in one for one in said):
            yield from (items[id(one)] for items in answers for one in chosen if id(one) in items)
    rules = _question_rules()
    for names in readings.read_by:
        yield from (rules[name] for name in sorted(names & rules.keys()))
    for reading in readings.chosen:
        yield from (Item(ACTS, type(act).__name__) for act in reading.acts)


def _typed(reply: Reply) -> Iterator[Item]:
    """Yield the types of what was asked and answered in a turn."""
    refusals = {one.__name__ for one in get_args(Refusal)}
    for grounded in reply.acts:
        act = grounded["act"]
        assert isinstance(act, dict)
        if "question" in act and act["is"] == "Ask":
            yield Item(QUESTIONS, act["question"]["is"])
    for answer in reply.answers:
        name = str(answer["is"])
        yield Item(REFUSALS if name in refusals else ANSWERS, name)


@dataclass
class _ReadingRecorder:
    """A recorder of the rules that the chosen readings are made of."""

    composed: list[tuple[Node, tuple[tuple[Act, ...], ...]]] = field(default_factory=list)
    read_by: list[frozenset[str]] = field(default_factory=list)  # names of rules, of each text
    chosen: list[Reading] = field(default_factory=list)
    _readings: tuple[Reading, ...] = ()

    def pipeline(self) -> Pipeline:
        """Return the usual pipeline, with its readings recorded here."""
        pipeline = make_pipeline()

        def read(text: str) -> tuple[Reading, ...]:
            self._readings = pipeline.read(text)
            first = self._readings[:1]  # a wish for a quiz needs no grounding
            self.chosen += (r for r in first if any(isinstance(a, Quizzing) for a in r.acts))
            return self._readings

        def ground(
            readings: tuple[Reading, ...], record: Record, discourse: Discourse
        ) -> Grounding:
            found = pipeline.ground(readings, record, discourse)
            if found.reading in readings:
                self._note(self._readings[readings.index(found.reading)])
            self.composed.clear()
            return found

        return replace(pipeline, read=read, ground=ground)

    def _note(self, chosen: Reading) -> None:
        """Record the rules of the units that a reading is composed of."""
        names: set[str] = set()
        self.chosen.append(chosen)
        for unit, ways in self.composed:
            if any(acts and set(acts) <= set(chosen.acts) for acts in ways):
                names |= set(_names(unit))
        self.read_by.append(frozenset(names))


def _names(node: Node) -> Iterator[str]:
    yield node.name
    for part in node.parts:
        if isinstance(part, Node):
            yield from _names(part)


@dataclass
class _TextRecorder:
    """A recorder of finished texts, each with the alternatives chosen since the previous one."""

    readings: _ReadingRecorder
    spoken: list[tuple[str, tuple[Alternative, ...]]] = field(default_factory=list)
    chosen: list[Alternative] = field(default_factory=list)

    def see(self, frame: FrameType, event: str, value: object) -> None:
        """Record a call that returns; the interpreter calls this."""
        if event != "return":
            return
        if frame.f_code is filled.__code__ and value is not None:  # None: a slot had no value
            self.chosen.append(frame.f_locals["alternative"])
        elif frame.f_code is capitalise.__code__ and isinstance(value, str):
            self.spoken.append((value, tuple(self.chosen)))
            self.chosen.clear()
        elif frame.f_code is Composer.compose.__code__ and isinstance(value, list):
            ways = tuple(acts for acts, _ in value)
            self.readings.composed.append((frame.f_locals["unit"], ways))


@contextmanager
def _watched(readings: _ReadingRecorder) -> Iterator[_TextRecorder]:
    """Watch parser and realiser; an active profiler is suspended meanwhile."""
    texts = _TextRecorder(readings)
    before: Callable[..., object] | None = sys.getprofile()
    sys.setprofile(texts.see)
    try:
        yield texts
    finally:
        sys.setprofile(before)


def _answer_rules() -> dict[int, Item]:
    """Return the rules of the answer grammars, by the identity of each of their alternatives."""
    places: dict[tuple[str, str], int] = {}
    items: dict[int, Item] = {}
    for file, line, rule, one in _placed():
        first = places.setdefault((file, rule), line)
        name = f"grammars/{file}:{first}: {rule}"
        items[id(one)] = Item(RULES_OF.format(file), name, fine=True)
    return items


def _alternatives() -> dict[int, Item]:
    """Return all alternatives of the answer grammars, by identity: two may be alike."""
    items: dict[int, Item] = {}
    numbers: dict[tuple[str, str], int] = {}
    for file, line, rule, one in _placed():
        number = numbers[file, rule] = numbers.get((file, rule), 0) + 1
        text = _lines(file)[line - 1]
        text = re.sub(r"^[A-Z_]+\[.*?\]\s*->|^\s*\|", "", text).strip()
        name = f"grammars/{file}:{line}: {rule} {number}: {text}"
        items[id(one)] = Item(ALTERNATIVES_OF.format(file), name, fine=True)
    return items


def _placed() -> Iterator[Placed]:
    """Yield the alternatives of the answer grammars; those for passengers are read as one text."""
    starts, before = [], 0
    for name in GRAMMARS:
        starts.append((before, f"{name}.rules"))
        before += len(_lines(f"{name}.rules"))
    for rule, one in _every(passenger_grammar()):
        start, file = max(place for place in starts if place[0] < one.line)
        yield file, one.line - start, rule, one
    for rule, one in _every(load_grammar(PAPER)):
        yield f"{PAPER}.rules", one.line, rule, one


def _every(grammar: Grammar) -> Iterator[tuple[str, Alternative]]:
    for rule in grammar.values():
        yield from ((rule.name, one) for one in rule.alternatives)


def _lines(file: str) -> list[str]:
    return (files("grammars") / file).read_text(encoding="utf-8").split("\n")


def _question_rules() -> dict[str, Item]:
    """Return the rules of the question grammar that can appear in readings, by name."""
    made = {
        name
        for phrase in question_grammar().phrases
        if not phrase.name.startswith("_")
        for state in phrase.states
        for name, _ in state.complete
    }
    items: dict[str, Item] = {}
    for file in GRAMMAR_FILES:
        for number, line in enumerate(_lines(file), 1):
            for name in _RULE.findall(line):
                if name in made and name not in items:
                    place = f"grammars/{file}:{number}: {name}"
                    items[name] = Item(RULES_OF.format(file), place, fine=True)
    return items
