"""The moment of the ride at which something was at its most, and what it was."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, deed, look, their
from tests.explain.answers.stated import did, scene
from xavi_dialogue.domain.answers import Counted, PeakMoment
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Peak
from xavi_dialogue.domain.terms import Between, Ego, Event, Vehicle
from xavi_dialogue.explain.answers.measuring import peak_moments

ONE, TWO = Vehicle(1), Vehicle(2)


def peak(of: Any, time: Any = None, span: Span | None = None, **more: Any) -> PeakMoment:
    given = {"looks": {1: look(1), 2: look(2)}} | more
    question = Peak(of) if time is None else Peak(of, time)
    found = peak_moments.peak(question, Given(**given).asked(span))
    assert isinstance(found, PeakMoment)
    assert found.of == of
    return found


def at(attribute: Any, time: float, value: float, to: Any = None) -> Measure:
    return Measure(attribute, Ego(), time, value=value, to=to)


@pytest.mark.parametrize(
    ("of", "which", "attribute"),
    [
        ("slowness", "lowest", "speed"),
        ("speed", "highest", "speed"),
        ("braking", "highest", "deceleration"),
    ],
)
def test_a_measure_is_at_its_most_at_its_extreme(of: Any, which: str, attribute: Any) -> None:
    found = at(attribute, 12.0, 2.0)
    braked = deed("brake", 11.0, 13.0)
    told = peak(of, extremes={(attribute, Ego(), which): found}, deeds=(braked,))
    assert told == PeakMoment(of, 12.0, (braked,), found)


def test_without_braking_there_is_no_hardest_braking() -> None:
    for value in (0.0, None):
        known = {("deceleration", Ego(), "highest"): value}
        assert peak("braking", extremes=known) == PeakMoment("braking")


def test_whom_we_braked_for_hardest_comes_before_whom_we_passed() -> None:
    found = at("deceleration", 12.0, 3.0)
    passed, braked = deed("pass", 11.5, 13.0, TWO), deed("brake", 11.0, 13.0, ONE)
    known = {("deceleration", Ego(), "highest"): found}
    told = peak("braking", extremes=known, deeds=(passed, braked))
    assert told.deeds == (braked,)


def test_extremes_are_looked_for_in_the_time_asked_about() -> None:
    spans: list[tuple[float, float]] = []

    def highest(begin: float, end: float) -> float:
        spans.append((begin, end))
        return 12.0

    known = {("speed", Ego(), "highest"): highest}
    peak("speed", extremes=known)
    peak("speed", Between(3.0, 9.0), extremes=known)
    peak("speed", Between(-4.0, 30.0), extremes=known)
    peak("speed", span=Span(7.0, 7.5), extremes=known)  # a moment is no stretch
    peak("speed", begin=2.0, extremes=known)
    assert spans == [(0.0, NOW), (3.0, 9.0), (0.0, NOW), (0.0, NOW), (2.0, NOW)]


def test_what_we_did_then_is_told_the_most_telling_first() -> None:
    deeds = (
        deed("brake", 11.0, 13.0),
        deed("change-left", 12.5, 14.0),
        deed("give-way", 8.0, 11.0, to=1),
        deed("speed-up", 12.0, 13.0),
        deed("stop", 5.0, 10.9),
        deed("stop", 13.1, 15.0),
        their(1, "brake", 11.0, 13.0),
    )
    asked = Given(deeds=deeds).asked()
    assert [e.action for e in peak_moments.deeds_at(asked, 12.0)] == [
        "give-way",
        "change-left",
        "brake",
    ]
    twice = (deed("brake", 11.0, 13.0), deed("brake", 10.0, 12.0))
    found = peak_moments.deeds_at(Given(deeds=twice).asked(), 12.0)
    assert [e.begin for e in found] == [10.0, 11.0]


NEAR = {
    ("distance", Ego(), "lowest", ONE): at("distance", 9.0, 5.0),
    ("distance", Ego(), "lowest", TWO): at("distance", 14.0, 3.0),
}


def test_the_closest_moment_is_with_the_vehicle_that_came_closest() -> None:
    passed, other = deed("pass", 13.0, 15.0, to=2), deed("pass", 13.0, 15.0, to=1)
    found = peak("closeness", extremes=NEAR, deeds=(passed, other))
    assert found == PeakMoment("closeness", 14.0, (passed,), at("distance", 14.0, 3.0), (look(2),))
    assert peak("closeness", looks={}) == PeakMoment("closeness")


def soon(*times: float | None) -> dict[tuple[Any, ...], Any]:
    """The shortest times to a collision with vehicles 1, 2, ..."""
    return {
        ("time-to-collision", Ego(), "lowest", Vehicle(v)): None
        if t is None
        else at("time-to-collision", 5.0 + v, t)
        for v, t in enumerate(times, 1)
    } | NEAR


def test_the_most_dangerous_moment_had_the_least_time_to_react() -> None:
    found = peak("danger", extremes=soon(2.0, 1.5))
    assert (found.time, found.others) == (7.0, (look(2),))
    assert peak("danger", extremes=soon(1.0, 1.5)).time == 6.0
    assert peak("danger", extremes=soon(3.0, None)).time == 6.0
    assert peak("danger", extremes=soon(3.1, None)).time == 14.0  # the closest instead
    assert peak("danger", extremes=soon(None, None)).measure == at("distance", 14.0, 3.0)


YIELDS = (
    deed("give-way", 4.0, 5.0, to=1),
    deed("give-way", 10.0, 12.0, to=1),
    deed("give-way", 11.0, 12.5, to=2),
    deed("change-left", 15.0, 19.0),
)


def test_without_danger_it_was_where_most_others_had_to_be_minded() -> None:
    for of in ("danger", "difficulty"):
        found = peak(of, deeds=YIELDS, extremes=soon(5.0, 6.0))
        assert (found.time, found.deeds[0]) == (10.0, YIELDS[1])
        assert found.deeds[1:] == (YIELDS[2],)
        assert [one.vehicle for one in found.others] == [1, 2]
        assert found.measure == Measure("duration", Ego(), 10.0, value=2.0)
    danger = peak("danger", deeds=YIELDS, extremes=soon(1.0, 6.0))
    assert danger.time == 6.0
    hard = peak("difficulty", deeds=YIELDS, extremes=soon(1.0, 6.0))
    assert hard.time == 10.0
    assert peak("difficulty", extremes=soon(1.0, 6.0)).time == 6.0


def test_giving_way_counts_before_a_change_of_lanes_and_the_longer_of_two() -> None:
    alone, change = deed("give-way", 4.0, 5.0), deed("change-left", 15.0, 19.0)
    assert peak("difficulty", deeds=(alone, change)).time == 4.0
    two = (deed("change-left", 3.0, 5.0), deed("change-right", 15.0, 19.0))
    assert peak("difficulty", deeds=two).time == 15.0
    same = (deed("change-left", 3.0, 5.0), deed("change-right", 15.0, 17.0))
    assert peak("difficulty", deeds=same).time == 3.0
    waits = (deed("wait", 3.0, 9.0), deed("change-right", 15.0, 17.0))
    assert peak("difficulty", deeds=waits).time == 15.0  # it waited for nobody
    with_one = (deed("wait", 3.0, 4.0, to=1), deed("change-right", 15.0, 17.0))
    assert peak("difficulty", deeds=with_one).time == 3.0


def test_those_minded_at_about_the_same_time_belong_together() -> None:
    first = deed("give-way", 4.0, 5.0, to=1)
    for begin, others in ((6.0, [1, 2]), (6.1, [1])):
        asked = Given(deeds=(first, deed("give-way", begin, 9.0, to=2))).asked()
        assert list(peak_moments._partners(asked, first)) == others
    going = deed("give-way", 12.0, to=1)
    later = Given(deeds=(going, deed("wait", 19.0, to=2))).asked()
    assert list(peak_moments._partners(later, going)) == [1, 2]
    before = Given(deeds=(deed("give-way", 2.0, 3.0, to=2), first)).asked()
    assert list(peak_moments._partners(before, first)) == [1, 2]
    long_before = Given(deeds=(deed("give-way", 2.0, 2.9, to=2), first)).asked()
    assert list(peak_moments._partners(long_before, first)) == [1]


def test_the_longest_wait_is_a_standstill_or_else_giving_way() -> None:
    stood = (deed("stop", 3.0, 5.0), deed("stand", 10.0, 14.0), deed("stop", 16.0, 20.0))
    found = peak("waiting", deeds=(*stood, deed("give-way", 6.0, 9.9, to=1)))
    assert (found.time, found.measure and found.measure.value) == (10.0, 4.0)  # the first of two
    rolled = (deed("let-go", 6.0, 8.0, to=1), deed("let-go", 10.0, 11.0, to=2))
    yielded = peak("waiting", deeds=rolled)
    assert (yielded.time, [one.vehicle for one in yielded.others]) == (6.0, [1])
    assert peak("waiting") == PeakMoment("waiting")
    late = peak("waiting", Between(15.0, 20.0), deeds=stood)
    assert late.time == 16.0
    going = peak("waiting", deeds=(*stood, deed("stand", 15.0)))
    assert going.measure == Measure("duration", Ego(), 15.0, value=5.0)


def test_a_slowing_down_of_unknown_speeds_is_not_the_greatest() -> None:
    unknown, slight = deed("brake", 3.0, 5.0), deed("brake", 8.0, 9.0, speed_from=9.0, speed_to=8.5)
    found = peak("slowing", deeds=(unknown, slight))
    assert found.time == 8.0
    assert found.measure == Measure("speed-change", Ego(), 8.0, value=0.5)


def test_what_cost_most_time_is_told_with_who_held_us_up_until_we_were_as_fast_again() -> None:
    short, long = did("brake", 3.0, 5.0), did("slow-down", 8.0, 10.0)
    behind = (did("follow", 8.5, 9.5, object=ONE), did("follow", 12.0, 18.0, object=TWO))
    asked = scene(
        episodes=(short, long, *behind),
        looks={1: look(1), 2: look(2)},
        delays={"brake": 2.0, "slow-down": 6.0},
    )
    found = peak_moments.peak(Peak("delay"), asked)
    assert isinstance(found, PeakMoment)
    assert (found.time, found.measure and found.measure.value) == (8.0, 6.0)
    none = peak_moments.peak(Peak("delay"), scene(episodes=(short,)))
    assert none == PeakMoment("delay")


@pytest.mark.parametrize(("of", "which"), [("slowness", "lowest"), ("speed", "highest")])
def test_among_deeds_their_own_speeds_are_compared(of: Any, which: str) -> None:
    found = at("speed", 12.0, 4.0)
    turned, later = deed("exit-right", 11.0, 13.0), deed("exit-left", 15.0, 17.0)
    given = Given(deeds=(turned, later), extremes={("speed", Ego(), which): found})
    told = peak_moments.peak(Peak(of, deed=Event("turn")), given.asked())
    assert told == PeakMoment(of, 12.0, (turned,), found, among=True)


@pytest.mark.parametrize("action", ["turn", "change-lane", "overtake"])
def test_a_deed_that_never_was_is_said_to_be_none(action: Any) -> None:
    told = peak_moments.peak(Peak("slowness", deed=Event(action)), Given().asked())
    assert isinstance(told, Counted)
    assert told.count == 0
