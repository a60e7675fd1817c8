"""Requests to a car of which it is given what it does and foresees."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, deed, look, plan
from xavi_dialogue.domain.answers import (
    Activity,
    Measures,
    MotionCause,
    MotionReason,
    PlanAhead,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Request
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.explain.answers import requests
from xavi_dialogue.explain.answers.expectations.foreseen import sided
from xavi_dialogue.explain.answers.reasons import motions, refraining
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.causes.vehicles.course import Expected

ONE = Vehicle(1)
SPEED = Measure("speed", Ego(), NOW, value=12.0)
WAIT = Measure("waiting-time", Ego(), NOW, value=4.0)
TURN, LEFT = Measure("turn", Ego(), NOW, value=50.0), Measure("time-to-go", Ego(), NOW, value=30.0)
LEADER = MotionCause("leader", 1)
BRAKING = deed("slow-down", 18.0)


class Setting:
    """What we do and foresee; a test sets what it needs."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.trend: Any = "steady"
        self.foreseen: dict[Any, Expected] = {}
        self.stands = False
        self.asked: list[Event] = []
        self.causes: Any = (LEADER,)
        self.staying: Any = None
        patch.setattr(requests, "activity", self._activity)
        ahead = PlanAhead((("continue", NOW),), (TURN, LEFT))
        patch.setattr(requests, "plan_ahead", lambda asked: ahead)
        patch.setattr(requests, "foreseen", self._foreseen)
        patch.setattr(requests, "stands", lambda asked: self.stands)
        patch.setattr(requests, "remaining_wait", lambda asked: WAIT)
        patch.setattr(requests, "speed_of", lambda asked: Measures((SPEED,)))
        patch.setattr(motions, "motion", self._motion)
        patch.setattr(refraining, "not_passed", self._not_passed)

    def _activity(self, *_: Any) -> Activity:
        return Activity(Ego(), NOW, (), 9.0, self.trend)

    def _foreseen(self, asked: Any, event: Event) -> Expected | None:
        self.asked.append(event)
        return self.foreseen.get(sided(event))

    def _motion(self, event: Event, asked: Any) -> Any:
        self.asked.append(event)
        if not isinstance(self.causes, tuple):
            raise Unanswered(self.causes)
        return MotionReason(BRAKING, self.causes)

    def _not_passed(self, event: Event, asked: Any) -> Any:
        self.asked.append(event)
        return self.staying

    def expects(self, action: str, share: float, in_: float = 2.0) -> None:
        time = NOW + in_
        self.foreseen[action] = Expected(share, time, time, time)


def reply(event: Event, *, negated: bool = False, **more: Any) -> Any:
    given = {"looks": {1: look(1)}, "traces": (plan(NOW, "continue"),)} | more
    return requests.request(Request(event, negated), Given(**given).asked())


def to(action: Any, **more: Any) -> Event:
    return Event(action, **({"tense": "present"} | more))
