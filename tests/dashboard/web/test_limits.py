"""Token buckets."""

from hypothesis import given
from hypothesis import strategies as st

from xavi_dialogue.dashboard.web.rate_limit import Bucket, Buckets, Rate


def test_a_burst_and_then_so_many_a_second() -> None:
    bucket = Bucket(Rate(2.0, 5), 0.0)
    assert [bucket.take(0.0) for _ in range(6)] == [True] * 5 + [False]
    assert [bucket.take(0.5), bucket.take(0.5)] == [True, False]
    assert [bucket.take(100.0) for _ in range(6)] == [True] * 5 + [False]


@given(st.lists(st.floats(0.0, 0.5), min_size=1, max_size=200))
def test_never_more_than_the_rate_allows(pauses: list[float]) -> None:
    bucket, now, taken = Bucket(Rate(3.0, 4), 0.0), 0.0, 0
    for pause in pauses:
        now += pause
        taken += bucket.take(now)
        assert taken <= 4 + 3.0 * now + 1e-6


def test_a_clock_that_goes_back_gives_nothing() -> None:
    bucket = Bucket(Rate(1.0, 1), 10.0)
    assert bucket.take(10.0)
    assert not bucket.take(5.0)
    assert not bucket.take(5.5)


def test_each_has_a_bucket_and_there_are_not_too_many() -> None:
    buckets = Buckets(Rate(1.0, 1), most=2)
    assert [buckets.take(who, 0.0) for who in "aab"] == [True, False, True]
    assert not buckets.take("c", 0.0)
    assert buckets.take("c", 2.0)
    assert buckets.take("a", 2.0)
