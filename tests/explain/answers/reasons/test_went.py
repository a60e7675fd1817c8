"""Why we went when we did: which going is meant, and what waiting is compared with; at 20 s."""

from typing import Any

import pytest

from planner.record.events import Event as Told
from tests.explain.answers.stated import decision, did, look, result, roads, scene
from xavi_dialogue.domain.answers import CrossingVehicle, GoReason
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Ego, Event, Exit, Junction, Vehicle
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reasons import going as room
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.history.deeds import Deed

US = Ego()
SAID = Span(4.0, 6.0, said=True)


def begun(action: Any, time: float, end: float | None = None, committed: float | None = -1.0) -> tuple[Told, ...]:  # fmt: skip  # noqa: E501
    """The events of something that we did; committed when it began unless said otherwise."""
    at = time if committed == -1.0 else committed
    over = () if end is None else (Told("action-ended", end, action, 1),)
    sure = () if at is None else (Told("action-committed", at, action, 1),)
    return (Told("action-started", time, action, 1), *sure, *over)


# Which way through a junction is meant ----------------------------------------------------------


@pytest.mark.parametrize(
    ("events", "span", "time"),
    [
        (begun("exit-left", 15.0), None, 15.0),
        (begun("exit-left", 15.0, 18.0), None, 15.0),
        (begun("exit-left", 5.0, 10.1), None, 5.0),
        (begun("exit-left", 5.0, 9.9), None, None),
        ((*begun("exit-left", 12.0, 13.0), *begun("exit-right", 15.0)), None, 15.0),
        ((*begun("exit-left", 4.0, 5.0), *begun("exit-right", 15.0)), SAID, 4.0),
        ((*begun("exit-left", 5.5, 6.0), *begun("exit-right", 6.4, 9.0)), SAID, 6.4),
        (begun("exit-right", 15.0), SAID, 15.0),  # the next one, where none was before
        ((*begun("exit-right", 9.0, 10.0), *begun("exit-left", 15.0)), SAID, 9.0),
        (begun("change-left", 15.0), None, None),
        (begun("continue-next-exit", 15.0), None, 15.0),
        ((), None, None),
    ],
)
def test_the_last_junction_gone_into_is_meant(events: Any, span: Any, time: Any) -> None:
    found = room.crossed(scene(span, events=events))
    assert (None if found is None else found.time) == time


# Going to a side --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "events", "action"),
    [
        (Event("exit-left"), begun("change-left", 15.0), "change-left"),
        (Event("exit-right"), begun("change-right", 15.0, 19.6), "change-right"),
        (Event("exit-left"), begun("change-left", 15.0, 19.4), "exit-left"),
        (Event("exit-left"), begun("change-right", 15.0), "exit-left"),
        (Event("exit-left"), begun("exit-left", 15.0), "exit-left"),
        (Event("exit-left", object=Exit()), begun("change-left", 15.0), "exit-left"),
        (Event("exit-left", object=Junction()), begun("change-left", 15.0), "exit-left"),
        (Event("turn"), begun("change-left", 15.0), "turn"),
        (Event("exit-left"), (), "exit-left"),
    ],
)
def test_going_left_may_be_changing_lanes(event: Event, events: Any, action: str) -> None:
    found = room.sideways(event, scene(events=events))
    assert (found.action, found.object) == (action, event.object)


def test_the_change_under_way_at_the_time_counts() -> None:
    events = (*begun("change-left", 4.0, 6.0), *begun("change-right", 15.0))
    assert room.sideways(Event("exit-left"), scene(SAID, events=events)).action == "change-left"
    assert room.sideways(Event("exit-right"), scene(SAID, events=events)).action == "exit-right"
    assert room.sideways(Event("exit-right"), scene(events=events)).action == "change-right"
    two = (*begun("change-left", 18.0, 19.6), *begun("change-right", 19.7))
    assert room.sideways(Event("exit-right"), scene(events=two)).action == "change-right"


# What waiting is compared with ------------------------------------------------------------------


@pytest.fixture
def open_(monkeypatch: pytest.MonkeyPatch) -> set[float]:
    """At which decisions stopping was an option; a comparison is told by its decision."""
    times: set[float] = set()

    def is_open(_: Any, trace: Any, foil: Any) -> bool:
        return foil == ("stop",) and trace.sim_time in times

    monkeypatch.setattr(room, "is_open", is_open)
    monkeypatch.setattr(room, "contrast", lambda _, trace, foil: (trace.sim_time, foil))
    return times


@pytest.mark.parametrize(
    ("times", "stops", "found"),
    [
        ({7.0, 9.0}, (), 9.0),
        ({7.0, 9.0}, (9.0,), 7.0),
        ({7.0}, (7.0,), None),
        ({10.0}, (), 10.0),
        ({11.0}, (), None),
        ({6.0}, (), 6.0),
        ({5.0}, (), None),
        (set(), (), None),
    ],
)
def test_waiting_is_the_last_chance_to_stop(
    open_: set[float], times: set[float], stops: Any, found: float | None
) -> None:
    open_ |= times
    traces = tuple(
        decision(t, ("stop", "continue") if t in stops else ("continue",))
        for t in (5.0, 6.0, 7.0, 9.0, 10.0, 11.0)
    )
    told: Any = room._waiting(scene(traces=traces), 10.0)
    assert told == (None if found is None else (found, ("stop",)))


