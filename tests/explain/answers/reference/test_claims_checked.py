"""Claims, and what is a matter of opinion, where it is given what propositions come to."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, Told, deed, look, their
from tests.explain.answers.yes_or_no import ONE, SPEED, A, B, Setting, claim, whether
from xavi_dialogue.domain.answers import (
    Beliefs,
    Course,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.meaning import HowMuch, Whether
from xavi_dialogue.domain.terms import (
    Caused,
    Compares,
    Ego,
    Event,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Quantity,
    Related,
)
from xavi_dialogue.explain.answers.reference.findings import Finding


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


@pytest.mark.parametrize("manner", ["late", "early", "long"])
def test_what_we_did_late_or_long_is_met_with_its_reason(manner: Any, setting: Setting) -> None:
    stop = Happens(Event("stop", manner=(manner,)))
    setting.handed = {stop: Told("why")}
    stopped = (deed("stop", 5.0, 7.0),)
    assert whether(stop, deeds=stopped) == claim(stop, deeds=stopped) == Told("why")
    assert whether(stop) == Verdict(stop, False)
    theirs = Happens(Event("stop", ONE, manner=(manner,)))
    setting.handed = {theirs: Told("why")}
    assert whether(theirs, deeds=(their(1, "stop", 5.0, 7.0),)) == Verdict(theirs, False)
    should = Happens(Event("stop", manner=(manner,), modal="should"))
    setting.handed = {should: Told("why")}
    assert whether(should, deeds=stopped) == Verdict(should, False)


def test_driving_slowly_is_met_with_its_reason(setting: Setting) -> None:
    for action, told in (("turn", True), ("enter", True), ("pass", True), ("stop", False)):
        slow = Happens(Event(action, manner=("slowly",)))  # type: ignore[arg-type]
        setting.handed = {slow: Told("why")}
        assert (whether(slow) == Told("why")) is told
    setting.handed = {A: Told("why")}
    assert whether(A, deeds=(deed("brake", 5.0, 7.0),)) == Verdict(A, False)


def test_what_it_cost_is_told_as_a_time(setting: Setting) -> None:
    delay = Compares(Measured("delay"), "more")
    assert whether(delay) == (Told("how much", (HowMuch(Measured("delay")),)), delay)
    lost = Compares(Measured("delay"), "more", Quantity(5.0, "s"))
    assert claim(lost) == (Told("how much", (HowMuch(Measured("delay")),)), lost)
    metres = Compares(Measured("delay"), "more", Quantity(5.0, "m"))
    assert whether(metres) == Verdict(metres, False)
    turn = Event("exit-left", modal="would")
    would = Compares(Measured("delay", event=turn), "less")
    assert whether(would) == (Told("of us", (turn, "quicker")), would)
    could = replace(would, left=Measured("delay", event=replace(turn, modal="could")))
    assert whether(could)[0].by == "of us"
    did = replace(would, left=Measured("delay", event=replace(turn, modal=None)))
    assert whether(did)[0].by == "how much"
    took = Compares(Measured("duration", ONE), "too-much")
    assert whether(took) == Told("how much", (HowMuch(Measured("delay", ONE)),))
    ours = Compares(Measured("duration"), "too-much")
    assert whether(ours) == Verdict(ours, False)
    timed = Compares(Measured("duration", ONE), "more", Quantity(5.0, "s"))
    assert whether(timed) == Verdict(timed, False)


# --- claims -------------------------------------------------------------------------------------


def test_a_claim_is_checked_as_one(setting: Setting) -> None:
    setting.known = {A: Finding(True, (SPEED,))}
    assert claim(A) == Verdict(A, True, (SPEED,), claim=True)
    assert claim(A, None, True) == Verdict(A, True, (SPEED,), claim=True, challenge=True)


def test_rules_and_beliefs_answer_claims_themselves(setting: Setting) -> None:
    rule = Priority(NOW, "give-way", 1, holds=True)
    setting.known = {A: Finding(True, answer=rule)}
    assert claim(A) == replace(rule, claim=True)
    belief = Beliefs(1, None, ())
    setting.known = {A: Finding(True, answer=belief)}
    assert claim(A) is belief


@pytest.mark.parametrize(
    ("that", "own"),
    [
        (A, False),
        (Not(A), False),
        (B, True),
        (Not(B), True),
        (Caused(ONE, A), True),
        (Is("safe"), True),
        (Is("right"), False),
        (Is("wrong"), False),
        (Has("lane", "left"), True),
    ],
)
def test_another_answer_is_told_where_it_says_it_better(
    that: Any, own: bool, setting: Setting
) -> None:
    told = Verdict(B, True)
    setting.known = {that: Finding(True, answer=told)}
    assert (claim(that) is told) is own
    setting.known = {that: Finding(None, answer=told)}
    assert claim(that) is told


@pytest.mark.parametrize(
    ("event", "ours"),
    [
        (Event("leave", modal="should", tense="past"), True),
        (Event("exit-right", modal="must", tense="past"), True),
        (Event("exit-right", modal="will"), False),
        (Event("exit-right", ONE, modal="should"), False),
        (Event("brake", modal="should"), False),
    ],
)
def test_the_way_that_we_were_meant_to_go_is_told(
    event: Event, ours: bool, setting: Setting
) -> None:
    setting.ours = Course("way", (), holds=True)
    for that in (Happens(event), Not(Happens(event))):
        found = claim(that)
        assert (found == Course("way", (), holds=None)) is ours
    if ours:
        meant = Happens(Event(event.action, tense="present"))
        assert setting.asked_ours == [Whether(meant)] * 2
    setting.ours = None
    assert isinstance(claim(Happens(event)), Verdict)


def test_when_we_first_saw_whom_we_are_said_not_to_see(setting: Setting) -> None:
    sees = Related("can-see", Ego(), ONE)
    setting.known = {Not(sees): Finding(False, (SPEED,)), sees: Finding(True, (SPEED,))}
    assert claim(Not(sees)).facts == (look(1),)
    assert whether(Not(sees), None, True).facts == (look(1),)
    assert whether(sees).facts == (SPEED,)
    assert claim(Not(sees), looks={1: None}).facts == (SPEED,)
    setting.known[Not(sees)] = Finding(True, (SPEED,))
    assert claim(Not(sees)).facts == (SPEED,)
