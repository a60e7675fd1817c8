"""What comes of weighing, negating and expecting."""

from tests.explain.answers.stated import belief, did
from xavi_dialogue.domain.answers import Beliefs, Measures, Priority, Verdict
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Event, Happens
from xavi_dialogue.explain.answers.reference.findings import Finding, expected, known, unknown

STOP, THAT = did("stop", 1.0), Happens(Event("stop"))
THOUGHT = belief(1, 2.0, ("continue", 0.7))


def test_the_contrary_of_a_finding() -> None:
    for holds, contrary in ((True, False), (False, True), (None, None)):
        found = Finding(holds, (STOP,), probability=0.8).negated()
        assert (found.holds, found.facts) == (contrary, (STOP,))
        assert found.probability is not None
        assert abs(found.probability - 0.2) < 1e-9
    assert Finding(True).negated().probability is None


def test_the_contrary_keeps_beliefs_and_turns_rules_round() -> None:
    beliefs = Beliefs(1, None, (THOUGHT,))
    assert Finding(True, answer=beliefs).negated().answer == beliefs
    assert Finding(True, answer=Measures(())).negated().answer is None
    for holds in (True, False):
        rule = Finding(holds, answer=Priority(3.0, "give-way", 1, holds=holds)).negated()
        assert rule.answer == Priority(3.0, "give-way", 1, holds=not holds)
    assert Finding(None, answer=Priority(3.0, "give-way", 1)).negated().answer is None


def test_a_finding_as_an_answer() -> None:
    found = Finding(False, (STOP,), "hidden", (THOUGHT,), mistaken=True, probability=0.3)
    assert found.verdict(THAT, claim=True, challenge=True) == Verdict(
        THAT, False, (STOP,), "hidden", True, True, (THOUGHT,), True, 0.3
    )
    plain = found.verdict(THAT)
    assert (plain.claim, plain.challenge) == (False, False)
    assert not Finding(True).verdict(THAT).mistaken


def test_what_is_not_known_says_why() -> None:
    assert unknown("hidden", STOP) == Finding(None, (STOP,), "hidden")


def test_what_is_to_come_holds_from_even_chances_on() -> None:
    assert expected(0.5, STOP, believed=(THOUGHT,)) == Finding(
        True, (STOP,), None, (THOUGHT,), probability=0.5
    )
    assert expected(0.49).holds is False
    assert expected(0.9).holds is True
    assert expected(None, STOP, believed=(THOUGHT,)) == Finding(
        None, (STOP,), "in-future", (THOUGHT,)
    )


def test_measures_without_a_value_are_left_out() -> None:
    value = Measure("speed", Ego(), 1.0, value=3.0)
    lacking = Measure("limit", Ego(), 1.0, gap="not-recorded")
    assert known(lacking, value) == (value,)
