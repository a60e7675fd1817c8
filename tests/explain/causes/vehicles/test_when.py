"""Which of several things that happened is meant."""

from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.explain.causes.vehicles.when import meets, moment_of, pick

DONE = ((2.0, 4.0), (10.0, 12.0), (20.0, None))


def bounds(one: tuple[float, float | None]) -> tuple[float, float | None]:
    return one


def test_without_a_time_the_last_is_meant() -> None:
    assert pick(None, DONE, bounds) == (20.0, None)


def test_a_moment_is_taken_with_some_leeway() -> None:
    assert pick(Span(13.0, 13.0, said=True), DONE, bounds) == (10.0, 12.0)
    assert pick(Span(16.0, 16.0, said=True), DONE, bounds) is None


def test_an_inferred_time_takes_the_nearest() -> None:
    assert pick(Span(15.0, 16.0), DONE, bounds) == (10.0, 12.0)


def test_of_several_within_a_stretch_the_last_is_meant() -> None:
    assert pick(Span(0.0, 15.0, said=True), DONE, bounds) == (10.0, 12.0)


def test_what_begins_as_a_stretch_ends_is_meant_only_if_nothing_lies_within() -> None:
    wait = ((18.1, 26.1), (26.1, 26.4))
    assert pick(Span(18.1, 26.1, said=True), wait, bounds) == wait[0]
    assert pick(Span(18.1, 26.1, said=True), wait[1:], bounds) == wait[1]
    assert pick(Span(26.1, 30.0, said=True), wait, bounds) == wait[1]


def test_what_goes_on_meets_all_that_is_later() -> None:
    assert meets(Span(100.0, 101.0), 20.0, None)
    assert not meets(Span(0.0, 10.0), 20.0, None)


def test_an_inferred_stretch_up_to_now_stands_for_now() -> None:
    assert moment_of(Span(0.0, 39.5), 39.5) == 39.5
    assert moment_of(Span(0.0, 20.0), 39.5) == 10.0
    assert moment_of(Span(0.0, 39.5, said=True), 39.5) == 19.75
