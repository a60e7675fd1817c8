"""What hides whom: only those whom one thing hides are gone where one sees past it."""

import pytest
from msgspec.structs import replace

from planner.record.hidden_record import HeldByHidden, Phantom
from planner.record.trace import PlanTrace, WhatIf
from tests.explain.answers.given import NOW
from tests.explain.answers.imagined import Drive, decided
from tests.traces import End
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.hidden_areas import SupposedSeeing
from xavi_dialogue.domain.meaning import Ask
from xavi_dialogue.domain.meaning import WhatIf as Supposing
from xavi_dialogue.domain.terms import Ego, Exists, Feature, Not, Proposition, Related, Vehicle
from xavi_dialogue.explain.answers.engine import explain
from xavi_dialogue.explain.causes.driving.hidden_areas import hidden_causes
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

LORRY, BUS = 3, 5
BUILDING = Feature("building")


def hidden(
    behind: int | None = None, *, heading: float = 1.6, beyond: tuple[int, ...] = (),
    walled: bool = False,
) -> Phantom:  # fmt: skip
    """Somebody who may come from the right; with a heading of -1.6, from the left."""
    return Phantom(
        ("side_0",), 0.0, 30.0, (30.0, -20.0), heading, 10.0, 20.0, 30.0, 0.08, 0.3, "J", 1, (0,),
        (4.0,), behind, beyond, walled,
    )  # fmt: skip


def slowed(*phantoms: Phantom, takes: float = 20.0, tried: tuple[int, ...] = ()) -> PlanTrace:
    """A decision to go on, slower for all that is hidden; or made again without some of it."""
    trace = decided(("continue",), Drive(1.0, end=End(time=takes)))
    held = tuple(HeldByHidden(k, False, NOW, NOW + 3.0) for k in range(len(phantoms)))
    drives = tuple(replace(one, held_by_hidden=held) for one in trace.rollouts)
    return replace(
        trace,
        phantoms=phantoms,
        rollouts=drives,
        what_if=WhatIf(seen_past=tried) if tried else None,
    )


FROM_BOTH = (hidden(LORRY), hidden(heading=-1.6))  # behind a lorry, and behind a building


@pytest.mark.parametrize(
    ("vehicles", "phantom", "seen"),
    [
        ((LORRY,), hidden(LORRY), True),
        ((BUS,), hidden(LORRY), False),
        ((LORRY,), hidden(), False),
        ((LORRY,), hidden(LORRY, walled=True), False),
        ((LORRY,), hidden(LORRY, beyond=(BUS,)), False),
        ((LORRY, BUS), hidden(LORRY, beyond=(BUS,)), True),
    ],
)
def test_one_is_seen_where_nothing_else_hides_it(
    vehicles: tuple[int, ...], phantom: Phantom, seen: bool
) -> None:
    assert phantom.seen_without(vehicles) is seen


def supposed(what: Proposition, *extra: PlanTrace, phantoms: tuple[Phantom, ...]) -> object:
    record = Record(NOW, (slowed(*phantoms),), extra=extra)
    return explain(GroundedAct(Ask(Supposing(what))), record)


def past(what: object) -> Related:
    return Related("sees-past", Ego(), what, tense="past")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("what", "gone"),
    [
        (past(Vehicle(LORRY)), (0,)),
        (past(BUILDING), (1,)),
        (Not(Exists(BUILDING, tense="past")), (1,)),
        (past(Feature("blind")), (0, 1)),
    ],
)
def test_past_one_thing_those_that_another_hides_stay(
    what: Proposition, gone: tuple[int, ...]
) -> None:
    need = supposed(what, phantoms=FROM_BOTH)
    assert isinstance(need, NeedRollout)
    assert need.seen_past == gone


def test_what_is_named_is_what_was_seen_past() -> None:
    again = slowed(*FROM_BOTH, takes=17.0, tried=(0,))
    told = supposed(past(Vehicle(LORRY)), again, phantoms=FROM_BOTH)
    assert isinstance(told, SupposedSeeing)
    assert [(one.vehicle, one.side) for one in told.hiders] == [(LORRY, "right")]
    assert told.saved == pytest.approx(3.0)


def test_seeing_past_a_lorry_before_a_building_changes_nothing() -> None:
    told = supposed(past(Vehicle(LORRY)), phantoms=(hidden(LORRY, walled=True),))
    assert isinstance(told, SupposedSeeing)
    assert [one.vehicle for one in told.hiders] == [LORRY]
    assert told.saved == 0.0


def causes(*extra: PlanTrace) -> list[tuple[int | None, bool | None]] | None:
    ride = Ride(Record(NOW, (slowed(*FROM_BOTH),), extra=extra))
    found = hidden_causes(ride, Episode(Ego(), "slow-down", NOW, NOW))
    return found and [(one.vehicle, one.necessary) for one in found[0]]


def test_the_reason_is_what_makes_the_difference() -> None:
    lorry = slowed(*FROM_BOTH, tried=(0,))
    building = slowed(*FROM_BOTH, takes=17.0, tried=(1,))
    assert causes(lorry, building) == [(None, True)]
    assert causes(slowed(*FROM_BOTH, takes=17.0, tried=(0,))) == [(LORRY, True)]


def test_both_are_told_where_only_both_make_a_difference() -> None:
    apart = (slowed(*FROM_BOTH, tried=(0,)), slowed(*FROM_BOTH, tried=(1,)))
    assert causes(*apart, slowed(*FROM_BOTH, takes=17.0, tried=(0, 1))) == [
        (LORRY, False),
        (None, False),
    ]
    assert causes(*apart, slowed(*FROM_BOTH, tried=(0, 1))) is None
