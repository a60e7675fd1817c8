"""Which slowing, standing or waiting of ours is meant, and what is told of it; asked at 20 s."""

from typing import Any

import pytest

from planner.record.events import Event as Told
from planner.record.places import RoadFacts
from tests.explain.answers.stated import decision, did, driven, look, place, result, roads, scene
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    DidNotHappen,
    Evidence,
    MotionCause,
    MotionReason,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.evidence import Causation, Contrast
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.explain.answers.reasons import motions as room
from xavi_dialogue.explain.answers.reference.reading import numbers_in
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)
LIMIT: RoadFacts = roads(places={0: place(limit=13.0)})
GO, STOP = decision(4.0, road=LIMIT), decision(4.0, ("stop", "continue"), road=LIMIT)
LEADER, PLAN = MotionCause("leader", vehicle=1), MotionCause("plan")
BRAKES, STANDS = did("brake", 4.0, 8.0), did("stop", 8.0, 12.0)
FOR_IT = did("brake", 4.0, 8.0, object=IT)


def driving(speed: float | tuple[float, ...] = 9.0) -> dict[int, Any]:
    """Our motion at a speed, or at one speed each second up to 20 s."""
    return {0: driven((0.0,) * 21, speed=speed)}


@pytest.fixture
def because(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """For which reasons we drove so, and at which decision; what was asked is kept."""
    known: dict[str, Any] = {"causes": (LEADER,), "trace": GO, "causation": None, "contrast": None}

    def reasons(_ride: Any, _world: Any, deed: Episode, at: Any = None) -> Reasons:
        known["asked"] = (deed, at)
        evidence = Evidence("tree", traces=("t4",))
        return Reasons(known["causes"], known["causation"], evidence, known["trace"])

    def stopping(_ride: Any, trace: Any, *, going_on: bool) -> Any:
        known["going_on"] = going_on
        return known["contrast"]

    monkeypatch.setattr(room, "driven_for", reasons)
    monkeypatch.setattr(room, "stopping", stopping)
    monkeypatch.setattr(room, "_speaks", lambda contrast, somebody: contrast == somebody)
    return known


def motion(event: Event, span: Span | None = None, **more: Any) -> Any:
    given = {"looks": SEEN, "traces": (GO,), "motions": driving()} | more
    asked = given.pop("asked", None)
    return result(lambda: room.motion(event, scene(span, **given), asked=asked))


# Which episode is meant -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("action", "episodes", "meant", "premise"),
    [
        ("brake", (BRAKES,), BRAKES, True),
        ("slow-down", (BRAKES,), BRAKES, True),
        ("brake", (STANDS,), STANDS, False),
        ("stop", (BRAKES, STANDS), STANDS, True),
        ("stop", (BRAKES,), BRAKES, False),
        ("stand", (did("stand", 8.0, 12.0),), did("stand", 8.0, 12.0), True),
        ("wait", (BRAKES, did("give-way", 9.0, 11.0)), did("give-way", 9.0, 11.0), True),
        ("wait", (BRAKES, STANDS), STANDS, True),
        ("give-way", (did("wait", 8.0, 12.0),), did("wait", 8.0, 12.0), False),
        ("give-way", (STANDS,), STANDS, False),
        ("let-go", (BRAKES,), BRAKES, False),
        ("speed-up", (did("go", 5.0, 7.0),), did("speed-up", 5.0, 7.0), True),
        ("block", (BRAKES, STANDS), STANDS, True),
        ("avoid", (STANDS,), STANDS, False),
        ("merge", (BRAKES,), BRAKES, True),
    ],
)
def test_the_row_of_its_name_comes_first(
    because: Any, action: Any, episodes: Any, meant: Episode, premise: bool
) -> None:
    found = motion(Event(action), episodes=episodes)
    assert (found.deed, found.premise, found.asked) == (meant, premise, action)


def test_what_is_asked_may_go_by_another_name(because: Any) -> None:
    found = motion(Event("merge"), episodes=(BRAKES, STANDS), asked="stop")
    assert (found.deed, found.asked) == (STANDS, "stop")


