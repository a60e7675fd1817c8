"""Of whom a state, a relation or a rule holds, and who is likeliest to do something; at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import look, result, scene, they
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    Identified,
    Located,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure, Relating
from xavi_dialogue.domain.meaning import Which
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Related,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.explain.answers.propositions import identify as room
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding

IT, OTHER, US, WHO = Vehicle(1), Vehicle(2), Ego(), Wanted()
SEEN = {1: look(1), 2: look(2, 40.0, kind="truck"), 3: look(3, -15.0, colour="blue")}
SAID = Span(4.0, 6.0, said=True)


def numbers(found: Any) -> list[int]:
    return [one.vehicle for one in found.looks]


def which(such: Any, thing: Any = WHO, span: Span | None = None, among: Any = (), **more: Any) -> Any:  # fmt: skip  # noqa: E501
    such = Happens(such) if isinstance(such, Event) else such
    return result(room.which, Which(thing, such, among), scene(span, **({"looks": SEEN} | more)))


BRAKES = (they(1, "brake", 5.0, 6.0), they(2, "brake", 3.0, 4.0), they(1, "brake", 12.0, 13.0))


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> dict[Any, Any]:
    """What is found of each, by vehicle: it does not hold unless a test says so."""
    known: dict[Any, Any] = {}

    def weigh(of: Any, _: Any) -> Any:
        thing = of.event.actor if isinstance(of, Happens) else of.thing
        found = known.get(thing, Finding(False))
        if isinstance(found, Exception):
            raise found
        return found

    monkeypatch.setattr(room, "weigh", weigh)
    return known


LIKELY, HARDLY = Finding(False, probability=0.3), Finding(False, probability=0.29)


def test_who_is_likeliest_to_do_so_comes_first(held: Any) -> None:
    held |= {IT: LIKELY, OTHER: Finding(True, probability=0.8), Vehicle(3): HARDLY}
    told = which(Event("turn", WHO, tense="future"))
    assert (numbers(told), told.none) == ([2, 1], False)
    state = which(Is("slow", WHO))
    assert numbers(state) == [2]
    held[IT] = Finding(True)
    assert numbers(which(Is("slow", WHO))) == [1, 2]  # for certain
    held[IT] = Unanswered(DidNotHappen(Event("turn")))
    assert numbers(which(Is("slow", WHO))) == [2]


def test_a_rule_is_told_at_once(held: Any) -> None:
    held[OTHER] = Finding(None, answer=Priority(20.0, "equal", 2))
    assert which(Is("last", WHO)) == Priority(20.0, "equal", 2)


def test_we_may_be_who_it_is(held: Any) -> None:
    held[US] = Finding(True, (Measure("speed", US, 20.0, value=3.0),))
    told = which(Is("slow", WHO))
    assert (told.looks, told.none) == ((), False)
    assert [fact.value for fact in told.facts] == [3.0]
    assert which(Is("slow", WHO), Wanted("car")).none


def test_what_bears_it_out_is_told_but_places_and_looks(held: Any) -> None:
    speeds = tuple(Measure("speed", IT, 20.0, value=float(k)) for k in range(10))
    beside = Relating("behind", IT, US, 20.0, True)
    held[IT] = Finding(True, (*speeds, SEEN[1], beside))
    told = which(Is("slow", WHO))
    assert told.facts == speeds[:8]


def test_who_is_lost_is_told_as_seen_last(held: Any) -> None:
    gone = {n: look(n, in_view=False, seen=s) for n, s in ((1, 15.0), (2, 5.0), (3, 18.0))}
    held |= {IT: Finding(True), OTHER: Finding(True)}
    for state in ("hidden", "lost"):
        told = which(Is(state, WHO), looks=gone)
        assert isinstance(told, Located)
        assert (told.thing, numbers(told), told.gap) == (Vehicles((1,)), [1], "out-of-view")
    held[IT] = Finding(False)
    assert which(Is("lost", WHO), looks=gone) == Identified((), Is("lost", WHO), none=True)
    assert which(Is("slow", WHO), looks=gone).none  # who is out of view is not asked after


@pytest.mark.parametrize(
    ("such", "thing", "ahead", "found"),
    [
        (Related("ahead-of", WHO), WHO, {1: "ahead", 2: "ahead", 3: "ahead-left"}, [2]),
        (Related("ahead-of", WHO), Described(plural=True), {1: "ahead", 2: "ahead"}, [2, 1]),
        (Related("ahead-of", WHO), WHO, {1: "ahead-left", 3: "ahead-right"}, [3]),
        (Related("behind", WHO), WHO, {1: "behind", 2: "behind-left"}, [1]),
        (Related("left-of", WHO), WHO, {1: "beside-left", 2: "ahead"}, [2, 1]),
        (Related("near", WHO), WHO, {1: "ahead", 2: "ahead"}, [2, 1]),
        (Related("can-see", WHO), WHO, {1: "ahead", 2: "ahead"}, [2, 1]),
        (Is("visible", WHO), WHO, {1: "ahead", 2: "ahead"}, [2, 1]),
        (Is("present", WHO), WHO, {1: "ahead", 2: "ahead"}, [2, 1]),
        (Is("slow", WHO), WHO, {1: "ahead", 2: "ahead"}, [1, 2]),
        (Is("slow", WHO), Described(extreme="nearest"), {1: "ahead", 2: "ahead"}, [2]),
    ],
)
def test_of_those_at_a_place_the_plainest_counts(
    held: Any, such: Any, thing: Any, ahead: Any, found: list[int]
) -> None:
    near = {n: look(n, 40.0 - 10.0 * n, bearing=b) for n, b in ahead.items()}
    held |= {Vehicle(n): Finding(True) for n in ahead}
    assert numbers(which(such, thing, looks=near)) == found


def test_who_merely_is_there_is_told_by_the_look_alone(held: Any) -> None:
    held |= {IT: Finding(True, (BRAKES[0],)), OTHER: Finding(True)}
    two = which(Is("visible", WHO))
    assert (two.such, two.facts) == (None, ())
    for relation in ("near", "can-see"):
        assert which(Related(relation, WHO)).such is None
    held[OTHER] = Finding(False)
    one = which(Is("visible", WHO))
    assert (one.such, one.facts) == (Is("visible", WHO), (BRAKES[0],))
    crowd = {n: look(n, 60.0 - 10.0 * n) for n in range(1, 6)}
    held |= {Vehicle(n): Finding(True, (BRAKES[0],)) for n in crowd}
    left = which(Related("left-of", WHO), looks=crowd)
    assert (numbers(left), left.facts) == ([5, 4, 3, 2, 1], ())
    four = which(Related("left-of", WHO), looks={n: crowd[n] for n in range(1, 5)})
    assert (numbers(four), four.such) == ([4, 3, 2, 1], Related("left-of", WHO))
    assert len(which(Related("ahead-of", WHO), looks=crowd).looks) == 1


def test_who_is_behind_another_is_told_with_what_it_does(held: Any) -> None:
    held |= {IT: Finding(True, (BRAKES[0],)), Vehicle(3): Finding(True)}
    speeds = {("speed", 1): 7.0, ("speed", 3): 8.0}
    of_two = Related("behind", WHO, OTHER)
    told = which(of_two, values=speeds)
    assert (numbers(told), [fact.value for fact in told.facts]) == ([1], [7.0])
    assert which(of_two).facts == (BRAKES[0],)
    both = which(Related("left-of", WHO, OTHER), values=speeds)
    assert numbers(both) == [3, 1]  # the nearest first


# Whose turn it is -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("such", "rule", "told"),
    [
        (Related("has-priority-over", WHO, US), "give-way", True),
        (Related("has-priority-over", WHO, US), "none", True),
        (Event("wait", WHO), "give-way", True),
        (Event("go", WHO, manner=("first",)), None, False),
    ],
)
def test_who_goes_first_is_told_by_the_rule(
    monkeypatch: pytest.MonkeyPatch, held: Any, such: Any, rule: Any, told: bool
) -> None:
    found = None if rule is None else Priority(20.0, rule)
    monkeypatch.setattr(room, "who_first", lambda *_: found)
    assert (which(such) == found) is told


def test_going_first_is_a_state(held: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "who_first", lambda *_: None)
    held[IT] = Finding(True)
    first = which(Event("go", WHO, manner=("first",)))
    assert (numbers(first), first.such) == ([1], Is("first", WHO, tense="past"))
    perfect = which(Event("cross", WHO, manner=("first",), tense="perfect", time=At(3.0)))
    assert perfect.such == Is("first", WHO, time=At(3.0), tense="past")
    now = which(Event("enter", WHO, manner=("first",), tense="present"))
    assert now.such == Is("first", WHO)
    assert which(Event("brake", WHO, manner=("first",)), episodes=BRAKES).facts == (
        BRAKES[1],
        BRAKES[0],
        BRAKES[2],
    )


def test_who_has_right_of_way_over_another_is_whom_that_lets_go(
    monkeypatch: pytest.MonkeyPatch, held: Any
) -> None:
    monkeypatch.setattr(room, "who_first", lambda *_: Priority(20.0, "none"))
    gave = they(1, "give-way", 19.0, object=OTHER)
    over = Related("has-priority-over", Described("bus"), IT)
    assert numbers(which(over, Described("bus"), episodes=(gave,))) == [2]
    assert which(over, Described("bus")) == Priority(20.0, "none")
