"""Shards of a fleet: which of several services answers about which car.

Every service, and everybody who looks, finds the home of a car from its name alone, by rendezvous
hashing: the car has a weight for each shard, and the heaviest one is its home. With one shard more,
only the cars whose home it becomes move.

A service shows its claim on the bus: its shard, and a rank after those of all services that it
found there. Of two claims to a car the earlier one holds; the later service is silent about it.
"""

import hashlib
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Self

from xavi_dialogue.bus.access_control import CLAIMS
from xavi_dialogue.bus.interface import FLEET

LARGEST = 1000  # shards of a fleet
CLAIMED = FLEET.of(CLAIMS)  # the pattern of all claims
MANY = 100_000  # cars whose homes are remembered


@dataclass(frozen=True, slots=True, order=True)
class Shard:
    """A part of a fleet: the `number`th, from 1, `of` so many."""

    number: int = 1
    of: int = 1

    @classmethod
    def read(cls, text: str) -> Self:
        """Read a shard such as `2/4`.

        Raises:
            ValueError: there is no such shard.
        """
        found = re.fullmatch(r"(\d{1,4})/(\d{1,4})", text, re.ASCII)
        if found is None or not 1 <= int(found[1]) <= int(found[2]) <= LARGEST:
            raise ValueError(
                f"{text!r} is no shard of at most {LARGEST}; the second of four is 2/4"
            )
        return cls(int(found[1]), int(found[2]))

    def has(self, vehicle: str) -> bool:
        """Check whether a car is of this shard."""
        return self.of == 1 or home(vehicle, self.of) == self.number

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"


ALL = Shard()  # one shard of one: every car


@lru_cache(MANY)
def home(vehicle: str, of: int) -> int:
    """Return the number of the shard that a car belongs to, of so many."""

    def weight(number: int) -> bytes:
        return hashlib.sha256(f"{vehicle}/{number}".encode()).digest()

    return max(range(1, of + 1), key=weight)


@dataclass(frozen=True, slots=True, order=True)
class Claim:
    """What a service answers for; an earlier claim is less."""

    rank: int
    name: str  # of the service, made at its start
    shard: Shard = field(default_factory=Shard)

    @property
    def key(self) -> str:
        """The key under which it is shown."""
        return FLEET.of(f"service/{self.rank}.{self.name}.{self.shard.number}.{self.shard.of}")

    @classmethod
    def read(cls, key: str) -> Self | None:
        """Read a claim from its key; None: it is none."""
        found = re.fullmatch(
            r"(\d{1,9})\.([0-9a-z]{1,32})\.(\d{1,4})\.(\d{1,4})", key.split("/")[-1]
        )
        if found is None:
            return None
        try:
            shard = Shard.read(f"{found[3]}/{found[4]}")
        except ValueError:
            return None
        return cls(int(found[1]), found[2], shard)


def after(claims: Iterable[Claim], name: str, shard: Shard) -> Claim:
    """Return the claim of a service that comes after all others."""
    return Claim(max((one.rank for one in claims), default=0) + 1, name, shard)


def holder(claims: Iterable[Claim], vehicle: str) -> Claim | None:
    """Return the claim that holds for a car; None: nobody answers about it."""
    return min((one for one in claims if one.shard.has(vehicle)), default=None)


def missing(claims: Iterable[Claim]) -> list[Shard]:
    """Return the shards without a service, of each number of shards that a service knows."""
    shards = {one.shard for one in claims}
    counts = sorted({one.of for one in shards})
    return [
        shard
        for of in counts
        for shard in (Shard(number, of) for number in range(1, of + 1))
        if shard not in shards
    ]
