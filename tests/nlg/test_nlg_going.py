"""What is said of going, of not having slowed down, and of what others announce."""

from dataclasses import replace

import pytest
from msgspec.structs import replace as replace_struct

from tests.nlg.causal_cases import LATER
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    CrossingVehicle,
    GoReason,
    MotionCause,
    MotionReason,
    PlaceReason,
    Share,
    SignalReason,
    Unslowed,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Feature, Junction, Vehicle
from xavi_dialogue.domain.traffic_lights import Shown
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlg.content.clauses.clauses import event_clause, verb_phrase
from xavi_dialogue.nlg.say import say
from xavi_dialogue.nlg.surface.values import Who

E, ONE = Ego(), Vehicle(1)
TURN = Episode(E, "exit-right", 9.0, 11.0)
SLOWED = Episode(E, "slow-down", 5.0, 7.0, speed_from=10.0, speed_to=5.0)
FIRST = MotionCause("right-of-way", 1)


@pytest.mark.parametrize(
    ("answer", "parts"),
    [
        (GoReason(TURN, ()), ("I turned right then because the way was free",)),
        (
            GoReason(TURN, (CrossingVehicle(1, "vehicle", "standing", 12.0),)),
            ("(vehicle 1)", "which had right of way, was standing still"),
        ),
        (
            GoReason(TURN, (CrossingVehicle(1, "vehicle", "standing", 12.0),), refrained="let-go"),
            ("I went first because", "which had right of way, was standing still"),
        ),
        (
            GoReason(TURN, (CrossingVehicle(1, "ego", "steady", 12.0),)),
            ("(vehicle 1) had to let us go first",),
        ),
        (
            GoReason(TURN, (CrossingVehicle(1, "vehicle", gone=True),)),
            ("I had let", "go first"),
        ),
        (Unslowed(SLOWED, FIRST), ("had right of way", "had to brake for us")),
        (Unslowed(SLOWED, FIRST, 8.0, 8.4), ("at about the same time",)),
        (Unslowed(SLOWED, FIRST, 8.0, 11.0), ("about 3 seconds before",)),
        (Unslowed(SLOWED, MotionCause("turn")), ("I had to take the turn at a safe speed",)),
        (
            SignalReason(1, Episode(ONE, "signal", 9.0, None, side="right"), ("exit-right",), 0.9),
            ("is indicating right", "seems to want to turn right", "90 %"),
        ),
        (
            PlaceReason(1, "behind", Episode(ONE, "give-way", 4.0, 5.0, object=E)),
            ("is behind us because it gave way to us",),
        ),
        (PlaceReason(1, "behind"), ("is going the same way as we are",)),
    ],
)
def test_it_is_said_so(answer, parts):
    text = say(answer, CONTEXT).text
    for part in parts:
        assert part.lower() in text.lower(), text


def test_simpler_words_have_no_figures_but_the_number_of_the_vehicle():
    simple = replace(CONTEXT, detail="simpler")
    signal = Episode(ONE, "signal", 9.0, None, side="right")
    assert "%" not in say(SignalReason(1, signal, ("exit-right",), 0.9), simple).text
    assert "seconds" not in say(Unslowed(SLOWED, FIRST, 8.0, 11.0), simple).text


RISKY = replace_struct(
    LATER,
    foil=("stop",),
    collision=0.21,
    fact_collision=0.0,
    collided_with=1,
    told=(Share("collision", 40.0, 0.21, 0.0),),
    verdict="better",
)


def test_a_risk_of_waiting_is_told_with_why_we_went():
    """A risk of a collision is said, and first, whatever else the reason is."""
    safe = GoReason(TURN, (CrossingVehicle(1, "ego", "steady", 12.0),))
    text = say(replace_struct(safe, contrast=RISKY), CONTEXT).text
    assert "21 %" in text
    assert text.index("21 %") < text.index("had to let us go first")
    assert "%" not in say(safe, CONTEXT).text


def test_a_risk_is_told_beside_the_way():
    """That a road is the way tells nothing of the risk of another."""
    way = ChoiceReason("why", None, replace_struct(RISKY, way=True, foil=("exit-left",)))
    text = say(way, CONTEXT).text
    assert "the way to our destination" in text
    assert "21 %" in text


@pytest.mark.parametrize("action", ["turn", "exit-left", "exit-right"])
def test_one_turns_in_front_of_somebody_but_at_a_place(action: ActionName) -> None:
    verb, rest = verb_phrase(action, ONE, E)
    assert verb.endswith("in front of")
    assert rest[0] == Who(E, None)
    assert "in front of" not in verb_phrase(action, ONE, Junction())[0]


def test_a_turn_that_is_foreseen_is_not_said_to_meet_anybody() -> None:
    for actor, whom in ((ONE, E), (E, ONE)):
        event = Event("exit-left", actor, whom, tense="future")
        for tense in ("present", "future"):
            assert event_clause(replace_struct(event, tense=tense), 9.0).rest == ()
        past = replace_struct(event, tense="past")
        assert event_clause(past, 9.0, negated=True).rest[0] == Who(whom, None)


@pytest.mark.parametrize(
    ("deed", "told"),
    [
        ("stand", "because the traffic light was red until 0:09"),
        ("speed-up", "because the traffic light has turned green"),
    ],
)
def test_a_light_that_turned_green_is_no_reason_for_standing(deed: ActionName, told: str) -> None:
    green = MotionCause("light", shown=Shown(Feature("light"), "green", 9.0, True))
    text = say(MotionReason(Episode(E, deed, 5.0, speed_to=0.0), (green,), asked=deed), CONTEXT)
    assert told in text.text
