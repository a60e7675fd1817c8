"""Planning again without vehicles: which of them a choice or a way of driving hangs on."""

from collections.abc import Mapping, Sequence
from dataclasses import replace as changed

import pytest
from msgspec.structs import replace

from planner.record.trace import HeldUp, PlanTrace, WhatIf
from tests.explain.causes.decisions import Line, decided, in_the_way, ride, steady
from tests.traces import Actions, Aim, End, Way
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.vehicles.involved import against, holding_up, slowing
from xavi_dialogue.explain.causes.vehicles.necessity import Proven, proven
from xavi_dialogue.explain.history.ride import Unanswered

TWO: tuple[Actions, ...] = (("continue",), ("change-left",))


def others(*vehicles: int) -> Mapping[int, tuple[Aim, ...]]:
    return {v: (Aim("continue", 1.0, (Way(("continue",)),)),) for v in vehicles}


def needed(work: object) -> object:
    with pytest.raises(Unanswered) as refused:
        work()  # type: ignore[operator]
    return refused.value.result


def choice(
    going: float, left: float, *vehicles: int, plan: Actions = ("continue",), by: Sequence[int] = ()
) -> PlanTrace:
    """Seconds that going on and moving left take, with who is in the way on the left."""
    held = tuple(in_the_way(v, 4.0, 9.0) for v in by)
    ends = {
        "continue": End(time=going, jerk=0.0),
        "change-left": End(time=left, jerk=0.0, held_up=held),
    }
    return decided(ends, others(*vehicles), TWO, plan=plan)


def again(trace: PlanTrace, *gone: int) -> PlanTrace:
    return replace(trace, what_if=WhatIf(removed=gone[0] if len(gone) == 1 else gone))


def judged(trace: PlanTrace, *extra: PlanTrace, refused: Sequence[NeedRollout] = ()) -> Proven:
    """The causes that matter of those who hold us up where we move left."""
    whole = ride(trace, extra=extra, refused=tuple(refused))
    model = whole.model(trace)
    here, there = model.intervene(("continue",)), model.intervene(("change-left",))
    assert here is not None
    assert there is not None
    suspects = [against(model, vehicle) for vehicle in slowing(model, there, here)]
    return proven(whole, model, suspects, here, there)


@pytest.mark.parametrize(
    ("left", "then", "plan", "matters", "decides"),
    [
        (14.0, 11.9, ("continue",), True, False),  # more than half of four seconds goes with it
        (14.0, 12.1, ("continue",), False, None),
        (10.6, 10.05, ("continue",), True, False),
        (10.6, 10.15, ("continue",), False, None),  # less than half a second does
        (14.0, 13.9, ("change-left",), True, True),  # it would be chosen
    ],
)
def test_a_choice_hangs_on_who_makes_it_better(
    left: float, then: float, plan: Actions, matters: bool, decides: bool | None
) -> None:
    trace = choice(10.0, left, 1, by=(1,))
    found = judged(trace, again(choice(10.0, then, plan=plan), 1))
    assert [(c.vehicle, c.necessary, c.decision_changes) for c in found.causes] == (
        [(1, True, decides)] if matters else []
    )
    assert found.causation is not None
    assert found.causation.kind == ("one" if matters else "none")
    assert found.cleared == (() if matters else (1,))
    assert found.causation.decides is (decides is not False)


def test_rollouts_are_asked_for_first() -> None:
    trace = choice(10.0, 14.0, 1, by=(1,))
    need = needed(lambda: judged(trace))
    assert need == NeedRollout(trace_id=trace.trace_id, removed=1)
    found = judged(trace, refused=(need,))
    assert [(c.vehicle, c.necessary) for c in found.causes] == [(1, None)]
    assert found.causation is not None
    assert found.causation.kind == "open"
    bare = replace(again(choice(10.0, 14.0), 1), rollouts=())
    assert judged(trace, bare).causation == found.causation
    assert judged(choice(10.0, 14.0, 1)) == Proven()


def test_either_of_two_may_be_enough() -> None:
    """Without one the other holds us up as long; without both nobody does."""
    trace = choice(10.0, 14.0, 1, 2, by=(1, 2))
    found = judged(
        trace,
        again(choice(10.0, 14.0, 2, by=(2,)), 1),
        again(choice(10.0, 14.0, 1, by=(1,)), 2),
        again(choice(10.0, 10.0), 1, 2),
    )
    assert found.causation is not None
    assert (found.causation.kind, found.causation.vehicles) == ("either", (1, 2))
    assert [(c.vehicle, c.necessary) for c in found.causes] == [(1, False), (2, False)]


def test_one_may_take_the_place_of_another() -> None:
    """The second is at work only where the first is not there."""
    trace = choice(10.0, 14.0, 1, 2, by=(1,))
    found = judged(
        trace,
        again(choice(10.0, 14.0, 2, by=(2,)), 1),
        again(choice(10.0, 14.0, 1, by=(1,)), 2),
        again(choice(10.0, 10.0), 1, 2),
    )
    assert found.causation is not None
    assert (found.causation.kind, found.causation.vehicles) == ("pre-empted", (1, 2))
    assert [c.vehicle for c in found.causes] == [1]
    whole = judged(
        trace,
        again(choice(10.0, 14.0, 2, by=(2,)), 1),
        again(choice(10.0, 14.0, 1, by=(1,)), 2),
        again(choice(10.0, 14.0), 1, 2),
    )
    assert whole.causation is not None
    assert (whole.causation.kind, whole.replaced) == ("none", (1, 2))


