"""`xavi bench dialogue`: how long answers take, within one process and over the bus."""

import time
from pathlib import Path
from tempfile import TemporaryDirectory

from sim.network import Network
from sim.scenario import load
from xavi_dialogue.app.bench.figures import Figures, Watch
from xavi_dialogue.app.client import Client
from xavi_dialogue.app.control import Until
from xavi_dialogue.app.convoy import convoy, first_scene
from xavi_dialogue.app.local import Conversation, drive_to, make_mind, planner_for
from xavi_dialogue.app.memory import Keeping
from xavi_dialogue.app.ride import network_of, start
from xavi_dialogue.transports.bus import Keys

SCENARIOS = ("s1", "s2")
SEED = 0
ROUNDS = 5  # of every question
QUESTIONS = (
    "Why did you do that?",
    "What are you doing?",
    "What would have happened if you had kept going straight?",
    "Why did you not turn right?",
    "What if vehicle 1 weren't there?",
    "What is vehicle 1 doing?",
    "Where are we going?",
    "Why did you not fly?",
    "Are you sure?",
    "Hello!",
)


def measure() -> Figures:
    """Answers within one process, from the record or with planning again, and over the bus."""
    watch = Watch()
    for name in SCENARIOS:
        conversation, _ = ride(name)
        at = conversation.dialogue.traces[-1].sim_time
        for question in QUESTIONS * ROUNDS:
            planned = len(conversation.dialogue.planned)
            began = time.perf_counter()
            conversation.ask(question, at)
            taken = time.perf_counter() - began
            again = len(conversation.dialogue.planned) > planned
            kind = "planned again" if again else "from the record"
            watch.taken.setdefault(f"{name} {kind}", []).append(taken)
    _over_the_bus(watch, "over the bus", None)
    with TemporaryDirectory() as folder:
        keeping = Keeping(Path(folder) / "dialogue.sqlite3", days=1)
        _over_the_bus(watch, "over the bus, kept on disk", keeping)
    return Figures("dialogue", watch.figures())


def ride(name: str) -> tuple[Conversation, Network]:
    """A scenario, driven to its end and recorded."""
    scenario = load(name)
    network = network_of(scenario)
    conversation = Conversation(make_mind(), planner_for(network))
    with start(scenario, SEED, network) as moments:
        drive_to(moments, conversation, scenario.duration)
    return conversation, network


def _over_the_bus(watch: Watch, how: str, keeping: Keeping | None) -> None:
    """The same, from a passenger's process through the service's."""
    name = SCENARIOS[0]
    with convoy(name, SEED, 0.0, keeping) as behind:
        client = Client(behind.bus, Keys(), "bench")
        first_scene(behind, client)
        at = behind.drive(client, Until(None), halt=True).sim_time
        for question in QUESTIONS * ROUNDS:
            with watch.time(f"{name} {how}"):
                client.ask(question, at)
