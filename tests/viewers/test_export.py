"""Rides for viewers, read with the reader of the schemas' own package."""

import json
import math
from collections import defaultdict
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from typer.testing import CliRunner

import xavi_dialogue as xavi
from sim.roads.netfile import read_network
from sim.scene import Light, LightState, PersonState, Scene, Signal, VehicleState
from sim.setup.scenario import load as load_scenario
from tests.recording.test_player import recorded_in, ride_moments
from xavi_dialogue.__main__ import app
from xavi_dialogue.library.trajectories import Trajectory
from xavi_dialogue.storage.recording_format import FileThere, Unwritable
from xavi_dialogue.viewers import drawing, export, motion

S1 = Path(__file__).parents[2] / "transcripts" / "rides" / "s1-0.ride.jsonl.gz"
WHY = "Why did you change left?"
SCHEMAS = {
    "/roads": "foxglove.SceneUpdate",
    "/vehicles": "foxglove.SceneUpdate",
    "/beliefs": "foxglove.SceneUpdate",
    "/ghost": "foxglove.SceneUpdate",
    "/plan": "foxglove.PosesInFrame",
    "/log": "foxglove.Log",
    "/tf": "foxglove.FrameTransform",
    "/odometry": "foxglove.Odometry",
}


@cache
def s1() -> xavi.Ride:
    return xavi.open(S1)


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("viewers") / "s1.mcap"
    export.export(s1(), export.ExportOptions(S1, target, (WHY,)))
    return target


def messages(path: Path) -> dict[str, list[tuple[float, Any]]]:
    """Every message of the standard schemas by topic, with its time [s]."""
    found = defaultdict(list)
    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in reader.iter_decoded_messages(topics=[*SCHEMAS]):
            assert schema is not None
            assert schema.name == SCHEMAS[channel.topic]
            found[channel.topic].append((message.log_time / 1e9, decoded))
    return found


def texts(entity: Any) -> list[str]:
    return [one.text for one in entity.texts]


def test_the_foreign_reader_reads_every_topic(exported: Path) -> None:
    found = messages(exported)
    assert found.keys() == SCHEMAS.keys()
    assert len(found["/roads"]) == 1
    decisions = len(s1().decisions)
    assert (len(found["/plan"]), len(found["/beliefs"])) == (decisions, decisions)
    moments = [time for time, _ in found["/tf"]]
    assert moments == sorted(moments)
    assert max(b - a for a, b in pairwise(moments)) <= 0.21
    assert moments[-1] == pytest.approx(s1().scenes[-1].time)


def test_vehicles_stand_where_they_were_in_their_size_and_colour(exported: Path) -> None:
    scene = next(one for one in s1().scenes if one.time == 5.0)
    shown = dict(messages(exported)["/vehicles"])[5.0]
    entities = {one.id: one for one in shown.entities}
    assert entities.keys() == {f"user {who}" for who in scene.vehicles}
    car = scene.vehicles[1]
    [cube] = entities["user 1"].cubes
    assert (cube.size.x, cube.size.y) == (car.length, car.width)
    assert cube.color.b > cube.color.r  # it is blue
    front_x = cube.pose.position.x + car.length / 2.0 * math.cos(car.heading)
    front_y = cube.pose.position.y + car.length / 2.0 * math.sin(car.heading)
    assert (front_x, front_y) == pytest.approx(car.position)
    assert texts(entities["user 1"]) == [f"car 1, {car.speed * 3.6:.0f} km/h"]


def test_our_own_frame_goes_with_us(exported: Path) -> None:
    scene = next(one for one in s1().scenes if one.time == 5.0)
    found = messages(exported)
    frame = dict(found["/tf"])[5.0]
    assert (frame.parent_frame_id, frame.child_frame_id) == ("map", "car")
    heading = 2.0 * math.atan2(frame.rotation.z, frame.rotation.w)
    assert heading == pytest.approx(scene.ego.heading)
    back = math.dist((frame.translation.x, frame.translation.y), scene.ego.position)
    assert back == pytest.approx(scene.ego.length / 2.0)
    assert dict(found["/odometry"])[5.0].linear_velocity.x == scene.ego.speed


