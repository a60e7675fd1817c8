"""The library: rides as values that answer as `xavi ask` and the golden conversations do."""

import dataclasses
import gzip
import pickle
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import msgspec
import pytest

import xavi_dialogue as xavi
from planner.record.trace import encode
from sim.roads.netfile import read_network
from sim.setup.scenario import load as load_scenario
from tests.recording.test_player import recorded_in, ride_moments
from xavi_dialogue.cli.ask import ask_once
from xavi_dialogue.library import names
from xavi_dialogue.service.in_process import Conversation, make_pipeline, planner_for
from xavi_dialogue.storage import ride_file
from xavi_dialogue.transcripts.transcript import At, Exchange, read
from xavi_dialogue.vehicle.episode import clock

TRANSCRIPTS = Path(__file__).parents[2] / "transcripts"
S1 = TRANSCRIPTS / "rides" / "s1-0.ride.jsonl.gz"
WHY = "Why did you change left?"
ROADLESS = "To say that, I would have to plan again, and this record has no roads to plan on."
WHAT_IF = "What if vehicle 1 had not been there?"


@cache
def s1() -> xavi.Ride:
    """The recorded ride through s1."""
    return xavi.open(S1)


def test_to_import_it_loads_nothing_heavy() -> None:
    code = (
        "import sys, xavi_dialogue as xavi\n"
        "assert set(xavi.__all__) <= set(dir(xavi))\n"
        "heavy = {'numba', 'numpy', 'msgspec', 'libsumo', 'planner', 'xavi_dialogue.library'}\n"
        "sys.exit(', '.join(heavy & sys.modules.keys()) or None)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_every_public_name_is_there_and_no_other() -> None:
    assert set(names.__all__) | {"__version__"} == set(xavi.__all__)
    assert all(getattr(xavi, name) is not None for name in xavi.__all__)
    with pytest.raises(AttributeError, match="'recall'"):
        xavi.recall  # noqa: B018


@pytest.mark.parametrize("name", ["s1", "s1-alternatives", "s2", "s4-gap"])
def test_a_conversation_is_the_golden_one(name: str) -> None:
    transcript = read((TRANSCRIPTS / f"{name}.txt").read_text(encoding="utf-8"))
    ride = f"{transcript.get('scenario')}-{transcript.get('seed')}.ride.jsonl.gz"
    conversation = xavi.open(TRANSCRIPTS / "rides" / ride).conversation()
    at, asked = None, 0
    for step in transcript.steps:
        match step:
            case At(time):
                at = time
            case Exchange(question, reply):
                found = conversation.ask(question, at)
                assert (question, found.text) == (question, reply)
                asked += 1
    assert asked == len(conversation.answers) > 3


def test_an_answer_is_a_frozen_value() -> None:
    found = s1().ask(WHY)
    assert found == s1().ask(WHY)
    assert str(found) == found.text
    assert found.text.startswith("I moved to the left lane, because I expected the blue car")
    assert (found.question, found.at, found.kind, found.reason) == (WHY, 6.0, "answer", None)
    assert [one["is"] for one in found.content] == ["ChoiceReason"]
    assert [one["is"] for one in found.meaning] == ["GroundedAct"]
    assert found.explanation is not None
    assert found.explanation["causes"][0]["vehicle"] == 1
    assert found.evidence.method == "tree"
    assert found.evidence.rollouts > 0
    assert found.suggestions
    assert found.decision in s1().decisions
    assert found.decision is not None
    assert found.evidence.traces == (found.decision.trace_id,)
    with pytest.raises(dataclasses.FrozenInstanceError):
        found.text = "otherwise"  # type: ignore[misc]


def test_values_can_be_collected_in_sets() -> None:
    decision = s1().decisions[3]
    for value, same in (
        (s1().ask(WHY), s1().ask(WHY)),
        (decision, xavi.Decision.from_json(decision.json())),
        (decision.options[0], xavi.Decision.from_json(decision.json()).options[0]),
        (s1().report(6.0), s1().report(6.0)),
    ):
        assert value is not same
        assert value == same
        assert len({value, same}) == 1
    assert len(set(s1().decisions)) == len(s1().decisions)


def test_rides_and_conversations_can_be_pickled() -> None:
    ride = xavi.open(S1)
    conversation = ride.conversation()
    conversation.ask(WHY, at=8.0)
    again, follow_up = pickle.loads(pickle.dumps((ride, conversation)))
    assert again.record == ride.record
    assert again.report(6.0) == ride.report(6.0)
    again.record.whatifs.clear()  # so that it plans again
    assert again.ask(WHAT_IF) == ride.ask(WHAT_IF)
    assert again.record.whatifs
    text = "and if it had not been there?"
    assert follow_up.ask(text) == conversation.ask(text)
    assert follow_up.answers == conversation.answers


def test_a_refusal_is_a_value_with_its_reason() -> None:
    for question, reason in (
        ("Why did you stop?", "did-not-happen"),
        ("asdf qwer", "not-understood"),
    ):
        found = s1().ask(question)
        assert (found.kind, found.reason) == ("refusal", reason), found.text
        assert found.text


def test_each_question_of_a_ride_stands_alone_and_those_of_a_conversation_do_not() -> None:
    conversation = s1().conversation()
    first = conversation.ask(WHY, at=8.0)
    follow_up = conversation.ask("and if it had not been there?")
    assert follow_up.at == 8.0
    assert follow_up.text == "Without the blue car, I would have stayed in my lane instead."
    assert conversation.answers == (first, follow_up)
    assert s1().ask("and if it had not been there?", at=8.0).text != follow_up.text


def test_a_moment_knows_nothing_of_later_ones() -> None:
    early = s1().ask(WHY, at=1.0)
    assert (early.kind, early.reason) == ("refusal", "did-not-happen")
    assert s1().ask("What are you doing?", at=1e9).at == s1().end
    conversation = s1().conversation()
    conversation.ask(WHY, at=8.0)
    assert conversation.ask(WHY, at=1.0).reason == "did-not-happen"


def test_decisions_tell_what_was_weighed_and_believed() -> None:
    decision = next(one for one in s1().decisions if one.plan[0] == "change-left")
    assert decision.time == decision.trace.sim_time == 3.0
    assert decision == s1().decisions[decision.number]
    values = [one.value for one in decision.options]
    assert values == sorted(values, reverse=True)
    assert [one.action for one in decision.options if one.chosen] == ["change-left"]
    assert sum(decision.options[0].chances.values()) == pytest.approx(1.0, abs=1e-5)
    options = [option for one in s1().decisions for option in one.options]
    assert all(0.0 < chance <= 1.0 for one in options for chance in one.chances.values())
    assert decision.ruled_out["change-right"] == "there is no lane to the right"
    by_vehicle: dict[int, float] = {}
    for one in decision.beliefs:
        by_vehicle[one.vehicle] = by_vehicle.get(one.vehicle, 0.0) + one.probability
    assert by_vehicle.keys() == {one.vehicle for one in decision.trace.predictions}
    assert all(total == pytest.approx(1.0, abs=1e-3) for total in by_vehicle.values())
    assert decision.beliefs[0].place == "the road to the right"


def test_a_saved_ride_has_its_events_and_a_scene_for_each_decision() -> None:
    assert [one.time for one in s1().scenes] == [one.time for one in s1().decisions]
    assert s1().scenes[0].ego.speed > 0.0
    assert [e.sim_time for e in s1().events if e.kind == "arrived"] == [s1().end]
    assert repr(s1()) == "<Ride s1, seed 0: 19 decisions, 19 s>"


def test_values_are_short_where_a_terminal_shows_them() -> None:
    found = s1().ask(WHY)
    assert repr(found) == (
        f"Answer(question={WHY!r}, at=6.0, text={found.text!r}, kind='answer', reason=None)"
    )
    conversation = s1().conversation()
    assert repr(conversation) == "<Conversation about s1, seed 0: 0 answers>"
    conversation.ask(WHY)
    assert repr(conversation) == "<Conversation about s1, seed 0: 1 answers>"
    begun = repr(s1().events[0])
    assert begun.startswith("Event(kind='action-started', sim_time=0.0, action='continue'")
    assert "UNSET" not in begun


def test_conversations_and_reports_show_themselves() -> None:
    conversation = s1().conversation()
    assert conversation._repr_html_() == "<p>Conversation about s1, seed 0: 0 answers</p>"
    asked = [conversation.ask(text)._repr_html_() for text in (WHY, "why?")]
    assert conversation._repr_html_() == "".join(asked)
    report = s1().report(at=6.0)
    shown = report._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!doctype html&gt;')
    assert "<html" not in shown
    assert shown.count('"') == 4


def test_tables_have_a_number_for_every_outcome_and_what_kept_the_car() -> None:
    options = s1().table("options")
    chances = options[[name for name in options if name.startswith("p_")]]
    assert list(chances) == ["p_done", "p_collision", "p_termination", "p_dead"]
    assert not chances.isna().any().any()
    assert chances.sum(axis=1).to_numpy() == pytest.approx(1.0, abs=1e-5)
    events = s1().table("events")
    assert list(events[events["event"] == "restrained"]["by"]) == ["nothing", "limit"]
    assert [str(events[name].dtype) for name in ("decision", "vehicle")] == ["Int64", "Int64"]


def test_html_escapes_what_was_typed_and_what_was_said() -> None:
    evil = "<script>alert(1)</script>"
    found = s1().ask(f"{WHY} {evil}")
    shown = dataclasses.replace(found, text=evil, suggestions=(evil,))._repr_html_()
    assert shown.count("&lt;script&gt;") == 3
    assert "<script" not in shown
    decision = s1().decisions[0]
    belief = dataclasses.replace(decision.beliefs[0], place=evil)
    altered = dataclasses.replace(decision)
    altered.__dict__["beliefs"] = (belief,)
    assert "<script" not in altered._repr_html_()
    assert "&lt;script&gt;" in altered._repr_html_()


def test_what_is_saved_is_the_ride_with_what_was_planned_again(tmp_path: Path) -> None:
    ride = xavi.open(S1)
    ride.record.whatifs.clear()
    found = ride.ask(WHAT_IF)
    planned = dict(ride.record.whatifs)
    assert planned
    file = ride.save(tmp_path / "mine")
    assert file == tmp_path / "mine.ride.jsonl.gz"
    again = xavi.open(tmp_path / "mine")
    assert again.record == ride.record
    assert again.ask(WHAT_IF) == found == s1().ask(WHAT_IF)


def test_without_its_roads_a_ride_answers_from_its_record_alone(tmp_path: Path) -> None:
    ride = ride_file.load(S1.read_bytes())
    ride.scenario, ride.whatifs = "elsewhere", {}
    ride_file.save(ride, tmp_path / "mine.ride.jsonl.gz")
    alone = xavi.open(tmp_path / "mine.ride.jsonl.gz")
    assert alone.ask("What are you doing?").kind == "answer"
    found = alone.ask("What if vehicle 2 had not been there?")
    assert (found.kind, found.reason) == ("refusal", "planner-unavailable")
    assert found.text == ROADLESS
    named = xavi.open(tmp_path / "mine.ride.jsonl.gz", scenario="s1")
    assert named.ask("What if vehicle 2 had not been there?").kind == "answer"
    with pytest.raises(xavi.XaviError, match=r"s2 has other roads .* name its own scenario"):
        xavi.open(tmp_path / "mine.ride.jsonl.gz", scenario="s2")


def test_a_recording_answers_as_its_ride_did(tmp_path: Path) -> None:
    moments = tuple(ride_moments(ride_file.load(S1.read_bytes())))
    network = load_scenario("s1").network
    recorded_in(tmp_path / "ride.mcap", iter(moments), network)
    ride = xavi.open(tmp_path / "ride.mcap")
    assert (ride.scenario, ride.seed) == ("s1", 4)  # as the car reported
    assert [one.time for one in ride.scenes] == [clock(moment) for moment in moments]
    assert [one.trace for one in ride.decisions] == [m.trace for m in moments if m.trace]
    assert list(ride.events) == [event for moment in moments for event in moment.events]
    for question, at in ((WHY, 6.0), (WHAT_IF, 6.0), ("What are you doing?", 2.0)):
        driven = Conversation(make_pipeline(), planner_for(read_network(network)))
        for moment in moments:
            if clock(moment) <= at:
                driven.record(moment)
        assert ride.ask(question, at).text == driven.ask(question, at).text


def test_of_a_recording_that_is_cut_off_the_rest_is_opened_with_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    recorded_in(path, ride_moments(ride_file.load(S1.read_bytes())))
    path.write_bytes(path.read_bytes()[:-30])
    with pytest.warns(UserWarning, match=r"ride\.mcap: it was cut off"):
        ride = xavi.open(path)
    assert ride.decisions


@pytest.mark.parametrize(
    ("name", "data", "told"),
    [
        ("gone", None, r"cannot read .*gone\.ride\.jsonl\.gz: No such file .*; give a file that"),
        ("text.ride.jsonl.gz", b"hello", r"text\.ride\.jsonl\.gz: not a recorded ride.* give a"),
        ("other.gz", gzip.compress(b"{}\n", mtime=0), "names no scenario, seed, halt; give a file"),
        ("ride.mcap", b"hello", r"ride\.mcap is not an MCAP file"),
        ("gone.mcap", None, r"cannot read .*gone\.mcap"),
        ("noending", b"", r"noending: the file is empty; give a file"),
        (".", None, r"cannot read .*: Is a directory; give a file"),
    ],
)
def test_what_cannot_be_opened_is_told_with_its_name(
    tmp_path: Path, name: str, data: bytes | None, told: str
) -> None:
    if data is not None:
        (tmp_path / name).write_bytes(data)
    with pytest.raises(xavi.XaviError, match=told):
        xavi.open(tmp_path / name)


def test_a_saved_ride_is_opened_by_its_content_and_of_its_car_alone(tmp_path: Path) -> None:
    (tmp_path / "mine").write_bytes(S1.read_bytes())
    assert xavi.open(tmp_path / "mine", car="car").decisions
    with pytest.raises(xavi.XaviError, match=r"mine is a ride of 'car', not of 'other'"):
        xavi.open(tmp_path / "mine", car="other")


def test_wrong_arguments_are_told_with_what_is_right() -> None:
    with pytest.raises(
        xavi.XaviError, match=r"at is -1; give a time \[s or m:ss\] of the ride, 0 to 19"
    ):
        s1().ask(WHY, at=-1)
    with pytest.raises(xavi.XaviError, match="at is nan"):
        s1().ask(WHY, at=float("nan"))
    for at in ("tea", True, [8]):
        with pytest.raises(xavi.XaviError, match=r"at is .*; give a time \[s or m:ss\] of the"):
            s1().ask(WHY, at=at)  # type: ignore[arg-type]
    for at in (-5.0, float("nan"), "tea"):
        with pytest.raises(xavi.XaviError, match=r"at is .*; give a time \[s or m:ss\] of the"):
            s1().map(at=at)  # type: ignore[arg-type]
    with pytest.raises(xavi.XaviError, match="the question is None; give a text"):
        s1().ask(None)  # type: ignore[arg-type]
    with pytest.raises(xavi.XaviError, match=r"no style 'rude'; use one of .*'paper'"):
        s1().conversation(style="rude")  # type: ignore[arg-type]
    for seed in (-1, "a", 1.5, True):
        with pytest.raises(xavi.XaviError, match=r"seed is .*; give a whole number from 0"):
            xavi.drive("s1", seed=seed)  # type: ignore[arg-type]
    for duration in (0.0, -1.0, float("nan"), "9"):
        with pytest.raises(xavi.XaviError, match=r"duration is .*; give seconds greater than 0"):
            xavi.drive("s1", duration=duration)  # type: ignore[arg-type]
    with pytest.raises(xavi.XaviError, match="there is no scenario 'nowhere'; those that exist"):
        xavi.drive("nowhere")
    with pytest.raises(xavi.XaviError, match="scenario is None; give the name of one, or the path"):
        xavi.drive(None)  # type: ignore[arg-type]
    with pytest.raises(xavi.XaviError, match="vehicle is '1'; give its number, such as 1"):
        s1().curves("1")  # type: ignore[arg-type]
    planned = s1().decisions[0].planned
    assert planned is not None
    for time in (float("nan"), "8"):
        with pytest.raises(xavi.XaviError, match=r"time is .*; give a time \[s\]"):
            planned.at(time)  # type: ignore[arg-type]
    assert planned.at(float("inf")) is planned.at(-1.0) is None


@pytest.mark.parametrize("path", [None, 0, "", "a\0b", "\ud800", ["s1"]])
def test_what_is_no_path_is_told(path: object) -> None:
    for use in (xavi.open, s1().save, s1().map().save, s1().report(6.0).save):
        with pytest.raises(xavi.XaviError, match=r"path is .*; give the path of a file"):
            use(path)  # type: ignore[operator]


def test_a_path_that_no_file_can_have_is_told(tmp_path: Path) -> None:
    name = "a" * 5000
    for what, use in (
        ("cannot read", lambda: xavi.open(name)),
        ("cannot read", lambda: xavi.open(S1, scenario=name)),
        ("cannot read", lambda: xavi.drive(name)),
        ("cannot write", lambda: s1().save(name)),
        ("there is no scenario", lambda: xavi.drive("~who-is-not-there/x")),
    ):
        with pytest.raises(xavi.XaviError, match=what):
            use()
    ride = ride_file.load(S1.read_bytes())
    ride.scenario = name[:4000]
    ride_file.save(ride, tmp_path / "mine.ride.jsonl.gz")
    assert xavi.open(tmp_path / "mine").network is None


def test_a_folder_without_a_name_is_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for path in (".", "/"):
        with pytest.raises(xavi.XaviError, match=r"cannot read .*: Is a directory"):
            xavi.open(path)
        with pytest.raises(xavi.XaviError, match=r"cannot write .*: Is a directory"):
            s1().save(path)


@pytest.mark.parametrize(
    "wrong",
    [
        {"endpoint": 5}, {"vehicle": None}, {"session": 5}, {"zenoh": 5},
        {"patience": "x"}, {"patience": float("nan")}, {"patience": -1.0},
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_connection_is_told_at_once(wrong: dict[str, Any]) -> None:
    ((name, _),) = wrong.items()
    with pytest.raises(xavi.XaviError, match=f"^{name} is .*; give "):
        xavi.connect(**wrong)


@pytest.mark.slow
def test_a_ride_that_is_driven_answers_as_xavi_ask_does() -> None:
    ride = xavi.drive("s1", seed=3)
    scenario = load_scenario("s1", 3)
    for question, at in ((WHY, None), ("What are you doing?", 2.5), (WHAT_IF, 5.0)):
        said = ask_once(scenario, question, at)
        found = ride.ask(question, at)
        assert (found.text, found.at) == (said.text, said.sim_time)
        assert (found.content, found.explanation) == (said.answers, said.explanation)
    assert ride.scenes[1].time - ride.scenes[0].time == pytest.approx(scenario.step)
    assert ride.end == ride.record.ended


def test_plan_traces_of_any_planner_are_a_ride_of_decisions(tmp_path: Path) -> None:
    kept = s1().record.traces[:5]
    file = tmp_path / "mine.jsonl"
    file.write_bytes(b"\n".join(map(encode, kept)))
    ride = xavi.open(file)
    assert [one.time for one in ride.decisions] == [trace.sim_time for trace in kept]
    why = "Why are you changing left?"
    assert ride.ask(why, at=3.0).text == s1().ask(why, at=3.0).text
    refused = ride.ask("What if vehicle 1 were not there?", at=3.0)
    assert refused.reason == "planner-unavailable"
    planned = xavi.open(file, scenario="s1").ask("What if vehicle 1 were not there?", at=3.0)
    assert planned.kind == "answer"


def test_a_decision_goes_to_json_and_back(tmp_path: Path) -> None:
    decision = s1().decisions[3]
    text = decision.json()
    assert "\n" not in text
    again = xavi.Decision.from_json(text)
    assert again == decision
    assert xavi.Decision.from_json(text.encode()).trace_id == decision.trace_id
    file = tmp_path / "traces.jsonl"
    file.write_text("\n".join(one.json() for one in s1().decisions), encoding="utf-8")
    assert xavi.open(file).decisions == s1().decisions


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("hello", "not a plan trace"),
        ("{}", "not a plan trace: Object missing required field `schema`"),
        ("\ud800", "not a plan trace"),
        (b"\xff", "not a plan trace"),
        (None, "give JSON as a text, not NoneType"),
    ],
)
def test_what_is_no_decision_is_told(text: str, told: str) -> None:
    with pytest.raises(xavi.XaviError, match=told):
        xavi.Decision.from_json(text)


def test_without_predictions_what_a_vehicle_does_is_given_no_chance(tmp_path: Path) -> None:
    trace = s1().record.traces[3]
    blind = tuple(msgspec.structs.replace(one, samples=()) for one in trace.rollouts)
    bare = msgspec.structs.replace(trace, predictions=(), rollouts=blind)
    file = tmp_path / "bare.json"
    file.write_bytes(encode(bare))
    told = xavi.open(file).ask("Why are you changing left?").text
    assert "(vehicle 1) to slow down to about 13 km/h; staying in my lane would cost us" in told


def test_a_saved_ride_that_was_unpacked_keeps_its_events(tmp_path: Path) -> None:
    file = tmp_path / "s1.jsonl"
    file.write_bytes(gzip.decompress(S1.read_bytes()))
    assert xavi.open(file).events == s1().events


def test_what_holds_no_trace_is_no_ride(tmp_path: Path) -> None:
    file = tmp_path / "mine.json"
    file.write_text("{}", encoding="utf-8")
    with pytest.raises(xavi.XaviError, match=r"mine\.json: not a plan trace.*or plan traces"):
        xavi.open(file)


def test_times_are_given_as_they_are_written() -> None:
    assert s1().ask(WHY, at="0:06") == s1().ask(WHY, at=6.0)
    assert s1().map(at="0:06").caption == s1().map(at=6.0).caption


def test_files_are_what_their_names_say(tmp_path: Path) -> None:
    report = s1().report(at=6.0)
    assert report.save(tmp_path / "report.json").read_text("utf-8") == report.json()
    assert report.save(tmp_path / "report.html").read_text("utf-8") == report.html()
    with pytest.raises(xavi.XaviError, match=r"end it with \.html or \.json"):
        report.save(tmp_path / "report.pdf")
    with pytest.raises(xavi.XaviError, match="pictures are written as SVG"):
        s1().map().save(tmp_path / "map.png")


def test_a_conversation_of_several_threads_is_refused() -> None:
    conversation = s1().conversation()
    taken = conversation._free.pop()
    with pytest.raises(xavi.XaviError, match="one question at a time"):
        conversation.ask(WHY)
    conversation._free.append(taken)
    assert conversation.ask(WHY).kind == "answer"
