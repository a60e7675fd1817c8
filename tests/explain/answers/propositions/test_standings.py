"""Why things stand so to each other or show a light, and when something supposed is tried."""

from typing import Any

import pytest

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, deed, look, plan, stand_in
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import Ego, Event, Has, Lane, Nobody, Related, Vehicle
from xavi_dialogue.explain.answers.propositions import standings
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.suppositions import supposed_when
from xavi_dialogue.explain.causes.plans.premise import Premise

ONE, TWO = Vehicle(1), Vehicle(2)
NOT_NEGATED = {"negated": False}


@pytest.fixture
def explainers(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(
        monkeypatch,
        *("choices.in_lane", "motions.motion", "motions.slow", "others.why", "others.placed"),
        *("standings.why_signal", "verdicts.whether"),
    )


def rest(found: Any) -> Any:
    """Who was asked, and for what, without the scene."""
    args = tuple(one for one in found.args if not hasattr(one, "world"))
    return (found.by, args, found.more) if found.more else (found.by, args)


@pytest.mark.usefixtures("explainers")
@pytest.mark.parametrize(
    ("of", "told"),
    [
        (Related("on", Ego(), Lane("left")), ("choices.in_lane", ())),
        (Related("waiting-for", Ego(), ONE, tense="past"),
         ("motions.motion", (Event("wait", object=ONE),))),
        (Related("must-yield-to", Ego(), ONE),
         ("verdicts.whether", (Whether(Related("must-yield-to", Ego(), ONE)),))),
        (Related("has-priority-over", Ego(), ONE),
         ("verdicts.whether", (Whether(Related("has-priority-over", Ego(), ONE)),))),
        (Related("near", Ego(), ONE), ("motions.slow", ("close",))),
        (Related("closer-than", Ego(), ONE), ("motions.slow", ("close",))),
        (Related("behind", Ego(), ONE), ("motions.slow", ("slowly",))),
        (Related("waiting-for", ONE, TWO),
         ("others.why", (Event("stand", ONE, object=TWO, tense="present"),), NOT_NEGATED)),
        (Related("in-the-way-of", ONE),
         ("others.why", (Event("stand", ONE, object=Ego(), tense="present"),), NOT_NEGATED)),
        (Related("ahead-of", ONE), ("others.placed", (Related("ahead-of", ONE),))),
        (Related("near", ONE), ("others.placed", (Related("near", ONE),))),
        (Related("can-see", ONE),
         ("others.why", (Event("do", ONE, tense="present"),), NOT_NEGATED)),
        (Related("ahead-of", ONE, TWO),
         ("others.why", (Event("do", ONE, tense="present"),), NOT_NEGATED)),
        (Related("on", ONE, Lane("left")),
         ("others.why", (Event("do", ONE, tense="present"),), NOT_NEGATED)),
        (Related("behind", Ego(), Nobody()),
         ("verdicts.whether", (Whether(Related("behind", Ego(), Nobody())),))),
        (Related("behind", Nobody()),
         ("verdicts.whether", (Whether(Related("behind", Nobody())),))),
    ],
)  # fmt: skip
def test_each_relation_has_its_explainer(of: Related, told: Any) -> None:
    assert rest(standings.related(of, Given().asked())) == told


@pytest.mark.usefixtures("explainers")
@pytest.mark.parametrize(
    ("of", "told"),
    [
        (Has("brake-lights", "on", tense="past"), ("motions.motion", (Event("brake"),))),
        (Has("indicator", "left"), ("standings.why_signal", ("left",), {"past": False})),
        (Has("indicator", "right", tense="past"),
         ("standings.why_signal", ("right",), {"past": True})),
        (Has("indicator", "on"), ("standings.why_signal", (None,), {"past": False})),
        (Has("brake-lights", "on", ONE),
         ("others.why", (Event("signal", ONE, tense="present"),), NOT_NEGATED)),
        (Has("indicator", "left", ONE),
         ("others.why", (Event("signal", ONE, tense="present"),), NOT_NEGATED)),
    ],
)  # fmt: skip
def test_each_light_has_its_explainer(of: Has, told: Any) -> None:
    assert rest(standings.signalling(of, Given().asked())) == told


# --- when something supposed is tried -----------------------------------------------------------


def begun(action: Any, start: float, end: float | None = None) -> tuple[Any, ...]:
    events = (
        Recorded("action-started", start, action, round(start)),
        Recorded("action-committed", start, action),
    )
    return events if end is None else (*events, Recorded("action-ended", end, action))


SLOWED, STOOD = deed("slow-down", 5.0, 7.0), deed("stop", 9.0, 11.0)


def driven(then: Event | None, span: Span | None = None, **more: Any) -> Any:
    given = Given(**({"deeds": (SLOWED, STOOD), "traces": (plan(NOW),)} | more))
    return supposed_when.driven(given.asked(span), then)


def test_a_way_of_driving_is_the_episode_of_it() -> None:
    assert driven(None) is None
    assert driven(Event("brake")) == SLOWED
    assert driven(Event("stop")) == STOOD
    assert driven(Event("exit-right")) is None  # a choice
    assert driven(Event("follow")) == SLOWED
    assert driven(Event("speed-up")) is None
    assert driven(Event("stop"), deeds=(SLOWED,)) == SLOWED
    two = (SLOWED, deed("slow-down", 14.0, 16.0))
    assert driven(Event("brake"), deeds=two) == two[1]
    assert driven(Event("brake"), Span(6.0, 6.0, said=True), deeds=two) == SLOWED
    assert driven(Event("brake"), deeds=()) is None
    wait = deed("give-way", 14.0, 16.0, to=1)
    assert driven(Event("wait"), deeds=(SLOWED, wait)) == wait


def test_where_a_stop_was_chosen_it_is_that_choice() -> None:
    assert driven(Event("stop"), events=begun("stop", 8.0)) is None
    assert driven(Event("brake"), events=begun("stop", 6.0)) is None
    assert driven(Event("brake"), events=begun("stop", 8.0)) == SLOWED  # it began later
    elsewhere = Span(15.0, 16.0, said=True)
    over = begun("exit-right", 8.0, 9.0)
    assert driven(Event("brake"), events=over) == SLOWED
    assert driven(Event("brake"), elsewhere) is None


TURN = Event("exit-right")
LANE = Event("change-left")


def moment(then: Any = None, drove: Any = None, span: Any = None, **more: Any) -> float:
    past = more.pop("past", False)
    return supposed_when.moment(Given(**more).asked(span), then, drove, past=past)


def test_a_supposition_is_tried_when_what_is_asked_about_began(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert moment(Event("brake"), SLOWED) == 5.0
    monkeypatch.setattr(supposed_when, "premise", lambda *args: Premise(plan(9.0), None))
    assert moment(LANE) == 9.0
    ahead = Event("exit-right", tense="present")
    assert moment(ahead, traces=(plan(9.0),)) == NOW  # the next turn, not the last one
    assert moment(Event("brake")) == NOW
    assert moment() == NOW
    assert moment(span=Span(4.0, 6.0, said=True)) == 5.0

    def lost(*args: Any) -> Any:
        raise Unanswered(NotRecorded("gap-in-record"))

    monkeypatch.setattr(supposed_when, "premise", lost)
    assert moment(LANE) == NOW
    assert moment(LANE, span=Span(4.0, 6.0, said=True)) == 5.0


def test_of_the_past_it_is_tried_at_the_decision_for_what_we_did() -> None:
    turned = {"events": begun("exit-right", 8.0, 11.0), "traces": (plan(7.0, "exit-right"),)}
    assert moment(past=True, **turned) == 7.0
    assert moment(past=False, **turned) == NOW
    assert moment(past=True, events=turned["events"]) == 8.0  # its decision is not recorded
    assert moment(past=True, events=begun("continue", 2.0)) == NOW
    assert moment(past=True) == NOW
    two = (*begun("change-left", 3.0, 5.0), *begun("exit-right", 8.0, 11.0))
    then = Span(3.0, 4.5, said=True)
    assert moment(past=True, events=two, span=then) == 3.0
    assert moment(past=True, events=two, span=Span(3.0, 4.5)) == 8.0
    assert moment(past=True, events=two) == 8.0


@pytest.mark.parametrize(
    ("chances", "at", "found"),
    [
        ({8.0: 0.5, 10.0: 0.3, 12.0: 1.0}, 15.0, 10.0),
        ({8.0: 0.5, 10.0: 0.03, 12.0: 0.99}, 15.0, 10.0),
        ({8.0: 0.97, 10.0: 0.02}, 15.0, 8.0),
        ({8.0: 0.0, 10.0: 1.0}, 15.0, 15.0),
        ({8.0: 0.5, 16.0: 0.5}, 15.0, 8.0),
        ({15.0: 0.5}, 15.0, 15.0),
        ({}, 15.0, 15.0),
    ],
)
def test_it_is_tried_when_it_was_still_open(
    chances: Any, at: float, found: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    traces = tuple(plan(t) for t in chances)
    monkeypatch.setattr(supposed_when, "known_to", lambda ride, vehicle, moment: traces)
    monkeypatch.setattr(
        supposed_when, "probability", lambda ride, trace, v, names: chances[trace.sim_time]
    )
    asked = Given(looks={1: look(1)}).asked()
    assert supposed_when.open_until(asked, 1, TURN, at) == found


def test_what_it_was_before_we_decided_otherwise_does_not_count(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It was open at 8 s, when we went straight on; at 10 s we chose to change lanes."""
    traces = (plan(8.0), plan(10.0, "change-left"), plan(12.0, "change-left"))
    chances = {8.0: 0.5, 10.0: 1.0, 12.0: 1.0}
    monkeypatch.setattr(supposed_when, "known_to", lambda ride, vehicle, moment: traces)
    monkeypatch.setattr(
        supposed_when, "probability", lambda ride, trace, v, names: chances[trace.sim_time]
    )
    monkeypatch.setattr(supposed_when, "prediction", lambda trace, vehicle: seen[0])
    seen: list[object] = [object()]
    asked = Given(looks={1: look(1)}, traces=traces).asked()
    assert supposed_when.open_until(asked, 1, TURN, 10.0) == 10.0
    assert supposed_when.open_until(asked, 1, TURN, 8.0) == 8.0
    chances[10.0] = 0.5
    assert supposed_when.open_until(asked, 1, TURN, 12.0) == 10.0
    chances[10.0], seen[0] = 1.0, None  # out of view since: as long as it could have done it
    assert supposed_when.open_until(asked, 1, TURN, 12.0) == 8.0


def test_keeping_the_lane_is_what_a_change_of_lanes_did_not_do() -> None:
    kept = Event("keep-lane", tense="past")
    moved = {"events": begun("change-left", 8.0, 11.0), "traces": (plan(7.0, "change-left"),)}
    assert moment(kept, past=True, **moved) == 7.0
    assert supposed_when.was_done(Given(**moved).asked(), kept) is False
    assert moment(kept, past=False, **moved) != 7.0
