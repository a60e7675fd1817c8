"""What waits for one browser, and what it may say."""

import json
from typing import Any

import msgspec
import pytest

from tests.dashboard.web.known_source import STATUS, WELCOME, scene
from xavi_dialogue.dashboard.web import client_session
from xavi_dialogue.dashboard.web.client_session import (
    MAX_IN_FLIGHT,
    MAX_WAITING,
    ClientSession,
    pack,
)
from xavi_dialogue.dashboard.web.websocket_messages import (
    MAX_INCOMING,
    Ask,
    Cancel,
    Ride,
    Suggest,
    Trouble,
)


def viewer(*, browsers: int = 1) -> ClientSession:
    """One that has been greeted and has read that."""
    made = ClientSession(0, 0.0, lambda: browsers)
    made.greet((WELCOME, STATUS))
    taken(made)
    return made


def taken(one: ClientSession, now: float = 0.0) -> list[dict[str, Any]]:
    """All that is to be sent now."""
    found = []
    while (text := one.take(now)) is not None:
        found.append(json.loads(text))
    return found


def kinds(one: ClientSession, now: float = 0.0) -> list[str]:
    return [message["type"] for message in taken(one, now)]


def seen(seq: int) -> str:
    return json.dumps({"type": "seen", "seq": seq})


def here() -> str:
    return json.dumps({"type": "here"})


def ask(number: int = 0) -> str:
    return json.dumps({"type": "ask", "request": f"r{number}", "text": "Why?"})


def trouble(number: int) -> Trouble:
    return Trouble(request=None, text=str(number))


def ride(name: str, roads: str | None = None) -> Ride:
    return Ride(ride=name, scenario=None, seed=None, roads=roads)


def test_a_browser_is_greeted_first_and_told_its_own_status() -> None:
    one = ClientSession(0, 0.0, lambda: 7)
    one.tell(trouble(1))
    assert one.take(0.0) is None
    one.greet((WELCOME, STATUS))
    welcome, status = taken(one)
    assert welcome["type"] == "welcome"
    assert status == json.loads(pack(msgspec.structs.replace(STATUS, browsers=7)).text)


def test_all_but_scenes_comes_in_order() -> None:
    one = viewer()
    for number in range(100):
        one.tell(trouble(number))
    assert [message["text"] for message in taken(one)] == [str(number) for number in range(100)]


def test_of_scenes_the_newest_waits_and_those_left_out_are_counted() -> None:
    one = viewer()
    for seq in range(5):
        one.tell(scene(seq))
    assert [message["seq"] for message in taken(one)] == [4]
    assert one.dropped == 4


def test_scenes_wait_for_those_before_to_be_drawn() -> None:
    one = viewer()
    sent = []
    for seq in range(10):
        one.tell(scene(seq))
        sent += taken(one)
    assert [message["seq"] for message in sent] == list(range(MAX_IN_FLIGHT))
    assert one.dropped == 10 - MAX_IN_FLIGHT - 1
    assert one.hear(seen(0), 0.0) is None
    assert [message["seq"] for message in taken(one)] == [9]


def test_the_last_one_drawn_stands_for_those_before_it() -> None:
    one = viewer()
    for seq in (7, 8, 2):  # another ride counts anew
        one.tell(scene(seq))
        taken(one)
    one.hear(seen(2), 0.0)
    for seq in range(3, 3 + MAX_IN_FLIGHT):
        one.tell(scene(seq))
        assert [message["seq"] for message in taken(one)] == [seq]
    assert one.dropped == 0


@pytest.mark.parametrize("seq", [-1, 5, 2**62])
def test_a_scene_that_was_not_sent_cannot_have_been_drawn(seq: int) -> None:
    one = viewer()
    for number in range(10):
        one.tell(scene(number))
        taken(one)
    one.hear(seen(seq), 0.0)
    assert taken(one) == []


