"""Our planner beside IGP2's published one: both decide in the same scenes.

IGP2 drives scenarios of its checkout. In each of its decisions our planner gets the same map, the
same vehicles with the same tracks, the same destination and as many rollouts.
"""

import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import msgspec

from benchmarks.errors import Igp2Unusable
from benchmarks.figures import Watch, in_columns
from benchmarks.igp2.timed_ride import MARK
from benchmarks.planning.timed_decision import timed_decision
from planner.record.trace import EgoGoal, PlanTrace, Settings
from planner.record.trace_reading import decode
from planner.roads.trajectory import Roads
from planner.rollouts.waypoints import survey
from planner.search.inputs import Frame, Moment, Root, root_at
from sim.roads.netconvert import opendrive_net
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.scene import EGO, Point
from xavi_dialogue.vehicle.replan_worker import warm_up

SCENARIOS = ("scenario1", "scenario2", "scenario3", "scenario4")  # with maps of their own
DECISIONS = 3  # of each scenario, from its start
SEED = 21  # of IGP2's rides, as in its configurations
PATIENCE = 3600.0  # [s] for one scenario
EXAMPLES = Path(__file__).parents[2] / "examples"
SCRIPT = Path(__file__).with_name("timed_ride.py")
REACH, TURN = 6.0, 7.0  # [m], [rad]: the destination may lie between lanes, with any heading


class Side(msgspec.Struct, frozen=True):
    """The processor time of a decision by one planner."""

    recognition: float  # [ms] for each other vehicle
    search: float  # [ms]
    decision: float  # [ms] recognition of all, and search
    rollouts: int  # simulated in the search
    rollouts_per_s: float


class BesideIgp2(msgspec.Struct, frozen=True):
    """One scene, in which both planners decide."""

    scenario: str
    time: float  # [s] of the ride
    others: int  # in view
    igp2: Side
    ours: Side
    faster: float  # how many times as long IGP2's decision takes


class TheirDecision(msgspec.Struct, frozen=True):
    """A decision of IGP2, as `timed_ride.py` prints it."""

    trace: msgspec.Raw
    recognition: tuple[float, ...]  # [s] for each other vehicle
    search: float  # [s]
    goal: Point  # [m]


def beside_igp2(
    checkout: Path, python: Path, note: Callable[[str], None], scenarios: Sequence[str] = SCENARIOS
) -> tuple[BesideIgp2, ...]:
    """Let both planners decide in the first scenes of IGP2's scenarios.

    Args:
        checkout: folder of a checkout of IGP2.
        python: interpreter of an environment with what IGP2 requires.
        note: gets a line before each scenario.
        scenarios: names in the checkout's `scenarios/configs`.

    Raises:
        Igp2Unusable: the folder is no checkout, IGP2 cannot run, or its scene is not on the map.
        NetconvertMissing: netconvert is not installed.
    """
    found: list[BesideIgp2] = []
    for name in scenarios:
        note(f"IGP2's {name}: {DECISIONS} decisions")
        network = read_network(opendrive_net(_map(checkout, name), {}))
        warm_up(network)
        found += [_beside(name, network, one) for one in their_decisions(checkout, python, name)]
    return tuple(found)


def their_decisions(checkout: Path, python: Path, scenario: str) -> Iterator[TheirDecision]:
    """Run IGP2 in another process, and yield its decisions.

    Raises:
        Igp2Unusable: it cannot run, or makes no decision.
    """
    arguments = (EXAMPLES, checkout.resolve(), scenario, SEED, DECISIONS)
    command = [str(python), str(SCRIPT), *map(str, arguments)]
    try:
        ran = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Igp2Unusable(f"{python} cannot run IGP2's {scenario}: {error}") from error
    lines = [line for line in ran.stdout.splitlines() if line.startswith(MARK)]
    if not lines:
        last = ran.stderr.strip().splitlines()[-1:] or ["it printed no decision"]
        raise Igp2Unusable(
            f"IGP2 does not run {scenario} with {python}: {last[0]}. Name the Python of an "
            "environment with what its requirements.txt lists: --igp2-python PATH"
        )
    for line in lines:
        yield msgspec.json.decode(line.removeprefix(MARK), type=TheirDecision)


