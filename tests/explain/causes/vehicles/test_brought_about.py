"""Who matters by what it makes another do, or by what it keeps us from doing."""

from collections.abc import Mapping, Sequence

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace
from planner.record.trace import PlanTrace, TimedAction, WhatIf
from tests.explain.causes.decisions import decided, in_the_way, ride, steady
from tests.traces import Actions, Aim, End, Way
from xavi_dialogue.explain.causes.vehicles.involved import holding_up
from xavi_dialogue.explain.causes.vehicles.mediated import holders
from xavi_dialogue.explain.causes.vehicles.necessity import Proven, proven

ON = Aim("continue", 1.0, (Way(("continue",)),))


def waiting(time: float, *shares: tuple[int, float], **fields: object) -> PlanTrace:
    """A decision that expects the first vehicle to be held up by others, each so probably."""
    aims = [
        Aim(
            "continue", p, (Way(("continue",), held_up=(in_the_way(v, time, time + 2.0),)),), str(v)
        )
        for v, p in shares
    ]
    rest = 1.0 - sum(p for _, p in shares)
    known = {1: (*aims, Aim("continue", rest, (Way(("continue",)),))), 2: (ON,)}
    return decided({"continue": End()}, known, [("continue",)], time=time, **fields)  # type: ignore[arg-type]


def since(*traces: PlanTrace) -> dict[int, float]:
    """Who has held the first vehicle up before the last decision, and since when [s]."""
    found = holders(ride(*traces), traces[-1], 1)
    return {vehicle: trace.sim_time for vehicle, trace in found.items()}


@pytest.mark.parametrize(
    ("known", "found"),
    [
        ({t: [(2, 0.9)] for t in range(4, 13)}, {2: 4.0}),
        ({t: [(2, 0.9)] for t in range(4, 14)}, {2: 5.0}),  # eight seconds back and no more
        ({4: [(2, 0.9)], 5: [(2, 0.9)], 6: [], 7: []}, {2: 4.0}),
        ({4: [(2, 0.9)], 5: [(2, 0.9)], 6: [], 7: [], 8: []}, {}),  # it is over long since
        ({4: [(2, 0.9)], 5: [], 6: [(2, 0.9)], 7: [(2, 0.9)]}, {2: 4.0}),
        ({4: [(2, 0.9)], 5: [], 6: [(2, 0.9)]}, {}),  # now and then
        ({4: [(2, 0.25)]}, {2: 4.0}),
        ({4: [(2, 0.24)]}, {}),
        ({4: [(2, 0.3), (3, 0.3)], 5: [(3, 0.3)]}, {3: 4.0, 2: 4.0}),
        ({4: [(2, 0.3), (3, 0.3), (4, 0.3)]}, {2: 4.0, 3: 4.0}),  # two are tried
    ],
)
def test_who_makes_another_one_wait(
    known: Mapping[int, Sequence[tuple[int, float]]], found: dict[int, float]
) -> None:
    told = since(*(waiting(float(t), *shares) for t, shares in known.items()))
    assert told == found
    assert list(told) == list(found)


def test_while_something_must_be_finished_nothing_is_foreseen() -> None:
    busy = waiting(4.0, (2, 0.9), under_way=TimedAction("change-left", 3.0))
    assert since(busy, waiting(5.0)) == {}
    assert holders(ride(waiting(4.0, (2, 0.9))), waiting(4.0, (2, 0.9)), 7) == {}


def pulling(time: float, lanes: Mapping[int, int], chance: float = 0.5, who: int = 1) -> PlanTrace:
    """A decision that expects a vehicle to leave its lane; others are 20 m apart by number."""
    aims: dict[int, tuple[Aim, ...]] = {v: (ON,) for v in lanes if v not in (0, who)}
    aims[who] = (
        Aim("continue", chance, (Way(("change-left", "continue")),)),
        Aim("stop", 1.0 - chance, (Way(("continue",)),)),
    )
    places = {v: RoadPlace("a", lane, 2, 14.0, False, False) for v, lane in lanes.items()}
    return decided({"continue": End()}, aims, [("continue",)], time=time, road=RoadFacts(places))


@pytest.mark.parametrize(
    ("lanes", "chance", "who", "found"),
    [
        ({1: 0, 2: 0}, 0.5, 1, {2: 4.0}),
        ({1: 0, 2: 1}, 0.5, 1, {}),
        ({1: 0, 2: 0}, 0.25, 1, {2: 4.0}),
        ({1: 0, 2: 0}, 0.24, 1, {}),
        ({3: 0, 2: 0}, 0.5, 3, {}),  # it is behind
        ({1: 0, 4: 0}, 0.5, 1, {4: 4.0}),  # 62 m ahead
        ({1: 0, 5: 0}, 0.5, 1, {}),  # 82 m
        ({1: 0, 2: 0, 4: 0}, 0.5, 1, {2: 4.0}),
        ({0: 0, 1: 0, 4: 0}, 0.5, 1, {4: 4.0}),
    ],
)
def test_whom_another_one_has_pulled_out_for(
    lanes: dict[int, int], chance: float, who: int, found: dict[int, float]
) -> None:
    before, after = pulling(4.0, lanes, chance, who), pulling(5.0, {**lanes, who: 1}, 0.0, who)
    told = holders(ride(before, after), after, who)
    assert {v: t.sim_time for v, t in told.items()} == found
    stays = pulling(5.0, lanes, 0.0, who)
    assert holders(ride(before, stays), stays, who) == {}
    long_ago = pulling(17.0, {**lanes, who: 1}, 0.0, who)
    assert holders(ride(before, long_ago), long_ago, who) == {}


