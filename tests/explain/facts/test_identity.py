"""What a vehicle is, where it came from and goes, and why there is no value."""

import math

import pytest

from tests.explain.facts.scenes import Actor, Pose, made, straight
from tests.traces import Aim, Way
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.states import States

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


OURS = Actor(straight(0.0, 0.0, 10.0))


def of(
    found: States, attribute: Attribute, thing: Thing = US, at: float = 8.0, to: Thing | None = None
) -> Measure:
    return measure(found, attribute, thing, at, to)


@pytest.mark.parametrize(
    ("length", "word"), [(2.9, "small"), (3.0, None), (6.4, None), (6.5, "big")]
)
def test_looks_are_known_once_it_was_seen(length: float, word: str | None) -> None:
    actors = {0: OURS, 1: Actor(straight(9.0, 0.0, 10.0), "truck", "red", length, until=3.0)}
    found = States(made(actors, 8.0))
    size = of(found, "size", ONE)
    assert (size.value, size.word) == (length, word)
    assert of(found, "colour", ONE).word == "red"
    assert of(found, "kind", ONE).word == "truck"
    assert of(found, "name", ONE).value == 1.0
    for attribute in ("size", "colour", "kind"):
        assert of(found, attribute, TWO).gap == "out-of-view"
    plain = States(made({0: OURS, 1: Actor(straight(9.0, 0.0, 10.0), colour=None)}, 8.0))
    assert of(plain, "colour", ONE).gap == "not-sensed"


@pytest.mark.parametrize(
    ("x", "turn", "word", "side"),
    [
        (30.0, 0.0, "ahead", None),
        (-30.0, 0.0, "behind", None),
        (30.0, 49.0, "ahead", None),
        (30.0, 51.0, "right", "right"),  # it heads left, so it came from the right
        (30.0, -51.0, "left", "left"),
        (30.0, -129.0, "left", "left"),
        (30.0, 131.0, "oncoming", None),
    ],
)
def test_where_somebody_came_from(x: float, turn: float, word: str, side: str | None) -> None:
    other = Actor(straight(x, 5.0, 10.0, math.radians(turn)), since=3.0)
    moved = Actor(lambda t: (x + 10.0 * 3.0, 5.0, math.radians(turn), 0.0), since=3.0)
    for one in (other, moved) if x > 0.0 else (moved,):
        found = of(States(made({0: OURS, 1: one}, 8.0)), "origin", ONE)
        assert (found.word, found.side, found.time) == (word, side, 3.0)
    states = States(made({0: OURS, 1: other}, 8.0))
    assert of(states, "origin", ONE, 2.0).gap == "out-of-view"
    assert of(states, "origin", TWO).gap == "out-of-view"
    assert of(states, "origin").gap == "not-recorded"


AIMS = (
    Aim(
        "exit-left",
        0.3,
        (
            Way(
                ("change-left", "exit-left"),
            ),
        ),
    ),
    Aim("continue", 0.25, (Way(("continue",)),)),
    Aim("stop", 0.45, (Way(("stop",)),)),
)


def test_where_somebody_is_thought_to_go() -> None:
    """Of several aims stopping tells no way; what is likeliest of the others is told."""
    found = of(
        States(made({0: OURS, 1: Actor(straight(9.0, 0.0, 8.0), aims=AIMS)}, 8.0)), "turn", ONE
    )
    assert (found.word, found.side, found.time, found.value) == ("exit-left", "left", 8.0, 0.3)
    assert found.attribute == "turn"
    only = Actor(straight(9.0, 0.0, 8.0), aims=(Aim("stop", 1.0, (Way(("stop",)),)),))
    assert of(States(made({0: OURS, 1: only}, 8.0)), "heading", ONE).word == "stop"
    assert of(States(made({0: OURS}, 8.0)), "heading", ONE).gap == "out-of-view"


