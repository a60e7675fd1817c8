"""Replies to a clarification, corrections, and new parts put in the place of old ones."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.completion.test_discussed import SLOWED, grounder
from tests.nlu.grounding.fakes import talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    Elliptic,
    Feel,
    HowMuch,
    Identify,
    Listing,
    Repair,
    Request,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Compares,
    Described,
    Ego,
    Event,
    Exit,
    Happens,
    Is,
    Junction,
    Measured,
    Pronoun,
    Quantity,
    Relative,
    Unsaid,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.nlu.grounding.completion.binding import bound
from xavi_dialogue.nlu.grounding.completion.repairs import answers_clarification, complete
from xavi_dialogue.nlu.grounding.completion.replacing import with_event, with_thing, with_time

WHY = Ask(Why(Happens(SLOWED)))
SPEEDS: tuple[Act, ...] = tuple(Ask(HowMuch(Measured("speed", Vehicle(n)))) for n in (1, 2, 3))
THINGS = (Vehicle(1), Vehicle(2), Vehicle(3))
PENDING = Ask(HowMuch(Measured("speed", Described("car"))))
#: A yellow bus 20 m ahead (1), and white cars behind us (2) and to the left ahead (3).
OPEN = talk(offered=SPEEDS, offered_things=THINGS, pending=PENDING)


def repaired(spoken: Repair, discourse: Discourse) -> Act:
    return complete(spoken, grounder(discourse))


@pytest.mark.parametrize(
    ("spoken", "discourse", "found"),
    [
        (Repair("pick", pick=1), OPEN, SPEEDS[0]),
        (Repair("pick", pick=3), OPEN, SPEEDS[2]),
        (Repair("pick", pick=-1), OPEN, SPEEDS[2]),
        (Repair("pick", pick=4), OPEN, None),
        (Repair("pick", pick=-4), OPEN, None),
        (Repair("pick", thing=Vehicle(2)), OPEN, SPEEDS[1]),
        (Repair("pick", pick=2), replace(OPEN, offered=()),
         Ask(HowMuch(Measured("speed", Vehicle(2))))),
        (Repair("pick", pick=2), replace(OPEN, offered=(), pending=None), None),
        (Repair("pick", pick=2), replace(OPEN, offered=(), pending=WHY), WHY),
        # With nothing offered a number is a vehicle, or a speed where a speed was asked for.
        (Repair("pick", pick=90), talk(question=HowMuch(Measured("speed", Vehicle(1)))),
         Ask(Whether(Compares(Measured("speed", Vehicle(1)), "same", Quantity(25.0, "m/s"))))),
        (Repair("pick", pick=90), talk(question=Identify(Vehicle(1))), Ask(Identify(Vehicle(90)))),
        (Repair("pick", pick=2), talk(question=Identify(Vehicle(1))), Ask(Identify(Vehicle(2)))),
        (Repair("pick", pick=-1), talk(question=Identify(Vehicle(1))), None),
        (Repair("yes"), talk(offered=SPEEDS[:1]), SPEEDS[0]),
        (Repair("yes"), talk(offered=SPEEDS[:2]), None),
        (Repair("yes"), talk(pending=PENDING), PENDING),
        (Repair("yes"), Discourse(), None),
        (Repair("no"), talk(offered=SPEEDS[:1]), None),
        (Repair("no"), talk(offered=SPEEDS[:2]), None),
        (Repair("no", thing=Vehicle(2)), talk(question=Identify(Vehicle(1))),
         Ask(Identify(Vehicle(2)))),
        (Repair("no", question=Whither()), talk(question=Identify(Vehicle(1))), Ask(Whither())),
        (Repair("correct", question=Whither()), Discourse(), Ask(Whither())),
        (Repair("correct"), talk(question=Identify(Vehicle(1))), None),
        (Repair("meant", thing=Vehicle(2)), OPEN, SPEEDS[1]),
        (Repair("meant", thing=Vehicle(2)), Discourse(last_acts=(Feel("afraid", Vehicle(1)),)),
         Feel("afraid", Vehicle(2))),
        (Repair("meant", thing=Vehicle(2)),
         Discourse(last_acts=(Claim(Is("fast", Vehicle(1))),)),
         Ask(Whether(Is("fast", Vehicle(2))))),
        (Repair("meant", thing=Vehicle(2)), Discourse(), None),
        (Repair("repeat"), OPEN, None),
    ],
)  # fmt: skip
def test_repairs(spoken: Repair, discourse: Discourse, found: Act | None) -> None:
    assert repaired(spoken, discourse) == (spoken if found is None else found)


@pytest.mark.parametrize(
    ("thing", "chosen"),
    [
        (Vehicle(3), 2),
        (Vehicle(9), None),
        (Described(rank=2), 1),
        (Described(), None),
        (Described("bus"), None),  # a bare kind is read otherwise
        (Described("bus", colour="yellow"), 0),
        (Described(bearing="behind"), 1),
        (Described(colour="white"), None),  # two are
        (Described(colour="white", bearing="ahead"), 2),
        (Described(colour="white", extreme="nearest"), 1),
        (Described(colour="white", extreme="farthest"), 2),
        (Described(colour="red"), None),
        (Ego(), None),
    ],
)
def test_a_thing_names_what_was_offered(thing: Any, chosen: int | None) -> None:
    for form in ("same", "which"):
        found = answers_clarification(Elliptic(thing, form=form), grounder(OPEN))
        assert found == (None if chosen is None else SPEEDS[chosen])
    assert answers_clarification(Elliptic(thing, form="where"), grounder(OPEN)) is None
    assert answers_clarification(Elliptic(thing), grounder()) is None


def test_an_event_names_the_act_that_was_offered() -> None:
    acts = tuple(Ask(Why(Happens(Event("turn", side=side)))) for side in ("left", "right"))
    offered = grounder(talk(offered=acts))
    assert answers_clarification(Elliptic(event=Event("turn", side="right")), offered) == acts[1]
    assert answers_clarification(Elliptic(event=Event("turn")), offered) is None
    assert answers_clarification(Elliptic(event=Event("stop", side="right")), offered) is None


def test_a_bare_kind_said_to_correct_is_another_one() -> None:
    asked = talk(question=Identify(Vehicle(2)))
    car, bus = Described("car"), Described("bus")
    assert repaired(Repair("correct", thing=car), asked) == Ask(Identify(replace(car, other=True)))
    assert repaired(Repair("correct", thing=bus), asked) == Ask(Identify(bus))
    left = Described("car", bearing="left")
    assert repaired(Repair("correct", thing=left), asked) == Ask(Identify(left))
    second = Described("car", rank=2)
    assert repaired(Repair("correct", thing=second), asked) == Ask(Identify(second))
    assert repaired(Repair("correct", thing=car), talk(question=Whither(BUS))) == Ask(Whither(car))


BUS = Described("bus")


@pytest.mark.parametrize(
    ("term", "thing", "found"),
    [
        (Identify(Vehicle(1)), Vehicle(2), Identify(Vehicle(2))),
        (Identify(BUS), Vehicles((1, 2)), Identify(Vehicles((1, 2)))),
        (Identify(Vehicle(1)), Ego(), Identify(Ego())),
        (HowMuch(Measured("speed")), Vehicle(1), HowMuch(Measured("speed", Vehicle(1)))),
        (HowMuch(Measured("speed")), Ego(), HowMuch(Measured("speed"))),
        (Happens(Event("leave", object=Exit(1))), Exit(2), Happens(Event("leave", object=Exit(2)))),
        (Happens(Event("leave", object=Vehicle(1))), Exit(2),
         Happens(Event("leave", object=Exit(2)))),
        (Identify(Vehicle(1)), Junction(), Identify(Vehicle(1))),
        (Doing(), Vehicle(1), Doing(Vehicle(1))),
        (Listing("beliefs"), Vehicle(1), Listing("beliefs", Vehicle(1))),
        (None, Vehicle(1), None),
    ],
)  # fmt: skip
def test_a_thing_takes_the_place_of_one_of_its_sort(term: Any, thing: Any, found: Any) -> None:
    assert with_thing(term, thing, grounder().context) == found


@pytest.mark.parametrize(
    ("term", "event", "found"),
    [
        (None, Event("stop"), Happens(Event("stop"))),
        (Is("fast", Ego()), Event("stop"), Happens(Event("stop"))),
        (Identify(Vehicle(1)), Event("stop"), Identify(Vehicle(1))),
        (Happens(Event("brake", Vehicle(1), time=At(3.0))), Event("stop"),
         Happens(Event("stop", Vehicle(1)))),
        (Happens(Event("brake", Vehicle(1), time=At(3.0))), Event("brake", manner=("hard",)),
         Happens(Event("brake", Vehicle(1), manner=("hard",), time=At(3.0)))),
        (Happens(Event("brake", time=At(3.0))), Event("brake", tense="future"),
         Happens(Event("brake", tense="future"))),
        (Happens(Event("brake", time=At(3.0))), Event("brake", time=At(9.0)),
         Happens(Event("brake", time=At(9.0)))),
        (Happens(Event("brake")), Event("stop", Vehicle(2)), Happens(Event("stop", Vehicle(2)))),
    ],
)  # fmt: skip
def test_an_event_takes_the_place_of_another(term: Any, event: Event, found: Any) -> None:
    assert with_event(term, event) == found


@pytest.mark.parametrize(
    ("term", "found"),
    [
        (Event("stop"), Event("stop", time=At(3.0))),
        (Measured("speed"), Measured("speed", time=At(3.0))),
        (Whither(), Whither(time=At(3.0))),
        (Why(Happens(SLOWED)), Why(Happens(replace(SLOWED, time=At(3.0))))),
        (Why(Happens(Event("enter", object=Junction(time=9.0)))),
         Why(Happens(Event("enter", object=Junction(time=9.0), time=At(3.0))))),
    ],
)  # fmt: skip
def test_a_time_takes_the_place_of_another(term: Any, found: Any) -> None:
    assert with_time(term, At(3.0)) == found


# Pronouns and omissions in the time of a question.


def timed(main: Event, anchor: Event, relation: Any = "during") -> Ask:
    return Ask(Why(Happens(replace(main, time=Relative(relation, anchor)))))


@pytest.mark.parametrize(
    ("main", "anchor", "found"),
    [
        # "why did the bus stop when it appeared"
        (Event("stop", BUS), Event("appear", Pronoun("it")),
         (Vehicle(1), Event("appear", Vehicle(1)))),
        (Event("stop", Vehicle(1)), Event("appear", Pronoun("he")),
         (Vehicle(1), Event("appear", Vehicle(1)))),
        (Event("stop", BUS), Event("appear", Pronoun("they")),
         (BUS, Event("appear", Pronoun("they")))),
        # "what was the bus doing when we passed": whom we passed
        (Event("stop", BUS), Event("pass"), (Vehicle(1), Event("pass", object=Vehicle(1)))),
        (Event("stop", BUS), Event("overtake"), (Vehicle(1), Event("overtake", object=Vehicle(1)))),
        (Event("stop", BUS), Event("pass", Vehicle(3)), (BUS, Event("pass", Vehicle(3)))),
        (Event("stop", BUS), Event("turn"), (BUS, Event("turn"))),
        # "has he braked when we did"
        (Event("brake", Vehicle(2)), Event("do"), (Vehicle(2), Event("brake"))),
        (Event("brake", Vehicle(2)), Event("do", object=Pronoun("it"), tense="perfect"),
         (Vehicle(2), Event("brake", tense="perfect"))),
        (Event("do", Vehicle(2)), Event("do"), (Vehicle(2), Event("do"))),
        # "why did it stop when the bus turned"
        (Event("stop", Pronoun("it")), Event("turn", BUS), (Vehicle(1), Event("turn", BUS))),
        (Event("stop", Pronoun("they")), Event("turn", BUS), (Pronoun("they"), Event("turn", BUS))),
        (Event("stop"), Event("turn", BUS), (Ego(), Event("turn", BUS))),
    ],
)  # fmt: skip
def test_the_time_of_a_question_speaks_of_what_the_question_does(
    main: Event, anchor: Event, found: tuple[Any, Event]
) -> None:
    event: Any = bound(timed(main, anchor), grounder()).question.of.event  # type: ignore[union-attr]
    assert (event.actor, event.time) == (found[0], Relative("during", found[1]))


def test_other_times_bind_nothing() -> None:
    for time in (Unsaid(), At(3.0), Relative("during", Vehicle(1)), Between(3.0, 4.0)):
        asked = Ask(Why(Happens(Event("stop", BUS, time=time))))
        assert bound(asked, grounder()) == asked
    nobody = timed(Event("stop", Described("motorcycle")), Event("pass"))
    assert bound(nobody, grounder()) == nobody


def test_a_request_is_repaired_as_a_question_whether() -> None:
    before = Discourse(last_acts=(Request(Event("overtake", object=Vehicle(1))),))
    found = repaired(Repair("meant", thing=Vehicle(2)), before)
    assert found == Ask(Whether(Happens(Event("overtake", object=Vehicle(2)))))