@pytest.mark.parametrize(
    ("event", "span", "episodes", "begin"),
    [
        (Event("brake"), None, (BRAKES, did("brake", 14.0, 15.0)), 14.0),
        (Event("brake"), SAID, (BRAKES, did("brake", 14.0, 15.0)), 4.0),
        (Event("brake", object=IT), None, (FOR_IT, did("brake", 14.0)), 4.0),
        (Event("brake", object=Vehicle(2)), None, (BRAKES, did("brake", 14.0)), 14.0),
        (Event("brake", tense="present"), None, (BRAKES, did("brake", 14.0)), 14.0),
        (Event("brake", tense="present"), None, (did("brake", 14.0, 18.0),), 14.0),
        (Event("brake", tense="present"), None, (did("brake", 14.0, 17.9),), None),
        (Event("brake", tense="present"), SAID, (BRAKES,), 4.0),
        (Event("wait"), None, (did("stop", 8.0, 12.0), did("wait", 8.4, 12.0)), 8.4),
        (Event("wait"), None, (did("wait", 7.6, 12.0), did("stop", 8.0, 12.0)), 7.6),
        (Event("wait"), None, (did("wait", 4.5, 5.0), did("stop", 9.0, 10.0)), 9.0),
    ],
)  # fmt: skip
def test_the_last_that_fits_is_meant(
    because: Any, event: Event, span: Any, episodes: Any, begin: Any
) -> None:
    present = event.tense == "present" and span is None
    kinds = room.KINDS[event.action][0]
    asked = scene(span, looks=SEEN, episodes=episodes)
    whom = frozenset(numbers_in(event.object))
    known = (room._episode(asked, kinds, one, present=present) for one in (whom, frozenset()))
    found = next((one for one in known if one is not None), None)
    assert (None if found is None else found.begin) == begin


# What is told of it -----------------------------------------------------------------------------


def test_a_motion_is_told_with_its_reasons(because: Any) -> None:
    causation = Causation("one", (1,), cleared=(2,))
    because["causation"] = causation
    found = motion(Event("brake", manner=("hard", "suddenly")), episodes=(BRAKES,))
    assert found == MotionReason(
        BRAKES, (LEADER,), asked="brake", evidence=Evidence("tree", traces=("t4",)),
        manner="hard", limit=13.0, cleared=(2,), past=True, causation=causation,
    )  # fmt: skip
    assert because["asked"] == (BRAKES, 20.0)
    motion(Event("brake"), SAID, episodes=(BRAKES,))
    assert because["asked"] == (BRAKES, 5.0)


@pytest.mark.parametrize(
    ("event", "span", "end", "past"),
    [
        (Event("brake"), None, 19.0, True),
        (Event("brake"), None, None, False),
        (Event("brake", tense="present"), None, 19.0, False),
        (Event("brake", tense="present"), SAID, 19.0, True),
        (Event("brake", tense="present"), Span(4.0, 6.0), 19.0, False),
        (Event("brake", tense="present"), Span(4.0, 19.1, said=True), None, False),
        (Event("brake", tense="present"), Span(4.0, 18.9, said=True), None, True),
    ],
)
def test_it_is_past_where_it_is_over_or_named_so(
    because: Any, event: Event, span: Any, end: Any, past: bool
) -> None:
    assert motion(event, span, episodes=(did("brake", 4.0, end),)).past is past


CONTRAST = Contrast(("stop",), ("continue",), None, (), (), Evidence(), 4.0)


@pytest.mark.parametrize(
    ("deed", "trace", "causes", "speaks", "choice"),
    [
        (STANDS, STOP, (LEADER,), True, True),
        (STANDS, STOP, (PLAN,), False, True),
        (STANDS, STOP, (LEADER,), False, False),
        (STANDS, GO, (LEADER,), True, False),
        (BRAKES, STOP, (LEADER,), True, True),
        (did("give-way", 8.0, 12.0), STOP, (LEADER,), True, False),
    ],
)
def test_a_stop_that_was_decided_is_a_choice(
    because: Any, monkeypatch: pytest.MonkeyPatch, deed: Any, trace: Any, causes: Any,
    speaks: bool, choice: bool,
) -> None:  # fmt: skip
    because |= {"trace": trace, "causes": causes, "contrast": CONTRAST}
    monkeypatch.setattr(room, "_speaks", lambda contrast, somebody: somebody is speaks)
    found = motion(Event("wait"), episodes=(deed,), traces=(trace,))
    if choice:
        assert found == ChoiceReason("why", deed, CONTRAST, past=True)
        assert motion(
            Event("wait", tense="present"), episodes=(did(deed.action, 8.0),), traces=(trace,)
        ).past is False  # fmt: skip
    else:
        assert isinstance(found, MotionReason)


@pytest.mark.parametrize(
    ("end", "span", "going_on"),
    [(None, None, True), (12.0, None, False), (None, SAID, False)],
)
def test_driving_on_is_compared_with_what_goes_on(
    because: Any, end: Any, span: Any, going_on: bool
) -> None:
    because["trace"] = STOP
    motion(Event("stop"), span, episodes=(did("stop", 4.0, end),), traces=(STOP,))
    assert because["going_on"] is going_on


