import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest

from planner.errors import TraceError
from planner.prediction.people import MOST
from planner.record.fitting import IMPROBABLE, RECENT, fitted
from planner.record.places import LightChange
from planner.record.trace import MAX_BYTES, ROOM, SCHEMA, PlanTrace, Rollout, Sample, Track, encode
from planner.record.trace_reading import decode
from planner.search.decide import CROWD, decide
from tests.planner.worlds import QUICK, before_end, changing, driven, frame, moment, still


def decision() -> PlanTrace:
    """A small decision on s1."""
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
    scene = {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, 12.0, [8.0] * 8),
    }
    return decide(frame("s1", QUICK), moment("s1", scene, time=2.0)).trace


@pytest.fixture(scope="module")
def trace() -> PlanTrace:
    return decision()


def test_reading_gives_what_was_written(trace: PlanTrace) -> None:
    assert decode(encode(trace)) == trace
    assert encode(decode(encode(trace))) == encode(trace)


def test_the_json_is_plain_and_holds_no_nan(trace: PlanTrace) -> None:
    def refuse(constant: str) -> float:
        raise AssertionError(constant)

    plain = json.loads(encode(trace), parse_constant=refuse)
    assert plain["schema"] == SCHEMA
    assert plain["rollouts"][0]["index"] == 0
    assert set(plain["scene"]) == {"0", "1"}


def test_hold_ups_are_written_with_from_and_to(trace: PlanTrace) -> None:
    stretches = [s for r in json.loads(encode(trace))["rollouts"] for s in r["held_up"]]
    assert stretches
    for stretch in stretches:
        assert set(stretch) == {"vehicle", "from", "to", "how", "speed_from", "speed_to"}


def test_who_holds_a_predicted_vehicle_up_is_written_where_somebody_does(trace: PlanTrace) -> None:
    ways = [way for goal in trace.predictions[0].goals for way in goal.trajectories]
    plain = json.loads(encode(trace))["predictions"][0]["goals"]
    written = [way for goal in plain for way in goal["trajectories"]]
    assert [len(way.get("held_up", ())) for way in written] == [len(way.held_up) for way in ways]
    held = msgspec.structs.replace(ways[0], held_up=trace.rollouts[0].held_up[:1])
    goal = msgspec.structs.replace(trace.predictions[0].goals[0], trajectories=(held,))
    known = msgspec.structs.replace(trace.predictions[0], goals=(goal,))
    other = msgspec.structs.replace(trace, predictions=(known,), rollouts=())
    assert held.held_up
    assert decode(encode(other)) == other


def test_the_id_is_sixteen_hex_digits_of_the_content(trace: PlanTrace) -> None:
    assert len(trace.trace_id) == 16
    int(trace.trace_id, 16)
    assert decode(encode(trace)).trace_id == trace.trace_id
    other = msgspec.structs.replace(trace, decision=trace.decision + 1)
    assert other.trace_id != trace.trace_id


def test_what_is_too_large_is_not_read() -> None:
    with pytest.raises(TraceError, match=f"at most {MAX_BYTES}"):
        decode(b" " * (MAX_BYTES + 1))


@pytest.mark.parametrize("data", [b"", b"{", b"\xff", b"[]", b"null"])
def test_what_is_no_trace_is_not_read(data: bytes) -> None:
    with pytest.raises(TraceError, match="not a plan trace"):
        decode(data)


def test_another_schema_is_named(trace: PlanTrace) -> None:
    other = msgspec.structs.replace(trace, schema="xavi.plan_trace/3")
    with pytest.raises(TraceError, match=r"'xavi\.plan_trace/3'; this version reads"):
        decode(encode(other))


def test_whether_others_react_is_left_out_of_older_traces(trace: PlanTrace) -> None:
    assert b"reacting" not in encode(trace)
    now = msgspec.structs.replace(trace.settings, reacting=True)
    newer = decode(encode(msgspec.structs.replace(trace, settings=now)))
    assert newer.settings.reacting is True
    assert newer.trace_id != trace.trace_id


def test_a_trace_of_the_first_schema_is_read_and_keeps_its_name(trace: PlanTrace) -> None:
    plain = json.loads(encode(trace))
    del plain["road"]
    written = msgspec.json.encode({**plain, "schema": "xavi.plan_trace/1"})
    old = decode(written)
    assert old.road is None
    assert {track.lights for track in old.history.values()} == {()}
    assert encode(old) == written
    assert b"lights" not in written


