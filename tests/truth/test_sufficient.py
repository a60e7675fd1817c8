"""What an answer has to tell, and what it must not, on a decision made by hand."""

import dataclasses

import pytest
from msgspec.structs import replace

from benchmarks.truth.checker import checked
from benchmarks.truth.decision import Decision
from benchmarks.truth.reckoning import Reckoning
from benchmarks.truth.ridden import Ridden, ridden
from benchmarks.truth.sufficient import Check, check_of, insufficient
from planner.record.trace import Action, EgoGoal, PlannedAction, PlanTrace, WhatIf
from sim.scene import Scene
from tests.explain.trust import trusted
from tests.sources import imports, modules
from tests.traces import Aim, Chosen, End, Way, World, trace_of
from xavi_dialogue.vehicle.episode import Moment

APART = ("explain", "causal", "nlg", "nlu", "dialogue", "domain")
ASKED = "Why don't you move to the left lane?"
LEFT = "I am not moving to the left lane, because that "
RISK = f"{100 * trusted(0.2):.0f} %"  # of moving left; vehicle 1 turns right in a fifth
RISKY = f"carries a {RISK} risk of a collision"
TOLD = LEFT + RISKY + " with vehicle 1, though it would save us 2 seconds."


def simulate(plan: tuple[str, ...], chosen: Chosen) -> tuple[End, int]:
    """Moving left saves 2 s, and collides where vehicle 1 turns right; stopping costs 5 s."""
    if plan == ("change-left",):
        if chosen[1][0] == "exit-right":
            return End("collision", collided_with=1), 1
        return End(time=10.0), 1
    return End(time=17.0 if plan == ("stop",) else 12.0), 1


WORLD = World(
    {
        1: (Aim("continue", 0.8, (Way(("continue",)),)), Aim("exit-right", 0.2, (Way(()),))),
        2: (Aim("continue", 1.0, (Way(("continue",)),)),),
    },
    (("continue",), ("change-left",), ("stop",)),
    simulate,
)


def seen(*traces: PlanTrace) -> Ridden:
    return ridden([Moment(Scene(t.sim_time, t.scene), (), t) for t in traces])


def found(text: str, *, trace: PlanTrace | None = None, asked: str = "change-left") -> set[Check]:
    """The checks that a text fails, as an answer to a question about a foil."""
    trace = trace or trace_of(WORLD)
    decision = Decision(trace, asked=(asked,))  # type: ignore[arg-type]
    faults, _, told = checked(seen(trace), trace.sim_time, ASKED, text, decision)
    return {check_of(one) for one in (*faults, *insufficient(text, told, decision))}


def test_the_reader_shares_no_code_with_what_it_judges() -> None:
    readers = [m for name, m in modules().items() if name.startswith("benchmarks.truth")]
    assert len(readers) > 10
    for module in readers:
        for one in imports(module):
            assert not one.target.startswith(tuple(f"xavi_dialogue.{a}" for a in APART))


def test_an_answer_that_tells_enough_passes() -> None:
    assert found(TOLD) == set()


@pytest.mark.parametrize(
    ("text", "check"),
    [
        (LEFT + "would save us 2 seconds, but not enough to be worth a lane change.", "sign"),
        (LEFT + "would only save us 9 seconds, not enough to be worth a lane change.", "number"),
        (LEFT + "would save us 2 seconds, but not enough to be worth a lane change.", "risk"),
        ("It is a close decision: moving to the left lane would be about as good.", "sign"),
        ("I now think that moving to the left lane would be better.", "sign"),
        (TOLD.replace(RISK, "31 %"), "number"),
        (TOLD.replace("2 seconds", "4 seconds"), "number"),
        (TOLD.replace("save us", "cost us"), "number"),
        (TOLD.replace("vehicle 1", "vehicle 2"), "reason"),
        (LEFT + "would end in a collision with vehicle 1.", "number"),
        (LEFT + f"would mean sharper steering, and {RISKY}.", "reason"),
        ("I am not moving to the left lane, because vehicle 2 is standing in our way.", "reason"),
        ("I moved to the left lane, because stopping would cost us about 5 seconds.", "reason"),
        ("I am staying in my lane, because stopping would cost us about 5 seconds.", "sign"),
        ("I am going because vehicle 2 has to let us go first.", "reason"),
    ],
)
def test_what_is_missing_or_wrong_is_found(text: str, check: Check) -> None:
    assert check in found(text)


def test_who_is_named_must_hold_us_up() -> None:
    text = "I am staying in my lane, because vehicle 1 is slowing down ahead of us."
    assert "reason" in found(text)


@pytest.mark.parametrize("told", ["get there 2 seconds sooner", "not get to our destination"])
def test_the_destination_is_not_a_waypoint(told: str) -> None:
    risk = f"there would be a {RISK} risk of a collision"
    text = f"If I moved to the left lane, {risk}, and we would {told}."
    there, waypoint = trace_of(WORLD), replace(trace_of(WORLD), waypoint=EgoGoal("mid", 10.0, None))
    assert "waypoint" in found(text, trace=waypoint)
    assert "waypoint" not in found(text, trace=there)