def test_whom_another_one_is_about_to_pull_out_for() -> None:
    lanes = {1: 0, 2: 0}
    before, now = pulling(4.0, lanes, 0.9), pulling(5.0, lanes, 0.9)
    told = holders(ride(before, now), now, 1)
    assert {v: t.sim_time for v, t in told.items()} == {2: 4.0}


# Planning again ----------------------------------------------------------------------------


def slowed(
    speed: float,
    *vehicles: int,
    by: Sequence[int] = (),
    hit: int | None = None,
    behind: int | None = None,
    at: float = 4.0,
    seconds: float = 20.0,
    leaving: float = 0.0,
    lanes: Mapping[int, int] | None = None,
) -> PlanTrace:
    """Going on at such a speed in the end, with who is in the way; to the left one is hit.

    The first vehicle may be held up itself, by the one `behind` it all, and may be expected to
    leave its lane with a probability `leaving`.
    """
    wait = () if behind is None else (in_the_way(behind, at, at + 2.0),)
    aims = {
        v: (Aim("continue", 1.0, (Way(("continue",), held_up=wait if v == 1 else ()),)),)
        for v in vehicles
    }
    if leaving:
        away = Aim("continue", leaving, (Way(("change-left", "continue")),))
        aims[1] = (away, Aim("stop", 1.0 - leaving, (Way(("continue",)),)))
    places = {v: RoadPlace("a", n, 2, 14.0, False, False) for v, n in (lanes or {}).items()}
    plans: list[Actions] = [("continue",)] if hit is None else [("continue",), ("change-left",)]
    ends = {
        "continue": End(
            time=seconds, jerk=0.0, held_up=tuple(in_the_way(v, at, at + 5.0) for v in by)
        ),
        "change-left": End("collision", collided_with=hit),
    }
    line = steady(*[10.0] * 5, *[speed] * 60)
    road = RoadFacts(places) if places else None
    return decided(ends, aims, plans, lines={"continue": line}, time=at, road=road)


def again(trace: PlanTrace, *gone: int) -> PlanTrace:
    return replace(trace, what_if=WhatIf(removed=gone[0] if len(gone) == 1 else gone))


def judged(traces: Sequence[PlanTrace], *extra: PlanTrace) -> Proven:
    whole = ride(*traces, extra=extra)
    model = whole.model(traces[-1])
    plan = model.intervene(("continue",))
    assert plan is not None
    return proven(whole, model, holding_up(model, plan), plan)


@pytest.mark.parametrize(("then", "kind"), [(10.0, "both"), (5.0, "one")])
def test_who_keeps_us_in_the_lane_may_matter_too(then: float, kind: str) -> None:
    """The first drives ahead of us; the second would be hit on moving left."""
    trace = slowed(5.0, 1, 2, by=(1,), hit=2)
    found = judged(
        [trace],
        again(slowed(10.0, 2, hit=2), 1),
        again(slowed(then, 1, by=() if then == 10.0 else (1,)), 2),
        again(slowed(10.0), 1, 2),
    )
    assert found.causation is not None
    assert found.causation.kind == kind
    told = [(c.vehicle, c.mechanism and c.mechanism.how) for c in found.causes]
    assert told == [(1, "leader"), (2, "collision")][: 2 if kind == "both" else 1]


def test_who_is_held_up_itself_is_of_no_matter() -> None:
    """Without the first the second is in our way; without the second nobody is."""
    found = judged(
        [slowed(5.0, 1, 2, by=(1,))],
        again(slowed(5.0, 2, by=(2,)), 1),
        again(slowed(10.0, 1), 2),
        again(slowed(10.0), 1, 2),
    )
    assert found.causation is not None
    assert (found.causation.kind, found.causation.vehicles) == ("one", (2,))
    (cause,) = found.causes
    assert (cause.vehicle, cause.mechanism and cause.mechanism.how) == (2, "leader")


@pytest.mark.parametrize(
    ("then", "alone", "kind"),
    [(10.0, 10.0, "both"), (16.0, 10.0, "one"), (15.0, 10.0, "both"), (19.6, 19.6, "one")],
)
def test_who_made_another_one_wait_matters_too(then: float, alone: float, kind: str) -> None:
    """Of 20 s at the decision before, half of what others cost must go without it."""
    first, decision = (slowed(5.0, 1, 2, by=(1,), behind=2, at=t) for t in (3.0, 4.0))
    found = judged(
        [first, decision],
        again(slowed(10.0, 2), 1),
        again(slowed(5.0, 1, by=(1,), at=3.0, seconds=then), 2),
        again(slowed(10.0, at=3.0, seconds=alone), 1, 2),
    )
    assert found.causation is not None
    assert found.causation.kind == kind
    assert found.causation.vehicles == ((1, 2) if kind == "both" else (1,))
    assert [c.vehicle for c in found.causes] == [1]  # the other is not in our own way


@pytest.mark.parametrize(
    ("chance", "then", "kind"), [(0.9, 0.0, "both"), (0.9, 0.6, "one"), (0.4, 0.0, "one")]
)
def test_for_whom_one_ahead_has_pulled_out_matters_too(
    chance: float, then: float, kind: str
) -> None:
    """It cost little when it was foreseen; without it the one ahead would have kept its lane."""
    before, now = {1: 0, 2: 0}, {1: 1, 2: 0}
    found = judged(
        [
            slowed(5.0, 1, 2, at=3.0, leaving=chance, lanes=before),
            slowed(5.0, 1, 2, by=(1,), lanes=now),
        ],
        again(slowed(10.0, 2), 1),
        again(slowed(5.0, 1, at=3.0, leaving=then, lanes={1: 0}), 2),
        again(slowed(10.0, at=3.0), 1, 2),
    )
    assert found.causation is not None
    assert found.causation.kind == kind
    assert found.causation.vehicles == ((1, 2) if kind == "both" else (1,))
