"""Which part of a ride a span points at, and which of several things it means."""

import pytest

from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.explain.causes.vehicles.when import meets, moment_of, past, pick

Thing = tuple[float, float | None]


def said(begin: float, end: float) -> Span:
    return Span(begin, end, said=True)


@pytest.mark.parametrize(
    ("span", "moment"),
    [
        (None, 20.0),
        (Span(30.0, 40.0, ahead=True), 20.0),
        (Span(10.0, 20.0), 20.0),  # inferred, and up to now
        (Span(10.0, 19.0), 14.5),
        (said(10.0, 20.0), 15.0),
        (said(10.0, 10.0), 10.0),
    ],
)
def test_the_instant_that_a_span_stands_for(span: Span | None, moment: float) -> None:
    assert moment_of(span, 20.0) == moment


def test_what_is_to_come_is_no_past() -> None:
    assert past(Span(1.0, 2.0)) == Span(1.0, 2.0)
    assert past(Span(1.0, 2.0, ahead=True)) is None
    assert past(None) is None


@pytest.mark.parametrize(
    ("span", "begin", "end", "met"),
    [
        (None, 50.0, 60.0, True),
        (Span(1.0, 2.0, ahead=True), 50.0, 60.0, True),
        (said(10.0, 10.0), 11.5, 12.0, True),  # a moment is misjudged by 1.5 s
        (said(10.0, 10.0), 11.6, 12.0, False),
        (said(10.0, 10.0), 7.0, 8.5, True),
        (said(10.0, 10.0), 7.0, 8.4, False),
        (said(10.0, 10.0), 7.0, None, True),
        (said(10.0, 12.0), 12.0, 13.0, True),
        (said(10.0, 12.0), 12.1, 13.0, False),
        (said(10.0, 12.0), 8.0, 10.0, True),
        (said(10.0, 12.0), 8.0, 9.9, False),
        (said(10.0, 11.4), 12.8, 13.0, True),
        (said(10.0, 11.5), 11.6, 12.0, False),
    ],
)
def test_what_lies_in_a_span(span: Span | None, begin: float, end: float | None, met: bool) -> None:
    assert meets(span, begin, end) is met


@pytest.mark.parametrize(
    ("span", "things", "meant"),
    [
        (None, [(1.0, 2.0), (5.0, 6.0)], (5.0, 6.0)),
        (None, [], None),
        (said(3.0, 4.0), [], None),
        (said(0.0, 9.0), [(1.0, 2.0), (5.0, 6.0)], (5.0, 6.0)),  # the latest
        (said(10.0, 10.0), [(9.0, 9.5), (10.2, 11.0), (4.0, None)], (4.0, None)),  # the nearest
        (said(10.0, 10.0), [(9.0, 9.5), (10.2, 11.0)], (10.2, 11.0)),
        (said(10.0, 10.0), [(9.0, 9.8), (10.4, 11.0)], (9.0, 9.8)),
        (said(10.0, 10.0), [(9.0, 11.0), (9.5, 11.0)], (9.5, 11.0)),
        (said(30.0, 40.0), [(1.0, 2.0), (5.0, 6.0)], None),
        (Span(30.0, 40.0), [(1.0, 2.0), (5.0, 6.0)], (5.0, 6.0)),
        (Span(-9.0, -5.0), [(1.0, 2.0), (5.0, 6.0)], (1.0, 2.0)),
    ],
)
def test_which_of_several_a_span_means(
    span: Span | None, things: list[Thing], meant: Thing | None
) -> None:
    assert pick(span, things, lambda thing: thing) == meant