def test_two_may_be_causes_together() -> None:
    trace = choice(10.0, 14.0, 1, 2, by=(1, 2))
    found = judged(
        trace,
        again(choice(10.0, 11.0, 2, by=(2,)), 1),
        again(choice(10.0, 11.0, 1, by=(1,)), 2),
    )
    assert found.causation is not None
    assert (found.causation.kind, found.causation.vehicles) == ("both", (1, 2))
    assert [(c.vehicle, c.necessary) for c in found.causes] == [(1, True), (2, True)]


@pytest.mark.parametrize(
    ("then", "plan", "kind", "decides"),
    [
        (10.0, ("continue",), "several", False),
        (10.0, ("change-left",), "several", True),
        (14.0, ("continue",), "none", True),
    ],
)
def test_three_may_do_together_what_no_two_do(
    then: float, plan: Actions, kind: str, decides: bool
) -> None:
    """Without one or two of them the third holds us up as long; without all nobody does."""
    trace = choice(10.0, 14.0, 1, 2, 3, by=(1, 2, 3))
    some = [
        again(choice(10.0, 14.0, *(rest := sorted({1, 2, 3} - set(gone))), by=rest), *gone)
        for gone in ((1,), (2,), (3,), (1, 2), (1, 3), (2, 3))
    ]
    found = judged(trace, *some, again(choice(10.0, then, plan=plan), 1, 2, 3))
    assert found.causation is not None
    assert (found.causation.kind, found.causation.decides) == (kind, decides)
    if kind == "several":
        assert (found.causation.vehicles, found.cleared) == ((1, 2, 3), ())
        assert [(c.vehicle, c.necessary) for c in found.causes] == [
            (1, False), (2, False), (3, False),
        ]  # fmt: skip
    else:
        assert (found.causes, found.cleared) == ((), (1, 2, 3))


def driving(
    speed: float,
    *vehicles: int,
    by: Sequence[int] = (),
    own: float = 10.0,
    time: float = 10.0,
) -> PlanTrace:
    """Going on is driven at such a speed at last, with who is in the way."""
    held: tuple[HeldUp, ...] = tuple(in_the_way(v, 4.0, 9.0) for v in by)
    line: Line = steady(*[10.0] * 5, *[speed] * 60)
    trace = decided(
        {"continue": End(time=time, jerk=0.0, held_up=held)},
        others(*vehicles),
        [("continue",)],
        lines={"continue": line},
    )
    return replace(trace, scene={**trace.scene, 0: changed(trace.scene[0], speed=own)})


def drove(trace: PlanTrace, *extra: PlanTrace) -> Proven:
    whole = ride(trace, extra=extra)
    model = whole.model(trace)
    plan = model.intervene(("continue",))
    assert plan is not None
    return proven(whole, model, holding_up(model, plan), plan)


@pytest.mark.parametrize(
    ("speed", "free", "matters"),
    [
        (5.0, 10.0, True),
        (8.9, 10.0, True),
        (9.1, 10.0, False),  # less than 1 m/s is lost to it
        (5.0, 6.5, True),
        (5.0, 5.9, False),
    ],
)
def test_a_way_of_driving_hangs_on_who_costs_speed(
    speed: float, free: float, matters: bool
) -> None:
    found = drove(driving(speed, 1, by=(1,)), again(driving(free), 1))
    assert [c.vehicle for c in found.causes] == ([1] if matters else [])
    assert found.causation is not None
    assert found.causation.decides


@pytest.mark.parametrize(
    ("then", "alone", "kind"),
    [(5.0, 10.0, "none"), (7.4, 10.0, "none"), (7.6, 10.0, "one"), (5.0, 5.5, "none")],
)
def test_most_of_what_is_lost_must_go_with_it(then: float, alone: float, kind: str) -> None:
    """Without the first, the second holds us up; with nobody there the road is free."""
    trace = driving(5.0, 1, 2, by=(1,))
    found = drove(
        trace,
        again(driving(then, 2, by=(2,)), 1),
        again(driving(5.0, 1, by=(1,)), 2),
        again(driving(alone), 1, 2),
    )
    assert found.causation is not None
    assert found.causation.kind == (kind if alone < 10.0 or kind == "one" else "pre-empted")


@pytest.mark.parametrize(
    ("time", "then", "matters"), [(20.0, 19.0, True), (20.0, 19.6, False), (20.0, 10.0, True)]
)
def test_who_creeps_loses_time(time: float, then: float, matters: bool) -> None:
    trace = driving(0.0, 1, by=(1,), own=0.9, time=time)
    found = drove(trace, again(driving(0.0, own=0.9, time=then), 1))
    assert [c.vehicle for c in found.causes] == ([1] if matters else [])


def test_creeping_most_of_the_time_must_go_with_it() -> None:
    for then, kind in ((14.9, "one"), (15.1, "pre-empted")):
        found = drove(
            driving(0.0, 1, 2, by=(1,), own=0.5, time=20.0),
            again(driving(0.0, 2, by=(2,), own=0.5, time=then), 1),
            again(driving(0.0, 1, by=(1,), own=0.5, time=20.0), 2),
            again(driving(0.0, own=0.5, time=10.0), 1, 2),
        )
        assert found.causation is not None
        assert found.causation.kind == kind
