"""On what evidence something is believed; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    did,
    look,
    result,
    scene,
)
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    MotionCause,
    MotionReason,
    NeedRollout,
    NoSuchVehicle,
    NotRecorded,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowDecide, HowKnow
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Now,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reasons import knowing as room
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)
YIELD = Priority(20.0, "give-way", 1)


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """What others tell is told by who was asked for what."""

    def grounds(_: Any, vehicle: int, names: Any, at: float, *, held: bool = True) -> Any:
        return ("grounds", vehicle, names, at, held)

    stand_ins: dict[str, Any] = {
        "grounds": grounds,
        "since_when": lambda _, event: ("since", event),
        "how_decide": lambda question, _: ("decide", question),
        "priority_at": lambda *_: Priority(20.0, "priority", 1),
        "motion": lambda event, _: MotionReason(did(event.action, 5.0), ()),
    }
    for name, stand_in in stand_ins.items():
        monkeypatch.setattr(room, name, stand_in)
    return monkeypatch


def known(of: Any, span: Span | None = None) -> Any:
    of = Happens(of) if isinstance(of, Event) else of
    return result(room.how_know, HowKnow(of), scene(span, looks=SEEN))


@pytest.mark.parametrize(
    ("of", "answer"),
    [
        (Event("give-way", IT), ("since", Event("give-way", IT))),
        (Event("wait", IT), ("since", Event("wait", IT))),
        (Event("brake", IT), ("grounds", 1, ("slow-down",), 20.0, True)),
        (Event("brake", IT, time=Now()), ("grounds", 1, ("slow-down",), 20.0, False)),
        (
            Event("brake", IT, time=Now(), modal="would"),
            ("grounds", 1, ("slow-down",), 20.0, True),
        ),
        (Not(Happens(Event("brake", IT))), ("grounds", 1, ("slow-down",), 20.0, True)),
        (Related("ahead-of", IT, US), ("grounds", 1, (), 20.0, True)),
        (Related("ahead-of", US, IT), ("grounds", 1, (), 20.0, True)),
        (Is("slow", Vehicle(2)), ("grounds", 2, (), 20.0, True)),
        (Event("give-way", object=IT), ("grounds", 1, (), 20.0, True)),
        (Event("stop"), ("decide", HowDecide(Happens(Event("stop"))))),
        (None, ("decide", HowDecide(None))),
    ],
)
def test_how_we_know_is_told_of_whom_it_is_about(told: Any, of: Any, answer: Any) -> None:
    assert known(of) == answer


def test_of_a_moment_gone_by_the_grounds_of_then_count(told: Any) -> None:
    assert known(Event("brake", IT), SAID) == ("grounds", 1, ("slow-down",), 5.0, True)
    assert isinstance(known(Event("brake", Vehicle(9))), NoSuchVehicle)


@pytest.mark.parametrize(
    ("event", "rule", "owed"),
    [
        (Event("give-way", object=IT), YIELD, True),
        (Event("wait"), YIELD, True),
        (Event("let-go"), YIELD, True),
        (Event("stop"), YIELD, False),
        (Event("give-way", IT), YIELD, False),
        (Event("wait"), Priority(20.0, "priority", 1), False),
        (Event("wait"), None, False),
    ],
)
def test_who_gave_way_did_so_by_the_rule(told: Any, event: Event, rule: Any, owed: bool) -> None:
    def priority(_: Any, vehicle: int | None, about: Window) -> Priority:
        if rule is None:
            raise Unanswered(NotRecorded("not-recorded"))
        assert vehicle == (None if event.object is None else 1)
        assert about in (Window(20.0, 20.0), Window(4.0, 6.0))
        found: Priority = rule
        return found

    told.setattr(room, "priority_at", priority)
    for span in (None, SAID):
        found = room._owed(event, scene(span, looks=SEEN))
        assert (found == YIELD) is owed
        assert (found is None) is not owed
    assert (known(event) == YIELD) is owed


CAUSES = (MotionCause("limit"), MotionCause("leader", vehicle=2), MotionCause("cut-in", vehicle=1))


def test_because_of_whom_we_drove_so_is_looked_up(told: Any) -> None:
    told.setattr(room, "motion", lambda event, _: MotionReason(did(event.action, 5.0), CAUSES))
    asked = scene(looks=SEEN)
    assert room._because_of(Event("stop"), asked) == 2
    assert room._because_of(Event("stop", object=IT), asked) == 1
    assert room._because_of(Event("brake", object=IT), asked) == 2
    assert known(Event("stop")) == ("grounds", 2, (), 20.0, True)

    class Choice:
        causes = CAUSES
        contrast = type("Against", (), {"causes": CAUSES[2:]})

    told.setattr(choices, "why", lambda event, _: Choice)
    assert room._because_of(Event("change-left"), asked) == 1
    told.setattr(choices, "why", lambda event, _: Verdict(Happens(event), True))
    assert room._because_of(Event("change-left"), asked) is None


def test_rollouts_that_are_needed_are_asked_for(told: Any) -> None:
    def refuses(refusal: Any) -> Any:
        def motion(*_: Any) -> Any:
            raise Unanswered(refusal)

        return motion

    need = NeedRollout("t4", removed=1)
    told.setattr(room, "motion", refuses(need))
    assert result(room._because_of, Event("stop"), scene()) == need
    told.setattr(room, "motion", refuses(DidNotHappen(Event("stop"))))
    assert room._because_of(Event("stop"), scene()) is None


@pytest.mark.parametrize(
    ("told_of", "answer"),
    [
        (Finding(True, answer=YIELD), YIELD),
        (Finding(True, answer=YIELD, probability=0.9), YIELD),
        (Finding(False, answer=YIELD, probability=0.0), "assured"),
        (None, "assured"),
    ],
)
def test_that_somebody_may_come_out_before_us_is_known_by_the_rule(
    told_of: Any, answer: Any, told: pytest.MonkeyPatch
) -> None:
    told.setattr(room, "comes_before", lambda *_: told_of)
    told.setattr(room, "assured", lambda *_: "assured")
    assert known(Event("pull-out", IT, tense="future")) == answer


@pytest.mark.parametrize(("whom", "vehicle"), [(IT, 1), (None, None)])
def test_an_earlier_risk_rests_on_what_was_simulated_then(
    whom: Any, vehicle: Any, told: pytest.MonkeyPatch
) -> None:
    told.setattr(room, "was_assured", lambda _, *told_of: told_of)
    crash = Event("collide", US, whom, time=At(4.0), tense="present")
    assert known(Believed(Happens(crash), time=At(4.0))) == (vehicle, 4.0)
