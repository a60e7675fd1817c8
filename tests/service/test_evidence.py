"""The evidence that answers name, and the latest turns alone, over the in-memory bus."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import msgspec
import pytest

from planner.record import trace as plan_trace
from planner.record.trace import PlanTrace, WhatIf
from sim.scene import Scene
from tests.fakes import again
from tests.service.test_service import Bench
from xavi_dialogue.bus.interface import Call, Keys, Outcome, Refused
from xavi_dialogue.bus.memory_bus import MemoryBus, MemoryHub
from xavi_dialogue.bus.messages import (
    EvidenceRequest,
    Failure,
    Message,
    WhatIfRequest,
    pack,
    unpack,
)
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.dialogue import manager
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.ride_file import RecordedRide
from xavi_dialogue.transcripts.replay import Written, by_ride, recording, transcripts_in
from xavi_dialogue.transcripts.transcript import At, Exchange
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.telemetry import Reporter

KEYS = Keys()
EVIDENCE = KEYS.of("@rpc/evidence")
WHATIF = KEYS.of("@rpc/whatif")
ABOUT = by_ride(transcripts_in(Path(__file__).parents[2] / "transcripts"))
# Rides about which answers name decisions and plans made again; of the last one decisions alone.
PLANNED_AGAIN = (
    *("s1-0.ride", "s1-4.ride", "s4-0.ride", "motorway-0.ride"),
    *("even.json", "lorry.ride", "waiting.ride"),
)
RIDES = (*PLANNED_AGAIN, "s3-0.ride")


class Prompt(MemoryBus):
    """A bus on which the service works as soon as something is asked of it."""

    service: Service

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        super().request(key, payload, timeout, done)
        self.service.work()


class Talk:
    """A service, a car whose ride was recorded, and a passenger."""

    def __init__(self, ride: RecordedRide, pipeline: Pipeline, until: float) -> None:
        hub = MemoryHub()
        service = Service(hub.connect(), pipeline)
        service.open()
        car = hub.connect()
        car.appear(KEYS.of("alive/car"))
        car.serve(WHATIF, partial(planned, ride))
        reporter = Reporter(car, KEYS)
        for trace in ride.traces:
            reporter.record(Moment(Scene(trace.sim_time, trace.scene), (), trace, (), None))
        last = Moment(Scene(until, ride.traces[-1].scene), (), None, tuple(ride.events), None)
        reporter.record(last)
        reporter.show(last, "driving" if ride.ended is None else "ended", 1.0)
        self.bus = Prompt(hub)
        self.bus.service = service
        self.clients: dict[str, Client] = {}

    def client(self, session: str) -> Client:
        if session not in self.clients:
            self.clients[session] = Client(self.bus, KEYS, session)
        return self.clients[session]


def planned(ride: RecordedRide, call: Call) -> None:
    """Plan again as the recording has it."""
    wanted = unpack(call.payload, WhatIfRequest)
    [origin] = [trace for trace in ride.traces if trace.trace_id == wanted.trace_id]
    again = msgspec.convert(msgspec.to_builtins(wanted), WhatIf)
    for plan in ride.whatifs.values():
        if (plan.what_if, plan.sim_time, plan.decision) == (
            again,
            origin.sim_time,
            origin.decision,
        ):
            call.reply(plan_trace.encode(plan))
            return
    call.refuse(pack(Failure(reason="planner-failed")))


def asked(one: Written, talk: Talk, halt: float) -> list[Reply]:
    """The replies to all questions of a transcript."""
    at, replies = halt, []
    for step in one.transcript.steps:
        match step:
            case At(time):
                at = time
            case Exchange(question):
                replies.append(talk.client(one.path.stem).ask(question, at))
    return replies


def named(replies: list[Reply]) -> set[str]:
    """The decisions that answers name."""
    found = {reply.trace_id for reply in replies} - {None}
    explained = [reply.explanation for reply in replies if reply.explanation is not None]
    return found.union(*(one.get("evidence", {}).get("traces", ()) for one in explained))  # type: ignore[arg-type]


def outcome(bus: Prompt, wanted: Message | bytes, at: str = EVIDENCE) -> Outcome:
    came: list[Outcome] = []
    bus.request(at, wanted if isinstance(wanted, bytes) else pack(wanted), 1.0, came.append)
    [one] = came
    return one


def refusal(outcome: Outcome) -> Failure:
    assert isinstance(outcome, Refused)
    return unpack(outcome.payload, Failure)


@pytest.fixture(scope="module")
def pipeline() -> Pipeline:
    return make_pipeline()


@pytest.mark.parametrize("name", RIDES)
def test_all_that_answers_rest_on_can_be_had(name: str, pipeline: Pipeline) -> None:
    [path] = [path for path in ABOUT if path.name.startswith(name)]
    ride, about = recording(path), ABOUT[path]
    moments = [step.time for one in about for step in one.transcript.steps if isinstance(step, At)]
    talk = Talk(ride, pipeline, max(ride.halt, ride.ended or 0.0, *moments))
    replies = [reply for one in about for reply in asked(one, talk, ride.halt)]
    found = {one: talk.client("anybody").evidence(one) for one in sorted(named(replies))}
    assert all(trace.trace_id == one for one, trace in found.items())
    known = {trace.trace_id: trace for trace in (*ride.traces, *ride.whatifs.values())}
    assert found == {one: known[one] for one in found}
    assert any(trace.what_if is None for trace in found.values())
    again = any(trace.what_if is not None for trace in found.values())
    assert again == (name in PLANNED_AGAIN)


@pytest.fixture
def bench() -> Bench:
    found = Bench()
    found.drive()
    return found


def ask_for(bench: Bench, trace_id: str) -> Outcome:
    bus = Prompt(bench.hub)
    bus.service = bench.service
    return outcome(bus, EvidenceRequest(request="e1", trace_id=trace_id))


def test_evidence_comes_as_the_bytes_that_its_name_is_of(bench: Bench) -> None:
    for trace in bench.service.vehicle_session().dialogue.traces:
        assert ask_for(bench, trace.trace_id) == plan_trace.encode(trace)


def test_what_was_planned_again_can_be_had(bench: Bench) -> None:
    plans: list[PlanTrace] = []
    bench.car.serve(WHATIF, lambda call: plans.append(plan(bench, call)))
    bench.ask("lack more")
    assert len(plans) == 2
    for one in plans:
        assert ask_for(bench, one.trace_id) == plan_trace.encode(one)


def plan(bench: Bench, call: Call) -> PlanTrace:
    """Reply to the service as the car does once it has planned again."""
    wanted = unpack(call.payload, WhatIfRequest)
    [trace] = [
        t for t in bench.service.vehicle_session().dialogue.traces if t.trace_id == wanted.trace_id
    ]
    found = again(trace, wanted)
    call.reply(plan_trace.encode(found))
    return found


def test_plans_beyond_those_that_are_remembered_are_told_to_be_gone(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(manager, "MAX_PLANNED", 1)
    plans: list[PlanTrace] = []
    bench.car.serve(WHATIF, lambda call: plans.append(plan(bench, call)))
    bench.ask("lack more")
    gone, kept = plans
    assert refusal(ask_for(bench, gone.trace_id)).reason == "outside-record"
    assert ask_for(bench, kept.trace_id) == plan_trace.encode(kept)


def test_another_ride_leaves_no_evidence(bench: Bench) -> None:
    names = [trace.trace_id for trace in bench.service.vehicle_session().dialogue.traces]
    bench.drive(until=1.0, appear=False)
    kept = {trace.trace_id for trace in bench.service.vehicle_session().dialogue.traces}
    for one in names:
        assert isinstance(ask_for(bench, one), bytes if one in kept else Refused)
    assert set(names) - kept


@pytest.mark.parametrize("vehicle", ["car", "nobody"])
def test_what_is_not_in_the_record_is_told_in_words(bench: Bench, vehicle: str) -> None:
    bus = Prompt(bench.hub)
    bus.service = bench.service
    wanted = EvidenceRequest(request="e1", trace_id="0" * 16)
    failure = refusal(outcome(bus, wanted, Keys(vehicle).of("@rpc/evidence")))
    assert failure.reason == "outside-record"
    assert "no decision of this ride" in failure.detail
    with pytest.raises(ServiceLost, match="refused: no decision of this ride"):
        Client(bus, Keys(vehicle), "ada").evidence("0" * 16)


@pytest.mark.parametrize(
    ("data", "at", "detail"),
    [
        (b"junk", EVIDENCE, "no xavi.evidence/1"),
        (b'{"schema": "xavi.evidence/2"}', EVIDENCE, "'xavi.evidence/1' is read here"),
        (b'{"schema": "xavi.evidence/1", "request": "e"}', EVIDENCE, "trace_id"),
        (b" " * EvidenceRequest.LIMIT + b"{}", EVIDENCE, "at most 4096"),
        (
            pack(EvidenceRequest(request="e1", trace_id="t")),
            "xavi/v1/*/@rpc/evidence",
            "name one car",
        ),
    ],
)
def test_nonsense_is_refused_with_its_reason(
    bench: Bench, data: bytes, at: str, detail: str
) -> None:
    came: list[Outcome] = []
    handler = bench.hub.servers["xavi/v1/*/@rpc/evidence"][0][1]
    handler(Asked(at, data, came))
    bench.service.work()
    failure = refusal(came[0])
    assert failure.reason == "not-understood"
    assert detail in failure.detail


class Asked:
    """A call as it comes from the bus, whatever its key."""

    def __init__(self, key: str, payload: bytes, came: list[Outcome]) -> None:
        self.key, self.payload, self._came = key, payload, came

    def reply(self, payload: bytes) -> None:
        self._came.append(payload)

    def refuse(self, payload: bytes) -> None:
        self._came.append(Refused(payload))

    def drop(self) -> None:
        raise AssertionError("it is to be answered")


def test_a_client_takes_no_nonsense_for_evidence() -> None:
    hub = MemoryHub()
    hub.connect().serve(EVIDENCE, lambda call: call.reply(b"{}"))
    with pytest.raises(ServiceLost, match="nonsense: not a plan trace"):
        Client(hub.connect(), KEYS, "ada").evidence("0" * 16)


def test_the_latest_turns_alone_can_be_read(bench: Bench) -> None:
    for k in range(4):
        bench.ask(f"answer {k}", request=f"q{k}")
    bus = Prompt(bench.hub)
    bus.service = bench.service
    client = Client(bus, KEYS, "ada")
    texts = [turn.text for turn in client.history()]
    assert len(texts) == 4
    for turns in (1, 3, 4, 100):
        assert [turn.text for turn in client.history(turns)] == texts[-turns:]
    with pytest.raises(ServiceLost, match="turns"):
        client.history(0)
