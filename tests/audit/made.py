"""Rides of an audit, made up."""

from typing import Any

from xavi_dialogue.audit.audit import Audit, Looked
from xavi_dialogue.audit.questions import Question
from xavi_dialogue.audit.sources import Source
from xavi_dialogue.audit.values import Answered, Choice, Facts, Mistake, Peak

QUESTION = Question("Why?", "end")


def facts(**changed: Any) -> Facts:
    known: dict[str, Any] = {
        "scenario": "s1", "seed": 0, "end": 20.0, "ending": "arrived", "decisions": 20,
        "ride_hash": "aa", "ride_bytes": 10, "collision": None, "braking": Peak(2.0, 5.0),
        "distance": Peak(3.0, 6.0, 1, "blue car 1"),
        "time_to_collision": Peak(2.5, 5.5, 1, "blue car 1"), "choices": (), "mistakes": (),
    }  # fmt: skip
    return Facts(**{**known, **changed})


def answered(text: str = "Because.", **changed: Any) -> Answered:
    known: dict[str, Any] = {"at": 20.0, "kind": "answer", "text": text}
    return Answered(QUESTION.text, QUESTION.when, **{**known, **changed})


def choice(at: float, margin: float, error: float = 0.5) -> Choice:
    return Choice(at, f"trace {at:g}", "continue", "change-left", margin, error)


def mistake(gain: float | None, *, mattered: bool | None = True) -> Mistake:
    return Mistake(
        vehicle=1, who="blue car 1", begin=1.0, end=3.0, expected="the road straight on",
        probability=0.7, came="the road to the right", given=0.2, came_at=8.0, mattered=mattered,
        at=2.0, trace_id="trace 2", chosen="continue", instead="change-left", gain=gain,
    )  # fmt: skip


def audit(*rides: tuple[Facts, Answered]) -> Audit:
    """Return an audit of rides `s1-0`, `s1-1` and so on."""
    looked = tuple(
        Looked(Source(f"s1-{k}", "s1", "content", k), f"key{k}", one, (answer,), f"rides/{k}.gz")
        for k, (one, answer) in enumerate(rides)
    )
    return Audit("program", (QUESTION,), looked, ())