def test_a_scene_of_the_ride_before_is_not_sent() -> None:
    one = viewer()
    one.tell(ride("a"))
    one.tell(scene(1))
    one.tell(ride("b"))
    assert kinds(one) == ["ride", "ride"]
    one.tell(scene(2))
    one.tell(ride("b", roads="abc"))
    assert kinds(one) == ["ride", "scene"]


def test_dropped_scenes_are_told_once_a_second() -> None:
    one = viewer()
    told = []
    for tick in range(100):  # ten seconds, ten scenes a second
        one.tell(scene(tick))
        told += [m for m in taken(one, tick / 10) if m["type"] == "status"]
    assert len(told) in {9, 10}
    assert [status["dropped"] for status in told] == sorted({s["dropped"] for s in told})
    assert told[-1]["service"] == "gone"
    assert one.due(9.9) is not None
    assert taken(one, 12.0)[0]["dropped"] == one.dropped == 100 - MAX_IN_FLIGHT - 1
    assert one.due(12.0) is None


def test_another_number_of_browsers_is_told() -> None:
    there = 1
    one = ClientSession(0, 0.0, lambda: there)
    one.greet((WELCOME, STATUS))
    taken(one)
    there = 2
    assert one.due(0.25) == 0.75
    assert kinds(one, 0.9) == []
    assert [message["browsers"] for message in taken(one, 1.0)] == [2]


def test_who_reads_nothing_is_sent_away_and_holds_no_memory() -> None:
    one = viewer()
    changes = []
    one.changed = lambda: changes.append(one.waiting)
    large = pack(Trouble(request=None, text="x" * 100_000))
    for _ in range(200):
        one.put(large)
        one.tell(scene(0))
    assert max(changes) <= MAX_WAITING + 2 * large.size
    assert one.leave is not None
    assert one.leave.code == 1013
    assert one.waiting == 0
    assert taken(one) == []


def test_scenes_alone_never_send_a_browser_away() -> None:
    one = viewer()
    large = pack(scene(0, vehicles=3000))
    for _ in range(200):
        one.put(large)
    assert one.leave is None
    assert one.waiting == large.size


def test_a_greeting_may_be_as_long_as_it_is() -> None:
    one = ClientSession(0, 0.0)
    many = tuple(Trouble(request=None, text="x" * 100_000) for _ in range(100))
    one.greet((WELCOME, *many))
    one.tell(trouble(1))
    assert one.leave is None
    assert len(taken(one)) == 102


def test_a_message_is_made_json_once_for_all() -> None:
    packed, all_of_them = pack(trouble(1)), [viewer() for _ in range(3)]
    for one in all_of_them:
        one.put(packed)
    assert {id(one.take(0.0)) for one in all_of_them} == {id(packed.text)}


def test_what_a_browser_wants() -> None:
    one = viewer()
    assert one.hear(ask(), 0.0) == Ask(request="r0", text="Why?")
    at = '{"type":"ask","request":"a","text":"Why?","at":1.5,"later":"unknown here"}'
    assert one.hear(at, 0.0) == Ask(request="a", text="Why?", at=1.5)
    assert one.hear('{"type":"cancel","request":"a"}', 0.0) == Cancel(request="a")
    assert one.hear('{"type":"suggest","at":2}', 0.0) == Suggest(at=2.0)
    assert taken(one) == []


