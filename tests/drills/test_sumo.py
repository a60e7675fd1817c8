"""Rides that end badly: the ego is run into, or SUMO itself gives up."""

import shutil
from pathlib import Path

from tests.drills.processes import PATIENCE, Crew, until
from tests.drills.stage import WHERE, staged

# A queue that stands where nobody stood before, the ego in its midst.
QUEUE = "".join(
    f"""
    <vehicle id="{number}" type="car" depart="5" departLane="1" departPos="{60 + 5 * number}"
        departSpeed="0" insertionChecks="none">
        <route edges="main_in main_out"/>
    </vehicle>"""
    for number in range(11, 25)
)
# What SUMO finds wrong with it, it finds out when it is to depart.
BROKEN = """
    <vehicle id="9" depart="5" departLane="9"><route edges="main_in main_out"/></vehicle>
"""
WHY_CRASH = "Why did we crash?"
UNHEARD = {"timed-out", "busy", "planner-unavailable", "trace-gap"}


def scenario(root: Path, folder: Path, addition: str) -> Path:
    """The folder of s1 with something more in its traffic."""
    shutil.copytree(root / "sim" / "scenarios" / "s1", folder)
    routes = folder / "s1.rou.xml"
    routes.write_text(routes.read_text().replace("</routes>", f"{addition}</routes>"))
    return folder


def test_a_collision_is_talked_about(crew: Crew, root: Path, tmp_path: Path) -> None:
    folder = scenario(root, tmp_path / "crash", QUEUE)
    with staged(crew, at=60.0, drive=("--scenario", str(folder))) as stage:
        assert stage.listener.state == "ended"
        assert stage.listener.events[-1].event.kind == "collided"
        ada = stage.passenger("ada")
        told = [ada.ask(question) for question in ("What happened?", WHY_CRASH, WHY_CRASH, WHERE)]
        assert "collided" in told[0].text
        assert {answer.kind for answer in told} <= {"answer", "refusal"}
        assert not {answer.reason for answer in told} & UNHEARD
        assert stage.car.end() == 143


def test_a_ride_that_sumo_gives_up_is_talked_about(crew: Crew, root: Path, tmp_path: Path) -> None:
    folder = scenario(root, tmp_path / "broken", BROKEN)
    with staged(crew, at=3.0, drive=("--scenario", str(folder))) as stage:
        stage.car.order("until 60.0")
        assert stage.car.popen.wait(PATIENCE) == 1
        [line] = stage.car.said.splitlines()
        assert "SUMO at 4.9 s" in line
        assert str(folder) in line
        ada = stage.passenger("ada")
        told = [ada.ask(question) for question in (WHERE, "Why did you change lanes?", WHERE)]
        assert told[0].kind == "answer"
        assert told[1].kind == "answer" or told[1].reason == "planner-unavailable"
        assert not {answer.reason for answer in told} & {"timed-out", "busy"}
        before = {scene.ride for scene in stage.listener.scenes}
        again = stage.crew.drive(stage.endpoint, "--scenario", "s2", "--control")
        assert until(lambda: stage.listener.scenes[-1].ride not in before), again.said
        again.order("until 3.0")
        assert stage.listener.halted(3.0)
        assert ada.ask(WHERE).kind == "answer"


def test_a_chat_goes_on_without_a_car_that_cannot_go_on(
    crew: Crew, root: Path, tmp_path: Path
) -> None:
    folder = scenario(root, tmp_path / "broken", BROKEN)
    chat = crew.xavi("chat", "--scenario", str(folder))
    chat.order("@ 3.0s", WHERE)
    chat.hear(1)
    chat.order("@ 20.0s", WHERE, "What are you doing?")
    chat.popen.stdin.close()  # type: ignore[union-attr]
    assert chat.popen.wait(PATIENCE) == 0, chat.said
    [_, where, what] = chat.answers
    assert "on our way to our destination" in where
    assert "planner is not running" not in what
    assert chat.said.count("The car has ended") == 1
    assert chat.said.count("started again") == 3
