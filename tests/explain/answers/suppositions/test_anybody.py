"""What if somebody who is not there comes, or nobody does what is owed to us; at 15 s."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, look, refused
from xavi_dialogue.domain.answers import CannotSay, Reaction
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Exists, Happens, Nobody, Vehicle
from xavi_dialogue.explain.answers.suppositions.anybody import of_anybody

ONE, TWO = Vehicle(1), Vehicle(2)
LETS = Happens(Event("let-go", Nobody(), Ego(), tense="present"))


def asked(*deeds: Episode) -> Any:
    speed = {("speed", Ego()): 10.0}
    return Given(looks={1: look(1), 2: look(2)}, deeds=deeds, measures=speed).asked()


def test_if_nobody_lets_us_go_it_is_the_one_that_gives_way() -> None:
    gave = Episode(ONE, "give-way", 2.0, 5.0, object=Ego())
    given = asked(gave, Episode(TWO, "give-way", 9.0, object=Ego()))
    for action in ("let-go", "give-way", "stop"):
        nobody: Any = Happens(Event(action, Nobody(), Ego(), tense="present"))  # type: ignore[arg-type]
        found = of_anybody(nobody, given, negated=True)
        assert found == Happens(Event(action, TWO, Ego(), tense="present"))  # type: ignore[arg-type]


def test_if_nobody_gives_way_to_us_nothing_can_be_said() -> None:
    assert refused(of_anybody, LETS, asked(), negated=True) == CannotSay("unsupported-condition")
    over = asked(Episode(ONE, "give-way", 2.0, 5.0, object=Ego()))
    assert isinstance(refused(of_anybody, LETS, over, negated=True), CannotSay)
    past = Happens(Event("let-go", Nobody(), Ego(), tense="perfect"))
    found = of_anybody(past, over, negated=True)
    assert found == Happens(Event("let-go", ONE, Ego(), tense="perfect"))


def test_who_comes_may_get_in_our_way_and_nobody_else_can_be_added() -> None:
    comes = of_anybody(Happens(Event("come", Nobody())), asked(), negated=False)
    assert isinstance(comes, Reaction)
    assert (comes.kind, comes.time) == ("anybody", NOW)
    follows = Happens(Event("follow", Nobody(), Ego()))
    assert refused(of_anybody, follows, asked(), negated=False) == CannotSay("imagined")
    denied = Happens(Event("turn", Nobody()))
    assert refused(of_anybody, denied, asked(), negated=True) == CannotSay("unsupported-condition")


@pytest.mark.parametrize("of", [None, Exists(ONE), Happens(Event("stop", ONE))])
def test_of_a_vehicle_it_says_nothing(of: Any) -> None:
    assert of_anybody(of, asked(), negated=False) is None
