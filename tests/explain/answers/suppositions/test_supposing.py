"""Whom it is asked of what would have been, had something been otherwise."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, expects, refused
from tests.explain.answers.supposed import GONE, ONE, TURNS, Setting, did, what_if
from xavi_dialogue.domain.answers import CannotSay
from xavi_dialogue.domain.meaning import Doing, Whether
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Is,
    Measured,
    Nobody,
    Not,
    Quantity,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.suppositions import supposing


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


@pytest.mark.parametrize(
    ("of", "free"),
    [
        (Exists(Nobody()), True),
        (Related("ahead-of", Nobody()), True),
        (Not(Exists(Feature("queue"))), True),
        (Not(Exists(Feature("obstacle"))), True),
        (Not(Exists(Feature("light"))), True),
        (Not(Exists(Everyone())), True),
    ],
)
def test_a_free_road_is_asked_of_what_held_us_up(of: Any, free: bool, setting: Setting) -> None:
    found = what_if(of)
    assert (found.by == "hastened") is free
    assert found.events == (Event("wait", tense="past", modal="would"),)
    assert found.args[2] == "arrival"
    crash = what_if(of, Whether(did("collide", Ego())))
    assert crash.args[2] == "crash"


def test_what_is_no_free_road(setting: Setting) -> None:
    assert supposing._is_free_road(Exists(Nobody()), negated=True) is False
    assert supposing._is_free_road(Exists(Feature("queue")), negated=False) is False
    assert supposing._is_free_road(Exists(Feature("sign")), negated=True) is False
    assert supposing._is_free_road(Exists(ONE), negated=True) is False
    assert supposing._is_free_road(None, negated=True) is False


def test_somebody_who_is_not_there_is_asked_of_how_far_we_need(setting: Setting) -> None:
    child = did("cross", Nobody())
    assert what_if(child).by == "for_anybody"
    assert isinstance(refused(what_if, Not(did("turn", Nobody()))), object)


def test_what_we_would_do_is_asked_of_our_own_foils(setting: Setting) -> None:
    ours = did("exit-right", Ego())
    found = what_if(ours, Whether(did("collide", Ego(), object=ONE)))
    now = replace(ours.event, tense="present")  # "if you turned right"
    assert (found.by, found.args[0], found.args[2:]) == ("of_us", now, ("crash", 1))
    against = what_if(Not(ours), Whether(did("collide", Ego(), object=ONE)))
    assert (against.by, against.args[0], against.args[2:]) == ("undone", ours.event, ("crash", 1))
    faster = what_if(Compares(Measured("speed"), "more"))
    assert (faster.by, faster.events[0].manner) == ("of_us", ("fast",))
    fast = what_if(did("go", Ego(), object=ONE, manner=("fast",)))
    assert fast.args[2] == "could"
    assert what_if(did("go", Ego(), manner=("fast",))).args[2] == "what-if"
    assert what_if(did("go", Ego(), object=ONE)).args[2] == "what-if"
    for other in (Exists(Feature("sign")), did("turn", Nobody())):
        assert refused(what_if, Not(other)) is not None


def test_a_gain_that_is_claimed_is_held_against_the_foil(
    setting: Setting, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(supposing, "claimed", lambda found, that: (found.by, that))
    gain = Whether(Compares(Measured("delay"), "more", Quantity(3.0, "s")))
    assert what_if(did("exit-right", Ego()), gain) == ("of_us", gain.that)
    assert what_if(did("exit-right", Ego()), Doing()) == ("of_us", None)


def test_being_faster_to_go_before_somebody_is_going_before_him(setting: Setting) -> None:
    faster = Compares(Measured("speed"), "more")
    then: Any = Whether(did("go", Ego(), object=ONE, manner=("first",), tense="past"))
    found = what_if(faster, then)
    assert found.args[0] == replace(then.that.event, modal="would", manner=("first", "fast"))
    assert found.args[2] == "could"
    alone = what_if(faster, Whether(did("go", Ego())))
    assert alone.args[0].object is None
    slower = what_if(Compares(Measured("speed"), "less"), then)
    assert slower.args[0].action == "slow-down"
    theirs = supposing._faster(Event("go", manner=("fast",)), Whether(did("go", ONE, object=ONE)))
    assert theirs == Event("go", manner=("fast",))
    assert supposing._faster(None, then) is None


def test_what_another_would_do_no_plan_tells(setting: Setting) -> None:
    theirs = Whether(did("exit-left", Vehicle(2)))
    found = what_if(GONE, theirs)
    assert (found.by, found.args[:2]) == ("freed", (theirs, 1))
    assert refused(what_if, Exists(ONE), theirs) == CannotSay("unsupported-condition")
    crash = what_if(TURNS, Whether(did("collide", Vehicle(2))))
    assert crash.vehicle == 1
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(supposing, "freed", lambda *args: None)
        assert refused(what_if, GONE, theirs) == CannotSay("unsupported-condition")


def test_what_going_first_makes_another_do_is_told_by_who_is_first(setting: Setting) -> None:
    first = did("go", Ego(), manner=("first",), tense="perfect")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(supposing, "forced", lambda *args, negated: (*args[:2], negated))
        then = Whether(did("brake", ONE, modal="would"))
        assert what_if(first, then) == (first.event, then, False)


def test_one_that_breaks_down_stops_and_no_plan_has_a_fault_of_ours(setting: Setting) -> None:
    assert what_if(Is("faulty", ONE)).supposed == Event("stop", ONE, tense="present")
    for ours in (Is("faulty", Ego()), Is("faulty", event=Event("brake"))):
        assert refused(what_if, ours) == CannotSay("unsupported-condition")


def test_no_plan_brakes_sooner_or_later_or_lets_anybody_out(setting: Setting) -> None:
    for of in (
        did("arrive", Ego()),
        did("brake", Ego(), manner=("late",)),
        did("slow-down", Ego(), manner=("early",)),
    ):
        assert refused(what_if, of) == CannotSay("unsupported-condition")
    assert what_if(did("brake", Ego(), manner=("hard",))).by == "of_us"
    assert what_if(did("exit-right", Ego(), manner=("late",))).by == "of_us"


def test_being_wrong_about_somebody_is_its_not_doing_what_is_expected(setting: Setting) -> None:
    belief = expects(1, (("continue", "exit-left"), 0.8), (("exit-right",), 0.2))
    found = what_if(Is("wrong", ONE), beliefs={1: belief})
    assert (found.supposed, found.negated) == (Event("exit-left", ONE, tense="present"), True)
    on = what_if(Is("wrong", ONE, tense="past"), beliefs={1: expects(1, (("continue",), 1.0))})
    assert on.supposed == Event("continue", ONE, tense="past")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(supposing, "least_sure", lambda scene, at: 2 if at == NOW else None)
        least = what_if(Is("wrong"), beliefs={2: expects(2, (("stop",), 1.0))})
        assert least.supposed == Event("stop", Vehicle(2), tense="present")
        assert refused(what_if, Is("wrong")) == CannotSay("unsupported-condition")
