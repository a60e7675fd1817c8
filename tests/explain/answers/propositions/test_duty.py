"""Whether somebody has to let another go first, did so, or is willing to."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    US,
    aim,
    decision,
    did,
    driven,
    look,
    result,
    roads,
    scene,
    they,
)
from tests.traces import Way
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Everyone,
    Happens,
    Is,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.propositions.duties import duty, is_owed

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2), 3: look(3)}
#: Two go first, and one has to wait for us.
ROAD = roads((1, "vehicle"), (2, "vehicle"), (3, "ego"))


def weighed(event: Event, *, road: Any = ROAD, span: Any = None, **facts: Any) -> Any:
    traces = facts.pop("traces", [decision(20.0, road=road)])
    asked = scene(span, **({"looks": LOOKS, "traces": traces, "road": road} | facts))
    return result(duty, asked, event)


def action(name: Any, actor: Any = US, whom: Any = None, **more: Any) -> Event:
    return Event(name, actor, whom, **more)


# --- who has to wait ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "holds"),
    [
        (action("wait", whom=ONE), True),
        (action("give-way", whom=Vehicle(3)), False),
        (action("let-go", ONE, US), False),
        (action("let-go", Vehicle(3), US), True),
        (action("stop", Vehicle(3), US), True),
        (action("brake", ONE, US), False),
        (action("go", ONE, manner=("first",)), True),
        (action("enter", whom=ONE, manner=("first",)), False),
        (action("cross", US, ONE), False),
        (action("merge", US, Vehicle(3)), True),
    ],
)
def test_who_has_to_yield_by_the_rule(event: Event, holds: bool) -> None:
    for modal in ("must", "should"):
        asked = type(event)(**{**_fields(event), "modal": modal, "tense": "present"})
        found = weighed(asked)
        assert (found.holds, found.answer.holds) == (holds, holds)
        assert is_owed(Happens(asked))


def test_whether_somebody_may_go_first_is_settled_by_the_rule() -> None:
    for modal in ("can", "could", "might"):
        asked = action("go", ONE, US, manner=("first",), modal=modal, tense="present")
        assert weighed(asked).answer.holds is True
    assert weighed(action("go", ONE, modal="might", tense="present")) is None


def _fields(event: Event) -> dict[str, Any]:
    return {name: getattr(event, name) for name in event.__struct_fields__}


def test_what_is_no_such_duty() -> None:
    for event in (
        action("wait", whom=ONE, tense="present"),
        action("turn", modal="must", tense="present"),
        action("stop", ONE, TWO, modal="must", tense="present"),
        action("cross", ONE, US, modal="must", tense="present"),
        action("stop", whom=ONE, modal="must", tense="present"),
    ):
        assert not is_owed(Happens(event))
    assert not is_owed(Is("safe"))
    assert weighed(action("turn", ONE, modal="must", tense="present")) is None
    for tense in ("present", "past"):
        assert weighed(action("turn", modal="must", tense=tense)) is None
        assert weighed(action("turn", ONE, modal="must", tense=tense)) is None
    past = action("stop", ONE, US, modal="must")
    assert not is_owed(Happens(past))
    assert is_owed(Happens(action("stop", ONE, US, modal="should")))


def test_what_comes_after_tells_whom_it_is_for() -> None:
    then = action("wait", TWO, Vehicle(3))
    event = action("turn", US, modal="must", tense="present", then=then)
    found = weighed(event)
    assert (found.holds, found.answer.vehicle) == (False, 3)


def test_where_no_rule_tells_what_we_did_does() -> None:
    waited = (did("wait", 15.0, object=ONE),)
    event = action("wait", whom=ONE, modal="must", tense="present")
    unsettled = roads((1, "depends"))
    found = weighed(event, road=unsettled, episodes=waited)
    assert (found.holds, found.facts) == (True, waited)
    found = weighed(event, road=unsettled)
    assert (found.holds, found.answer.rule) == (None, "depends")
    theirs = action("wait", ONE, US, modal="must", tense="present")
    told = (they(1, "wait", 15.0, object=US),)
    assert weighed(theirs, road=unsettled, episodes=told).answer.rule == "depends"
    past = action("wait", whom=ONE, modal="must", time=At(18.0))
    found = weighed(past, road=unsettled, episodes=(did("wait", 15.0, 17.0, object=ONE),))
    assert (found.holds, found.facts[0].end) == (True, 17.0)


def test_of_the_past_the_rule_of_that_time_is_told() -> None:
    traces = [decision(5.0, road=roads((1, "ego"))), decision(20.0, road=roads((1, "vehicle")))]
    event = action("wait", whom=ONE, modal="must", time=At(5.0))
    found = weighed(event, traces=traces)
    assert (found.holds, found.answer.time) == (False, 5.0)
    now = action("wait", whom=ONE, modal="must", tense="present")
    assert weighed(now, traces=traces).answer.time == 20.0


@pytest.mark.parametrize(
    ("event", "vehicle", "others", "holds"),
    [
        (action("wait", US, Vehicles((1, 2, 3))), 1, (2,), True),
        (action("wait", US, Vehicles((3, 2))), 2, (), True),
        (action("wait", US, Everyone()), 1, (2,), True),
        (action("wait", Vehicles((1, 3)), US), 3, (), True),
        (action("wait", Everyone(), US), 3, (), True),
        (action("wait", US, Vehicles((3,))), 3, (), False),  # not 1, which was not asked about
    ],
)
def test_of_several_those_are_told_of_whom_it_holds(
    event: Event, vehicle: int, others: Any, holds: bool
) -> None:
    asked = type(event)(**{**_fields(event), "modal": "must", "tense": "present"})
    found = weighed(asked)
    assert (found.holds, found.answer.vehicle, found.answer.others) == (holds, vehicle, others)
    assert found.answer.first is None


# --- who went first -----------------------------------------------------------------------------

#: We come to where lines meet at 10 s.
OURS = driven([10.0 * k for k in range(21)])


def meeting(at: float, who: Any) -> dict[str, Any]:
    """Somebody comes to where lines meet at a time [s]; by the road we or he go first."""
    theirs = driven([100.0] * 21, ys=[10.0 * (k - at) for k in range(21)])
    road = roads((1, who))
    return {"motions": {0: OURS, 1: theirs}, "traces": [decision(9.0, road=road)], "road": road}


THEN = Between(8.0, 12.0)


def test_who_went_first_of_both() -> None:
    for at, ours in ((12.0, True), (8.0, False)):
        facts = meeting(at, "vehicle")
        for event, holds in (
            (action("go", US, ONE, manner=("first",), time=THEN), ours),
            (action("enter", ONE, manner=("first",), time=THEN), not ours),
            (action("cross", ONE, manner=("first",), time=THEN, tense="perfect"), not ours),
        ):
            found = weighed(event, **facts)
            assert (found.holds, found.answer.holds) == (holds, holds)
    facts = {"traces": [decision(9.0, road=roads((1, "vehicle")))], "road": None}
    unmet = weighed(action("go", ONE, manner=("first",), time=THEN), **facts)
    assert (unmet.holds, unmet.answer.rule) == (None, "give-way")
    facts = {"traces": [decision(9.0, road=roads())], "road": roads()}
    assert weighed(action("go", ONE, manner=("first",), time=THEN), **facts) is None
    assert weighed(action("go", manner=("first",), time=THEN), **meeting(8.0, "ego")) is None


def test_coming_into_his_way_is_going_first() -> None:
    for name in ("pull-out", "cut-in", "cross", "block"):
        event = action(name, US, ONE, time=THEN)
        found = weighed(event, **meeting(12.0, "vehicle"))
        assert (found.holds, found.answer.holds, found.answer.rule) == (True, True, "give-way")
        assert weighed(event, **meeting(12.0, "depends")).answer.rule == "depends"
        assert weighed(event, **meeting(12.0, "ego")) is None
        assert weighed(event, **meeting(8.0, "vehicle")) is None
        assert weighed(action(name, US, time=THEN), **meeting(12.0, "vehicle")) is None
    future = action("cross", US, ONE, tense="future")
    assert weighed(future, **meeting(12.0, "vehicle")) is None
    recorded = (did("cut-in", 9.0, 10.0, object=ONE),)
    event = action("cut-in", US, ONE, time=THEN)
    assert weighed(event, episodes=recorded, **meeting(12.0, "vehicle")) is None
    theirs = action("cut-in", ONE, US, time=THEN)
    assert weighed(theirs, **meeting(12.0, "vehicle")) is None


# --- who is willing -----------------------------------------------------------------------------


def test_whether_somebody_lets_us_go_first_is_told_by_the_rule() -> None:
    for name in ("give-way", "let-go", "wait", "stop", "brake", "slow-down"):
        for tense, modal in (("present", None), ("future", None), ("future", "will")):
            event = action(name, Vehicle(3), US, tense=tense, modal=modal)
            assert weighed(event).holds is True
            event = action(name, ONE, US, tense=tense, modal=modal)
            found = weighed(event)
            assert (found.holds, found.answer.rule) == (False, "give-way")
    for event in (
        action("stop", ONE, TWO, tense="future"),
        action("stop", ONE, US),
        action("stop", ONE, US, tense="future", modal="can"),
        action("stop", Everyone(), US, tense="future"),
        action("overtake", ONE, US, tense="future"),
    ):
        assert weighed(event) is None


def test_who_does_so_or_probably_will_is_told_by_that() -> None:
    event = action("stop", ONE, US, tense="future")
    assert weighed(event, episodes=(they(1, "stop", 18.0, object=US),)) is None
    stays, goes = (Way(("stop",), 1.0, ()),), (Way(("continue",), 1.0, ()),)
    for share, told in ((0.5, None), (0.49, False)):
        aims = {1: (aim("stop", share, ways=stays), aim("continue", 1.0 - share, ways=goes))}
        traces = [decision(20.0, aims=aims, road=ROAD)]
        found = weighed(action("wait", ONE, US, tense="future"), traces=traces)
        assert (None if found is None else found.holds) is told
    unsettled = roads((1, "depends"))
    assert weighed(event, road=unsettled) is None


def test_whether_we_let_somebody_go_first() -> None:
    for name in ("give-way", "let-go"):
        found = weighed(action(name, US, ONE, tense="future"))
        assert (found.holds, found.answer.vehicle) == (True, 1)
        found = weighed(action(name, US, ONE, tense="present", modal="want"))
        assert found.holds is True
        assert weighed(action(name, US, Vehicle(3), tense="future")) is None
        assert weighed(action(name, US, tense="future")) is None
        found = weighed(action(name, US, ONE, tense="present"))
        assert (found.holds, found.answer.vehicle) == (True, 1)  # we shall, as we have to
        assert weighed(action(name, US, Vehicle(3), tense="present")) is None


def test_way_that_we_did_not_give_is_told_with_who_went_first() -> None:
    event = action("give-way", US, ONE, time=THEN)
    found = weighed(event, **meeting(12.0, "vehicle"))
    assert (found.holds, found.answer.holds, found.answer.first) == (False, False, US)
    perfect = action("give-way", US, ONE, time=THEN, tense="perfect")
    assert weighed(perfect, **meeting(12.0, "vehicle")).holds is False
    ever = weighed(action("give-way", US, ONE), **meeting(12.0, "vehicle"))
    assert (ever.holds, ever.answer.time) == (False, 9.0)
    assert weighed(event, **meeting(8.0, "vehicle")) is None
    assert weighed(event, **meeting(12.0, "ego")) is None
    gave = (did("give-way", 8.0, 9.0, object=ONE),)
    assert weighed(event, episodes=gave, **meeting(12.0, "vehicle")) is None
    anybody = action("give-way", US, time=THEN)
    assert weighed(anybody, **meeting(12.0, "vehicle")).holds is False
    modal = action("give-way", US, ONE, time=THEN, modal="might")
    assert weighed(modal, **meeting(12.0, "vehicle")) is None


def test_way_that_he_had_and_nobody_has_taken_yet_is_being_given() -> None:
    """Nobody has come to where the lines meet: we are about to let him go first."""
    facts: dict[str, Any] = {"traces": [decision(9.0, road=ROAD)], "road": ROAD}
    found = weighed(action("give-way", US, ONE, time=THEN), **facts)
    assert (found.holds, found.answer.holds, found.answer.rule) == (True, True, "give-way")
    assert weighed(action("give-way", US, Vehicle(3), time=THEN), **facts) is None
    assert weighed(action("give-way", US, time=THEN), **facts) is None
