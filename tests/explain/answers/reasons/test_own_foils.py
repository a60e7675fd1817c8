"""What would have come of it, had we done otherwise: against what it is tried.

The comparison of two plans itself is given.
"""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, Told, deed, look, plan, refused
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    Contrast,
    DidNotHappen,
    Effect,
    Evidence,
    MotionCause,
    NeedRollout,
    NotApplicable,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Lane,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reasons.against import Against
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.foils import Did
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.suppositions import own_suppositions as own
from xavi_dialogue.explain.causes.plans.natural import STAYING
from xavi_dialogue.explain.causes.plans.premise import Premise

ONE = Vehicle(1)

NOTHING = Contrast((), (), None, (), (), Evidence(), NOW)
LATER = replace(NOTHING, effects=(Effect("jerk", "m/s3", 1.0, 0.0, 2.0, 9, 9),
                                  Effect("time", "s", 4.0, 1.0, 6.0, 9, 9)))  # fmt: skip
ARRIVES = {("arrival-time", Ego()): 50.0}


class Setting:
    """What is found of a foil; a test sets what it needs."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.against: Any = LATER
        self.events: list[Event] = []
        self.reasons: Any = {}
        for name in ("hastened", "as_it_was", "closeness"):
            patch.setattr(own, name, lambda *args, _by=name, **more: Told(_by, args, more))
        patch.setattr(own, "against", self._against)
        patch.setattr(own, "natural", lambda ride, trace, *node: replace(NOTHING, decided=9.0))
        self.later: Any = None
        self.earlier = False
        patch.setattr(choices, "why", self._why)
        self.blocking: Any = None
        patch.setattr(own, "blocking", lambda *args: self.blocking)

    def _against(self, event: Event, scene: Any) -> Against:
        self.events.append(event)
        if isinstance(self.against, Exception):
            raise self.against
        found = Premise(plan(NOW), None)
        return Against(found, ("stop",), self.against, self.earlier, self.later)

    def _why(self, event: Event, scene: Any) -> Any:
        self.events.append(event)
        found = self.reasons.get(event.action, ChoiceReason("why", None, LATER, past=False))
        if isinstance(found, Exception):
            raise found
        return found


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


def scene(span: Span | None = None, **more: Any) -> Any:
    given = {"looks": {1: look(1)}, "traces": (plan(NOW, "continue"),), "measures": ARRIVES} | more
    return Given(**given).asked(span)


def of_us(event: Event, span: Span | None = None, form: Any = "what-if", **more: Any) -> Any:
    return own.of_us(event, scene(span, **more), form, 1)


TURN = Event("exit-right", tense="present")


def test_a_foil_is_told_with_when_we_would_be_there(setting: Setting) -> None:
    found = of_us(TURN, form="safer")
    assert found == SupposedOfUs(LATER, past=False, form="safer", arrival=54.0)
    assert of_us(replace(TURN, tense="past")).past is True
    assert of_us(replace(TURN, modal="would")).past is True
    assert of_us(TURN, Span(3.0, 5.0)).past is True
    assert of_us(TURN, measures={}).arrival is None
    for action in ("brake", "slow-down"):
        assert of_us(Event(action)).asked == action
    assert found.asked is None
    setting.against = NOTHING
    assert of_us(TURN).arrival is None


def test_who_stood_in_our_lane_is_told_where_we_would_have_stayed(setting: Setting) -> None:
    stays = replace(NOTHING, foil=STAYING, fact=("change-left", "continue"))
    for speed, told in ((0.0, True), (0.49, True), (None, True), (0.5, False)):
        setting.blocking = MotionCause("leader", 1, speed=speed)
        setting.against = stays
        assert (of_us(TURN).ahead is not None) is told
    setting.blocking = MotionCause("leader", 1, speed=0.0)
    setting.against = replace(stays, fact=("exit-right",))
    assert of_us(TURN).ahead is None
    setting.against = replace(stays, fact=())
    assert of_us(TURN).ahead is None
    setting.against = replace(stays, foil=("stop",))
    assert of_us(TURN).ahead is None
    setting.against, setting.blocking = stays, None
    assert of_us(TURN).ahead is None


def test_going_faster_or_earlier_is_asked_of_what_held_us_up(setting: Setting) -> None:
    yields = (deed("give-way", 3.0, 6.0, to=1),)
    for action in ("cut-in", "merge", "pull-out", "pass"):
        event = Event(action, object=ONE, tense="present")
        squeezed = of_us(event, deeds=yields)
        assert (squeezed.by, squeezed.args[0]) == ("hastened", replace(event, object=None))
        assert squeezed.args[2:] == ("what-if", 1)
        assert isinstance(of_us(event), SupposedOfUs)
    for action in ("go", "move", "enter", "cross", "speed-up", "continue"):
        faster = of_us(Event(action, object=ONE))  # type: ignore[arg-type]
        assert (faster.by, faster.args[0].object) == ("hastened", ONE)
    assert of_us(TURN, deeds=yields) == SupposedOfUs(LATER, past=False, arrival=54.0)


def test_going_on_instead_of_a_stop_is_the_best_alternative_to_it(setting: Setting) -> None:
    stops = (plan(NOW, "stop", "continue"),)
    begun = (Recorded("action-started", 19.0, "stop", 19),)
    found = of_us(Event("go", tense="perfect"), traces=stops, events=begun)
    assert isinstance(found, SupposedOfUs)
    assert setting.events == [Event("stop", tense="perfect")]
    fast = of_us(Event("go", manner=("fast",)), traces=stops)
    assert fast.by == "hastened"
    for side in (Event("go", side="left"), Event("go", object=ONE)):
        assert isinstance(of_us(side, traces=stops), SupposedOfUs)
        assert setting.events[-1] == side
    later = (plan(NOW, "continue", "stop"),)
    assert of_us(Event("go"), traces=later).by == "hastened"
    assert of_us(Event("go"), traces=()).by == "hastened"


def test_going_on_now_is_told_by_the_decision_in_force(
    setting: Setting, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        own, "natural", lambda ride, trace, *node: replace(NOTHING, decided=trace.sim_time)
    )
    stops = (plan(NOW - 1.0, "stop", "continue"), plan(NOW, "stop", "continue"))
    begun = (Recorded("action-started", 19.0, "stop", 19),)
    for tense in ("present", "past"):  # "if we go on now", "if we went on"
        for span in (None, Span(NOW, NOW, said=True)):
            found = of_us(Event("go", tense=tense), span, traces=stops, events=begun)  # type: ignore[arg-type]
            assert (found.contrast.decided, found.past) == (NOW, False)
    assert setting.events == []
    of_us(
        Event("go", tense="past"), Span(NOW - 1.0, NOW - 1.0, said=True), traces=stops, events=begun
    )
    assert setting.events == [Event("stop", tense="past")]


def test_what_we_do_once_we_may_go_is_asked_of_going_now(setting: Setting) -> None:
    setting.against = Did(TURN, PLANNED, Premise(plan(9.0), None))
    stands = (deed("stand", 15.0, None),)
    for form in ("what-if", "chance", "dangerous"):
        found = of_us(TURN, form=form, deeds=stands)
        assert (found.by, found.args[0]) == ("hastened", Event("go", tense="present"))
        assert found.args[2:] == (form, 1)
    for event in (Event("stop", tense="present"), replace(TURN, tense="perfect")):
        assert isinstance(of_us(event, deeds=stands), SupposedOfUs)


def test_a_collision_that_is_supposed_is_told_by_how_close_it_is(setting: Setting) -> None:
    for action in ("collide", "nearly-collide"):
        found = of_us(Event(action, object=Vehicle(2)))
        assert (found.by, found.args[1:]) == ("closeness", (2, Window(NOW, NOW), "hit"))
        assert found.more == {"past": False}


PLANNED = Performed("exit-right", "will")
DONE = Performed("exit-right", "did", 9.0)


def test_what_was_planned_anyway_is_told_as_planned(setting: Setting) -> None:
    setting.against = Did(TURN, PLANNED, Premise(plan(9.0), None))
    found = of_us(replace(TURN, tense="perfect"), form="safer")
    beside = replace(NOTHING, decided=9.0)
    assert found == SupposedOfUs(beside, done=PLANNED, past=False, form="safer")
    crash = of_us(TURN, form="crash")
    assert (crash.by, crash.args[1:], crash.more) == ("as_it_was", ("crash", 1), {"past": False})


def test_what_was_done_in_fact_is_told_so(setting: Setting) -> None:
    turned = deed("exit-right", 9.0, 11.0)
    setting.against = Did(TURN, DONE, Premise(plan(9.0), None), (turned,))
    assert of_us(TURN) == SupposedOfUs(replace(NOTHING, decided=9.0), done=DONE, past=True)
    setting.against = Did(TURN, DONE, None, (turned,))  # its decision is not recorded
    assert refused(of_us, TURN) == DidNotHappen(TURN, (turned,))
    for refusal in (DidNotHappen(TURN), NotApplicable((), "no road")):
        setting.against = Unanswered(refusal)
        assert refused(of_us, TURN) == refusal


def test_stopping_is_not_told_beside_what_was_done(
    setting: Setting, monkeypatch: pytest.MonkeyPatch
) -> None:
    stops = replace(NOTHING, foil=("stop",))
    monkeypatch.setattr(own, "natural", lambda *args: stops)
    monkeypatch.setattr(own, "factual", lambda model, trace: "fact")
    monkeypatch.setattr(own, "alone", lambda ride, model, here: replace(NOTHING, decided=4.0))
    setting.against = Did(TURN, DONE, Premise(plan(9.0), None))
    assert of_us(TURN).contrast == replace(NOTHING, decided=4.0)
    halt = Performed("stop", "did", 9.0)
    setting.against = Did(Event("stop"), halt, Premise(plan(9.0), None))
    assert of_us(Event("stop")).contrast == stops


def test_when_it_was_compared_and_done_later_is_told(setting: Setting) -> None:
    setting.later = DONE
    assert of_us(TURN).later == DONE
    setting.earlier = True
    assert of_us(TURN).past is True  # it is too late by now


def test_braking_that_was_done_just_then_is_no_foil(setting: Setting) -> None:
    braked = deed("brake", 15.0, 16.0)
    found = refused(of_us, Event("brake", tense="perfect"), deeds=(braked,))
    assert found == DidNotHappen(Event("brake", tense="perfect"), (braked,))
    harder = Event("brake", tense="perfect", manner=("hard",))
    for event in (harder, Event("brake", tense="present")):
        assert isinstance(of_us(event, deeds=(braked,)), SupposedOfUs)
    assert isinstance(of_us(Event("brake"), deeds=(deed("brake", 2.0, 3.0),)), SupposedOfUs)


# --- staying behind -----------------------------------------------------------------------------

CHANGED = (
    Recorded("action-started", 12.0, "change-left", 12),
    Recorded("action-committed", 12.0, "change-left"),
)
STAYS = Event("keep-lane")
BEHIND = Related("behind", Ego(), ONE)


@pytest.mark.parametrize(
    ("event", "changed", "plain"),
    [
        (Event("follow", object=ONE), STAYS, Event("slow-down", object=ONE)),
        (Event("wait", where=BEHIND), STAYS, None),
        (Event("stand", where=BEHIND), STAYS, None),
        (Event("stop", where=BEHIND), STAYS, None),
        (Event("turn", where=BEHIND), None, None),
        (Event("stop"), None, None),
        (Event("let-go", object=ONE), STAYS, None),
        (Event("give-way", object=ONE), STAYS, None),
        (Event("wait", object=ONE), STAYS, None),
        (Event("let-go"), None, None),
        (Event("pass", where=Related("on", Ego(), Lane("own"))), STAYS, STAYS),
        (Event("overtake", where=Related("on", Ego(), Lane("own"))), STAYS, STAYS),
        (Event("pass", where=Related("on", Ego(), Lane("left"))), None, None),
        (Event("turn", where=Related("on", Ego(), Lane("own"))), None, None),
    ],
)
def test_staying_behind_whom_we_left_is_staying_in_our_lane(
    event: Event, changed: Any, plain: Any
) -> None:
    assert own._staying(event, scene(events=CHANGED)) == (changed or event)
    assert own._staying(event, scene()) == (plain or event)
    turned = tuple(replace(one, action="exit-right") for one in CHANGED)
    assert own._staying(event, scene(events=turned)) == (plain or event)


# --- what was not done --------------------------------------------------------------------------


def undone(event: Event, **more: Any) -> Any:
    return own.undone(event, scene(**more), "safer", 1)


def test_not_having_done_it_is_the_best_alternative(setting: Setting) -> None:
    found = undone(TURN)
    assert found == SupposedOfUs(LATER, past=False, form="safer", arrival=54.0)
    assert undone(replace(TURN, tense="perfect")).past is True
    setting.reasons = {"exit-right": ChoiceReason("why", None, NOTHING, past=True)}
    assert undone(TURN) == SupposedOfUs(NOTHING, past=True, form="safer")


def test_a_way_of_driving_that_was_no_choice_is_asked_of_what_held_us_up(setting: Setting) -> None:
    braked = Event("brake")
    found = undone(braked)
    assert (found.by, found.args[0], found.args[2:]) == ("hastened", braked, ("safer", 1))
    stopped = (Recorded("action-started", 12.0, "stop", 12),)
    assert isinstance(undone(Event("stop"), events=stopped), SupposedOfUs)


def test_not_having_passed_is_not_having_changed_lanes(setting: Setting) -> None:
    never = Unanswered(DidNotHappen(Event("overtake")))
    for action in ("overtake", "pass", "avoid"):
        setting.reasons = {action: never}
        setting.events.clear()
        found = undone(Event(action), events=CHANGED)
        assert isinstance(found, SupposedOfUs)
        assert setting.events[-1] == Event("change-left")
        assert isinstance(refused(undone, Event(action)), DidNotHappen)
    back = tuple(
        replace(one, action="change-right", sim_time=time)
        for one, time in zip(CHANGED, (15.0, 15.0), strict=True)
    )
    setting.reasons = {"pass": never}
    assert isinstance(undone(Event("pass"), events=(*CHANGED, *back)), SupposedOfUs)
    assert setting.events[-1] == Event("change-right")
    setting.reasons = {"exit-right": never}
    assert isinstance(refused(undone, TURN, events=CHANGED), DidNotHappen)
    need = NeedRollout("trace")
    setting.reasons = {"pass": Unanswered(need)}
    assert refused(undone, Event("pass"), events=CHANGED) == need
