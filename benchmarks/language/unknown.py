"""`xavi bench unknown`: whether an unknown word in a question is ignored.

An invented word is inserted into questions that are understood without it. A plain answer that does
not mention the word may answer another question than the one that was asked.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from random import Random
from typing import Literal, TypeAlias, get_args

import msgspec

from benchmarks.figures import Aimed, aimed, at_most, in_columns, targets_table
from benchmarks.language.latency import understood
from benchmarks.language.questions import LEARN, read_folder
from planner.record.trace import PlanTrace
from xavi_dialogue.dialogue.manager import fold
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.events import EventRecorded, Input, RideEnded, TraceRecorded
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import Ask
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.text.spelling import corrections
from xavi_dialogue.service.in_process import Conversation, NoPlan, make_pipeline
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide

QUESTIONS = 200
ONSETS = ("bl", "dr", "fl", "gl", "kr", "pl", "skr", "spl", "thr", "vr", "zw", "z")
NUCLEI = ("a", "e", "i", "o", "u", "oo", "ee")
CODAS = ("b", "g", "lk", "mp", "nk", "rb", "rf", "sk", "x", "zz")

#: The result of a question with such a word; "owned up": answered, and the word was named.
Fate: TypeAlias = Literal["plain answer", "owned up", "not understood", "asked back", "declined"]


class Heard(msgspec.Struct, frozen=True):
    """A question with an unknown word, and the reply."""

    text: str
    word: str
    fate: Fate
    reply: str


class UnknownReport(Aimed, frozen=True):
    """The results of the benchmark."""

    bench: str
    questions: int
    plain_answers: int  # answers that do not mention the unknown word
    fates: dict[str, int]
    wrong: tuple[Heard, ...]  # the plain answers

    def table(self) -> str:
        """Return the report for people."""
        rows = [("", "questions"), *((fate, str(n)) for fate, n in self.fates.items())]
        wrong = [f"{one.text}\n    {one.reply}" for one in self.wrong] or ["none"]
        parts = (in_columns(rows), "plain answers:\n" + "\n".join(wrong))
        return "\n\n".join((*parts, targets_table(self.targets)))


def measure(
    questions: Path, ride: Path, number: int, seed: int, note: Callable[[str], None]
) -> UnknownReport:
    """Ask questions with an unknown word.

    Args:
        questions: parent of the folder `learn` with annotated questions.
        ride: the recorded ride that the questions are about.
        number: number of questions.
        seed: of the questions, the words and their places.
        note: is called if there are too few questions.

    Raises:
        QuestionFileError: the questions cannot be read.
        RideFileError: the file is no recorded ride.
    """
    rng, known = Random(seed), ride_file.load(ride.read_bytes())
    texts = [one.text for one in read_folder(questions / LEARN) if not one.context]
    rng.shuffle(texts)
    found: list[Heard] = []
    for text in plain_questions(tuple(dict.fromkeys(texts)), known):
        if len(found) == number:
            break
        found.append(tried(text, rng, known))
    if len(found) < number:
        note(f"only {len(found)} questions are understood and answered as they stand")
    return report(found)


def plain_questions(texts: Sequence[str], ride: RecordedRide) -> Iterator[str]:
    """Yield the questions that have an answer, and of which each word is understood."""
    record = Record(ride.halt, tuple(ride.traces), tuple(ride.events), ride.ended is not None)
    for text in texts:
        found = understood(text, record, Discourse())
        clear = found.refusal is None and found.clarify is None and found.acts
        whole = found.reading is not None and not found.reading.unknown
        asks = all(isinstance(act.act, Ask) for act in found.acts)
        if clear and whole and asks and _asked(text, ride).kind == "answer":
            yield text


def tried(text: str, rng: Random, ride: RecordedRide) -> Heard:
    """Ask a question with an unknown word somewhere in it."""
    word, words = made_up(rng), text.split()
    words.insert(rng.randint(0, len(words) - 1), word)
    asked = " ".join(words)
    reply = _asked(asked, ride)
    return Heard(asked, word, fate(reply, word), reply.text)


def fate(reply: Reply, word: str) -> Fate:
    """Return the kind of result of a question with an unknown word."""
    if reply.kind == "clarification":
        return "asked back"
    if reply.kind == "refusal":
        return "not understood" if reply.reason == "not-understood" else "declined"
    return "owned up" if word in reply.text.casefold() else "plain answer"


def made_up(rng: Random) -> str:
    """Draw a pronounceable word that is not similar to any known word."""
    vocabulary = lexicon().vocabulary
    while True:
        parts = (ONSETS, NUCLEI, CODAS) * rng.randint(1, 2)
        word = "".join(rng.choice(part) for part in parts)
        if word not in vocabulary.words and not corrections(word, vocabulary):
            return word


def report(found: Sequence[Heard]) -> UnknownReport:
    """Count the results."""
    fates = dict.fromkeys(get_args(Fate), 0)
    for one in found:
        fates[one.fate] += 1
    wrong = tuple(one for one in found if one.fate == "plain answer")
    return aimed(
        UnknownReport("unknown", len(found), len(wrong), fates, wrong),
        at_most("plain_answers", "questions", len(wrong) if found else None, 0),
    )


def _asked(text: str, ride: RecordedRide) -> Reply:
    """Ask at the end of a ride, as the first question of a conversation."""
    pipeline = make_pipeline()
    return Conversation(pipeline, _again(ride), _driven(pipeline, ride)).ask(text, ride.halt)


def _driven(pipeline: Pipeline, ride: RecordedRide) -> Dialogue:
    inputs: list[Input] = [*map(TraceRecorded, ride.traces), *map(EventRecorded, ride.events)]
    return fold(pipeline, [*inputs, *([] if ride.ended is None else [RideEnded(ride.ended)])])


def _again(ride: RecordedRide) -> Callable[[PlanTrace, NeedRollout], PlanTrace]:
    """Return a function that plans again from recorded plans."""

    def again(trace: PlanTrace, need: NeedRollout) -> PlanTrace:
        found = ride.whatifs.get(ride_file.key(need))
        if found is None:
            raise NoPlan("planner-unavailable")
        return found

    return again