@pytest.mark.parametrize("key", ["schema", "scene", "rollouts", "plan", "settings"])
def test_a_missing_key_is_named(trace: PlanTrace, key: str) -> None:
    plain = json.loads(encode(trace))
    del plain[key]
    with pytest.raises(TraceError, match=f"`{key}`"):
        decode(json.dumps(plain).encode())


def test_a_wrong_value_is_located(trace: PlanTrace) -> None:
    plain = json.loads(encode(trace))
    plain["rollouts"][3]["outcome"] = "arrived"
    with pytest.raises(TraceError, match=r"'arrived' - at `\$\.rollouts\[3\]\.outcome`"):
        decode(json.dumps(plain).encode())


def test_what_fits_stays_as_it_is(trace: PlanTrace) -> None:
    assert fitted(trace) is trace


def crowded(trace: PlanTrace, rollouts: int) -> PlanTrace:
    """The trace with many rollouts, each with a line of its own."""
    first = trace.rollouts[0]
    lines = [msgspec.structs.replace(first, index=k) for k in range(rollouts)]
    return msgspec.structs.replace(trace, rollouts=tuple(lines))


def bare(trace: PlanTrace) -> list[Rollout]:
    return [msgspec.structs.replace(r, path=None, speed=None) for r in trace.rollouts]


def test_what_does_not_fit_loses_the_lines_recorded_last(trace: PlanTrace) -> None:
    large = crowded(trace, 150)
    assert len(encode(large)) > ROOM
    small = fitted(large)
    assert ROOM - 5_000 < len(encode(small)) <= ROOM
    assert bare(small) == bare(large)
    assert small.rollouts[0] == large.rollouts[0]
    assert small.rollouts[-1].path is None
    for goal, before in zip(small.predictions[0].goals, trace.predictions[0].goals, strict=True):
        for way, known in zip(goal.trajectories, before.trajectories, strict=True):
            likely = before.probability * known.probability > max(IMPROBABLE)
            assert way == known if likely else way.path == ()


def test_in_a_great_crowd_the_past_of_who_is_not_predicted_goes_first(trace: PlanTrace) -> None:
    n = 45
    shown = (LightChange(2.0, ()), LightChange(3.0, ("left",)), LightChange(10.4, ("right",)))
    line = tuple((100.0 + k, 200.0) for k in range(n))
    track = Track(2.0, line, (0.0,) * n, tuple(float(k) for k in range(n)), shown)
    far = dict.fromkeys(range(2, 60), track)
    scene = trace.scene | dict.fromkeys(far, trace.scene[1])
    crowd = msgspec.structs.replace(trace, scene=scene, history=trace.history | far)
    large = crowded(crowd, 100)
    assert len(encode(large)) > ROOM
    small = fitted(large)
    assert len(encode(small)) <= ROOM
    assert small.history[0] == large.history[0]
    assert small.history[1] == large.history[1]
    assert small.history[30].start == pytest.approx(2.0 + 0.2 * (n - RECENT))
    assert small.history[30].speed == track.speed[-RECENT:]
    assert small.history[30].position == track.position[-RECENT:]
    assert [x.shown for x in small.history[30].lights] == [("left",), ("right",)]
    assert small.history[30].lights[0].time == small.history[30].start


def test_in_a_great_crowd_predictions_lose_their_lines_too(trace: PlanTrace) -> None:
    large = crowded(trace, 150)
    many = tuple(msgspec.structs.replace(trace.predictions[0], vehicle=k) for k in range(1, 120))
    small = fitted(msgspec.structs.replace(large, predictions=many))
    assert len(encode(small)) <= ROOM
    assert bare(small) == bare(large)
    for known, before in zip(small.predictions, many, strict=True):
        assert [goal.probability for goal in known.goals] == [
            goal.probability for goal in before.goals
        ]
        assert {way.path for goal in known.goals for way in goal.trajectories} == {()}


