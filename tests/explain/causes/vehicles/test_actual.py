"""Sets of vehicles that a deed hangs on: together, either of two, pre-empted, none."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from xavi_dialogue.explain.causes.vehicles.actual import (
    PAIRS,
    SINGLES,
    TRIALS,
    Trial,
    Try,
    actual_causes,
)


def trying(
    gone: Callable[[frozenset[int]], bool | None],
    instead: dict[tuple[int, ...], tuple[int, ...]] | None = None,
) -> tuple[Try, list[tuple[int, ...]]]:
    """A trial by a rule, and the sets that were tried."""
    tried: list[tuple[int, ...]] = []

    def trial(vehicles: tuple[int, ...]) -> Trial:
        tried.append(vehicles)
        return Trial(gone(frozenset(vehicles)), (instead or {}).get(vehicles, ()))

    return trial, tried


def test_one_without_whom_it_is_gone_is_the_cause() -> None:
    trial, tried = trying(lambda without: 1 in without)
    found = actual_causes((1,), (), trial)
    assert (found.kind, found.vehicles, found.cleared) == ("one", (1,), ())
    assert tried == [(1,)]


def test_who_makes_no_difference_beside_the_cause_is_cleared() -> None:
    trial, _ = trying(lambda without: 2 in without)
    found = actual_causes((1, 2), (), trial)
    assert (found.kind, found.vehicles, found.cleared) == ("one", (2,), (1,))


def test_two_of_whom_each_had_to_be_there_are_causes_together() -> None:
    trial, _ = trying(lambda without: bool(without & {1, 2}))
    assert actual_causes((1, 2), (), trial).kind == "both"
    found = actual_causes((1,), (2, 3), trial)  # the second is not at work by itself
    assert (found.kind, found.vehicles, found.cleared) == ("both", (1, 2), (3,))


def test_reserve_is_tried_only_beside_a_cause() -> None:
    trial, tried = trying(lambda without: False)
    found = actual_causes((1,), (2,), trial)
    assert (found.kind, tried) == ("none", [(1,)])


def test_either_of_two_at_work_would_have_been_enough() -> None:
    trial, _ = trying(lambda without: without >= {1, 2}, {(1,): (2,), (2,): (1,)})
    found = actual_causes((1, 2), (), trial)
    assert (found.kind, found.vehicles, found.cleared) == ("either", (1, 2), ())


def test_one_at_work_only_where_another_is_not_is_pre_empted_by_it() -> None:
    trial, _ = trying(lambda without: without >= {1, 2}, {(1,): (2,)})
    found = actual_causes((1,), (), trial)
    assert (found.kind, found.vehicles) == ("pre-empted", (1, 2))


def test_who_holds_up_the_one_at_work_is_the_cause_and_not_the_pair() -> None:
    trial, tried = trying(lambda without: 2 in without, {(1,): (2,)})
    found = actual_causes((1,), (), trial)
    assert (found.kind, found.vehicles, found.cleared) == ("one", (2,), (1,))
    assert (1, 2) not in tried


def test_where_nothing_helps_nobody_is_the_cause() -> None:
    trial, _ = trying(lambda without: False, {(1,): (3,), (2,): (3,)})
    found = actual_causes((1, 2), (), trial)
    assert (found.kind, found.vehicles) == ("none", ())
    assert set(found.cleared) >= {1, 2}


def test_where_no_two_are_enough_all_of_them_may_be_together() -> None:
    trial, tried = trying(lambda without: without >= {1, 2, 3})
    found = actual_causes((1, 2, 3), (), trial, everybody=(3, 2, 1))
    assert (found.kind, found.vehicles, found.cleared) == ("several", (1, 2, 3), ())
    assert (1, 2, 3) in tried


def test_those_at_work_are_named_where_they_are_enough_else_all_that_are_there() -> None:
    trial, _ = trying(lambda without: without >= {1, 2, 3})
    found = actual_causes((3, 1, 2), (), trial, everybody=(1, 2, 3, 4, 5))
    assert (found.kind, found.vehicles) == ("several", (1, 2, 3))
    trial, _ = trying(lambda without: without >= {1, 2, 3, 4})
    found = actual_causes((3, 1, 2), (), trial, everybody=(1, 2, 3, 4, 5))
    assert (found.kind, found.minimal, found.jointly) == ("several", False, ())
    found = actual_causes((1,), (), trial, everybody=(1, 2, 3, 4, 5))
    assert (found.kind, found.vehicles, found.cleared) == ("several", (1, 2, 3, 4), ())


def test_those_that_take_the_place_of_one_another_are_told_and_no_bystander() -> None:
    instead = {(1,): (5,), (5,): (1,), (1, 5): (8,)}
    trial, tried = trying(lambda without: without >= {1, 5, 8}, instead)
    found = actual_causes((1,), (), trial, everybody=tuple(range(1, 10)))
    assert (found.kind, found.vehicles, found.minimal) == ("several", (1, 5, 8), True)
    assert len(tried) <= TRIALS


def test_where_the_trials_end_before_the_set_is_the_smallest_nobody_is_named() -> None:
    trial, tried = trying(lambda without: without >= {2, 9, 15, 20})
    found = actual_causes((1,), (), trial, everybody=tuple(range(1, 21)))
    assert (found.kind, found.minimal, found.jointly) == ("several", False, ())
    assert len(tried) <= TRIALS


def test_one_or_two_of_all_others_are_told_as_such() -> None:
    trial, _ = trying(lambda without: 3 in without)
    found = actual_causes((1,), (), trial, everybody=(1, 2, 3, 4))
    assert (found.kind, found.vehicles) == ("one", (3,))
    trial, _ = trying(lambda without: without >= {1, 3})
    found = actual_causes((1,), (), trial, everybody=(1, 2, 3))
    assert (found.kind, found.vehicles) == ("pre-empted", (1, 3))


def test_where_it_is_so_without_all_others_too_it_was_none_of_them() -> None:
    trial, tried = trying(lambda without: False)
    found = actual_causes((1,), (), trial, everybody=(1, 2, 3))
    assert (found.kind, found.vehicles, found.cleared) == ("none", (), (1,))
    assert tried == [(1,), (1, 2, 3)]
    trial, _ = trying(lambda without: None if len(without) == 3 else False)
    assert actual_causes((1,), (), trial, everybody=(1, 2, 3)).kind == "open"


def test_where_there_are_but_two_all_of_them_are_a_pair() -> None:
    trial, _ = trying(lambda without: without >= {1, 2})
    found = actual_causes((1,), (), trial, everybody=(1, 2))
    assert (found.kind, found.vehicles) == ("pre-empted", (1, 2))
    trial, _ = trying(lambda without: 2 in without)
    found = actual_causes((1,), (), trial, everybody=(1, 2))
    assert (found.kind, found.vehicles, found.cleared) == ("one", (2,), (1,))


def test_what_could_not_be_planned_stays_open() -> None:
    trial, _ = trying(lambda without: None if 1 in without else False)
    found = actual_causes((1, 2), (), trial)
    assert (found.kind, found.cleared) == ("open", (2,))


@given(st.sets(st.frozensets(st.integers(1, 5), min_size=1, max_size=2), max_size=4), st.data())
def test_what_is_named_is_a_smallest_set_and_trials_are_few(
    causes: set[frozenset[int]], data: st.DataObject
) -> None:
    """A deed that is gone without any of some sets."""

    def gone(without: frozenset[int]) -> bool:
        return any(one <= without for one in causes)

    names = data.draw(st.permutations(range(1, 6)))
    count = data.draw(st.integers(1, 5))
    trial, tried = trying(gone)
    found = actual_causes(names[:count], names[count:], trial, everybody=names)
    assert len(tried) == len(set(tried)) <= SINGLES + 2 * PAIRS + 2
    assert not set(found.vehicles) & set(found.cleared)
    assert not any(gone(frozenset((one,))) for one in found.cleared)
    if found.kind in ("one", "both"):
        assert all(gone(frozenset((one,))) for one in found.vehicles)
    elif found.kind in ("either", "pre-empted"):
        assert gone(frozenset(found.vehicles))
        assert not any(gone(frozenset((one,))) for one in found.vehicles)
    elif found.kind == "several":
        assert gone(frozenset(found.vehicles))
        assert not any(gone(frozenset((one,))) for one in names[: min(count, SINGLES)])
        parts = (set(found.vehicles) - {one} for one in found.vehicles)
        assert not found.minimal or not any(gone(frozenset(part)) for part in parts)
    else:
        assert found.vehicles == ()
        assert not gone(frozenset(names))


@pytest.mark.parametrize("order", [(1, 2), (2, 1)])
def test_the_first_suspect_is_tried_first(order: tuple[int, int]) -> None:
    trial, tried = trying(lambda without: bool(without))
    actual_causes(order, (), trial)
    assert tried[0] == (order[0],)


def test_who_makes_a_necessary_one_do_so_is_a_cause_with_it() -> None:
    trial, tried = trying(lambda without: 1 in without)
    found = actual_causes((1,), (), trial, {1: (4,)}.__getitem__)
    assert (found.kind, found.vehicles) == ("both", (1, 4))
    assert tried == [(1,)]
    again = actual_causes((1,), (), trial, lambda _: (1,))  # nobody is behind himself
    assert (again.kind, again.vehicles) == ("one", (1,))


def test_who_stands_behind_one_that_makes_no_difference_is_not_looked_for() -> None:
    trial, _ = trying(lambda without: False)
    asked: list[int] = []

    def behind(one: int) -> tuple[int, ...]:
        asked.append(one)
        return (4,)

    found = actual_causes((1,), (), trial, behind)
    assert (found.kind, asked) == ("none", [])
