"""Suppositions, with stand-ins for those who answer them and for planning again."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, Told, look, plan
from xavi_dialogue.domain.answers import Contrast, Effect, Evidence
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import WhatIf
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exists,
    Happens,
    Not,
    Vehicle,
)
from xavi_dialogue.explain.answers.suppositions import reacting, supposing

ONE = Vehicle(1)
LATER = Contrast((), (), None, (Effect("time", "s", 4.0, 1.0, 6.0, 9, 9),), (), Evidence(), NOW)


class Found:
    """What planning again comes to."""

    def __init__(self, by: str, args: tuple[Any, ...], plan: Any, **more: Any) -> None:
        self.by, self.args, self.more = by, args, more
        self.prior, self.proxy, self.same, self.contrast = 0.3, more.get("proxy"), False, LATER
        self.trace, self.again = "before", "after"
        self.here = type("Here", (), {"plan": ("continue",)})()
        self.there = type("There", (), {"plan": plan})()


class Setting:
    """Who is asked; a test sets what planning again comes to."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.plan: Any = ("stop",)
        self.proxy: Any = None
        self.found: list[Found] = []
        self.shares: dict[Any, Any] = {}
        self.drove: Any = None
        self.open = 3.0
        self.happens: bool | None = None  # without a vehicle, as the reason is tried
        for name in ("hastened", "closeness", "freed", "of_us", "undone"):
            patch.setattr(supposing, name, self._teller(name))
        for name in ("reaction", "for_anybody"):
            patch.setattr(reacting, name, self._teller(name))
        patch.setattr(reacting, "is_sudden", lambda *args, **more: False)
        patch.setattr(supposing, "without", lambda *args: self._found("without", args))
        patch.setattr(supposing, "without_at", self._tried)
        patch.setattr(supposing, "otherwise", lambda *a, **m: self._found("otherwise", a, **m))
        patch.setattr(supposing, "share_of", lambda t, plan, name: self.shares.get((t, name)))
        patch.setattr(supposing, "driven", lambda scene, then: self.drove)
        patch.setattr(supposing, "moment", lambda scene, then, drove, past: 12.0 if past else NOW)
        patch.setattr(supposing, "open_until", lambda scene, v, event, at: self.open)

    def _teller(self, name: str) -> Any:
        return lambda *args, **more: Told(name, args, more)

    def _tried(self, *args: Any) -> Any:
        return None if self.happens is None else (self._found("without-at", args), self.happens)

    def _found(self, by: str, args: tuple[Any, ...], **more: Any) -> Found:
        found = Found(by, args[1:], self.plan, proxy=self.proxy, **more)
        self.found.append(found)
        return found


def what_if(of: Any, then: Any = None, span: Span | None = None, **more: Any) -> Any:
    given = {
        "looks": {1: look(1), 2: look(2)},
        "traces": (plan(NOW, "continue"),),
        "measures": {("arrival-time", Ego()): 50.0, ("speed", Ego()): 9.0},
    }
    return supposing.what_if(WhatIf(of, then), Given(**given | more).asked(span))


def did(action: Any, actor: Any = ONE, **more: Any) -> Happens:
    return Happens(Event(action, actor, **more))


GONE = Not(Exists(ONE))
TURNS = did("exit-right", tense="present")