def test_a_plan_that_is_worse_needs_another_answer() -> None:
    worse = replace(trace_of(WORLD), plan=(PlannedAction("stop", -17.5, 10),))
    reason = "I am not staying in my lane, because that would mean a rougher ride."
    assert "sign" in found(reason, trace=worse, asked="continue")


def test_a_belief_is_that_of_the_time_told() -> None:
    """Told as held now, it may not be older than one decision and since have changed."""
    turning = dataclasses.replace(WORLD, aims={**WORLD.aims, 1: _aims(0.8, 0.2)})
    doubted = dataclasses.replace(WORLD, aims={**WORLD.aims, 1: _aims(0.4, 0.6)})
    old, between, latest = (
        trace_of(world, time=4.0 + k, decision=k)
        for k, world in enumerate((turning, turning, doubted))
    )
    ride = seen(old, between, latest)
    for tense, share, kind in (
        ("expect", 20, "stale belief"), ("expected", 20, None), ("expected", 60, "belief"),
    ):  # fmt: skip
        text = f"I {tense} vehicle 1 to turn right ({share} %)."
        decision = Decision(old, before=between, latest=latest)
        faults, _, _ = checked(ride, 6.0, "Why?", text, decision)
        kinds = {one.kind for one in faults if "belief" in one.kind}
        assert kinds == (set() if kind is None else {kind})


def _aims(going: float, turning: float) -> tuple[Aim, ...]:
    return (Aim("continue", going, (Way(("continue",)),)), Aim("exit-right", turning, (Way(()),)))


def test_what_comes_without_a_vehicle_was_planned_again() -> None:
    trace = trace_of(WORLD)
    same = replace(trace, what_if=WhatIf(removed=1))
    other = replace(same, plan=(PlannedAction("stop", -17.5, 10),))
    for without, kind in (
        ((), "not tried without"),
        ((same,), None),
        ((other,), "differs without"),
    ):
        decision = Decision(trace, without=without)
        faults, _, _ = checked(seen(trace), 4.0, "Why?", "Vehicle 1 made no difference.", decision)
        assert {one.kind for one in faults} == (set() if kind is None else {kind})


NONE = "No other vehicle makes the difference to that, not even all of them together."
SEVERAL = "Others play a part, too: without any one of them alone, it would come to the same"
ALL_NAMED = f"{SEVERAL}, and without all 3 of them, I would do the same, but with less reason."


@pytest.mark.parametrize(
    ("text", "removed", "plan", "kind"),
    [
        (NONE, (1, 2), "continue", None),
        (NONE, (1, 2), "stop", "differs without"),
        (NONE, (1,), "continue", "not tried without"),
        (SEVERAL + ".", (1, 2, 3), "stop", None),
        (SEVERAL + ".", (1, 2), "stop", "not tried without"),
        (ALL_NAMED, (1, 2, 3), "continue", None),
        (ALL_NAMED, (1, 2, 3), "stop", "differs without"),
        (ALL_NAMED, (1, 2), "continue", "not tried without"),
    ],
)
def test_what_hangs_on_several_was_planned_again_without_them(
    text: str, removed: tuple[int, ...], plan: Action, kind: str | None
) -> None:
    trace = trace_of(WORLD)
    scene = {name: state for name, state in trace.scene.items() if name not in removed}
    again = replace(
        trace, what_if=WhatIf(removed=removed), scene=scene, plan=(PlannedAction(plan, -17.5, 10),)
    )
    faults, sentences, _ = checked(
        seen(trace), 4.0, "Why?", text, Decision(trace, without=(again,))
    )
    assert [one.understood for one in sentences] == [True]
    assert {one.kind for one in faults} == (set() if kind is None else {kind})


def test_a_sentence_that_is_not_read_is_told() -> None:
    trace = trace_of(WORLD)
    _, sentences, _ = checked(seen(trace), 4.0, ASKED, "The moon made me do it, for 7 reasons.")
    assert [one.understood for one in sentences] == [False]
    _, sentences, _ = checked(seen(trace), 4.0, ASKED, TOLD + " We owe that to 7 reasons.")
    assert [one.understood for one in sentences] == [True, False]


def test_means_are_weighed_by_how_probable_a_situation_is() -> None:
    record = Reckoning(trace_of(WORLD))
    assert [side.chance("collision") for side in record.sides(("change-left",))] == [
        pytest.approx(0.2), pytest.approx(0.2), pytest.approx(0.5),  # the last by draws alone
    ]  # fmt: skip
    fact, foil = record.sides(("continue",))[0], record.sides(("change-left",))[0]
    assert foil.value - fact.value == pytest.approx(0.8 * -10.5 - 0.2 * 200.0 + 12.5)
    both = record.paired(fact, foil)
    assert both is not None
    assert both[1].mean("time") == pytest.approx(10.0)
