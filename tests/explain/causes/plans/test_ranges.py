"""Calibrated ranges: kinds of cases, what stands for a kind, and where none is given."""

import math

import msgspec
import pytest

from planner.record.trace import PlanTrace, WhatIf
from tests.explain.causes.rides import recorded
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.evidence import TimeRange
from xavi_dialogue.explain.causes.plans.ranges import (
    LEAST,
    Error,
    Group,
    Ranges,
    Source,
    foil_kind,
    group_errors,
    likely,
    road_kind,
    table,
)

SOURCE = Source("", {}, 0, 0, 0)
KNOWN = Ranges(
    0.9,
    2.0,
    tuple(
        Group(foil, None, 30, 50 + k, 1.0 + k)
        for k, foil in enumerate(("stop", "exit", "manoeuvre"))
    ),
    SOURCE,
)


def case(name: str) -> tuple[CausalModel, Intervention, Intervention]:
    """A decision with the plan, and a foil that arrives and begins otherwise."""
    for trace in recorded(name).traces:
        model = CausalModel(trace)
        here = model.intervene((trace.plan[0].action,)) if trace.plan else None
        for action in model.options() if here is not None else ():
            there = model.intervene((action,))
            if here and there and there.plan[0] != here.plan[0] and there.likeliest == "done":
                return model, here, there
    raise AssertionError(f"{name} has no such decision")


MODEL, HERE, THERE = case("s1-0")
FOUND = effects(THERE, HERE)
DELTA = next(one.delta for one in FOUND if one.component == "time")


def errors(n: int, foil: str, road: str, shift: float = 0.0) -> list[Error]:
    return [Error(foil, road, f"{road}-{k}", shift + k / n) for k in range(n)]


def test_kinds_of_foils_are_told_apart() -> None:
    assert [foil_kind(a) for a in ("stop", "exit-left", "change-left", "continue")] == [
        *("stop", "exit", "manoeuvre", "manoeuvre")
    ]


def test_kinds_of_roads_follow_from_junctions_and_lanes() -> None:
    kinds = {road_kind(trace) for trace in recorded("s1-0").traces}
    assert "junction" in kinds
    assert road_kind(msgspec.structs.replace(MODEL.trace, road=None)) == "road"
    assert {road_kind(trace) for trace in recorded("motorway-0").traces} >= {"lanes"}


def test_each_kind_with_enough_cases_has_a_range_of_its_own() -> None:
    found = group_errors(
        [
            *errors(LEAST, "stop", "road"),
            *errors(LEAST, "stop", "lanes", 5.0),
            *errors(LEAST - 1, "stop", "junction", 20.0),
            *errors(LEAST - 1, "exit", "road"),
        ]
    )
    ranges = Ranges(0.9, 1.0, found, SOURCE)
    own, other = ranges.group("stop", "road"), ranges.group("stop", "lanes")
    assert own is not None
    assert other is not None
    assert own.reach < 1.0 < 5.0 < other.reach
    assert (own.rides, own.cases) == (LEAST, LEAST)
    pooled = ranges.group("stop", "junction")  # too few of its own: those of all roads
    assert pooled is not None
    assert pooled.road is None
    assert pooled.cases == 3 * LEAST - 1
    assert ranges.group("exit", "road") is None
    assert ranges.group("manoeuvre", "road") is None


def test_kinds_whose_foils_often_never_arrive_have_no_range() -> None:
    rest = [Error("stop", "road", f"never-{k}", math.inf) for k in range(LEAST)]
    assert group_errors([*errors(LEAST, "stop", "road"), *rest]) == ()


def test_a_range_lies_about_what_is_foreseen() -> None:
    found = likely(MODEL, HERE, THERE, FOUND, KNOWN)
    group = KNOWN.group(foil_kind(THERE.plan[0]), road_kind(MODEL.trace))
    assert group is not None
    expected = TimeRange(DELTA - group.reach, DELTA + group.reach, 0.9, group.cases)
    assert found == expected


def with_supposition(trace: PlanTrace) -> CausalModel:
    return CausalModel(msgspec.structs.replace(trace, what_if=WhatIf(removed=2)))


@pytest.mark.parametrize(
    "refused",
    [
        lambda: likely(MODEL, HERE, THERE, FOUND, msgspec.structs.replace(KNOWN, groups=())),
        lambda: likely(MODEL, THERE, THERE, FOUND, KNOWN),  # the same first action
        lambda: likely(MODEL, HERE, THERE, (), KNOWN),  # no difference in time is known
        lambda: likely(with_supposition(MODEL.trace), HERE, THERE, FOUND, KNOWN),
    ],
)
def test_no_range_is_given_where_the_calibration_does_not_reach(refused) -> None:
    assert refused() is None


def test_the_table_says_what_it_was_made_of() -> None:
    found = table()
    assert found.coverage == 0.9
    assert found.source.command.startswith("xavi bench fidelity --learn")
    assert found.source.cases >= sum(one.cases for one in found.groups if one.road is None)
    assert "random" not in found.source.worlds  # ranges are tested there
    for one in found.groups:
        assert one.reach >= 0.0
        assert one.cases >= one.rides >= LEAST
