"""What several others are expected to do, and how close they came."""

from typing import Any

from msgspec.structs import replace

from tests.explain.answers.given import NOW, Given, look
from xavi_dialogue.domain.answers import Forecast
from xavi_dialogue.domain.facts import Belief, Expectation
from xavi_dialogue.domain.meaning import Doing, Listing, Whether
from xavi_dialogue.domain.terms import Ego, Event, Happens, Next, Vehicle, Vehicles, WholeRide
from xavi_dialogue.explain.answers.events.accounts import listing
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.propositions.happenings import doing
from xavi_dialogue.explain.answers.propositions.verdicts import whether

THEM = Vehicles((1, 2, 3, 4))


def belief(vehicle: int) -> Belief:
    return Belief(vehicle, NOW, (Expectation(("cross",), 0.9), Expectation(("stop",), 0.1)))


def given(**more: Any) -> Given:
    looks = {
        1: replace(look(1), distance=9.0),
        2: replace(look(2), distance=4.0),
        3: replace(look(3), in_view=False),
        4: look(4),
    }
    return Given(looks=looks, beliefs={1: belief(1), 2: belief(2), 3: belief(3)}, **more)


def test_those_in_view_of_whom_something_is_believed_are_told_nearest_first() -> None:
    found = forecast(given().asked(), map(Vehicle, THEM.numbers))
    assert found == Forecast((belief(2), belief(1)))
    assert forecast(given().asked(), (Ego(), Vehicle(4))) is None


def test_several_are_told_by_what_is_believed_of_each() -> None:
    told = Forecast((belief(2), belief(1)))
    assert doing(Doing(THEM, Next(), "future"), given().asked()) == told
    assert listing(Listing("beliefs", THEM, WholeRide()), given().asked()) == told
    crossing = Event("cross", THEM, Ego(), time=Next(), tense="future")
    assert whether(Whether(Happens(crossing)), given().asked()) == told
