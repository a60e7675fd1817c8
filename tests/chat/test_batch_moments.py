"""Moments in a chat without a terminal."""

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import pytest

from xavi_dialogue.chat.batch import BatchChat

END = 73.2  # [s]


@dataclass
class Ride:
    """A ride that drives to the moment named, and ends."""

    driven: list[float] = field(default_factory=list)

    def check(self) -> None:
        pass

    def drive(self, client: Any, command: Any, *, halt: bool) -> Any:
        del client, halt
        self.driven.append(command.time)
        over = command.time >= END
        return SimpleNamespace(sim_time=min(command.time, END), state="ended" if over else "halted")


def chat(ride: Ride, told: list[str]) -> BatchChat:
    none: Any = None
    begin: Any = SimpleNamespace(sim_time=0.0, state="halted")
    return BatchChat(ride, none, none, told.append, told.append, False, begin, None)  # type: ignore[arg-type]


@pytest.mark.parametrize("line", ["@ 500s", "@ 73.3s"])
def test_a_moment_after_the_end_of_the_ride_is_its_end_and_says_so(line: str) -> None:
    told = list[str]()
    talk = chat(Ride(), told)
    talk.take(line)
    assert talk.at == END
    assert told == ["the ride ended at 73.2 s: questions are about then"]


def test_a_moment_of_the_ride_is_taken_without_a_word() -> None:
    told = list[str]()
    talk = chat(Ride(), told)
    talk.take("@ 12.4s")
    assert (talk.at, told) == (12.4, [])
