"""Whether we reach somebody, and whether others come closer, pass us, stay or trail behind.

We drive at 12 m/s unless something else is said.
"""

from typing import Any

import pytest

from tests.explain.answers.stated import look, result, scene, they
from xavi_dialogue.domain.answers import NoSuchVehicle, PlaceReason, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import At, Ego, Event, Now, Related, Vehicle, WholeRide
from xavi_dialogue.explain.answers.measuring import nearing
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.ride import leaving

IT = Vehicle(1)
NONE = "none"
BEHIND: dict[str, Any] = {"ahead": -12.0, "left": 3.5, "bearing": "behind-left"}


def seen(span: Any = None, *, ours: float | None = 12.0, episodes: Any = (), **more: Any) -> Any:
    """A vehicle, by default 20 m ahead of us at 10 m/s."""
    one = look(1, **more)
    values = {("speed", 0): ours, ("speed", 1): one.speed}
    return scene(span, looks={1: one}, values=values, episodes=episodes)


def holds(found: Finding | None) -> Any:
    return NONE if found is None else found.holds


@pytest.mark.parametrize(
    ("action", "more", "expected"),
    [
        ("approach", {}, True),
        ("pass", {}, True),
        ("pass", {"speed": 12.0}, False),
        ("approach", {"speed": 13.0}, False),
        ("overtake", {}, NONE),
        ("pass", {"oncoming": True}, NONE),
        ("pass", {"in_view": False}, NONE),
        ("pass", {"ahead": -1.0}, NONE),
        ("pass", {"ahead": 0.0}, NONE),
        ("pass", {"ahead": 0.5}, True),
        ("pass", {"ours": None}, NONE),
    ],
)
def test_we_reach_somebody_ahead_who_is_slower(action: Any, more: Any, expected: Any) -> None:
    assert holds(nearing.nears(seen(**more), Event(action, object=IT))) == expected


def test_both_speeds_bear_it_out() -> None:
    found = nearing.nears(seen(), Event("pass", object=IT))
    assert found is not None
    assert [(m.thing, m.value) for m in found.facts] == [(Ego(), 12.0), (IT, 10.0)]  # type: ignore[union-attr]
    assert nearing.nears(seen(), Event("pass")) is None


@pytest.mark.parametrize(
    ("action", "to", "more", "expected"),
    [
        ("pass", Ego(), {"speed": 14.0}, True),
        ("overtake", None, {"speed": 14.0}, True),
        ("pass", None, {"speed": 11.0}, False),
        ("pass", None, {"speed": 12.0}, False),
        ("approach", None, {"speed": 14.0}, NONE),
        ("pass", Vehicle(2), {"speed": 14.0}, NONE),
        ("pass", None, {"speed": 14.0, "in_view": False}, NONE),
        ("pass", None, {"speed": 14.0, "left": 1.9}, NONE),
        ("pass", None, {"speed": 14.0, "left": 2.0}, True),
        ("pass", None, {"speed": 14.0, "left": -3.5, "bearing": "beside-right"}, True),
        ("pass", None, {"speed": 14.0, "bearing": "crossing-left"}, NONE),
        ("pass", None, {"speed": 14.0, "bearing": "ahead-left"}, True),
        ("pass", None, {"speed": 14.0, "ahead": 4.5}, True),
        ("pass", None, {"speed": 14.0, "ahead": 5.0}, False),
        ("pass", None, {"speed": 14.0, "ours": None}, NONE),
    ],
)
def test_who_is_faster_in_another_lane_passes_us(
    action: Any, to: Any, more: Any, expected: Any
) -> None:
    assert holds(nearing.passes(seen(**(BEHIND | more)), Event(action, IT, to))) == expected


@pytest.mark.parametrize(
    ("left", "side", "end", "expected"),
    [
        (3.5, "right", None, NONE),  # it moves in behind us
        (3.5, "left", None, True),
        (-3.5, "left", None, NONE),
        (-3.5, "right", None, True),
        (3.5, "right", 18.0, True),  # its indicator has been off for 2 s
        (3.5, "right", 19.5, NONE),
    ],
)
def test_who_indicates_towards_us_does_not_pass(
    left: float, side: Any, end: float | None, expected: Any
) -> None:
    lit = they(1, "signal", 15.0, end, side=side)
    asked = seen(**(BEHIND | {"left": left, "speed": 14.0}), episodes=(lit,))
    assert holds(nearing.passes(asked, Event("pass", IT))) == expected