def test_the_road_covers_the_way_that_we_drove(exported: Path) -> None:
    [(_, shown)] = messages(exported)["/roads"]
    corners = [p for part in shown.entities[0].triangles for p in part.points]
    for scene in s1().scenes:
        x, y = scene.ego.position
        assert min(c.x for c in corners) <= x <= max(c.x for c in corners)
        assert min(c.y for c in corners) <= y <= max(c.y for c in corners)
    assert len(shown.entities[0].lines) > 4


def test_beliefs_fade_along_their_paths_and_with_their_chance(exported: Path) -> None:
    decision = s1().decisions[3]
    shown = dict(messages(exported)["/beliefs"])[decision.time]
    entity = next(one for one in shown.entities if one.id == "belief 1")
    best = max(entity.lines, key=lambda one: one.colors[0].a)
    opacity = [one.a for one in best.colors]
    assert len(opacity) == len(best.points) > 2
    assert opacity == sorted(opacity, reverse=True)
    assert opacity[0] == pytest.approx(decision.beliefs[0].probability, abs=0.05)
    assert any(text.startswith(decision.beliefs[0].place) for text in texts(entity))


def test_the_plan_is_the_path_of_the_decision(exported: Path) -> None:
    decision = s1().decisions[3]
    shown = dict(messages(exported)["/plan"])[decision.time]
    assert decision.planned is not None
    path = [(pose.position.x, pose.position.y) for pose in shown.poses]
    assert path == list(decision.planned.points)


def test_the_ghost_of_an_answer_drives_what_was_not_done(exported: Path) -> None:
    answer = s1().ask(WHY)
    assert answer.ghost is not None
    found = dict(messages(exported)["/ghost"])
    assert not found[1.0].entities  # before the decision
    [shown] = found[5.0].entities
    assert texts(shown) == [f"instead: {WHY}"]
    ghost, ours = shown.cubes[0], dict(messages(exported)["/vehicles"])[5.0].entities[0].cubes[0]
    assert ghost.color.a < 1.0
    assert str(ghost.size) == str(ours.size)
    assert abs(ghost.pose.position.y - ours.pose.position.y) > 2.0  # in the other lane
    at = answer.ghost.at(5.0)
    assert at is not None
    assert ghost.pose.position.y == pytest.approx(at[1], abs=0.1)


def test_the_log_tells_decisions_events_and_answers(exported: Path) -> None:
    told = [(one.name, one.message) for _, one in messages(exported)["/log"]]
    answer = s1().ask(WHY)
    assert ("question", WHY) in told
    assert ("answer", answer.text) in told
    assert ("decision", "move to the left lane") in told
    assert ("event", "I change to the left lane.") in told