ON = decision(15.0)


@pytest.mark.parametrize(
    ("deed", "traces", "causes", "given_up"),
    [
        (did("brake", 3.0, 8.0, speed_to=5.0), (STOP, ON), (PLAN,), True),
        (did("brake", 3.0, 8.0), (STOP, ON), (PLAN,), True),
        (did("brake", 3.0, 8.0, speed_to=2.5), (STOP, ON), (PLAN,), False),
        (did("brake", 3.0, 8.0, speed_to=5.0), (STOP, ON), (LEADER,), False),
        (did("brake", 3.0, 8.0, speed_to=5.0), (STOP,), (PLAN,), False),
        (did("stop", 3.0, 8.0, speed_to=5.0), (STOP, ON), (PLAN,), False),
    ],
)
def test_a_stop_may_be_given_up(
    because: Any, deed: Episode, traces: Any, causes: Any, given_up: bool
) -> None:
    because |= {"trace": STOP, "causes": causes}
    found = motion(Event("stop"), episodes=(deed,), traces=traces)
    assert found.causes == ((MotionCause("given-up"),) if given_up else causes)
    assert found.halted is None or not given_up


@pytest.mark.parametrize(
    ("begin", "traces", "causes", "halted"),
    [
        (3.0, (STOP,), (PLAN,), 4.0),
        (3.6, (STOP,), (PLAN,), 4.0),
        (3.8, (STOP,), (PLAN,), None),
        (3.0, (STOP, decision(15.0, ("change-left",))), (LEADER,), 4.0),
        (3.0, (STOP, ON), (LEADER,), None),
        (3.0, (STOP,), (MotionCause("given-up"),), None),
        (3.0, (STOP,), (MotionCause("given-up"), PLAN), None),
    ],
)
def test_while_slowing_down_it_was_decided_to_stop(
    because: Any, begin: float, traces: Any, causes: Any, halted: float | None
) -> None:
    because |= {"trace": STOP, "causes": causes}
    deed = did("brake", begin, 8.0, speed_to=2.0)
    assert motion(Event("brake"), episodes=(deed,), traces=traces).halted == halted
    because["trace"] = GO
    assert motion(Event("brake"), episodes=(deed,), traces=traces).halted is None


# Where we did not -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "span", "refusal"),
    [
        (Event("stop"), None, DidNotHappen(Event("stop"), (did("exit-left", 10.0, 12.0),))),
        (
            Event("brake"),
            SAID,
            DidNotHappen(Event("brake"), (did("brake", 14.0, 15.0),), elsewhen=14.0),
        ),
    ],
)
def test_what_we_did_not_do_is_refused_with_what_we_did(
    because: Any, event: Event, span: Any, refusal: DidNotHappen
) -> None:
    turned = (
        Told("action-started", 10.0, "exit-left", 1),
        Told("action-committed", 10.0, "exit-left", 1),
        Told("action-ended", 12.0, "exit-left", 1),
        Told("action-started", 12.0, "continue", 2),
    )
    episodes = () if span is None else (did("brake", 14.0, 15.0),)
    assert motion(event, span, episodes=episodes, events=turned) == refusal
    assert motion(Event("speed-up", tense="present")) == DidNotHappen(
        Event("speed-up", tense="present")
    )


def test_the_nearest_is_told_where_a_time_was_named(because: Any) -> None:
    two = (did("brake", 9.0, 10.0), did("brake", 14.0, 15.0))
    assert motion(Event("brake"), SAID, episodes=two).elsewhen == 9.0
    nothing = motion(Event("brake"), SAID, episodes=(did("go", 9.0, 10.0),))
    assert nothing == DidNotHappen(Event("brake"))


# A stop in force while we brake -----------------------------------------------------------------


@pytest.mark.parametrize("speaks", [True, False])
def test_who_brakes_at_a_red_light_for_a_chosen_stop_is_stopping(
    because: dict[str, Any], speaks: bool
) -> None:
    because["causes"] = (MotionCause("light"),)
    because["contrast"] = False if speaks else None
    facts: dict[str, Any] = {"episodes": (did("brake", 4.0),)}
    facts["traces"] = (GO, decision(15.0, ("stop", "continue"), road=LIMIT))
    found = motion(Event("stop", tense="present"), **facts)
    assert isinstance(found, ChoiceReason) if speaks else found.premise
    braking = motion(Event("brake", tense="present"), **facts)
    assert isinstance(braking, MotionReason)  # of braking, the light is the reason
    assert not motion(Event("stop", tense="present"), **(facts | {"traces": (GO,)})).premise