def coming(gained: float, span: Any = None, **more: Any) -> Any:
    """A vehicle that has come closer by a distance [m] within the last second."""

    def at(time: float) -> Any:
        away = 15.0 if time >= 20.0 else 15.0 + gained if time >= 19.0 else None
        return None if away is None else look(1, distance=away, **more)

    return scene(span, looks={1: at})


@pytest.mark.parametrize(
    ("gained", "event", "expected"),
    [
        (1.0, Event("approach", IT, tense="present"), True),
        (0.3, Event("approach", IT, tense="present"), True),
        (0.1, Event("approach", IT, tense="present"), False),
        (-1.0, Event("approach", IT, tense="present"), False),
        (1.0, Event("approach", IT, Ego(), tense="present", time=Now()), True),
        (1.0, Event("approach", IT, Vehicle(2), tense="present"), NONE),
        (1.0, Event("approach", IT), NONE),
        (1.0, Event("approach", IT, tense="present", time=At(5.0)), NONE),
        (1.0, Event("pass", IT, tense="present"), NONE),
        (1.0, Event("approach", tense="present"), NONE),
    ],
)
def test_who_is_nearer_than_a_second_ago_comes_closer(
    gained: float, event: Event, expected: Any
) -> None:
    assert holds(nearing.closes(coming(gained), event)) == expected


def test_nothing_is_told_of_coming_closer_without_two_sights() -> None:
    event = Event("approach", IT, tense="present")
    assert nearing.closes(coming(1.0, Span(3.0, 4.0, said=True)), event) is None
    assert nearing.closes(coming(1.0, in_view=False), event) is None
    new = scene(looks={1: lambda t: look(1) if t >= 20.0 else None})
    assert nearing.closes(new, event) is None
    found = scene(looks={1: lambda t: look(1, in_view=t >= 20.0, distance=40.0 - t)})
    assert nearing.closes(found, event) is None


YIELDS = they(1, "give-way", 12.0, object=Ego())


@pytest.mark.parametrize(
    ("action", "going", "episode", "expected"),
    [
        ("stand", True, YIELDS, True),
        ("stop", True, YIELDS, True),
        ("wait", True, they(1, "wait", 12.0, object=Ego()), True),
        ("slow-down", True, YIELDS, NONE),
        ("stand", False, YIELDS, NONE),
        ("stand", True, they(1, "give-way", 12.0, object=Vehicle(2)), NONE),
        ("stand", True, they(1, "give-way", 12.0, 19.5, object=Ego()), NONE),
        ("stand", True, they(2, "give-way", 12.0, object=Ego()), NONE),
    ],
)
def test_who_lets_us_go_first_stays(action: Any, going: bool, episode: Any, expected: Any) -> None:
    facts = (they(1, "stop", 11.0),) if going else ()
    asked = scene(looks={1: look(1), 2: look(2)}, episodes=(episode,))
    found = nearing.stays(asked, Event(action, IT), facts)
    assert holds(found) == expected
    assert found is None or found.facts == (episode,)


@pytest.mark.parametrize(
    ("event", "more", "told"),
    [
        (Event("follow", IT, tense="present"), {}, True),
        (Event("follow", IT, Ego(), tense="present", time=Now()), {}, True),
        (Event("follow", IT, Vehicle(2), tense="present"), {}, False),
        (Event("follow", IT), {}, False),
        (Event("follow", IT, tense="present", time=WholeRide()), {}, False),
        (Event("approach", IT, tense="present"), {}, False),
        (Event("follow", IT, tense="present"), {"in_view": False}, False),
        (Event("follow", IT, tense="present"), {"bearing": "ahead"}, False),
        (Event("follow", IT, tense="present"), {"bearing": "behind-left"}, True),
        (Event("follow", IT, tense="present"), {"oncoming": True}, False),
        (Event("follow", IT, tense="present"), {"speed": 0.0}, False),
        (Event("follow", IT, tense="present"), {"speed": 1.0}, True),
    ],
)
def test_who_is_far_behind_goes_our_way(event: Event, more: Any, told: bool) -> None:
    found = nearing.trails(seen(**({"ahead": -60.0} | more)), event)
    assert found == (Finding(None, answer=PlaceReason(1, "behind", None)) if told else None)