def test_the_same_ride_gives_the_same_bytes(exported: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.mcap"
    export.export(s1(), export.ExportOptions(S1, again, (WHY,)))
    assert again.read_bytes() == exported.read_bytes()


def test_our_own_messages_stay_beside_those_for_viewers(tmp_path: Path) -> None:
    source, target = tmp_path / "ride.mcap", tmp_path / "out.mcap"
    recorded_in(source, ride_moments(s1().record), load_scenario("s1").network)
    ride = xavi.open(source)
    told = export.export(ride, export.ExportOptions(source, target)).messages
    assert told["xavi/v1/car/trace"] == len(ride.decisions)
    assert told["/vehicles"] >= len(ride.decisions)
    again = xavi.open(target)
    assert again.decisions == ride.decisions
    assert again.scenes == ride.scenes
    assert again.network == ride.network
    assert again.ask(WHY).text == ride.ask(WHY).text


def test_lights_stand_where_their_lanes_end_and_leave_with_the_view() -> None:
    network = read_network(load_scenario("junction").network)
    link = next(one for one in network.links if isinstance(one.control, Signal))
    assert isinstance(link.control, Signal)
    car = VehicleState((0.0, 0.0), 0.0, 3.0, 0.0, 4.5, 1.8)
    red = Light(link.control, LightState.RED, 0.0, change_seen=False)
    before = Scene(1.0, {0: car}, (red,))
    [shown] = drawing.lights(before, network, None).entities
    ends = [network.lanes[one.from_lane].centreline[-1] for one in network.signalled(link.control)]
    assert (shown.spheres[0].pose.position.x, shown.spheres[0].pose.position.y) in ends
    assert shown.spheres[0].color.r > shown.spheres[0].color.g
    gone = drawing.lights(Scene(2.0, {0: car}), network, before)
    assert [one.id for one in gone.deletions] == [shown.id]


def test_who_has_left_the_view_is_removed() -> None:
    car = VehicleState((0.0, 0.0), 0.0, 3.0, 0.0, 4.5, 1.8)
    walker = PersonState((9.0, 0.0), 0.0, 1.0, 0.3, 0.5)
    before = Scene(1.0, {0: car, 2: car}, people={3: walker})
    shown: SceneUpdate = drawing.vehicles(Scene(2.0, {0: car}), before)
    assert sorted(one.id for one in shown.deletions) == ["user 2", "user 3"]
    assert [one.id for one in shown.entities] == ["user 0"]


def test_a_ghost_that_stands_looks_where_it_came_from() -> None:
    still = Trajectory(0.0, 1.0, ((0.0, 0.0), (0.0, 5.0), (0.0, 5.0)), (5.0, 5.0, 0.0), "done", 1.0)
    car = VehicleState((0.0, 0.0), 0.0, 0.0, 0.0, 4.0, 1.8)
    [shown] = drawing.ghost("ghost", still, 2.0, car).entities
    [cube] = shown.cubes
    assert (cube.pose.position.x, cube.pose.position.y) == pytest.approx((0.0, 3.0))


def test_scenes_between_decisions_lie_on_the_way_that_was_recorded() -> None:
    scenes = list(motion.scenes(s1()))
    assert len(scenes) > 4 * len(s1().decisions)
    for before, after in pairwise(scenes):
        moved = math.dist(before.ego.position, after.ego.position)
        assert moved == pytest.approx(before.ego.speed * (after.time - before.time), abs=0.5)


def panels(node: Any) -> set[str]:
    return {node} if isinstance(node, str) else panels(node["first"]) | panels(node["second"])


def test_the_layout_shows_topics_that_there_are() -> None:
    layout = json.loads(export.layout())
    assert panels(layout["layout"]) == set(layout["configById"])
    shown = set(layout["configById"]["3D!xavi"]["topics"])
    assert shown | {export.FRAMES, export.LOG} == {*SCHEMAS, export.LIGHTS}
    assert layout["configById"]["3D!xavi"]["followTf"] == "car"
    assert layout["configById"]["RosOut!xavi"]["topicToRender"] == export.LOG


def test_the_command_writes_both_files_and_overwrites_none(tmp_path: Path) -> None:
    out, layout = tmp_path / "out.mcap", tmp_path / "layout.json"
    command = ["export", str(S1), str(out), "--layout", str(layout)]
    done = CliRunner().invoke(app, command)
    assert done.exit_code == 0, done.output
    assert "/vehicles" in done.stdout
    assert layout.read_bytes() == export.layout()
    assert CliRunner().invoke(app, command).exit_code == 2
    assert CliRunner().invoke(app, [*command, "--force"]).exit_code == 0


@pytest.mark.parametrize(
    ("asked", "status", "told"),
    [
        (("foo bar baz",), 4, ("no /ghost for 'foo bar baz': I am sorry, I did not get",)),
        (("Why did you stop?", WHY), 3, ("no /ghost for 'Why did you stop?': ",)),
        (("What are you doing?",), 0, ("no /ghost for 'What are you doing?': ",)),
        ((WHY, "--at", "99"), 0, ("99 s is after the end: what was asked is asked at 19 s",)),
        ((WHY, "--at", "19"), 0, ()),
        (("--at", "99"), 0, ()),
    ],
)
def test_what_is_not_shown_of_a_question_is_told(
    asked: tuple[str, ...], status: int, told: tuple[str, ...], tmp_path: Path
) -> None:
    options = [part for one in asked for part in (("--ask", one) if " " in one else (one,))]
    done = CliRunner().invoke(app, ["export", str(S1), str(tmp_path / "out.mcap"), *options])
    assert done.exit_code == status
    assert (tmp_path / "out.mcap").exists()
    notes = done.stderr.splitlines()
    assert len(notes) == len(told)
    for note, begin in zip(notes, told, strict=True):
        assert note.startswith(f"xavi: {begin}")


@pytest.mark.parametrize("kept", [0.05, 0.5, 0.99])
def test_an_export_that_is_cut_off_is_told_to_be_one(
    kept: float, exported: Path, tmp_path: Path
) -> None:
    whole, cut = exported.read_bytes(), tmp_path / "cut.mcap"
    cut.write_bytes(whole[: int(kept * len(whole))])
    told = r"cut off .*; it is an export for viewers: give the ride that it was made of"
    with pytest.raises(xavi.XaviError, match=told):
        xavi.open(cut)


def test_a_ride_is_not_written_over_nor_two_files_into_one(tmp_path: Path) -> None:
    ride = tmp_path / "mine.ride.jsonl.gz"
    ride.write_bytes(S1.read_bytes())
    (tmp_path / "link").symlink_to(ride)
    for source, target in ((ride, ride), (tmp_path / "mine", ride), (ride, tmp_path / "link")):
        done = CliRunner().invoke(app, ["export", str(source), str(target), "--force"])
        assert done.exit_code == 1
        assert "is the ride itself; give another file to write" in done.stderr
    out = str(tmp_path / "out.mcap")
    done = CliRunner().invoke(app, ["export", str(ride), out, "--layout", out])
    assert done.exit_code == 1
    assert not Path(out).exists()
    assert ride.read_bytes() == S1.read_bytes()


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "is not an MCAP file"),
        (b"\x89PNG\r\n\x1a\n", "is not an MCAP file"),
        (S1.read_bytes(), "is not an MCAP file"),
    ],
)
def test_what_is_no_recording_is_not_exported(data: bytes, told: str, tmp_path: Path) -> None:
    foreign, out = tmp_path / "foreign.mcap", tmp_path / "out.mcap"
    foreign.write_bytes(data)
    done = CliRunner().invoke(app, ["export", str(foreign), str(out)])
    assert (done.exit_code, out.exists()) == (2, False)
    assert told in done.stderr


def test_a_recording_that_was_cut_off_or_spoilt_is_not_exported(
    exported: Path, tmp_path: Path
) -> None:
    whole, out = exported.read_bytes(), tmp_path / "out.mcap"
    spoilt = bytearray(whole)
    spoilt[len(whole) // 2] ^= 0xFF
    for data in (whole[: len(whole) // 2], whole[:60], bytes(spoilt)):
        (tmp_path / "bad.mcap").write_bytes(data)
        done = CliRunner().invoke(app, ["export", str(tmp_path / "bad.mcap"), str(out)])
        assert (done.exit_code, out.exists()) == (2, False)
        assert "bad.mcap" in done.stderr


def test_an_export_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    for target in (tmp_path / "nowhere" / "out.mcap", Path("/proc/out.mcap")):
        done = CliRunner().invoke(app, ["export", str(S1), str(target)])
        assert done.exit_code == 1
        assert f"cannot write {target}" in done.stderr


def test_a_layout_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "there").touch()
    with pytest.raises(FileThere, match="--force"):
        export.write_layout(tmp_path / "there")
    with pytest.raises(Unwritable, match="cannot write"):
        export.write_layout(tmp_path / "nowhere" / "layout.json")