def test_the_id_does_not_depend_on_the_hash_seed(trace: PlanTrace, root: Path) -> None:
    program = (
        "from tests.planner.record.test_trace import decision; import sys;"
        "sys.stdout.write(decision().trace_id)"
    )
    found = set()
    for seed in ("0", "1"):
        environment = os.environ | {"PYTHONHASHSEED": seed, "PYTHONPATH": str(root)}
        done = subprocess.run(
            [sys.executable, "-c", program],
            cwd=root,
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        )
        found.add(done.stdout)
    assert found == {trace.trace_id}


HELD = {
    "vehicle": 99, "from": 2.0, "to": 4.0, "how": "leader", "speed_from": 8.0, "speed_to": 8.0
}  # fmt: skip


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (
            lambda t: {"history": {**t["history"], "1": {**t["history"]["1"], "speed": []}}},
            "the history of vehicle 1 has lists of different lengths, or is empty",
        ),
        (
            lambda t: {"predictions": [{**t["predictions"][0], "goals": []}]},
            "vehicle 1 has no goal, or one with no trajectory",
        ),
        (lambda t: {"predictions": []}, "samples what is not predicted"),
        (
            lambda t: {"road": {"places": {}, "priority": [{"vehicle": 7, "who": "ego"}]}},
            "vehicle 7 is on the road and not in the scene",
        ),
        (
            lambda t: {"scene": {k: v for k, v in t["scene"].items() if k != "0"}},
            "the ego, 0, is missing in `scene`",
        ),
        (
            lambda t: {"rollouts": [{**t["rollouts"][0], "collided_with": 99}]},
            "`collided_with` of rollout 0 names vehicle 99, which is not another one in `scene`",
        ),
        (
            lambda t: {"rollouts": [{**t["rollouts"][0], "collided_with": 0}]},
            "`collided_with` of rollout 0 names vehicle 0, which is not another one in `scene`",
        ),
        (
            lambda t: {"rollouts": [{**t["rollouts"][0], "held_up": [HELD]}]},
            "`held_up` of rollout 0 names vehicle 99, which is not another one in `scene`",
        ),
        (
            lambda t: {"predictions": [{**t["predictions"][0], "vehicle": 99}], "rollouts": []},
            "vehicle 99 in `predictions` is not another one in `scene`",
        ),
        (
            lambda t: {"settings": {**t["settings"], "rollouts": 2**31}},
            r"settings\.rollouts is 2147483648; give 0 to 10000",
        ),
        (
            lambda t: {"settings": {**t["settings"], "horizon": 0}},
            r"settings\.horizon is 0; give 1 to 600 s",
        ),
        (
            lambda t: {"settings": {**t["settings"], "horizon": 1e6}},
            r"settings\.horizon is 1000000; give 1 to 600 s",
        ),
        (
            lambda t: {"settings": {**t["settings"], "depth": 0}},
            r"settings\.depth is 0; give 1 to 100",
        ),
        (
            lambda t: {"settings": {**t["settings"], "rationality": -900.0}},
            r"settings\.rationality is -900; give 0 to 1000",
        ),
    ],
)
def test_a_trace_that_does_not_fit_together_is_refused(
    trace: PlanTrace, change: Callable[[dict[str, Any]], dict[str, Any]], fault: str
) -> None:
    known = json.loads(encode(trace))
    damaged = msgspec.json.encode({**known, **change(known)})
    with pytest.raises(TraceError, match=fault):
        decode(damaged)


def test_in_the_greatest_crowd_what_rollouts_came_to_stays_and_is_read(trace: PlanTrace) -> None:
    known = trace.predictions[0]
    crowd = range(1, 2 * CROWD + MOST + 1)
    samples = tuple(Sample(k, 0, 0) for k in crowd)
    rollouts = tuple(
        msgspec.structs.replace(rollout, samples=samples)
        for rollout in crowded(trace, 200).rollouts
    )
    scene, history = (
        {0: part[0]} | dict.fromkeys(crowd, part[1]) for part in (trace.scene, trace.history)
    )
    large = msgspec.structs.replace(
        trace,
        rollouts=rollouts,
        scene=scene,
        history=history,
        predictions=tuple(msgspec.structs.replace(known, vehicle=k) for k in crowd),
    )
    small = fitted(large)
    assert ROOM < len(encode(small)) <= MAX_BYTES
    assert bare(small) == bare(large)
    assert decode(encode(small)) == small
