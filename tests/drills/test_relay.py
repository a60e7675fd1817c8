"""Between car and service, messages are dropped, lost for good, doubled, and overtake others."""

import msgspec
import pytest

from tests.drills.bus_clients import Answer, Listener, Passenger, on_bus
from tests.drills.processes import DEADLINE, Crew, free_endpoint, until
from tests.drills.relay import Faults
from tests.drills.stage import WHERE, WHY, Stage, staged
from xavi_dialogue.bus.interface import Bus

MOMENTS = (2.0, 5.0, 8.0, 12.0)
QUESTIONS = (WHERE, WHY, "What if you had stopped?", "How fast are we going?")
SPEED = 3.0  # simulated seconds per second
IN_TIME = DEADLINE + 1.0  # [s]
ROUGH = {"dropped": 0.5, "twice": 0.4, "held": 0.5}


def ask_all(bus: Bus, listener: Listener, stage: Stage) -> list[Answer]:
    """What is said while the ride goes on, each moment as soon as it has come."""
    assert until(lambda: listener.fares("service")["cars"] == 1.0)
    stage.car.order(f"speed {SPEED}")
    said = []
    for at in MOMENTS:
        stage.car.order(f"until {at}")
        said += [Passenger(bus, "ada").ask(text, at) for text in QUESTIONS]
        assert said[-1].reply is not None
        assert said[-1].reply.sim_time == at
    assert stage.listener.halted(MOMENTS[-1])
    return said


@pytest.mark.parametrize("seed", [1, 2])
def test_what_is_not_lost_for_good_changes_no_answer(crew: Crew, seed: int) -> None:
    far = free_endpoint()
    crew.serve(far, "--keep-days", "0")
    with staged(crew, at=None) as stage, on_bus(far) as bus:
        begin(crew, stage.endpoint, far, Faults(seed=seed, **ROUGH))
        listener = Listener(bus)
        said = ask_all(bus, listener, stage)
        wanted = [stage.passenger("ada").ask(text, at) for at in MOMENTS for text in QUESTIONS]
        assert [answer.told for answer in said] == [answer.told for answer in wanted]
        assert max(answer.taken for answer in said) < IN_TIME
        assert listener.fares("service")["rejected"] == 0.0
        scenes = stage.listener.scenes[-1].seq
        assert len({scene.seq for scene in listener.scenes}) < scenes  # some did not come
        assert len(listener.traces) > len(stage.listener.traces)  # and some came twice
        assert [s.seq for s in listener.scenes] != sorted(
            s.seq for s in listener.scenes
        )  # or too early


@pytest.mark.parametrize("lost", [(2, 3, 4, 5), (7,)], ids=["most", "one"])
def test_where_decisions_are_lost_for_good_nothing_is_said_about_them(
    crew: Crew, lost: tuple[int, ...]
) -> None:
    far = free_endpoint()
    crew.serve(far, "--keep-days", "0")
    with staged(crew, at=None) as stage, on_bus(far) as bus:
        faults = Faults(seed=3, **ROUGH, lost={"trace": lost, "event": (1,)})
        begin(crew, stage.endpoint, far, faults)
        said = ask_all(bus, Listener(bus), stage)
        gone = {report.trace.trace_id for report in stage.listener.traces if report.seq in lost}
        assert len(gone) == len(lost)
        for answer in said:
            assert answer.taken < IN_TIME
            assert answer.reply is not None
            if answer.kind == "answer":
                assert answer.reply.trace_id not in gone
                told = answer.reply.explanation or {}
                assert not gone & {*(told.get("evidence") or {}).get("traces", ())}
        assert any(answer.kind == "answer" for answer in said)
        last = Passenger(bus, "ben").ask(WHERE, MOMENTS[-1])
        assert last.told == stage.passenger("ben").ask(WHERE, MOMENTS[-1]).told


def begin(crew: Crew, here: str, there: str, faults: Faults) -> None:
    relay = crew.python(
        "-m", "tests.drills.relay", here, there, msgspec.json.encode(faults).decode()
    )
    relay.hear(1)