# Why we went ------------------------------------------------------------------------------------

ROAD = roads((1, "vehicle"))
TRACES = (decision(10.0, road=ROAD), decision(18.0, road=ROAD))
ONE, TWO = CrossingVehicle(1, "vehicle"), CrossingVehicle(2, "ego")


class Setting:
    """Which deed is meant, and who stood by; choices are told by what was asked."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.deed: Deed | None = None
        self.others: tuple[CrossingVehicle, ...] = (ONE, TWO)
        self.at: list[float] = []
        patch.setattr(room, "premise", lambda _, about: Premise(TRACES[1], self.deed))
        patch.setattr(room, "bystanders", self._bystanders)
        patch.setattr(room, "is_open", lambda *_: True)
        patch.setattr(room, "contrast", lambda _, trace, foil: None)
        patch.setattr(choices, "why", lambda event, _: ("choice", event))

    def _bystanders(self, _ride: Any, _world: Any, time: float) -> tuple[CrossingVehicle, ...]:
        self.at.append(time)
        return self.others


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


def went(event: Event, span: Span | None = None, **more: Any) -> Any:
    return result(room.went, event, scene(span, **({"traces": TRACES} | more)))


GO = Event("go")
TURN = Deed("exit-right", 10, 9.0, 10.0, 14.0)


@pytest.mark.parametrize(
    ("deed", "span", "choice"),
    [
        (Deed("change-left", 15, 15.0, 15.0), None, True),
        (Deed("change-right", 12, 12.0, 12.0, 16.1), None, True),
        (Deed("change-left", 12, 12.0, 12.0, 15.9), None, False),
        (Deed("change-left", 2, 2.0, 2.0, 3.0), SAID, True),
        (TURN, None, False),
    ],
)
def test_going_may_be_changing_lanes(setting: Setting, deed: Deed, span: Any, choice: bool) -> None:
    setting.deed = deed
    found = went(GO, span)
    if choice:
        assert found == ("choice", Event(deed.action))
    else:
        assert isinstance(found, GoReason)


def test_a_turn_is_told_by_when_it_was_decided(setting: Setting) -> None:
    setting.deed = TURN
    found = went(GO)
    assert (found.deed, found.others, found.past) == (did("exit-right", 10.0, 14.0), (ONE, TWO), True)  # fmt: skip  # noqa: E501
    assert setting.at == [10.0]
    now = went(Event("go", tense="present"))
    assert now.past  # it began long ago
    setting.deed = Deed("exit-right", 18, 18.0, 19.6)
    assert not went(Event("go", tense="present")).past
    setting.deed = Deed("exit-right", 18, 18.0, 19.4)
    assert went(Event("go", tense="present")).past


def test_a_turn_that_is_not_begun_is_of_the_moment(setting: Setting) -> None:
    setting.deed = Deed("exit-right", 18, 18.0)
    found = went(Event("go", tense="present"))
    assert (found.deed, found.past) == (did("exit-right", 20.0), False)
    assert setting.at == [20.0]


def test_a_junction_that_was_crossed_is_looked_up(setting: Setting) -> None:
    turned = (*begun("exit-left", 12.0, 15.0), *begun("continue", 15.0))
    setting.deed = Deed("continue", 15, 15.0)
    assert went(GO, events=turned).deed == did("exit-left", 12.0, 15.0)
    setting.deed = None
    assert went(GO, events=turned).deed == did("exit-left", 12.0, 15.0)
    none = went(GO)
    assert (none.deed, none.others, setting.at[-1]) == (None, (ONE, TWO), 20.0)


def test_who_is_named_is_told_alone(setting: Setting) -> None:
    setting.deed = TURN
    seen = {1: look(1), 2: look(2), 3: look(3)}
    assert went(Event("go", object=Vehicle(2)), looks=seen).others == (TWO,)
    assert went(Event("go", object=Vehicle(3)), looks=seen).others == (ONE, TWO)


@pytest.mark.parametrize(
    ("deed", "traces", "others", "choice"),
    [
        (TURN, TRACES, (), False),
        (TURN, (decision(10.0), TRACES[1]), (), True),
        (TURN, TRACES[1:], (), True),
        (TURN, (decision(10.0),), (ONE,), False),
        (None, TRACES, (), True),
        (None, TRACES, (ONE,), False),
    ],
)
def test_where_nobody_was_near_it_was_a_choice(
    setting: Setting, deed: Any, traces: Any, others: Any, choice: bool
) -> None:
    setting.deed, setting.others = deed, others
    found = went(GO, traces=traces)
    assert (found == ("choice", None)) is choice
    assert choice or isinstance(found, GoReason)
