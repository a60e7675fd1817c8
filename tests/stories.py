"""What conversations about made-up decisions are about: collisions, equal options, nobody there.

`python -m tests.stories` writes it to transcripts/traces.
"""

import gzip
from pathlib import Path

from planner.record.events import Event
from planner.record.trace import HeldUp, NotApplicable, PlanTrace, encode
from tests import oddities
from tests.planted import Actions, Moment, Seen, decision, ride_of, without
from tests.traces import Aim, Chosen, End, Way, World
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import ENDING, RecordedRide
from xavi_dialogue.transcripts.replay import BESIDE, TRACES

FOLDER = Path(__file__).parents[1] / "transcripts" / TRACES
NO_LEFT = NotApplicable((), "change-left", "there is no lane to the left")
NO_RIGHT = NotApplicable((), "change-right", "there is no lane to the right")
LANES: tuple[Actions, ...] = (("continue",), ("change-left", "continue"), ("stop", "continue"))


def steady(speed: float) -> tuple[float, ...]:
    """A pace [m/s] of 5 s that does not change."""
    return (speed,) * 26


def squeezed(time: float) -> Moment:
    """Behind a truck that brakes for its exit, with a car beside us that leaves no gap."""
    aims = {
        1: (
            Aim("exit-right", 0.6, (Way(("exit-right",), 1.0, (8.0, 4.0, 0.0)),)),
            Aim("continue", 0.4, (Way(("continue",)),)),
        ),
        2: (
            Aim("continue", 0.7, (Way(("continue",)),)),
            Aim("exit-right", 0.3, (Way(("exit-right",)),)),
        ),
    }
    halting = HeldUp(1, time, time + 6.0, "leader", 8.0, 0.2)

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        brakes = 1 in chosen and chosen[1][0] == "exit-right"
        match plan[0]:
            case "change-left" if 2 in chosen and chosen[2][0] == "continue":
                return End("collision", collided_with=2), 1
            case "change-left":
                return End(time=11.0, jerk=1.4, angular=0.2), 2
            case "continue" if brakes:
                return End(time=16.0, jerk=0.9, held_up=(halting,)), 1
            case "continue":
                return End(time=12.0), 1
        return End("termination"), 2

    seen = {
        0: Seen(0.0, 0.0, ((0.0, 14.0), (5.0, 14.0), (10.0, 9.0), (14.0, 6.0))),
        1: Seen(30.0, 0.0, ((0.0, 13.0), (4.0, 13.0), (9.0, 8.0), (13.0, 2.0)), "truck"),
        2: Seen(-4.0, 3.5, ((0.0, 13.0),)),
    }
    return Moment(World(aims, LANES, simulate, (NO_RIGHT,)), seen, time)


def lorry(time: float) -> Moment:
    """Behind a slow lorry, with another before it: without the one, the other is in the way."""
    aims = {v: (Aim("continue", 1.0, (Way(("continue",)),)),) for v in (1, 2)}
    held = {v: HeldUp(v, time, time + 12.0, "leader", 9.0 if v == 1 else 8.8, 8.7) for v in aims}

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        if plan[0] == "stop":
            return End(time=29.0, jerk=1.0), 2
        ahead = min(chosen, default=None)
        held_up = () if ahead is None else (held[ahead],)
        return End(time=14.0 if ahead is None else 20.0, held_up=held_up), 1

    seen = {
        0: Seen(0.0, 0.0, ((0.0, 15.0), (4.0, 15.0), (9.0, 9.0))),
        1: Seen(65.0, 0.0, ((0.0, 9.0),), "truck"),
        2: Seen(95.0, 0.0, ((0.0, 8.8),), "truck"),
    }
    plans: tuple[Actions, ...] = (("continue",), ("stop", "continue"))
    return Moment(World(aims, plans, simulate, (NO_LEFT, NO_RIGHT)), seen, time)


def even(time: float) -> Moment:
    """Two empty lanes that are as good, and a car behind us of which nobody knows more."""
    aims = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        return End(time=12.0), len(plan)

    seen = {0: Seen(0.0, 0.0, ((0.0, 12.0),)), 1: Seen(-30.0, 0.0, ((0.0, 12.0),))}
    return Moment(World(aims, LANES[:2], simulate, (NO_RIGHT,)), seen, time)


def alone(time: float) -> Moment:
    """One lane, nobody else, and only one thing to do."""

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        return End(time=8.0), 1

    refused = (NO_LEFT, NO_RIGHT, NotApplicable((), "stop", "we are nearly there"))
    world = World({}, (("continue",),), simulate, refused)
    return Moment(world, {0: Seen(0.0, 0.0, ((5.0, 10.0), (10.0, 7.0)))}, time)


