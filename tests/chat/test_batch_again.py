"""A question that the chat without a terminal repeats."""

from dataclasses import dataclass, field
from typing import Any

import pytest

from xavi_dialogue.chat.batch import BatchChat
from xavi_dialogue.chat.client import ServiceLost
from xavi_dialogue.dialogue.reply import Reply


@dataclass
class LostOnce:
    """A client whose first question gets no reply, though it is answered and stored."""

    requests: list[str | None] = field(default_factory=list)

    def ask(self, text: str, at: float | None = None, *, request: str | None = None) -> Reply:
        self.requests.append(request)
        if len(self.requests) == 1:
            raise ServiceLost("the dialogue service does not answer")
        return Reply(text=f"{text} So.", kind="answer", sim_time=0.0)


@dataclass
class Backend:
    """A service that comes back, or does not."""

    back: bool = True

    def check(self) -> None:
        pass

    def recover(self, client: Any) -> bool:
        return self.back

    def now(self, client: Any) -> float:
        return 1.0


def chat(client: LostOnce, backend: Backend, told: list[str]) -> BatchChat:
    none: Any = None
    return BatchChat(backend, client, none, told.append, told.append, False, none, None)  # type: ignore[arg-type]


def test_a_question_is_repeated_under_the_same_name_so_that_it_is_answered_once() -> None:
    client, told = LostOnce(), list[str]()
    assert chat(client, Backend(), told).take("Why?")
    assert told == ["Why? So."]
    first, second = client.requests
    assert first is not None
    assert first == second


def test_every_question_has_a_name_of_its_own() -> None:
    client = LostOnce()
    talk = chat(client, Backend(), [])
    talk.take("Why?")
    talk.take("Why?")
    assert len(set(client.requests)) == 2


def test_a_service_that_stays_away_ends_the_chat() -> None:
    with pytest.raises(ServiceLost):
        chat(LostOnce(), Backend(back=False), []).take("Why?")