def table(rows: Sequence[BesideIgp2]) -> str:
    """Return the comparison for people."""
    titles = ("recognition/vehicle", "search", "rollouts/s")
    sides = [f"{who} {title}" for title in titles for who in ("IGP2", "our")]
    cells = [["scene", "others", "IGP2 rollouts", "our rollouts", *sides, "times faster"]]
    for row in rows:
        both = (row.igp2, row.ours)
        cells.append(
            [
                f"{row.scenario} {row.time:.1f} s",
                str(row.others),
                *(str(side.rollouts) for side in both),
                *(f"{side.recognition:.1f}" for side in both),
                *(f"{side.search:.0f}" for side in both),
                *(f"{side.rollouts_per_s:.1f}" for side in both),
                f"{row.faster:.0f}",
            ]
        )
    return "processor time [ms] beside IGP2\n" + in_columns(cells)


def _beside(name: str, network: Network, theirs: TheirDecision) -> BesideIgp2:
    trace = decode(bytes(theirs.trace))
    rollouts, others = trace.settings.rollouts, len(trace.scene) - 1
    watch = Watch(time.process_time)
    frame, moment = _ours(network, trace, theirs.goal)
    search = timed_decision(watch, "", frame, moment)
    recognition = sum(theirs.recognition)
    per_vehicle = recognition / max(len(theirs.recognition), 1)
    taken = {part: times[-1] for part, times in watch.taken.items()}
    igp2 = _side(per_vehicle, recognition, theirs.search, rollouts)
    ours = _side(
        taken["recognition"] / max(others, 1),
        taken["recognition"],
        taken["search"],
        len(search.rollouts),
    )
    faster = round(igp2.decision / ours.decision, 1)
    return BesideIgp2(name, trace.sim_time, others, igp2, ours, faster)


def _side(per_vehicle: float, recognition: float, search: float, rollouts: int) -> Side:
    """Return the figures of a planner from times [s]."""
    return Side(
        recognition=round(1000.0 * per_vehicle, 3),
        search=round(1000.0 * search, 3),
        decision=round(1000.0 * (recognition + search), 3),
        rollouts=rollouts,
        rollouts_per_s=round(rollouts / search, 1),
    )


def _ours(network: Network, trace: PlanTrace, goal: Point) -> tuple[Frame, Moment]:
    """Return the scene of a decision of IGP2 for our planner."""
    places = network.locate(goal, 0.0, REACH, TURN)
    roads = Roads(network)
    root = root_at(roads, trace.scene[EGO], trace.sim_time)
    if root is None or not places:
        raise Igp2Unusable("IGP2's vehicle or its destination is on no lane of the converted map")
    where = places[0]
    wanted = EgoGoal(network.lanes[where.lane].edge, where.offset, None)
    settings = Settings(rollouts=trace.settings.rollouts, reacting=True)
    frame = Frame(roads, wanted, settings, SEED, "igp2")
    survey(roads, wanted)  # as a driver does before it drives
    return frame, Moment(trace.decision, trace.sim_time, trace.scene, trace.history, Root(root))


def _map(checkout: Path, scenario: str) -> Path:
    """Return the OpenDRIVE map of a scenario of a checkout."""
    file = checkout / "scenarios" / "configs" / f"{scenario}.json"
    try:
        config = msgspec.json.decode(file.read_bytes())
        return checkout / Path(config["scenario"]["map_path"])
    except (OSError, msgspec.DecodeError, KeyError, TypeError) as error:
        raise Igp2Unusable(
            f"{checkout} is no checkout of IGP2 (github.com/uoe-agents/IGP2): "
            f"scenarios/configs/{scenario}.json cannot be read ({error})"
        ) from error