def turning(t: float) -> Pose:
    """North for 4 s at 6 m/s, to the right within 2 s, and on to the east."""
    radius = 12.0 / (math.pi / 2.0)
    if t <= 4.0:
        return 0.0, 6.0 * t, math.pi / 2.0, 6.0
    turned = math.pi / 2.0 * min((t - 4.0) / 2.0, 1.0)
    x, y = radius * (1.0 - math.cos(turned)), 24.0 + radius * math.sin(turned)
    return x + max(t - 6.0, 0.0) * 6.0, y, math.pi / 2.0 - turned, 6.0


def test_where_somebody_went_is_known_better() -> None:
    states = States(made({0: OURS, 1: Actor(turning, aims=AIMS)}, 9.0))
    found = of(states, "heading", ONE, 3.0)
    assert (found.word, found.side) == ("exit-right", "right")
    assert found.time == pytest.approx(4.2, abs=0.3)
    assert found.until == pytest.approx(6.0, abs=0.3)
    assert of(states, "heading", ONE, 8.0).word == "exit-left"  # where it goes next


def test_since_when_somebody_is_in_view() -> None:
    actors = {
        0: OURS,
        1: Actor(straight(30.0, 0.0, 10.0), since=2.0, hidden=(4.0, 6.0)),
        2: Actor(straight(50.0, 0.0, 10.0), until=5.0),
    }
    found = States(made(actors, 10.0))
    told = [(m.word, m.value, m.time) for m in (of(found, "visibility", ONE, t) for t in (3, 5, 9))]
    assert told == [("in-view", 1.0, 2.0), ("hidden", 1.0, 4.0), ("in-view", 3.0, 6.0)]
    lost = of(found, "visibility", TWO, 9.0)
    assert (lost.word, lost.value, lost.time) == ("lost", 4.0, 5.0)
    assert of(found, "visibility", Vehicle(7)).gap == "out-of-view"
    assert of(found, "visibility").gap == "not-applicable"
    assert of(found, "count", at=3.0).value == 2.0
    assert of(found, "count", at=9.0).value == 1.0


@pytest.mark.parametrize(
    ("attribute", "thing", "at", "gap"),
    [
        ("weather", US, 3.0, "not-sensed"),
        ("money", US, 3.0, "not-recorded"),
        ("speed", US, 11.0, "in-future"),
        ("time", US, 11.0, "in-future"),
        ("route", ONE, 3.0, "others-thoughts"),
        ("value", ONE, 3.0, "others-thoughts"),
        ("speed", ONE, 9.0, "out-of-view"),
        ("gap", ONE, 9.0, "out-of-view"),
    ],
)
def test_why_there_is_no_value(attribute: Attribute, thing: Thing, at: float, gap: str) -> None:
    actors = {0: OURS, 1: Actor(straight(30.0, 0.0, 10.0), until=5.0)}
    assert of(States(made(actors, 10.0)), attribute, thing, at).gap == gap


def test_the_side_is_that_of_where_it_goes() -> None:
    for way, side in (("exit-right", "right"), ("continue", None)):
        aims = (Aim("stop", 0.4, (Way(("stop",)),)), Aim("continue", 0.6, (Way((way,)),)))  # type: ignore[arg-type]
        actors = {0: OURS, 1: Actor(straight(9.0, 0.0, 8.0), aims=aims)}
        found = of(States(made(actors, 8.0)), "heading", ONE)
        assert (found.word, found.side) == (way, side)


@pytest.mark.parametrize("lost", [0, 1])
def test_where_somebody_came_from_is_seen_from_where_we_were(
    lost: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = States(made({0: OURS, 1: Actor(straight(30.0, 5.0, 10.0))}, 8.0))
    assert of(found, "origin", ONE).word == "ahead"
    known = found.state
    monkeypatch.setattr(found, "state", lambda v, t: None if v == lost else known(v, t))
    assert of(found, "origin", ONE).gap == "out-of-view"
