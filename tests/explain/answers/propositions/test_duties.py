"""Whether questions of right of way and advice are answered by the rule, in the right polarity."""

import pytest

from tests.explain.answers.asked_facts import told
from tests.explain.answers.test_direct import BESIDE, ring, said
from tests.explain.facts.scenes import made
from xavi_dialogue.domain.answers import Priority, Verdict
from xavi_dialogue.domain.meaning import Claim, Whether, Which
from xavi_dialogue.domain.terms import Event, Everyone, Happens, Not, Related, Wanted
from xavi_dialogue.explain.history.ride import Ride

MUST = Event("wait", tense="present", modal="must")
FIRST = Event("go", manner=("first",), tense="present", modal="should")


@pytest.fixture
def ride() -> Ride:
    return made(BESIDE, 4.0, roads=ring)


def test_who_has_to_wait_is_told_by_the_rule(ride: Ride) -> None:
    found = told(ride, Whether(Happens(MUST)))
    assert isinstance(found, Priority)
    assert (found.rule, found.holds) == ("give-way", True)
    assert said(ride, Whether(Happens(MUST))).startswith(
        "Yes, cars on the roundabout go first, so I have to give way"
    )


def test_yes_affirms_the_fact_however_it_is_asked(ride: Ride) -> None:
    found = told(ride, Whether(Not(Happens(FIRST))))
    assert isinstance(found, Priority)
    assert found.holds is False


def test_who_goes_first_is_told_without_yes_or_no(ride: Ride) -> None:
    for such in (
        Happens(Event("go", Wanted(), manner=("first",), tense="present")),
        Related("has-priority-over", Wanted(), Everyone()),
    ):
        found = told(ride, Which(Wanted(), such))
        assert isinstance(found, Priority)
        assert (found.rule, found.holds) == ("give-way", None)


def test_a_wrong_claim_of_right_of_way_is_put_right(ride: Ride) -> None:
    claim = Claim(Happens(FIRST))
    found = told(ride, claim)
    assert isinstance(found, Priority)
    assert found.claim
    assert said(ride, claim).startswith(
        "Actually, cars on the roundabout go first, so I have to give way"
    )


def test_a_thing_is_not_denied_twice(ride: Ride) -> None:
    still = told(ride, Whether(Not(Happens(Event("stop", tense="present")))))
    assert isinstance(still, Verdict)
    assert still.that == Happens(Event("stop", tense="present"))
