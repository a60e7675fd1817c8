"""Replies of passengers to our questions, and their judgement. Pure."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Literal, TypeAlias, get_args

from planner.record.trace import Action
from xavi_dialogue.dialogue.state.turn import Judgement, Quiz
from xavi_dialogue.domain.meaning import Act, Ask, Reading
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import Event, Thing, Vehicle

Sign: TypeAlias = Literal[
    "passed", "same", "other", "sooner", "later", "yes", "no", "nobody", "another"
]
#: By action that a passenger names: the macro actions that it may mean.
_ALIKE: Mapping[str, tuple[Action, ...]] = {
    "continue": ("continue", "exit-straight"),
    "exit-straight": ("continue", "exit-straight"),
    "go": ("continue", "exit-straight"),
    "move": ("continue", "exit-straight"),
    "keep-lane": ("continue",),
    "change-lane": ("change-left", "change-right"),
    "turn": ("exit-left", "exit-right"),
    "overtake": ("change-left", "change-right"),
    "give-way": ("stop",),
    "wait": ("stop",),
    "brake": ("stop",),
    "stand": ("stop",),
}


def signs(text: str) -> frozenset[Sign]:
    """Return the signs in a text, other than vehicles and actions."""
    bare = " ".join(re.sub(r"[^\w'\s]", " ", text.casefold()).split())
    return frozenset(name for name, one in _patterns().items() if one.search(bare))


def judged(
    quiz: Quiz, said: frozenset[Sign], reading: Reading | None, meant: Sequence[Thing]
) -> Judgement | None:
    """Return the judgement of a reply; None if the text is not a reply.

    It is "passed" if the passenger does not know, or does not settle on one answer.

    Args:
        quiz: the question.
        said: the signs in the reply.
        reading: the reply as understood, if at all.
        meant: the vehicles that it names, grounded.
    """
    acts = () if reading is None else reading.acts
    found = {"vehicle": _vehicle, "deed": _deed, "sooner": _sooner}[quiz.posed.kind](
        quiz, said, acts, meant
    )
    if found is not None:
        return found
    return "passed" if "passed" in said else None


def _vehicle(
    quiz: Quiz, said: frozenset[Sign], _: Sequence[Act], meant: Sequence[Thing]
) -> Judgement | None:
    numbers = [thing.number for thing in meant if isinstance(thing, Vehicle)]
    if numbers:
        return "right" if set(numbers) == {quiz.vehicle} else "wrong"
    return "wrong" if "nobody" in said else None


def _deed(
    quiz: Quiz, said: frozenset[Sign], acts: Sequence[Act], _: Sequence[Thing]
) -> Judgement | None:
    if "other" in said:
        return "wrong" if quiz.same else "passed"
    if "same" in said:
        return "right" if quiz.same else "wrong"
    if any(isinstance(act, Ask) for act in acts):
        return None
    named = [event for act in acts for event in _events(act)]
    if named:
        return "right" if _is(named[0], quiz.actions) else "wrong"
    faster = _direction(said)
    if faster is None:
        return None
    if quiz.sooner is None:
        return "passed"
    return "right" if quiz.same and faster is quiz.sooner else "wrong"


def _sooner(
    quiz: Quiz, said: frozenset[Sign], _: Sequence[Act], __: Sequence[Thing]
) -> Judgement | None:
    if {"sooner", "later"} <= said:
        return "passed"
    faster = _direction(said)
    if faster is not None:
        return "right" if faster is quiz.sooner else "wrong"
    if "same" in said:
        return "wrong"
    return None


def _direction(said: frozenset[Sign]) -> bool | None:
    return None if ("sooner" in said) is ("later" in said) else "sooner" in said


def _events(act: Act) -> list[Event]:
    return list(parts(act, Event))


def _is(event: Event, actions: tuple[Action, ...]) -> bool:
    if event.action in ("turn", "change-lane") and event.side in ("left", "right"):
        kind = "exit" if event.action == "turn" else "change"
        return f"{kind}-{event.side}" in actions
    alike = _ALIKE.get(event.action, ())
    return event.action in actions or bool(set(alike) & set(actions))


@cache
def _patterns() -> Mapping[Sign, re.Pattern[str]]:
    path = files("grammars").joinpath("quiz_replies.toml")
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    names: tuple[Sign, ...] = get_args(Sign)
    return {name: re.compile("|".join(data[name]["patterns"])) for name in names}
