"""From whom or of what a danger is asked."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, talk
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.meaning import Whether, Why
from xavi_dialogue.domain.terms import (
    Ago,
    Between,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Now,
    Passenger,
    Pronoun,
    Relative,
    Unknown,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.dangers import (
    fresh_event,
    is_of_undone,
    mode_of,
    spoken_of,
    threatened,
)
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

OPTION = Event("change-left", tense="present")
WE = Is("dangerous", Ego(), tense="past")
HIM = Vehicle(1)


def grounder(said: Discourse | None = None, ahead: float = 8.0) -> TermGrounder:
    world = FakeWorld({1: Car(ahead), 2: Car(-60.0, 3.5)}, now=20.0)
    return TermGrounder(Context(world, said or Discourse()))


def of(vehicle: int, salience: float, asked_at: float | None = 15.0) -> Discourse:
    """A discourse in which a vehicle was spoken of."""
    mention = Mention(Vehicle(vehicle), 1, False, salience)
    return Discourse(turn=2, mentions=(mention,), asked_at=asked_at)


NEAR = of(1, 0.85)


@pytest.mark.parametrize("thing", [None, Pronoun("it"), Pronoun("that"), Pronoun("this")])
def test_a_danger_is_that_of_the_option_under_discussion(thing: Any) -> None:
    g = grounder(Discourse(option=OPTION))
    for state, asked in (
        ("dangerous", "dangerous"), ("safe", "safe"), ("worth-it", "worth-it"),
        ("wrong", "dangerous"),
    ):  # fmt: skip
        spoken = Is(state, thing, tense="present")  # type: ignore[arg-type]
        assert threatened(spoken, g) == Is(asked, event=OPTION, tense="present")  # type: ignore[arg-type]
    assert g.notes.leaned


@pytest.mark.parametrize("spoken", [
    Is("dangerous", Pronoun("he"), tense="present"), Is("safe", HIM, tense="present"),
    Is("worth-it", Pronoun("it"), tense="past"), Is("fast", Pronoun("it"), tense="present"),
    Is("dangerous", Pronoun("it"), event=Event("stop"), tense="present"),
    Is("wrong", Ego(), tense="past"),
])  # fmt: skip
def test_what_is_not_of_the_option_is_left_as_it_is(spoken: Is) -> None:
    g = grounder(replace(NEAR, option=OPTION))
    assert threatened(spoken, g) == spoken
    assert not g.notes.leaned


def test_whether_anything_was_dangerous_is_of_nobody() -> None:
    spoken = Is("dangerous", Described(definite=False), tense="past")
    assert threatened(spoken, grounder(NEAR)) == replace(spoken, thing=None)
    him = replace(spoken, thing=Described())
    assert threatened(him, grounder(NEAR)) == him


@pytest.mark.parametrize("words", ["ride", "trip", "journey", "drive"])
@pytest.mark.parametrize("state", ["dangerous", "safe", "comfortable", "uncomfortable"])
def test_a_dangerous_ride_is_asked_of_the_whole_of_it(words: str, state: Any) -> None:
    spoken = Is(state, Unknown(words), tense="past")
    assert threatened(spoken, grounder()) == Is(state, tense="past", time=WholeRide())
    other = Is(state, Unknown("weather"), tense="past")
    assert threatened(other, grounder()) == other


@pytest.mark.parametrize("actor", [Described(kind="bus"), Pronoun("he")])
def test_who_is_named_by_when_it_was_is_the_danger(actor: Any) -> None:
    time = Relative("during", Event("pass", actor, tense="past"))
    for us in (Ego(), Passenger(), Pronoun("it")):
        spoken = Is("dangerous", us, time=time, tense="past")
        assert threatened(spoken, grounder()) == replace(spoken, thing=actor)
    after = replace(WE, time=replace(time, relation="after"))
    assert threatened(after, grounder(NEAR)) == after
    ours = replace(WE, time=Relative("during", Event("pass", Ego(), tense="past")))
    assert threatened(ours, grounder(NEAR)) == ours


@pytest.mark.parametrize("time", [Unsaid(), Ago(), WholeRide()])
def test_a_danger_to_us_is_from_whom_was_spoken_of(time: Any) -> None:
    spoken = replace(WE, time=time)
    assert threatened(spoken, grounder(NEAR)) == replace(spoken, thing=HIM)
    assert threatened(spoken, grounder()) == spoken
    now = replace(spoken, tense="present")
    assert threatened(now, grounder(NEAR)) == now
    for other in (Ago(5.0), Now(), Between(3.0, 4.0)):
        assert threatened(replace(WE, time=other), grounder(NEAR)) == replace(WE, time=other)


def test_it_is_us_only_where_a_time_is_named() -> None:
    spoken = Is("dangerous", Pronoun("it"), tense="past")
    assert threatened(spoken, grounder(NEAR)) == spoken
    ride = replace(spoken, time=WholeRide())
    assert threatened(ride, grounder(NEAR)) == replace(ride, thing=HIM)
    him = replace(ride, thing=Pronoun("he"))
    assert threatened(him, grounder(NEAR)) == him
    for other in (None, Vehicle(2)):
        assert threatened(replace(ride, thing=other), grounder(NEAR)).thing == other


@pytest.mark.parametrize(
    ("said", "ahead", "found"),
    [
        (Discourse(asked_at=19.0), 8.0, None),
        (of(1, 0.85), 8.0, HIM),
        (of(1, 0.85), 12.0, HIM),
        (of(1, 0.85), 12.1, None),  # too far to have been one
        (of(2, 0.85), 8.0, None),
        (of(1, 0.85, 12.0), 8.0, HIM),
        (of(1, 0.85, 11.9), 8.0, None),  # long ago
        (of(1, 0.85, None), 8.0, None),
        (of(1, 0.52), 8.0, HIM),
        (of(1, 0.5), 8.0, None),  # spoken of by the way
        # Of the same breath it is who was named, wherever he is.
        (of(1, 1.5, None), 80.0, HIM),
        (of(2, 1.6, 0.0), 8.0, Vehicle(2)),
        (of(2, 1.4), 8.0, None),
    ],
)
def test_who_was_a_danger_was_spoken_of_just_now_and_is_near(
    said: Discourse, ahead: float, found: Vehicle | None
) -> None:
    assert spoken_of(grounder(said, ahead)) == found


@pytest.mark.parametrize(
    ("tense", "state", "actor", "mode"),
    [
        ("past", "safe", Ego(), "presupposed"),
        ("present", "safe", Ego(), "supposed"),
        ("present", "dangerous", Ego(), "supposed"),
        ("present", "safe", HIM, "asked"),
        ("present", "necessary", Ego(), "asked"),
        ("future", "safe", Ego(), "asked"),
        ("past", "necessary", HIM, "presupposed"),
    ],
)
def test_what_is_taken_for_granted_of_a_deed(tense: Any, state: Any, actor: Any, mode: str) -> None:
    event = Event("change-left", actor, tense=tense)
    assert mode_of(event, Is(state, event=event)) == mode


def test_that_is_the_event_of_the_turn_before_if_it_is_recent() -> None:
    slowed = Event("slow-down", time=Between(14.0, 16.0), tense="past")
    said = talk(propositions=(Happens(slowed),), asked_at=15.0)
    assert fresh_event(grounder(said)) == slowed
    assert fresh_event(grounder(replace(said, asked_at=11.0))) is None
    assert fresh_event(grounder(talk(asked_at=15.0))) is None


def test_is_it_safe_may_be_of_what_we_do_not_do() -> None:
    undone = grounder(Discourse(question=Why(Not(Happens(OPTION)))))
    for state, tense, meant in (
        ("safe", "present", True), ("dangerous", "present", True), ("safe", "past", False),
        ("close", "present", False),
    ):  # fmt: skip
        assert is_of_undone(Is(state, tense=tense), undone) is meant  # type: ignore[arg-type]
    for asked in (None, Why(Happens(OPTION)), Whether(Not(Happens(OPTION)))):
        g = grounder(Discourse(question=asked))
        assert not is_of_undone(Is("safe", tense="present"), g)
