"""How sure the car was: a belief, a rule, a distance or the plan, and since when."""

from typing import Any

import pytest

from tests.explain.answers.events.test_beliefs import ONE, STEADY, TURN, sure
from tests.explain.answers.stated import (
    US,
    aim,
    belief,
    decision,
    look,
    result,
    roads,
    scene,
    they,
    thoughts,
)
from tests.explain.trust import trusted
from tests.traces import End
from xavi_dialogue.domain.answers import Beliefs, Closeness, NoSuchVehicle, NotRecorded, Priority
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Caused,
    Event,
    Happens,
    Is,
    Not,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.events.beliefs import (
    beliefs_of,
    least_sure,
    since_when,
)

# --- how sure -----------------------------------------------------------------------------------


def test_what_is_believed_of_conduct_is_its_history() -> None:
    for of in (Happens(TURN), Believed(Happens(TURN)), Believed(Not(Happens(TURN)))):
        found = sure(of, **STEADY)
        assert isinstance(found, Beliefs)
        assert found.of == TURN
        assert found.denied == isinstance(getattr(of, "content", None), Not)
        assert found.probability == pytest.approx(0.1 if found.denied else 0.9)
    found = sure(Happens(Event("exit-left", ONE, time=At(3.0))), **STEADY)
    assert (found.time, found.probability) == (2.0, pytest.approx(0.6))
    found = sure(Happens(Event("exit-left", ONE, time=At(3.0))), At(9.0), **STEADY)
    assert found.time == 8.0  # the question's own time comes first


def test_an_unknown_vehicle_is_refused() -> None:
    found = sure(Happens(Event("exit-left", Vehicle(7))), **STEADY)
    assert isinstance(found, NoSuchVehicle)
    assert found.thing == Vehicle(7)


def test_what_goes_on_needs_no_chance() -> None:
    now = Event("exit-left", ONE, tense="present", modal="will")
    told = (they(1, "exit-left", 15.0),)
    found = sure(Happens(now), episodes=told, **STEADY)
    assert (found.that, found.holds, found.facts) == (
        Happens(Event("exit-left", ONE, tense="present")), True, told,
    )  # fmt: skip
    assert isinstance(sure(Happens(TURN), episodes=told, **STEADY), Beliefs)
    assert isinstance(sure(Happens(now), At(16.0), episodes=told, **STEADY), Beliefs)
    over = (they(1, "exit-left", 15.0, 19.9),)
    assert isinstance(sure(Happens(now), episodes=over, **STEADY), Beliefs)


def test_a_collision_of_ours_is_its_chance_under_the_plan() -> None:
    aims = {1: (aim("exit-left", 0.3), aim("continue", 0.7))}

    def crash(chosen: Any) -> Any:
        return End("collision", collided_with=1) if chosen[1][0] == "exit-left" else End()

    traces = [decision(5.0), decision(15.0, aims=aims, ends={("continue",): crash})]
    found = sure(Happens(Event("collide", tense="future")), traces=traces)
    assert (found.holds, found.probability) == (None, pytest.approx(trusted(0.3)))
    found = sure(Happens(Event("collide", time=At(8.0))), traces=traces)
    assert found.probability == trusted(0.0)


def test_what_we_mean_to_do_is_as_sure_as_the_plan() -> None:
    traces = [decision(20.0, ("change-left", "continue"))]
    found = sure(Happens(Event("change-left", tense="future")), traces=traces)
    assert (found.holds, found.probability) == (True, 1.0)
    found = sure(Happens(Event("change-right", tense="future")), traces=traces)
    assert (found.holds, found.probability) == (None, None)


def test_right_of_way_that_is_settled_is_told_by_the_rule() -> None:
    first = Related("has-priority-over", ONE, US)
    for who, rule in (("vehicle", "give-way"), ("ego", "priority")):
        found = sure(first, **(STEADY | {"traces": [decision(20.0, road=roads((1, who)))]}))
        assert isinstance(found, Priority)
        assert (found.rule, found.vehicle) == (rule, 1)
    depends = STEADY | {"traces": [decision(20.0, road=roads((1, "depends")))]}
    assert isinstance(sure(first, **depends), Beliefs)


def test_where_somebody_is_asks_for_what_it_is_expected_to_do() -> None:
    found = sure(Related("behind", ONE), **STEADY)
    assert (found.vehicle, found.of, found.time) == (1, None, 14.0)
    found = sure(Related("behind", ONE, time=At(3.0)), **STEADY)
    assert found.time == 2.0


def test_safety_beside_somebody_is_how_close_it_came() -> None:
    values = {("distance", 0, 1): lambda t: 5.0 + abs(t - 6.0)}
    for state in ("safe", "dangerous"):
        found = sure(Is(state, ONE), values=values, **STEADY)
        assert isinstance(found, Closeness)
        assert found.asked == state
        assert found.closest is not None
        assert (found.vehicle, found.closest.value, found.closest.time) == (1, 5.0, 6.0)
    assert isinstance(sure(Is("fast", ONE), values=values, **STEADY), Beliefs)


@pytest.mark.parametrize(
    ("of", "vehicle"),
    [
        (Related("behind", US, ONE), 1),
        (Is("fast", ONE), 1),
        (Caused(ONE), 2),
        (None, 2),
    ],
)
def test_whose_belief_it_is(of: Any, vehicle: int) -> None:
    facts = {
        "looks": {1: look(1), 2: look(2), 3: look(3, in_view=False)},
        "beliefs": (
            belief(1, 2.0, ("continue", 0.8)),
            belief(2, 2.0, ("continue", 0.6)),
            belief(3, 2.0, ("continue", 0.4)),
        ),
    }
    assert sure(of, **facts).vehicle == vehicle


def test_of_nobody_nothing_is_believed() -> None:
    assert sure(None) == NotRecorded("not-recorded", about="probability")
    assert least_sure(scene(looks={1: look(1)}, beliefs=(belief(1, 2.0),)), 20.0) is None


def test_least_sure_is_asked_of_the_time() -> None:
    facts = {
        "looks": {1: look(1), 2: look(2)},
        "beliefs": (
            belief(1, 2.0, ("continue", 0.5)),
            belief(2, 2.0, ("continue", 0.6)),
            belief(1, 8.0, ("continue", 0.9)),
        ),
    }
    assert least_sure(scene(**facts), 5.0) == 1  # type: ignore[arg-type]
    assert least_sure(scene(**facts), 9.0) == 2  # type: ignore[arg-type]


# --- since when ---------------------------------------------------------------------------------


def test_since_when_it_was_likely() -> None:
    told = thoughts((2.0, 0.6), (4.0, 0.3), (6.0, 0.5), (8.0, 0.9))
    found = result(since_when, scene(**told), TURN)
    assert (found.since, found.time, found.probability) == (6.0, 6.0, pytest.approx(0.5))


def test_once_it_has_come_later_beliefs_do_not_count() -> None:
    told = thoughts((2.0, 0.6), (4.0, 0.3), (6.0, 0.5), (8.0, 0.1))
    turned = (they(1, "exit-left", 7.0, 9.0),)
    assert result(since_when, scene(episodes=turned, **told), TURN).since == 6.0
    found = result(since_when, scene(**told), TURN)
    assert (found.since, found.time) == (None, 8.0)


def test_beliefs_of_conduct_are_of_the_actor() -> None:
    found = result(beliefs_of, scene(**STEADY), TURN, At(3.0))
    assert (found.vehicle, found.time) == (1, 2.0)
