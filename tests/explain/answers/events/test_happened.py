"""Whether somebody moved, and whether an event came about; asked at 20 s of a ride."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    belief,
    decision,
    did,
    look,
    result,
    scene,
    they,
)
from xavi_dialogue.domain.answers import Closeness
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Ego,
    Event,
    Everyone,
    Happens,
    Now,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.events import happens as room
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)


def weighed(event: Event, span: Span | None = None, **more: Any) -> Any:
    return result(room.happens, Happens(event), scene(span, **({"looks": SEEN} | more)))


@pytest.mark.parametrize(
    ("event", "speed", "holds"),
    [
        (Event("move", tense="present"), 5.0, True),
        (Event("go", tense="present", time=Now()), 1.0, True),
        (Event("go", tense="present"), 0.9, False),
        (Event("go", IT, tense="present"), 5.0, True),
        (Event("stop", tense="present"), 5.0, None),
        (Event("go", object=IT, tense="present"), 5.0, None),
        (Event("go", side="left", tense="present"), 5.0, None),
        (Event("go", tense="present", modal="can"), 5.0, None),
        (Event("go", tense="present", where=Related("behind", US, IT)), 5.0, None),
        (Event("go", tense="present", manner=("fast",)), 5.0, None),
        (Event("go", tense="future"), 5.0, None),
        (Event("go", tense="present", time=At(20.0)), 5.0, None),
        (Event("go", Everyone(), tense="present"), 5.0, None),
        (Event("go", tense="present"), None, None),
    ],
)
def test_everybody_in_motion_goes(event: Event, speed: Any, holds: Any) -> None:
    asked = scene(looks=SEEN, values={("speed", 0): speed, ("speed", 1): speed})
    found = room._moves(asked, event)
    assert (None if found is None else found.holds) is holds


def test_going_is_borne_out_by_setting_off_or_by_what_is_done_instead() -> None:
    event, values = Event("move", tense="present"), {("speed", 0): 5.0}
    speed = Measure("speed", US, 20.0, value=5.0)
    assert room._moves(scene(values=values), event) == Finding(True, (speed,))
    went = did("go", 19.0)
    assert room._moves(scene(values=values, episodes=(went,)), event) == Finding(True, (went,))
    waits, values = did("wait", 15.0), {("speed", 0): 0.0}
    assert room._moves(scene(values=values, episodes=(waits,)), event) == Finding(False, (waits,))
    still = Measure("speed", US, 20.0, value=0.0)
    assert room._moves(scene(values=values), event) == Finding(False, (still,))
    assert room._moves(scene(SAID, values=values), event) is None


@pytest.mark.parametrize(
    ("event", "more", "holds"),
    [
        (Event("go"), {}, True),
        (Event("go", IT, time=At(6.0)), {}, True),
        (Event("go", IT, time=At(3.0)), {}, None),
        (Event("go", IT, tense="perfect", time=At(3.0)), {}, True),
        (Event("go", IT, time=At(3.0)), {"in_view": False}, True),
        (Event("go", Everyone()), {}, None),
    ],
)
def test_who_was_in_motion_went(event: Event, more: Any, holds: Any) -> None:
    speeds = {("speed", n): lambda t: 1.0 if t >= 5.0 else 0.9 for n in (0, 1)}
    asked = scene(looks={1: look(1, **more)}, values=speeds)
    found = room._moves(asked, event)
    assert (None if found is None else found.holds) is holds
    if found is not None:
        (fact,) = found.facts
        shown = "vehicle" if more else "value"
        assert getattr(fact, shown) == 1


@pytest.mark.parametrize(("time", "holds"), [(3.0, False), (6.0, True)])
def test_whether_somebody_moved_at_a_moment_is_told_by_his_speed_then(
    time: float, holds: bool
) -> None:
    values = {("speed", 1): lambda t: 1.0 if t >= 5.0 else 0.0}
    asked = scene(looks={1: look(1, in_view=False)}, values=values)
    found = room._moves(asked, Event("move", IT, time=At(time)))
    assert found is not None
    assert (found.holds, found.facts[0].time) == (holds, time)


def test_a_going_on_record_is_told_as_such() -> None:
    went = they(1, "go", 6.0)
    asked = scene(looks=SEEN, values={("speed", 1): 5.0}, episodes=(went,))
    assert room._moves(asked, Event("go", IT)) is None
    found = room.happens(Happens(Event("go", IT)), asked)
    assert (found.holds, found.facts) == (True, (went,))
    assert room._moves(scene(looks=SEEN), Event("go", IT)) is None


# What came about --------------------------------------------------------------------------------

THOUGHT = belief(1, 4.0, ("exit-right", 0.9))
TURNED = they(1, "exit-left", 5.0, 8.0)


def test_what_came_otherwise_than_expected_is_owned_up_to() -> None:
    event = Event("exit-left", IT)
    plain = weighed(event, episodes=(TURNED,))
    assert plain == Finding(True, (TURNED,))
    wrong = weighed(event, episodes=(TURNED,), beliefs=(THOUGHT,))
    assert wrong == Finding(True, (TURNED,), None, (THOUGHT,), True)


@pytest.mark.parametrize(
    ("episodes", "mistaken"),
    [
        ((TURNED,), True),
        ((they(1, "brake", 5.0, 8.0),), False),  # it has done nothing that tells its way
        ((they(1, "change-left", 5.0, 8.0),), False),  # and may turn off still
        ((they(2, "exit-left", 5.0, 8.0),), False),
    ],
)
def test_what_was_expected_and_did_not_come_was_a_mistake(episodes: Any, mistaken: bool) -> None:
    found = weighed(Event("exit-right", IT), episodes=episodes, beliefs=(THOUGHT,))
    assert (found.holds, found.mistaken) == (False, mistaken)
    assert found.believed == ((THOUGHT,) if mistaken else ())


def test_what_was_done_instead_is_told() -> None:
    waits, brakes = did("wait", 4.0, 5.0), did("brake", 8.0, 9.0, peak=2.0)
    assert weighed(Event("stop"), episodes=(waits, brakes)).facts == (waits, brakes)
    hard = weighed(Event("brake", manner=("hard",)), episodes=(waits, brakes))
    assert hard == Finding(
        False, (Measure("deceleration", US, 8.0, value=2.0, until=9.0, extreme="highest"),)
    )
    for manner, done in ((("hard",), did("brake", 8.0, 9.0)), (("suddenly",), brakes)):
        asked = scene(episodes=(done,))
        assert room._how_hard(asked, Event("brake", manner=manner)) == ()  # type: ignore[arg-type]
    assert room._how_hard(scene(episodes=(brakes,)), Event("stop", manner=("hard",))) == ()
    slow = Event("slow-down", manner=("suddenly", "hard"))
    assert len(room._how_hard(scene(episodes=(brakes,)), slow)) == 1


def test_who_is_beside_us_still_was_not_passed() -> None:
    found = weighed(Event("overtake", object=IT), episodes=(did("follow", 3.0, object=IT),))
    assert (found.holds, [f.vehicle for f in found.facts]) == (False, [1])


def test_now_it_is_told_what_goes_on_and_how_fast() -> None:
    on, over = did("follow", 12.0, object=IT), did("brake", 8.0, 9.0)
    values = {("speed", 0): 4.0}
    speed = Measure("speed", US, 20.0, value=4.0)
    stops = Event("stop", tense="present")
    assert weighed(stops, episodes=(on, over), values=values).facts == (on, speed)
    assert weighed(stops, episodes=(over,), values=values).facts == (speed,)
    assert weighed(stops, episodes=(over,)).facts == (over,)
    assert weighed(Event("stop"), episodes=(), values=values).facts == (speed,)
    assert weighed(Event("stop"), episodes=(over,), values=values).facts == (over,)
    assert weighed(Event("circle"), values=values).facts == ()
    for action in ("wait", "give-way", "speed-up", "brake", "go"):
        assert weighed(Event(action), values=values).facts[-1:] == (speed,)


@pytest.mark.parametrize(
    ("episodes", "shown"),
    [
        ((did("brake", 15.0), did("wait", 16.0), did("follow", 12.0)), ["brake", "wait"]),
        ((did("go", 15.0), did("signal", 15.0)), []),
        ((did("brake", 15.0, 19.6),), ["brake"]),
        ((did("brake", 15.0, 19.4),), []),
        ((did("brake", 20.4),), ["brake"]),
        ((did("brake", 20.6),), []),
        ((did("stop", 15.0),), ["stand"]),
        ((they(1, "brake", 15.0),), []),
    ],
)
def test_under_way_is_what_the_actor_does_else(episodes: Any, shown: list[str]) -> None:
    asked = scene(looks=SEEN, episodes=episodes, values={("speed", 0): 0.0})
    found = room._under_way(asked, Event("go"), Window(20.0, 20.0))
    assert [e.action for e in found] == shown


def test_who_still_rolls_stops_and_does_not_stand() -> None:
    asked = scene(episodes=(did("stop", 15.0),), values={("speed", 0): 2.0})
    (found,) = room._under_way(asked, Event("go"), Window(20.0, 20.0))
    assert found.action == "stop"
    assert room._under_way(asked, Event("go", Everyone()), Window(20.0, 20.0)) == ()


@pytest.mark.parametrize(
    ("gap", "lost"),
    [((2.0, 3.0), False), ((2.0, 4.0), True), ((6.0, 7.0), True), ((6.1, 7.0), False)],
)
def test_in_a_hole_of_the_record_nothing_can_be_told(gap: Any, lost: bool) -> None:
    found = weighed(Event("stop", time=Between(4.0, 6.0)), gaps=(gap,))
    assert found == (Finding(None, gap="gap-in-record") if lost else Finding(False))


def gone(seen: float | None) -> Any:
    return {1: look(1, in_view=False, seen=seen)}


@pytest.mark.parametrize(
    ("time", "seen", "lost"),
    [
        (At(10.0), 5.0, True),
        (At(10.0), 8.4, True),
        (At(10.0), 8.6, False),
        (At(10.0), None, True),
        (Between(8.0, 12.0), 5.0, False),
    ],
)
def test_of_who_was_out_of_view_then_it_cannot_be_told(time: Any, seen: Any, lost: bool) -> None:
    brakes = they(1, "brake", 2.0, 3.0)
    turns = they(1, "exit-left", 4.0, 4.5)
    found = weighed(Event("stop", IT, time=time), looks=gone(seen), episodes=(brakes, turns))
    assert found.gap == ("out-of-view" if lost else None)
    if lost:
        assert [getattr(f, "vehicle", None) for f in found.facts] == [1]
    late = room._lost(
        scene(looks=gone(5.0), episodes=(brakes,)), Event("stop", IT), Window(9.0, 9.0)
    )
    assert late is not None
    assert late.facts[1:] == (brakes,)


def test_who_had_not_come_into_view_is_told_as_seen_first() -> None:
    def later(time: float) -> Any:
        return look(1) if time >= 12.0 else None

    traces = (decision(12.0),)
    found = weighed(Event("stop", IT, time=At(5.0)), looks={1: later}, traces=traces)
    assert (found.holds, found.gap, [f.vehicle for f in found.facts]) == (None, "out-of-view", [1])
    never = weighed(Event("stop", IT, time=At(5.0)), looks={1: later})
    assert (never.gap, never.facts) == ("out-of-view", ())
    assert weighed(Event("stop", time=At(5.0))).gap is None


def test_it_happened_where_there_is_such_an_episode() -> None:
    asked = scene(episodes=(did("stop", 5.0, 6.0),))
    assert room.happened(asked, Event("stop"))
    assert not room.happened(asked, Event("brake"))


def test_room_left_to_somebody_whom_we_did_not_follow_is_how_close_we_came() -> None:
    left = weighed(Event("keep-distance", US, IT, tense="past"))
    assert isinstance(left.answer, Closeness)
    assert (left.answer.vehicle, left.answer.asked, left.answer.past) == (1, "room", True)
    followed = (did("keep-distance", 3.0, 9.0, object=IT),)
    assert not isinstance(
        weighed(Event("keep-distance", US, IT, tense="past"), episodes=followed).answer, Closeness
    )
