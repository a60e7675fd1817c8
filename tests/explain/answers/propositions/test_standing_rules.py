"""Rules at a crossing for people on foot, and to whom we gave way over the ride."""

from types import SimpleNamespace
from typing import Any

import pytest

from xavi_dialogue.domain.answers import Priority
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import WhatIf, Whether
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Nobody,
    Related,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.propositions import standing_rules
from xavi_dialogue.explain.answers.reference.findings import Finding

CROSSING = Related("near", Ego(), Feature("crossing"))
STOP = Event("stop", tense="present", modal="must", where=CROSSING)
MUST = Whether(Happens(Event("stop", tense="present", modal="must")))
SOMEBODY = Nobody(Described(definite=False))


@pytest.mark.parametrize(
    ("event", "asked"),
    [
        (STOP, True),
        (Event("stop", tense="present", where=CROSSING), False),
        (Event("stop", tense="present", modal="must"), False),
        (Event("stop", Vehicle(1), tense="present", modal="must", where=CROSSING), False),
    ],
)
def test_it_is_asked_of_a_crossing_whether_we_must_stop(event: Event, asked: bool) -> None:
    assert standing_rules.at_crossing(Happens(event)) is asked


@pytest.mark.parametrize("walker", [None, 7])
def test_we_stop_for_who_walks_there(monkeypatch: pytest.MonkeyPatch, walker: int | None) -> None:
    rule = Priority(4.0, "give-way", walker, why="on-foot")
    monkeypatch.setattr(standing_rules, "_walker", lambda asked: walker)
    monkeypatch.setattr(standing_rules, "priority_at", lambda asked, one, about: rule)
    found: Any = standing_rules.whether(Whether(Happens(STOP)), SimpleNamespace(now=4.0))  # type: ignore[arg-type]
    assert (found.vehicle, found.holds, found.walkers) == (walker, walker is not None, not walker)


@pytest.mark.parametrize(
    ("supposed", "then", "holds"),
    [
        (Happens(Event("cross", SOMEBODY, Ego(), tense="present")), MUST, True),
        (Related("on", Nobody(), Feature("crossing")), MUST, False),
        (Happens(Event("cross", SOMEBODY, Ego(), tense="present")), None, None),
        (Happens(Event("brake", Vehicle(1), tense="present")), MUST, None),
    ],
)
def test_the_rule_tells_where_a_walker_is_supposed(supposed: Any, then: Any, holds: Any) -> None:
    question = WhatIf(supposed, then)
    assert standing_rules.supposes_walker(question) is (holds is not None)
    if holds is not None:
        found: Any = standing_rules.supposed(question, SimpleNamespace(now=4.0))  # type: ignore[arg-type]
        assert found.holds is holds


@pytest.mark.parametrize("other", [Vehicle(1), Vehicle(2), Everyone()])
def test_over_the_ride_it_counts_to_whom_we_gave_way(other: Any) -> None:
    given = Episode(Ego(), "give-way", 4.0, 6.0, object=Vehicle(1))
    light = Episode(Ego(), "wait", 8.0, 9.0, object=None)
    world = SimpleNamespace(episodes=lambda **_: (given, light))
    event = Event("let-go", object=other, time=WholeRide(), modal="must")
    found: Finding = standing_rules.ever_given(SimpleNamespace(world=world, now=10.0), event)  # type: ignore[arg-type]
    assert found.holds is (other != Vehicle(2))
    assert getattr(found.answer, "facts", None) == (given,)  # to whom else, where not to him
