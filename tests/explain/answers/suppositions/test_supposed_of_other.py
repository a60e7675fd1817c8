"""What we would have done, had another vehicle done otherwise, or not been there."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, deed, look, refused
from tests.explain.answers.supposed import GONE, LATER, ONE, TURNS, Setting, did, what_if
from xavi_dialogue.domain.answers import CannotSay, Measures, TooLittle
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Doing, HowMuch, When, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Exists,
    Is,
    Measured,
    Next,
    Nobody,
    Not,
    Now,
    Related,
)
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.answers.suppositions import reacting, supposed_when
from xavi_dialogue.explain.answers.suppositions.jointly import is_absence


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


def test_without_a_vehicle_it_is_planned_again(setting: Setting) -> None:
    found = what_if(GONE)
    assert (setting.found[0].by, setting.found[0].args) == ("without", ((1,), NOW))
    assert (found.vehicle, found.supposed, found.negated, found.past) == (1, None, False, False)
    assert (found.prior, found.plan, found.then, found.same) == (
        0.3,
        ("continue",),
        ("stop",),
        False,
    )
    assert (found.contrast, found.arrival, found.slows, found.still) == (LATER, 54.0, None, None)
    assert found.form == "what-if"
    past = what_if(Not(Exists(ONE, tense="past")), Whether(did("stop", Ego())))
    assert (past.past, setting.found[1].args) == (True, ((1,), 12.0))


@pytest.mark.parametrize(
    ("of", "absent"),
    [
        (GONE, True),
        (Not(Is("present", ONE)), True),
        (Not(Is("visible", ONE)), True),
        (Not(Is("safe", ONE)), False),
        (Is("present", ONE), False),
        (Not(Related("near", ONE)), True),
        (Related("near", ONE), False),
        (Not(did("appear")), True),
        (Is("hidden", ONE), True),
        (Not(Is("hidden", ONE)), False),
        (did("appear"), False),
        (did("disappear"), True),
        (did("stop"), False),
        (None, False),
    ],
)
def test_what_means_that_a_vehicle_is_not_there(of: Any, absent: bool) -> None:
    plain, negated = unwrapped(of)
    assert is_absence(plain, negated=negated) is absent


def test_what_another_does_is_planned_with_its_conduct(setting: Setting) -> None:
    found = what_if(TURNS)
    assert (setting.found[0].by, setting.found[0].args) == ("otherwise", (1, ("exit-right",), NOW))
    assert setting.found[0].more["negated"] is False
    assert (found.supposed, found.past) == (TURNS.event, False)
    denied = what_if(Not(TURNS))
    assert denied.negated is True
    assert setting.found[1].more["negated"] is True
    early = what_if(did("exit-right", tense="past"), span=Span(5.0, 7.0, said=True))
    assert (early.past, setting.found[2].args[-1]) == (True, 3.0)  # when it was open still


def test_what_stands_for_a_way_of_driving_is_told(setting: Setting) -> None:
    setting.proxy = "stop"
    for action in ("brake", "slow-down"):
        brakes = did(action, manner=("hard",), tense="present")
        assert what_if(brakes).supposed == Event("stop", ONE, tense="present")
        assert what_if(Not(brakes)).supposed == brakes.event
    assert what_if(TURNS).supposed == TURNS.event
    setting.proxy = None
    gentle = did("brake", manner=("gently",), tense="present")
    assert what_if(gentle).supposed == gentle.event


@pytest.mark.parametrize(
    ("there", "here", "slows"),
    [(0.5, 0.4, True), (0.4, 0.1, False), (0.9, 0.5, False), (None, 0.1, None), (0.9, None, None)],
)
def test_it_is_told_whether_we_would_have_to_slow_down(
    there: Any, here: Any, slows: Any, setting: Setting
) -> None:
    setting.shares = {("after", "slow-down"): there, ("before", "slow-down"): here}
    assert what_if(TURNS).slows is slows
    assert what_if(Not(TURNS)).slows is None
    assert what_if(GONE).slows is None


@pytest.mark.parametrize(
    ("then", "plan_", "still"),
    [
        (did("exit-right", Ego()), ("exit-right",), True),
        (did("exit-right", Ego()), ("continue", "exit-right"), True),
        (did("exit-right", Ego()), ("stop", "exit-right"), False),
        (did("exit-right", Ego()), ("continue", "stop", "exit-right"), False),
        (did("turn", Ego()), ("exit-left",), True),
        (did("turn", Ego()), ("continue",), False),
    ],
)
def test_whether_we_would_still_do_it_is_told_by_the_plan(
    then: Any, plan_: Any, still: bool, setting: Setting
) -> None:
    setting.plan = plan_
    found = what_if(GONE, Whether(then))
    assert (found.still, found.asked) == (still, then.event)


@pytest.mark.parametrize(
    ("action", "name"),
    [("brake", "slow-down"), ("stop", "stop"), ("stand", "stop"), ("speed-up", "speed-up")],
)
def test_whether_we_would_still_drive_so_is_told_by_the_drives(
    action: Any, name: str, setting: Setting
) -> None:
    then = Whether(did(action, Ego()))
    for share, still in ((0.5, True), (0.4, False), (None, None)):
        setting.shares = {("after", name): share}
        assert what_if(GONE, then).still is still
    setting.drove = deed("brake", 3.0, 5.0, standing=True)
    setting.shares = {("after", "stop"): 0.9}
    assert what_if(TURNS, then).still is True
    turn = Whether(did("exit-right", Ego()))
    assert what_if(TURNS, turn).still is True
    setting.drove = deed("brake", 3.0, 5.0)
    setting.shares = {("after", "slow-down"): 0.9}
    assert what_if(TURNS, turn).still is True


@pytest.mark.parametrize("happens", [True, False])
def test_without_one_we_would_drive_so_as_the_trial_of_the_reason_shows(
    happens: bool, setting: Setting
) -> None:
    setting.drove, setting.happens = deed("brake", 3.0, 5.0), happens
    setting.shares = {("after", "slow-down"): 0.0 if happens else 1.0}
    found = what_if(GONE, Whether(did("slow-down", Ego())))
    assert [one.by for one in setting.found] == ["without-at"]
    assert found.still is happens


def test_where_the_trial_of_the_reason_cannot_be_made_no_other_decision_clears_it(
    setting: Setting,
) -> None:
    setting.drove = deed("brake", 3.0, 5.0)
    then = Whether(did("slow-down", Ego()))
    setting.shares = {("after", "slow-down"): 0.1}
    assert what_if(GONE, then).still is False
    setting.shares = {("after", "slow-down"): 0.9}
    assert refused(what_if, GONE, then) == TooLittle("too-little-evidence")


def test_only_what_we_would_do_is_asked_of_the_other_world(setting: Setting) -> None:
    sooner = Whether(did("go", Ego(), manner=("first",)))
    assert what_if(GONE, sooner).asked is None
    assert what_if(GONE, Doing()).asked is None
    assert what_if(GONE, When(did("arrive", Ego()))).form == "arrival"
    assert what_if(GONE, Whether(Is("safe"))).asked is None


def test_what_else_is_told_of_another(setting: Setting, monkeypatch: pytest.MonkeyPatch) -> None:
    pace = HowMuch(Measured("speed", event=Event("go", modal="could")))
    speed = Measure("speed", Ego(), NOW, value=9.0)
    assert what_if(GONE, pace) == Measures((speed,))
    assert not isinstance(what_if(TURNS, pace), Measures)
    for manner in ("fast", "slowly", "early", "late"):
        quick = did("exit-right", manner=(manner,), tense="present")
        assert refused(what_if, quick) == CannotSay("unsupported-condition")
    assert refused(what_if, Exists(ONE)) == CannotSay("imagined")
    nobody = Nobody(Described(kind="truck"))
    for of in (Exists(nobody), Related("behind", nobody)):
        assert refused(what_if, of) == CannotSay("imagined")
    for of in (Is("stationary", ONE), Is("slow", ONE), Related("behind", ONE)):
        assert refused(what_if, of) == CannotSay("unsupported-condition")
    hit = what_if(did("collide", object=Ego()))
    assert (hit.by, hit.args[1:], hit.more) == (
        "closeness", (1, Window(NOW, NOW), "hit"), {"past": False},
    )  # fmt: skip
    leaves = did("exit-right", tense="past", then=Event("continue", ONE))
    other = what_if(Not(leaves))
    assert (other.supposed, other.negated) == (Event("continue", ONE, tense="past"), False)
    monkeypatch.setattr(reacting, "is_sudden", lambda *args, **more: True)
    sudden = what_if(Not(TURNS), span=Span(5.0, 7.0, said=True))
    assert (sudden.by, sudden.args[0], sudden.args[3:]) == ("reaction", TURNS.event, (1, 6.0))
    assert sudden.more == {"negated": True, "past": True}
    assert what_if(TURNS, span=None).args[3:] == (1, NOW)
    into = did("exit-right", then=Event("collide", ONE))
    assert what_if(into).args[0] == Event("cut-in", ONE)


# --- whether it is of the past ------------------------------------------------------------------


def past(of: Any, then: Any = None, span: Any = None, *, now: bool = False, **more: Any) -> bool:
    given = {"looks": {1: look(1)}} | more
    question = Doing(Ego()) if now else None
    return supposed_when.is_over(Given(**given).asked(span), of, question, then, 1)


def test_a_reason_in_a_supposed_world_is_of_when_it_is_asked_of() -> None:
    scene = Given(looks={1: look(1)}).asked(Span(5.0, 7.0))
    for tense, over in (("past", True), ("present", False)):
        reason = Why(did("continue", Ego(), tense=tense, modal="would"))
        assert supposed_when.is_over(scene, Exists(ONE), reason, None, 1) is over


def test_what_is_supposed_of_now_is_not_past() -> None:
    said, inferred = Span(5.0, 7.0, said=True), Span(5.0, 7.0)
    for time in (Now(), Next(), At(NOW)):
        assert past(did("stop", tense="past", time=time), span=said) is False
    assert past(did("stop", time=At(19.0)), span=said) is True
    for tense in ("present", "future"):
        assert past(did("stop", tense=tense)) is False
        assert past(did("stop", tense=tense), span=inferred) is False
        assert past(did("stop", tense=tense), span=said) is True
    assert past(Exists(ONE), span=inferred) is True
    assert past(Exists(ONE)) is False
    assert past(did("stop", tense="perfect")) is True
    assert past(did("stop", tense="past"), Event("brake")) is True
    assert past(did("stop", tense="past"), Event("brake", tense="present")) is False


def test_if_he_stopped_is_of_now_as_long_as_it_can_still_come_about() -> None:
    stopped = did("stop", tense="past")
    assert past(stopped) is False
    assert past(stopped, looks={1: look(1, ahead=-1.0)}) is True
    assert past(stopped, looks={1: look(1, in_view=False)}) is True
    assert past(stopped, looks={1: None}) is True
    assert past(stopped, looks={1: None}, now=True) is False
    assert past(Exists(ONE, tense="past")) is True
    assert past(Exists(ONE, tense="past"), now=True) is False


# --- what did not come about ----------------------------------------------------------------------


def braking(setting: Setting, deeds: Any, *, then: float, anyway: float) -> Any:
    """Ask "would you have braked without it?", where so much of the rollouts slows down."""
    setting.shares = {("after", "slow-down"): then, ("before", "slow-down"): anyway}
    braked = Whether(did("brake", Ego(), tense="past", modal="would"))
    return what_if(Not(Exists(ONE, tense="past")), braked, deeds=deeds)


def test_what_did_not_come_about_is_told_so(setting: Setting) -> None:
    """No "I would still have braked" where we did not, even if the plan is to slow down later."""
    braked = (deed("brake", 5.0, 7.0),)
    for then, anyway, undone, still in (
        (1.0, 1.0, True, False),  # it is planned anyway, and has not come yet
        (1.0, 0.0, True, True),
        (0.0, 0.0, True, False),
    ):
        found = braking(setting, (), then=then, anyway=anyway)
        assert (found.undone, found.still) == (undone, still)
    found = braking(setting, braked, then=1.0, anyway=1.0)
    assert (found.undone, found.still) == (False, True)


def test_whether_we_would_still_be_slow_is_whether_we_would_slow_down(setting: Setting) -> None:
    for share in (0.9, 0.1):
        setting.shares = {("after", "slow-down"): share, ("before", "slow-down"): 0.9}
        found = what_if(Not(Exists(ONE)), Whether(Is("slow", Ego())))
        assert found.asked == Event("slow-down", tense="present", modal="would")
        assert found.still is (share > 0.5)
