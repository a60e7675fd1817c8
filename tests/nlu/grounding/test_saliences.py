"""Salience, the scene, and what happened: worked out case by case."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse, GroundedAct, Mention, Span
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Identify,
    Social,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Everyone,
    Happens,
    Nobody,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.grounding import salience
from xavi_dialogue.nlu.grounding.context import Context, Notes
from xavi_dialogue.nlu.grounding.kin import like
from xavi_dialogue.nlu.grounding.things.scene import (
    interacting,
    most_prominent,
    nearest,
    prominence,
)

STOPS = Happens(Event("stop", Vehicle(3)))


@pytest.mark.parametrize(
    ("role", "weight"),
    [("subject", 1.0), ("cause", 0.95), ("object", 0.85), ("other", 0.7), (None, 0.7), ("x", 0.7)],
)
def test_roles_have_weights(role: str | None, weight: float) -> None:
    mine = salience.mention(Vehicle(3), 4, role)
    assert (mine.salience, mine.turn, mine.by_car) == (weight, 4, False)
    ours = salience.mention(Vehicle(3), 4, role, by_car=True)
    assert ours.salience == pytest.approx(0.97 * weight)
    assert ours.by_car


def mentioned(number: int, weight: float, turn: int = 1, role: str = "subject") -> Mention:
    return Mention(Vehicle(number), turn, False, weight, role)


def test_mentions_are_ordered_by_salience_then_turn_then_role() -> None:
    row = [
        mentioned(1, 0.5),
        mentioned(2, 0.9),
        mentioned(3, 0.5, turn=2),
        mentioned(4, 0.5, role="object"),
    ]
    assert [m.thing.number for m in salience.ordered(row)] == [2, 3, 1, 4]  # type: ignore[union-attr]


def test_a_turn_takes_two_fifths_and_what_is_left_may_be_too_little() -> None:
    found = salience.decayed([mentioned(1, 1.0), mentioned(2, 0.09), mentioned(3, 0.08)])
    assert [m.thing for m in found] == [Vehicle(1), Vehicle(2)]
    assert [m.salience for m in found] == pytest.approx([0.6, 0.054])


def test_what_is_named_again_keeps_the_higher_salience_and_the_later_mention() -> None:
    before = [mentioned(1, 0.9), mentioned(2, 0.4)]
    found = salience.renewed(
        before, [mentioned(1, 0.8, 2), mentioned(2, 0.4, 2), mentioned(3, 1.0, 2)]
    )
    assert [(m.thing.number, m.turn) for m in found] == [(3, 2), (1, 1), (2, 2)]  # type: ignore[union-attr]


def test_parts_in_an_act_are_told_by_the_events() -> None:
    asked = Ask(Why(Happens(Event("follow", Vehicle(2), object=Vehicles((5, 6))))))
    by_car = salience.mentions_of(asked, 3, by_car=True)
    assert [(m.thing, m.role, m.by_car, m.turn) for m in by_car] == [
        (Vehicle(2), "subject", True, 3), (Vehicles((5, 6)), "object", True, 3)
    ]  # fmt: skip
    alone = salience.mentions_of(Ask(Identify(Vehicle(4))), 1)
    assert [(m.thing, m.role, m.by_car) for m in alone] == [(Vehicle(4), "subject", False)]
    assert salience.mentions_of(Ask(Why(Happens(Event("stop", Ego())))), 1) == ()


def test_vehicles_of_a_group_have_less_but_not_where_they_were_named_alone() -> None:
    group = replace(mentioned(1, 1.0), thing=Vehicles((1, 2, 3)))
    found = salience.vehicles_of([mentioned(2, 0.9), group, mentioned(3, 0.95)])
    assert found == ((3, 0.95), (2, 0.9), (1, 0.8))
    assert salience.group([mentioned(2, 0.9), replace(group, thing=Vehicles((4,))), group]) == (
        1, 2, 3
    )  # fmt: skip
    assert salience.group([mentioned(2, 0.9)]) == ()


def test_what_was_just_said_outdoes_all_that_was_said_before() -> None:
    found = salience.naming(talk(Vehicle(1), Vehicle(2)), Happens(Event("stop", Vehicle(2))))
    assert found.mentions[0].thing == Vehicle(2)
    assert found.mentions[0].salience == pytest.approx(0.9 + 1.0 + 1.5)
    assert salience.naming(Discourse(), STOPS).mentions[0].salience == pytest.approx(2.5)


def test_within_a_turn_acts_lead_on() -> None:
    before = Discourse(propositions=(STOPS,), episode=(1.0, 2.0))
    why = GroundedAct(Ask(Why(STOPS)), Span(3.0, 62.9))
    assert salience.after(before, why).episode == (3.0, 62.9)
    for span in (None, Span(3.0, 5.0, ahead=True), Span(3.0, 63.0)):
        assert salience.after(before, replace(why, span=span)).episode == (1.0, 2.0)
    assert salience.after(before, why).question == Why(STOPS)
    claimed = Happens(Event("go"))
    found = salience.after(before, GroundedAct(Claim(claimed)))
    assert found.propositions == (claimed, STOPS)
    assert salience.after(before, GroundedAct(Social("thanks"))).question is None


@pytest.mark.parametrize(
    ("act", "span", "time"),
    [
        (Ask(Why(Happens(Event("stop", time=At(9.0))))), None, (9.0, 9.0)),
        (Ask(Why(Happens(Event("stop", time=At(19.6))))), None, (19.6, 19.6)),
        (Ask(Why(Happens(Event("stop", time=At(19.8))))), None, None),
        (Ask(Why(STOPS)), Span(3.0, 5.0, said=True), (3.0, 5.0)),
        (Ask(Why(STOPS)), Span(3.0, 5.0), None),
        (Ask(Why(STOPS)), Span(3.0, 19.7, said=True), None),
        (Ask(Why(STOPS)), None, None),
    ],
)
def test_a_time_that_is_named_and_over(
    act: Any, span: Span | None, time: tuple[float, float] | None
) -> None:
    assert salience.named_time(GroundedAct(act, span), 20.0) == time


def kin(event: Event, *happened: Any) -> list[str]:
    context = Context(FakeWorld({1: Car(20.0)}, happened), Discourse())
    return [episode.action for episode in like(context, event, 0.0, 20.0)]


def test_what_somebody_did_who_is_said_to_have_done_something_like_it() -> None:
    stood, braked = did("stand", 4.0), did("brake", 8.0)
    assert kin(Event("stop"), stood, braked) == ["stand"]  # the nearest there is
    assert kin(Event("stop"), braked) == ["brake"]
    assert kin(Event("turn"), braked) == []
    followed = did("follow", 4.0, whom=1)
    assert kin(Event("follow", object=Vehicle(2)), followed) == ["follow"]
    assert kin(Event("follow"), followed) == []
    other = did("follow", 4.0, who=1, whom=0)
    assert kin(Event("follow", Vehicle(1), object=Vehicle(2)), other) == []


def scene(cars: dict[int, Car], *happened: Any, discourse: Discourse | None = None) -> Context:
    return Context(FakeWorld(cars, happened), discourse or Discourse())


@pytest.mark.parametrize(
    ("car", "distance"),
    [
        (Car(20.0), 20.0),
        (Car(1.0), 2.0),
        (Car(20.0, seen=(0.0, 9.0)), 60.0),
        (Car(-20.0), 30.0),
        (Car(20.0, drift=-1.0, at=10.0), 14.0),  # it comes nearer
        (Car(20.0, drift=-0.4, at=10.0), 20.0),
        (Car(20.0, seen=(10.5, 99.0)), 1e4),
    ],
)
def test_who_is_near_in_view_and_comes_stands_out(car: Car, distance: float) -> None:
    assert prominence(scene({1: car}), 1, 10.0) == pytest.approx(distance)


def test_who_was_mentioned_or_has_to_do_with_us_stands_out() -> None:
    cars = {1: Car(20.0), 2: Car(40.0)}
    assert prominence(scene(cars, discourse=talk(Vehicle(1))), 1, 10.0) == pytest.approx(8.0)
    faded = replace(talk(Vehicle(1)), mentions=(mentioned(1, 0.29),))
    assert prominence(scene(cars, discourse=faded), 1, 10.0) == pytest.approx(20.0)
    for episode, distance in (
        (did("follow", 4.0, 6.0, whom=1), 8.0),
        (did("follow", 0.5, 1.5, whom=1), 20.0),  # more than 8 s ago
        (did("follow", 4.0, 6.0, whom=2), 20.0),
        (did("see", 4.0, 6.0, whom=1), 20.0),
    ):
        assert prominence(scene(cars, episode), 1, 10.0) == pytest.approx(distance)


def test_the_nearest_stands_out_clearly_within_three_fifths() -> None:
    cars = {1: Car(20.0), 2: Car(11.9), 3: Car(90.0)}
    assert most_prominent(scene(cars), (1, 2, 3), 10.0) == ((2, 1, 3), True)
    assert most_prominent(scene({**cars, 2: Car(12.1)}), (1, 2), 10.0) == ((2, 1), False)
    assert most_prominent(scene(cars), (3,), 10.0) == ((3,), True)
    assert [one.vehicle for one in nearest(scene(cars), (1, 2, 3, 9), 10.0)] == [2, 1, 3]


def test_who_has_to_do_with_us_is_meant_then_our_leader_then_the_nearest() -> None:
    cars = {1: Car(60.0), 2: Car(10.0, 5.0), 3: Car(30.0, -9.0)}
    assert interacting(scene(cars), 10.0) == 1  # ahead of us within 70 m
    assert interacting(scene({**cars, 1: Car(71.0)}), 10.0) == 2
    last = [did("wait", 3.0, 5.0, whom=2), did("wait", 6.0, 8.0, whom=3)]
    assert interacting(scene(cars, *last), 10.0) == 3
    assert interacting(scene(cars, did("see", 6.0, 8.0, whom=3)), 10.0) == 1
    assert interacting(scene(cars, did("wait", 0.5, 1.5, whom=3)), 10.0) == 1
    assert interacting(scene({}), 10.0) is None


def test_who_did_what_is_said_is_meant_even_far_away() -> None:
    cars = {1: Car(60.0), 2: Car(10.0, 5.0), 3: Car(30.0, seen=(0.0, 4.0)),
            4: Car(30.0, seen=(0.0, 4.0))}  # fmt: skip
    done = {2: did("brake", 5.0, who=2), 3: did("brake", 2.0, who=3), 4: did("brake", 3.0, who=4)}

    def fits(*known: int) -> Any:
        return lambda vehicle: done[vehicle] if vehicle in known else None

    assert interacting(scene(cars), 10.0, fits(2, 3)) == 2
    assert interacting(scene(cars), 10.0, fits(3, 4)) == 4  # the last, of those out of view
    assert interacting(scene(cars), 10.0, fits()) == 1


def test_a_time_that_was_said_counts_most_and_else_the_first() -> None:
    notes = Notes()
    notes.spans(Span(1.0, 2.0))
    notes.spans(Span(3.0, 4.0))
    assert notes.span == Span(1.0, 2.0)
    notes.spans(Span(5.0, 6.0, said=True))
    notes.spans(Span(7.0, 8.0, said=True))
    assert notes.span == Span(5.0, 6.0, said=True)


def test_events_of_several_or_of_anybody_are_looked_for_one_by_one() -> None:
    happened = (did("brake", 4.0, who=2), did("brake", 3.0, who=1), did("brake", 2.0, who=3),
                did("follow", 6.0, whom=2), did("follow", 5.0, whom=1))  # fmt: skip
    context = scene({1: Car(20.0), 2: Car(30.0), 3: Car(40.0)}, *happened)

    def begins(event: Event, begin: float = 0.0, end: float = 20.0) -> list[float]:
        return [episode.begin for episode in context.holds(event, begin, end)]

    assert begins(Event("brake", Vehicles((1, 2)))) == [3.0, 4.0]
    assert begins(Event("brake", Everyone())) == begins(Event("brake", Wanted())) == [2.0, 3.0, 4.0]
    assert begins(Event("follow", object=Vehicles((1, 2)))) == [5.0, 6.0]
    assert begins(Event("follow", object=Wanted())) == [5.0, 6.0]
    assert begins(Event("brake", Nobody())) == []
    assert begins(Event("brake", Vehicle(1)), 21.0, 30.0) == []
    assert begins(Event("brake", Vehicle(1)), -9.0, -1.0) == []
    assert begins(Event("brake", Vehicle(1)), 3.0, 99.0) == [3.0]
    # Neither manner nor modal matters to whether it came about.
    assert begins(Event("brake", Vehicle(1), manner=("hard",), modal="would", time=At(9.0))) == [
        3.0
    ]
    assert context.within(talk(Vehicle(1))).discourse == talk(Vehicle(1))