NO_MESSAGES = [
    *("", " ", "null", "[]", "{}", "1", '"ask"', "\x00", "{", "nonsense", "﻿{}"),
    '{"type":"welcome"}',
    '{"type":"ask"}',
    '{"type":["ask"]}',
    '{"type":"ask","request":1,"text":"Why?"}',
    '{"type":"ask","request":"","text":"Why?"}',
    '{"type":"ask","request":"a b","text":"Why?"}',
    '{"type":"ask","request":"a\\n","text":"Why?"}',
    '{"type":"ask","request":"' + "a" * 65 + '","text":"Why?"}',
    '{"type":"ask","request":"a","text":null}',
    '{"type":"ask","request":"a","text":"' + "x" * 4097 + '"}',
    '{"type":"ask","request":"a","text":"\\ud83d"}',
    '{"type":"ask","request":"a","text":"Why?","at":NaN}',
    '{"type":"ask","request":"a","text":"Why?","at":-1}',
    '{"type":"ask","request":"a","text":"Why?","at":1e300}',
    '{"type":"ask","request":"a","text":"Why?","at":"1"}',
    '{"type":"seen","seq":1.5}',
    '{"type":"seen","seq":1e400}',
    '{"type":"seen","seq":' + "9" * 5000 + "}",
    '{"type":"seen","seq":1,"x":' + "[" * 20_000 + "]" * 20_000 + "}",
    "[" * 50_000,
]


@pytest.mark.parametrize("text", NO_MESSAGES, ids=lambda text: text[:30])
def test_what_cannot_be_read_is_said_so(text: str) -> None:
    one = viewer()
    assert one.hear(text, 0.0) is None
    assert [(m["type"], m["text"]) for m in taken(one)] == [("trouble", client_session.NOT_READ)]
    assert one.leave is None


def test_what_is_too_long_ends_the_connection() -> None:
    one = viewer()
    assert one.hear(" " * MAX_INCOMING + "{}", 0.0) is None
    assert one.leave is not None
    assert one.leave.code == 1009


def test_questions_are_taken_up_twice_a_second() -> None:
    one = viewer()
    heard = [one.hear(ask(number), 0.0) for number in range(8)]
    assert [h is not None for h in heard] == [True] * 5 + [False] * 3
    assert [(m["request"], m["text"]) for m in taken(one)] == [
        (f"r{number}", client_session.TOO_FAST) for number in (5, 6, 7)
    ]
    assert one.hear(ask(), 0.5) is not None
    assert one.hear(ask(), 0.5) is None
    assert one.hear('{"type":"cancel","request":"r0"}', 0.5) is not None


def test_other_messages_are_taken_up_fifty_times_a_second() -> None:
    one = viewer()
    suggest = '{"type":"suggest","at":2}'
    heard = [one.hear(suggest, 0.0) for _ in range(110)]
    assert sum(h is not None for h in heard) == 100
    assert len(taken(one)) == 10
    assert sum(one.hear(suggest, 1.0) is not None for _ in range(60)) == 50


@pytest.mark.parametrize("text", [ask(), seen(1), "nonsense", '{"type":"suggest","at":2}'])
def test_a_flood_ends_the_connection(text: str) -> None:
    one = viewer()
    for _ in range(1000):
        one.hear(text, 0.0)
    assert one.leave is not None
    assert one.leave.code == 4429
    assert one.waiting == 0
    assert one.hear(ask(), 100.0) is None


def test_a_reason_is_short_enough_and_the_first_one_stands() -> None:
    one = viewer()
    one.send_away(1001, "ä" * 100)
    one.send_away(1013, "no")
    assert one.leave is not None
    assert (one.leave.code, len(one.leave.reason.encode())) == (1001, 122)


def test_a_browser_is_silent_until_it_says_something() -> None:
    one = viewer()
    assert one.silent(7.0) == 7.0
    one.hear("nonsense", 7.0)
    assert one.silent(7.0) == 7.0
    assert one.hear(here(), 8.0) is None
    assert one.silent(60.0) == 0.0


def test_a_browser_is_silent_while_it_does_not_say_that_it_has_seen_a_scene() -> None:
    one = viewer()
    one.hear(here(), 0.0)
    for seq in (1, 2):
        one.put(pack(scene(seq)))
        assert kinds(one, 10.0 * seq) == ["scene"]
    assert one.silent(30.0) == 20.0
    one.hear(seen(1), 30.0)
    assert one.silent(34.0) == 4.0
    one.hear(seen(2), 35.0)
    assert one.silent(60.0) == 0.0