def test_who_follows_us_is_not_said_to_trail() -> None:
    follows = they(1, "follow", 5.0, object=Ego())
    asked = seen(ahead=-60.0, episodes=(follows,))
    assert nearing.trails(asked, Event("follow", IT, tense="present")) is None


# Whom we have left behind, and how far two others are apart -----------------------------------


def overtaken(now: float = -20.0, first: float = 30.0, **more: Any) -> Any:
    """A vehicle that was ahead of us at first [m] and is behind us now."""
    return scene(looks={1: lambda t: look(1, now if t >= 20.0 else first, **more)})


@pytest.mark.parametrize(
    ("event", "asked", "behind"),
    [
        (Event("overtake", object=IT), overtaken(), True),
        (Event("pass", object=IT), overtaken(), True),
        (Event("follow", object=IT), overtaken(), False),
        (Event("overtake", IT, Ego()), overtaken(), False),
        (Event("overtake"), overtaken(), False),
        (Event("overtake", object=IT), overtaken(-4.0), False),
        (Event("overtake", object=IT), overtaken(-4.5), False),
        (Event("overtake", object=IT), overtaken(-20.0, -3.0), True),
        (Event("overtake", object=IT), overtaken(-20.0, -5.0), False),
        (Event("overtake", object=IT), overtaken(-20.0, -4.5), False),
        (Event("overtake", object=IT), overtaken(oncoming=True), False),
        (Event("overtake", object=IT), overtaken(in_view=False), False),
    ],
)
def test_who_was_ahead_and_is_behind_was_left_behind(
    event: Event, asked: Any, behind: bool
) -> None:
    found = leaving.left_behind(asked, event)
    assert holds(found) == (True if behind else NONE)
    if found is not None:
        assert isinstance(found.answer, Verdict)
        assert found.answer.that == Related("behind", IT, Ego())
        assert (found.answer.holds, found.answer.facts) == (True, found.facts)
        assert [fact.ahead for fact in found.facts] == [-20.0]  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("event", "more", "told"),
    [
        (Event("overtake", object=IT), {}, True),
        (Event("pass", IT, Ego()), {}, True),
        (Event("pass", object=IT, tense="present"), {}, False),
        (Event("follow", object=IT), {}, False),
        (Event("overtake", object=IT), {"in_view": False}, False),
        (Event("overtake"), {}, False),
    ],
)
def test_whom_we_have_not_passed_is_still_there(event: Event, more: Any, told: bool) -> None:
    found = leaving.still_there(seen(**more), event)
    assert [fact.vehicle for fact in found] == ([1] if told else [])  # type: ignore[union-attr]


def test_two_others_hit_each_other_or_are_so_far_apart() -> None:
    hit = Event("collide", IT, Vehicle(2))
    crash = they(1, "collide", 8.0, 8.0, object=Vehicle(2))
    both = {1: look(1), 2: look(2)}
    asked = scene(looks=both, episodes=(crash,))
    assert leaving.apart(asked, hit) == Finding(True, (crash,))
    gaps = {("distance", 1, 2): lambda t: 30.0 - t}
    far = scene(looks=both, values=gaps)
    for time, metres in ((At(4.0), 26.0), (At(24.0), 10.0)):
        found = leaving.apart(far, Event("nearly-collide", IT, Vehicle(2), time=time))
        assert (found.holds, found.gap) == (None, "not-recorded")
        assert [m.value for m in found.facts] == [metres]  # type: ignore[union-attr]
    assert leaving.apart(scene(looks=both), hit).facts == ()
    assert isinstance(result(leaving.apart, scene(looks={}), hit), NoSuchVehicle)