def waiting(time: float) -> Moment:
    """At a junction, standing, while a bus from the right takes its time."""
    aims = {
        1: (
            Aim("continue", 0.8, (Way(("continue",), 1.0, (6.0, 6.0, 6.0)),)),
            Aim("exit-left", 0.2, (Way(("exit-left",), 1.0, (6.0, 3.0, 3.0)),)),
        )
    }

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        passing = HeldUp(1, time, time + 4.0, "right-of-way", 6.0, 6.0)
        if plan[0] == "stop":
            return End(time=22.0), 2
        if plan[0] == "exit-left":
            return End("dead"), 1
        return End(time=14.0 if 1 in chosen else 9.0, held_up=(passing,) if 1 in chosen else ()), 1

    seen = {
        0: Seen(0.0, 0.0, ((0.0, 8.0), (3.0, 8.0), (7.0, 0.0))),
        1: Seen(55.0, -90.0, ((0.0, 6.0),), "bus", 1.5708),
    }
    plans: tuple[Actions, ...] = (
        ("exit-right", "continue"),
        ("stop", "exit-right"),
        ("exit-left",),
    )
    halt = (0.0,) * 20 + tuple(0.6 * k for k in range(20))
    world = World(aims, plans, simulate, (NO_LEFT, NO_RIGHT))
    return Moment(world, seen, time, pace=lambda _: halt)


def crash(time: float) -> Moment:
    """A car beside us moves in ahead and brakes; nothing but stopping in time would have helped."""
    aims = {
        1: (
            Aim("exit-right", 0.3, (Way(("change-right", "exit-right"), 1.0, (9.0, 4.0, 2.0)),)),
            Aim("continue", 0.7, (Way(("continue",)),)),
        )
    }
    cut = HeldUp(1, time + 1.0, time + 4.0, "cut-in", 9.0, 3.0)

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        turns = 1 in chosen and chosen[1][0] == "exit-right"
        if plan[0] == "stop":
            return End(time=19.0, jerk=1.5, held_up=(cut,) if turns else ()), 2
        if turns:
            return End("collision", collided_with=1, held_up=(cut,)), 1
        return End(time=10.0), 1

    seen = {
        0: Seen(0.0, 0.0, ((0.0, 13.0), (9.0, 13.0), (9.6, 9.0))),
        1: Seen(6.0, 3.5, ((0.0, 13.0), (6.0, 13.0), (9.0, 9.0))),
    }
    plans: tuple[Actions, ...] = (("continue",), ("stop", "continue"))
    return Moment(World(aims, plans, simulate, (NO_LEFT, NO_RIGHT)), seen, time)


def decisions() -> dict[str, tuple[Moment, tuple[int, ...]]]:
    """The decisions by name, with the vehicles without which they are planned again."""
    return {
        "squeezed": (squeezed(10.0), (1, 2)),
        "even": (even(10.0), (1,)),
        "alone": (alone(10.0), ()),
    }


def rides() -> dict[str, RecordedRide]:
    """The rides by name."""
    begun = Event("action-started", 0.0, "continue", 0)
    over = Event("collided", 9.6, vehicle=1)
    every = (4.0, 6.0, 8.0, 10.0)
    turn = Event("action-started", 0.0, "exit-right", 0)
    gave = Event("gave-way", 5.0, vehicle=1)
    return {
        "braking": ride_of(map(squeezed, every), (begun,), 10.0, {4.0: (2,), 6.0: (1,)}),
        "lorry": ride_of(
            map(lorry, every), (begun,), 10.0, dict.fromkeys((4.0, 6.0, 8.0, 10.0), (1,))
        ),
        "crash": ride_of(map(crash, (3.0, 5.0, 7.0)), (begun, over), 10.0),
        "waiting": ride_of(map(waiting, every), (turn, gave), 10.0, {4.0: (1,), 10.0: (1,)}),
        "nobody": ride_of(map(alone, every), (begun,), 10.0),
    }


def files() -> dict[str, bytes]:
    """What is to lie in transcripts/traces, by name."""
    found: dict[str, bytes] = {}
    for name, (at, removed) in decisions().items():
        found[f"{name}.json.gz"] = _packed(decision(at))
        for need, plan in (without(at, vehicle) for vehicle in removed):
            found[BESIDE.format(ride_file.key(need))] = _packed(plan)
    every = rides() | oddities.rides()
    rode = {f"{name}{ENDING}": ride_file.dump(ride) for name, ride in every.items()}
    return found | rode


def _packed(trace: PlanTrace) -> bytes:
    return gzip.compress(encode(trace), mtime=0)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for path in FOLDER.iterdir():
        path.unlink()
    for name, content in files().items():
        (FOLDER / name).write_bytes(content)
