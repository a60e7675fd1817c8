"""Yes or no questions and claims, where it is given what propositions come to."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, Told, look, plan
from xavi_dialogue.domain.answers import (
    Staying,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Claim, Whether, Why
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exists,
    Happens,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import verdicts
from xavi_dialogue.explain.answers.reference.findings import Finding

ONE = Vehicle(1)
SPEED = Measure("speed", Ego(), NOW, value=9.0)
A, B = Happens(Event("brake")), Exists(ONE)


class Setting:
    """What propositions come to, and who answers instead."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.known: dict[Any, Finding] = {}
        self.weighed: list[Any] = []
        self.ours: Any = None
        self.handed: Any = {}
        patch.setattr(verdicts, "weigh", self._weigh)
        patch.setattr(verdicts, "whether_ours", self._whether_ours)
        patch.setattr(verdicts, "handed", self._handed)
        patch.setattr(verdicts, "staying", lambda asked, leader: Staying(leader))
        patch.setattr(verdicts, "of_us", lambda *args: Told("of us", (args[0], args[2])))
        measures = "xavi_dialogue.explain.answers.propositions.measures.how_much"
        patch.setattr(measures, lambda question, asked: Told("how much", (question,)))
        patch.setattr(verdicts, "claimed", lambda found, amount: (found, amount))
        self.asked_ours: list[Any] = []

    def _weigh(self, of: Any, asked: Any) -> Finding:
        self.weighed.append(of)
        return self.known.get(of, Finding(False))

    def _whether_ours(self, question: Whether, asked: Any) -> Any:
        self.asked_ours.append(question)
        return self.ours

    def _handed(self, why: Why, asked: Any) -> Any:
        found = self.handed.get(why.of)
        if isinstance(found, Exception):
            raise found
        return found


def whether(
    that: Any, span: Span | None = None, tag: bool = False, **more: Any
) -> Any:  # fmt: skip
    given = {"looks": {1: look(1)}, "traces": (plan(NOW),)} | more
    return verdicts.whether(Whether(that, tag), Given(**given).asked(span))


def claim(that: Any, span: Span | None = None, challenge: bool = False, **more: Any) -> Any:
    given = {"looks": {1: look(1)}, "traces": (plan(NOW),)} | more
    return verdicts.claim(Claim(that, challenge), Given(**given).asked(span))
