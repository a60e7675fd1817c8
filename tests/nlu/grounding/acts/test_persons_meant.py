"""Questions in which it matters who is spoken of: others, and from whom there was a danger."""

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import HowLong, Whether
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Is,
    Junction,
    Not,
    Pronoun,
    Related,
    Relative,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.acts.dangers import threatened
from xavi_dialogue.nlu.grounding.acts.others import of_others
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

LORRY = Described("truck")


def grounder() -> TermGrounder:
    world = FakeWorld({1: Car(20.0, kind="truck"), 2: Car(-10.0)})
    return TermGrounder(Context(world, Discourse()))


def test_how_long_we_stood_behind_somebody_is_how_long_we_stood() -> None:
    stood = Event("stand", Ego(), where=Related("behind", Ego(), LORRY), tense="past")
    plain = Event("stand", Ego(), tense="past")
    assert of_others(HowLong(stood), grounder()) == HowLong(plain)


def test_how_long_somebody_has_stood_beside_us_is_how_long_it_was_there() -> None:
    beside = Related("near", LORRY, Ego(), tense="present")
    stands = Event("stand", LORRY, where=Related("near", LORRY, Ego()), tense="present")
    assert of_others(HowLong(stands), grounder()) == HowLong(beside)
    lights = Related("near", LORRY, Feature("light"))
    at_lights = Event("stand", LORRY, where=lights, tense="present")
    assert of_others(HowLong(at_lights), grounder()) is None


def test_whether_we_keep_away_from_somebody_is_whether_it_is_not_close() -> None:
    keeps = Event("keep-distance", Ego(), LORRY, tense="present")
    close = Whether(Not(Is("close", LORRY), lexical=True))
    assert of_others(Whether(Happens(keeps)), grounder()) == close


@pytest.mark.parametrize("whom", [LORRY, Pronoun("he")])
def test_a_danger_while_somebody_did_something_came_from_it(whom: Described | Pronoun) -> None:
    when = Relative("during", Event("pass", whom, Ego(), tense="past"))
    danger = Is("dangerous", Ego(), tense="past", time=when)
    assert threatened(danger, grounder()).thing == whom


def test_a_danger_otherwise_is_that_of_what_is_named() -> None:
    ours = Relative("during", Event("pass", Ego(), Junction(), tense="past"))
    for said in (
        Is("dangerous", Ego(), tense="past", time=ours),
        Is("dangerous", Vehicle(1), tense="past"),
        Is("slow", Ego(), tense="past"),
    ):
        assert threatened(said, grounder()) == said
