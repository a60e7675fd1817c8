import json
from pathlib import Path

import msgspec
import pytest

from planner.record.events import Event
from tests.fakes import EGO
from tests.traces import s1_ride
from xavi_dialogue.bus.catalogue import MESSAGES
from xavi_dialogue.bus.errors import Malformed, MessageError, TooLarge, WrongSchema
from xavi_dialogue.bus.messages import (
    MAX_TEXT,
    MAX_TURNS,
    AskReply,
    AskRequest,
    CancelRequest,
    EventReport,
    EvidenceRequest,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryRequest,
    SceneReport,
    TraceReport,
    WhatIfRequest,
    pack,
    schema_name,
    unpack,
)
from xavi_dialogue.bus.schema import schema_of
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.storage.ride_file import load

TRACE = s1_ride(draws=10).traces[0]
RIDES = sorted((Path(__file__).parents[2] / "transcripts" / "rides").glob("*.gz"))
HEAD = {"ride": "r1", "seq": 3, "sim_time": 2.0, "wall_time": 1.0e9}
EXAMPLES = (
    SceneReport(
        **HEAD, vehicles={0: EGO}, state="driving", speed_factor=1.0, plan=(), traces=1, events=0
    ),
    TraceReport(**HEAD, trace=TRACE),
    EventReport(**HEAD, event=Event("arrived", 2.0)),
    AskRequest(request="q1", session="ada", text="Why?"),
    AskReply(text="So.", kind="answer", sim_time=2.0, request="q1", seq=0, wall_time=1.0),
    CancelRequest(request="q1", session="ada"),
    WhatIfRequest(request="q1", trace_id=TRACE.trace_id, actions=("stop",)),
    Failure(reason="busy"),
    ForgetRequest(request="q1", session="ada"),
    ForgetReply(request="q1", session="ada", turns=2, forgotten=True),
    EvidenceRequest(request="q1", trace_id=TRACE.trace_id),
    HistoryRequest(session="ada", turns=3),
    WhatIfRequest(
        request="q2", trace_id="t", vehicle=1, goal="exit-right", vehicle_actions=("exit-right",)
    ),
)
ASK = json.loads(pack(EXAMPLES[3]))


@pytest.mark.parametrize("message", EXAMPLES, ids=lambda m: type(m).__name__)
def test_a_message_comes_through_as_it_was(message: AskRequest) -> None:
    assert unpack(pack(message), type(message)) == message


def test_a_trace_keeps_its_name_on_the_way() -> None:
    report = unpack(pack(EXAMPLES[1]), TraceReport)
    assert report.trace.trace_id == TRACE.trace_id


@pytest.mark.parametrize("file", RIDES, ids=lambda file: file.name.partition(".")[0])
def test_every_decision_of_a_recorded_ride_is_small_enough_to_be_read(file: Path) -> None:
    ride = load(file.read_bytes())
    assert ride.traces
    for seq, trace in enumerate(ride.traces):
        report = TraceReport(**HEAD | {"seq": seq}, trace=trace)
        assert unpack(pack(report), TraceReport).trace.trace_id == trace.trace_id


def test_a_reply_can_be_told_from_what_surrounds_it() -> None:
    reply = Reply(text="So.", kind="answer", sim_time=2.0)
    assert EXAMPLES[4].reply() == reply


@pytest.mark.parametrize("kind", MESSAGES.values(), ids=MESSAGES)
def test_every_message_has_a_schema_of_its_own(kind: type[AskRequest]) -> None:
    schema = json.dumps(schema_of(kind, schema_name(kind)))
    assert "$ref" not in schema
    assert schema_name(kind) in schema


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"schema": "xavi.ask/2"}, WrongSchema),
        ({"schema": None}, Malformed),
        ({"request": ""}, Malformed),
        ({"request": "a b"}, Malformed),
        ({"session": "x" * 65}, Malformed),
        ({"text": 7}, Malformed),
        ({"text": "x" * 5000}, Malformed),
        ({"text": "x" * 60000}, TooLarge),
        ({"deadline_ms": -1}, Malformed),
        ({"deadline_ms": 1e9}, Malformed),
        ({"at": "noon"}, Malformed),
        ({"style": "pirate"}, Malformed),
    ],
)
def test_a_wrong_message_gets_its_error(
    change: dict[str, object], error: type[MessageError]
) -> None:
    with pytest.raises(error):
        unpack(json.dumps({**ASK, **change}).encode(), AskRequest)


def test_a_history_is_of_all_that_is_told_unless_it_says_otherwise() -> None:
    plain = {"schema": "xavi.history/1", "session": "ada"}
    assert unpack(json.dumps(plain).encode(), HistoryRequest).turns == MAX_TURNS
    for turns in (0, -1, MAX_TURNS + 1, 1.5, "all", None):
        with pytest.raises(Malformed, match="turns"):
            unpack(json.dumps({**plain, "turns": turns}).encode(), HistoryRequest)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x00\xff\xfe",
        b"null",
        b"[]",
        b"{}",
        b'{"schema": "xavi.ask/1"}',
        b"[" * 15000,
        json.dumps(ASK).replace("10000.0", "NaN").encode(),
    ],
)
def test_what_is_no_message_gets_a_typed_error(data: bytes) -> None:
    with pytest.raises(Malformed):
        unpack(data, AskRequest)


@pytest.mark.parametrize("character", ["x", "\u00e4", "\U0001f600", '"'])
def test_a_question_of_all_its_characters_fits(character: str) -> None:
    asked = {**ASK, "text": character * MAX_TEXT}
    for data in (msgspec.json.encode(asked), json.dumps(asked).encode()):
        assert len(unpack(data, AskRequest).text) == MAX_TEXT
    with pytest.raises(Malformed):
        unpack(json.dumps({**asked, "text": character * (MAX_TEXT + 1)}).encode(), AskRequest)


@pytest.mark.parametrize(
    ("example", "field"),
    [(0, "seed"), (0, "traces"), (0, "events"), (0, "orders"), (1, "seq"), (2, "seq")],
)
@pytest.mark.parametrize("number", [2**53, 2**63, 2**64, 10**100])
def test_no_number_is_larger_than_any_file_holds(example: int, field: str, number: int) -> None:
    known = json.loads(pack(EXAMPLES[example]))
    kind = type(EXAMPLES[example])
    assert unpack(json.dumps({**known, field: 2**53 - 1}).encode(), kind)
    with pytest.raises(Malformed):
        unpack(json.dumps({**known, field: number}).encode(), kind)


def test_the_schema_must_be_told() -> None:
    unlabelled = {key: value for key, value in ASK.items() if key != "schema"}
    with pytest.raises(Malformed, match="schema"):
        unpack(json.dumps(unlabelled).encode(), AskRequest)


def test_a_question_is_made_harmless_where_it_comes_in() -> None:
    data = json.dumps({**ASK, "text": "\x1b[2JWhy\n did you?"}).encode()
    assert unpack(data, AskRequest).text == "Why did you?"


def test_a_reply_is_made_harmless_before_it_is_shown() -> None:
    reply = msgspec.structs.replace(EXAMPLES[4], text="\x1b]0;evil\x07So.")
    assert unpack(pack(reply), AskReply).reply().text == "So."
