"""Answers: what the car replies to a question, as a value."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import msgspec

from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.standing import Kind
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.library.decisions import Decision
from xavi_dialogue.library.html import element, listed
from xavi_dialogue.library.pictures import Picture, drawn
from xavi_dialogue.library.trajectories import Compared, Trajectory


@dataclass(frozen=True, slots=True)
class Answer:
    """The reply to one question; a refusal is one too, with its reason."""

    question: str  # as it was asked
    at: float  # [s] when it was asked
    text: str  # the sentences
    kind: Kind  # answer, refusal or clarification
    reason: Reason | None  # why it was not answered; None of an answer
    meaning: tuple[dict[str, Any], ...] = field(repr=False)  # what was asked, act by act
    content: tuple[dict[str, Any], ...] = field(repr=False)  # what was answered, by `is`
    explanation: dict[str, Any] | None = field(repr=False)  # as in `xavi ask --json`
    evidence: Evidence = field(repr=False)  # what it rests on
    choices: tuple[str, ...] = field(repr=False)  # of a clarification: ask with "1" for the first
    suggestions: tuple[str, ...] = field(repr=False)  # what could be asked next
    decision: Decision | None = field(repr=False)  # that it explains
    planned: Trajectory | None = field(repr=False)  # that the car set out on
    ghost: Trajectory | None = field(repr=False)  # that it would have driven otherwise

    def __str__(self) -> str:
        return self.text

    def __hash__(self) -> int:
        return hash((self.question, self.at, self.text, self.kind, self.reason))

    @property
    def map(self) -> Picture | None:
        """The decision on a map, with the plan and the ghost; None where it explains none."""
        if self.decision is None:
            return None
        return drawn(replace(self.decision.view, planned=self.planned, ghost=self.ghost))

    def _repr_html_(self) -> str:
        rests = f"At {self.at:g} s. {_evidence(self.evidence)}"
        if self.reason is not None:
            rests = f"{self.kind.capitalize()}: {self.reason}. {rests}"
        more = self.choices or self.suggestions
        return (
            f"<blockquote>{element('p', self.question)}</blockquote>"
            + "".join(element("p", line) for line in self.text.splitlines())
            + f"<p>{element('small', rests)}</p>"
            + self._shown()
            + (listed(more) if more else "")
        )

    def _shown(self) -> str:
        compares = self.planned is not None or self.ghost is not None
        picture = self.map if compares else None
        return "" if picture is None else picture._repr_html_()


def answer(question: str, reply: Reply, decision: Decision | None, lines: Compared) -> Answer:
    """Return a reply as an answer."""
    return Answer(
        question=question,
        at=reply.sim_time,
        text=reply.text,
        kind=reply.kind,
        reason=reply.reason,
        meaning=reply.acts,
        content=reply.answers,
        explanation=reply.explanation,
        evidence=_evidence_of(reply),
        choices=reply.choices,
        suggestions=reply.suggestions,
        decision=decision,
        planned=lines.planned,
        ghost=lines.ghost,
    )


def told_so_far(owner: object, answers: Iterable[Answer]) -> str:
    """Return the answers of a conversation as HTML, or what it is if there are none yet."""
    return "".join(one._repr_html_() for one in answers) or element("p", repr(owner)[1:-1])


def _evidence_of(reply: Reply) -> Evidence:
    told = (reply.explanation or {}).get("evidence")
    if told is not None:
        return msgspec.convert(told, Evidence)
    return Evidence(traces=() if reply.trace_id is None else (reply.trace_id,))


def _evidence(known: Evidence) -> str:
    if known.rollouts:
        return f"Rests on {known.rollouts} rollouts of {known.distinct_samples} distinct samples."
    return "Rests on the record."
