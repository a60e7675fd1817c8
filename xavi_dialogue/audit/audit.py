"""An audit: what it covers, how it is run, and what it collects."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from os.path import relpath
from pathlib import Path
from typing import TypeAlias

from xavi_dialogue.audit.program import program
from xavi_dialogue.audit.questions import Question
from xavi_dialogue.audit.running.local import Result
from xavi_dialogue.audit.sources import Source
from xavi_dialogue.audit.store import Store, keys
from xavi_dialogue.audit.values import Answered, Facts, Failed
from xavi_dialogue.audit.work import Task

#: Works on tasks and yields results as they come; calls the function when a worker has died.
Runner: TypeAlias = Callable[[Sequence[Task], Callable[[], None]], Iterator[Result]]


@dataclass(frozen=True, slots=True)
class Looked:
    """One ride with all that is known of it."""

    source: Source
    key: str  # of the ride
    facts: Facts
    answers: tuple[Answered, ...]
    file: str  # of the ride, seen from the folder of the audit


@dataclass(frozen=True, slots=True)
class Audit:
    """The rides of an audit in order, and those that failed with the reason."""

    program: str
    questions: tuple[Question, ...]
    rides: tuple[Looked, ...]
    failed: tuple[tuple[Source, str], ...]


@dataclass(frozen=True, slots=True)
class Progress:
    """Who is told how an audit gets on."""

    begin: Callable[[int, int], None]  # number of rides, and of those that are known
    step: Callable[[], None]  # after each ride
    lost: Callable[[], None]  # a worker has died


def run(
    sources: Sequence[Source],
    questions: tuple[Question, ...],
    store: Store,
    runner: Runner,
    progress: Progress,
) -> Audit:
    """Do what is not stored yet, store it, and return all of it.

    Raises:
        AuditError: the runner cannot be used.
        AuditFailed: the runner broke off, or results cannot be written.
    """
    version = program()
    tasks = [
        store.task(version, source, questions)
        for source in sources
        if not _known(store, version, source, questions)
    ]
    progress.begin(len(sources), len(sources) - len(tasks))
    failures: dict[str, str] = {}
    for task, result in runner(tasks, progress.lost):
        if isinstance(result, Failed):
            failures[task.source.ride] = result.why
        else:
            store.keep(task, result)
        progress.step()
    return _collected(sources, questions, store, failures)


def _known(store: Store, version: str, source: Source, questions: tuple[Question, ...]) -> bool:
    ride, answers = keys(version, source, questions)
    facts = store.facts(ride)
    there = facts is not None and (source.seed is None or store.whole(ride, facts))
    return there and store.answers(answers) is not None


def _collected(
    sources: Sequence[Source],
    questions: tuple[Question, ...],
    store: Store,
    failures: dict[str, str],
) -> Audit:
    version = program()
    rides, failed = [], []
    for source in sources:
        key, asked = keys(version, source, questions)
        facts, answers = store.facts(key), store.answers(asked)
        if facts is None or answers is None:
            failed.append((source, failures.get(source.ride, "its result cannot be read")))
        else:
            rides.append(Looked(source, key, facts, answers, _file(store, source, key)))
    return Audit(version, questions, tuple(rides), tuple(failed))


def _file(store: Store, source: Source, key: str) -> str:
    if source.seed is None:
        # from where the folder really is, as `..` leads out of that
        return Path(relpath(source.place, store.folder.resolve())).as_posix()
    return store.ride(key).relative_to(store.folder).as_posix()
