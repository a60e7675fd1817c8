"""Which story is told in a run, and what goes wrong when: all of it from one seed."""

import random
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Literal, TypeAlias, get_args

from sim.scene import Scene
from xavi_dialogue.storage.ride_file import RecordedRide
from xavi_dialogue.transcripts.replay import recording
from xavi_dialogue.vehicle.episode import Moment

RIDES = Path(__file__).parents[2] / "transcripts" / "rides"
STEP = 0.5  # [s] between the moments of a ride
SETTLED = 0.5  # [s] before which nothing goes wrong
HEALED = 10.0  # [s] after which nothing goes wrong any more

Kind: TypeAlias = Literal[
    "crash",  # of a process, after some of its steps
    "power",  # cut to a machine
    "stored",  # the service crashes as soon as it has stored a turn
    "stall",  # of a process
    "apart",  # a machine is separated from the hub
    "loss",
    "twice",
    "delay",
    "disorder",
    "full",  # the disk of the service
    "failing",
    "read",  # the file of the service, by another program
    "locked",  # the same, by one that writes
    "clock",  # of a machine jumps
    "planner",  # of the car is slow, or fails
]
MACHINES = ("hub", "car", "phone", "tablet", "desk", "diary")
LASTING = ("apart", "loss", "twice", "delay", "disorder", "full", "failing", "read", "locked")


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that goes wrong."""

    at: float  # [s]
    kind: Kind
    machine: str = "hub"
    amount: float = 0.0  # steps, seconds, chance: see `draw`
    lasts: float = 0.0  # [s]

    def __str__(self) -> str:
        whose = f" of {self.machine}" if self.kind not in ("loss", "twice", "delay") else ""
        long = f" for {self.lasts:.2f} s" if self.lasts else ""
        return f"{self.at:6.2f} s  {self.kind}{whose}, {self.amount:g}{long}"


@dataclass(frozen=True, slots=True)
class Story:
    """A ride, and what is asked about it."""

    ride: str
    halt: float  # [s] at which the car halts
    phone: tuple[tuple[float, str], ...]  # time [s] that a question is about, and its text
    tablet: tuple[str, ...]  # questions about the time at which the car has halted
    desk: tuple[tuple[float, str], ...]


STORIES = (
    Story(
        "s1-4",
        6.5,
        (
            (5.2, "did vehicle 2 have anything to do with it?"),
            (5.2, "why did you move over?"),
            (5.2, "how likely was it that he would cut in"),
            (6.0, "What are you doing?"),
            (6.0, "why?"),
        ),
        ("Why did you change left?", "why?", "quiz me", "i don't know"),
        ((5.0, "How fast are you?"), (6.0, "Why did you not stop?")),
    ),
    Story(
        "s2-2",
        6.5,
        (
            (4.9, "why is vehicle 1 slowing down"),
            (4.9, "and vehicle 2?"),
            (6.5, "why are you giving way?"),
            (6.5, "when can we go?"),
        ),
        ("What are you doing?", "why?", "what if you had stopped", "are you sure?"),
        ((4.8, "How fast is vehicle 1?"), (6.5, "Why did you slow down?")),
    ),
    Story(
        "s1-4",
        6.5,
        (
            (4.0, "What are you doing?"),
            (5.2, "quiz me"),
            (5.2, "stop"),
            (5.2, "why did you move over?"),
            (5.2, "are you sure?"),
        ),
        ("What if you had stopped?", "why?", "What is vehicle 1 doing?"),
        ((6.0, "Why did you change left?"), (6.0, "why?")),
    ),
)


@dataclass(frozen=True, slots=True)
class Plan:
    """A run."""

    seed: int
    story: int
    faults: tuple[Fault, ...]

    def without(self, faults: frozenset[Fault]) -> "Plan":
        """Return the plan with fewer faults."""
        return replace(self, faults=tuple(f for f in self.faults if f not in faults))


def plan_of(seed: int) -> Plan:
    """Draw a run."""
    dice = random.Random(f"plan {seed}")
    # Half of the runs crash something: most else is mended by waiting.
    kinds = dice.sample(get_args(Kind), dice.randint(1, 6))
    kinds += dice.choice(((), (), ("crash",), ("crash", "crash", "power")))
    count = dice.choice((1, 2, 3, 4, 6, 8, 12))
    faults = sorted((_draw(dice, dice.choice(kinds)) for _ in range(count)), key=lambda one: one.at)
    return Plan(seed, dice.randrange(len(STORIES)), tuple(faults))


def _draw(dice: random.Random, kind: Kind) -> Fault:
    at = round(SETTLED + (HEALED - SETTLED - 1.0) * dice.random() ** 1.3, 2)
    machine = dice.choice(("hub", "hub", *MACHINES))
    lasts = round(min(dice.choice((0.1, 0.5, 2.0, 6.0)) * dice.uniform(0.5, 1.0), HEALED - at), 2)
    amount = 0.0
    match kind:
        case "crash":
            amount, lasts = float(int(dice.choice((3, 30, 300)) * dice.random()) + 1), 0.0
        case "power":
            lasts = 0.0
        case "stall":
            lasts = min(lasts, 3.0)
        case "apart":
            machine = dice.choice(MACHINES[1:])
        case "loss" | "twice":
            amount = dice.choice((0.02, 0.1, 0.4))
        case "delay" | "disorder":
            amount = dice.choice((0.02, 0.2, 0.8))
        case "stored" | "full" | "failing" | "read" | "locked":
            machine = "hub"
        case "clock":
            amount = dice.choice((-1.0, 1.0)) * dice.choice((1.0, 20.0, 3600.0, 86400.0))
            lasts = 0.0
        case "planner":
            machine, amount = "car", dice.choice((0.0, 1.0, 20.0))
    return Fault(at, kind, machine, amount, lasts)


@cache
def ride_of(name: str) -> RecordedRide:
    """Return a recorded ride."""
    return recording(RIDES / f"{name}.ride.jsonl.gz")


@cache
def moments_of(name: str, until: float) -> tuple[Moment, ...]:
    """Return the moments of a ride up to a time [s]; between decisions nothing moves."""
    ride, found = ride_of(name), []
    decided = {one.sim_time: one for one in ride.traces if one.sim_time <= until}
    times = sorted({*decided, *(round(k * STEP, 6) for k in range(round(until / STEP) + 1))})
    seen, before = ride.traces[0], -1.0
    for time in times:
        seen = decided.get(time, seen)
        events = tuple(one for one in ride.events if before < one.sim_time <= time)
        plan = tuple(one.action for one in seen.plan)
        found.append(Moment(Scene(time, dict(seen.scene)), plan, decided.get(time), events))
        before = time
    return tuple(found)
