"""Rate limits by token buckets. The clock is an argument."""

from collections.abc import Hashable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Rate:
    """A rate and a burst."""

    every_second: float  # rate in the long run
    burst: int  # greatest number at once


class Bucket:
    """A bucket that starts with `burst` tokens, and is refilled by `every_second` per second."""

    def __init__(self, rate: Rate, now: float) -> None:
        self._rate, self._tokens, self._filled = rate, float(rate.burst), now

    def take(self, now: float) -> bool:
        """Take a token at a time [s, monotonic]; return whether there was one."""
        if self.full(now):
            self._tokens = float(self._rate.burst)
        else:
            self._tokens += max(now - self._filled, 0.0) * self._rate.every_second
        self._filled = now
        if self._tokens < 1.0:
            return False
        self._tokens -= 1.0
        return True

    def full(self, now: float) -> bool:
        """Check whether the bucket is full."""
        grown = self._tokens + max(now - self._filled, 0.0) * self._rate.every_second
        return grown >= self._rate.burst


class Buckets:
    """Token buckets by client, such as an address; at most `most` of them."""

    def __init__(self, rate: Rate, most: int = 1000) -> None:
        self._rate, self._most = rate, most
        self._buckets: dict[Hashable, Bucket] = {}

    def take(self, whose: Hashable, now: float) -> bool:
        """Take a token of a client; see `Bucket.take`.

        If there are more than `most` clients, new ones get no token.
        """
        bucket = self._buckets.get(whose)
        if bucket is None:
            if len(self._buckets) >= self._most:
                self._buckets = {k: b for k, b in self._buckets.items() if not b.full(now)}
            if len(self._buckets) >= self._most:
                return False
            bucket = self._buckets[whose] = Bucket(self._rate, now)
        return bucket.take(now)
