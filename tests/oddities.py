"""More made-up rides: hold-ups of every kind, many options, a plan without hope."""

from planner.record.events import Event
from planner.record.trace import Action, HeldUp, HoldUp, NotApplicable
from tests.planted import Actions, Moment, Seen, ride_of
from tests.traces import Aim, Chosen, End, Way, World
from xavi_dialogue.storage.ride_file import RecordedRide

BEGUN = Event("action-started", 0.0, "continue", 0)
NO_RIGHT = NotApplicable((), "change-right", "there is no lane to the right")
BOTH: tuple[Actions, ...] = (("continue",), ("change-left", "continue"))
#: How somebody is in the way at a time [s]: how, from and to which speed [m/s], what it may do.
KINDS: dict[float, tuple[HoldUp, float, float, tuple[Action, ...]]] = {
    6.0: ("cut-in", 9.0, 9.0, ("change-right",)),
    16.0: ("blocked", 0.0, 0.0, ("stop",)),
    26.0: ("leader", 9.0, 8.9, ("continue",)),
    36.0: ("leader", 12.0, 7.0, ("exit-right",)),
    46.0: ("leader", 11.0, 0.0, ("stop",)),
    56.0: ("leader", 11.0, 6.0, ("change-right",)),
    66.0: ("blocked", 3.0, 3.0, ("exit-right",)),
}
#: The speeds [m/s] of one that brakes at each of these times.
BRAKING = tuple(
    (time + step, speed)
    for time in KINDS
    for step, speed in ((-2.0, 14.0), (0.0, 9.0), (1.0, 9.0), (3.0, 14.0))
)


def hindered(time: float) -> Moment:
    """Somebody is in the way of what the ego does."""
    return _in_the_way(time, "continue", time, Seen(0.0, 0.0, BRAKING), 1.0)


def obstructed(time: float) -> Moment:
    """Somebody would be in the way of a change of lane; that is likely, or not at all."""
    likely = 0.6 if time < 30.0 else 0.3 if time < 50.0 else 1.0
    return _in_the_way(time, "change-left", time + 1.5, Seen(0.0, 0.0, ((0.0, 13.0),)), likely)


def _in_the_way(time: float, what: Action, since: float, me: Seen, likely: float) -> Moment:
    how, speed_from, speed_to, actions = KINDS[time]
    vehicle = round(time) // 10 + 1
    rest = Aim("exit-straight", 1.0 - likely, (Way(("exit-straight",)),))
    aims = {vehicle: (Aim(actions[-1], likely, (Way(actions),)), *((rest,) if likely < 1 else ()))}
    held = HeldUp(vehicle, since, since + 3.0, how, speed_from, speed_to)

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        met = vehicle in chosen and chosen[vehicle][0] == actions[-1]
        free = 12.0 if plan[0] == "continue" else 13.0
        if plan[0] != what or not met:
            return End(time=free), len(plan)
        return End(time=free + 6.0 / likely, held_up=(held,)), len(plan)

    side = 3.5 if what == "change-left" else 0.0
    other = Seen(22.0, side, me.speeds)
    plans = BOTH if what == "change-left" else (("continue",), ("stop", "continue"))
    return Moment(World(aims, plans, simulate, (NO_RIGHT,)), {0: me, vehicle: other}, time)


def plenty(time: float) -> Moment:
    """Many options, one of them as good, and a change of lane of which nobody knows the end."""
    aims = {
        1: (Aim("continue", 0.55, (Way(("continue",)),)), Aim("stop", 0.45, (Way(("stop",)),))),
        2: (
            Aim("continue", 0.55, (Way(("continue",)),)),
            Aim("exit-left", 0.45, (Way(("exit-left",)),)),
        ),
    }
    ends = {
        (True, True): End("collision"),
        (True, False): End("termination"),
        (False, True): End("dead"),
        (False, False): End(time=11.0),
    }

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        other = tuple(v not in chosen or chosen[v][0] == "continue" for v in (1, 2))
        match plan[0]:
            case "change-left":
                return ends[other], 1  # type: ignore[index]
            case "change-right":
                return End(time=12.0, jerk=1.8), 2
            case "continue-next-exit":
                return End(time=12.0, curvature=0.02), 1
            case "stop":
                return End(time=17.0), 2
            case "exit-left":
                return End("dead"), 1
        return End(time=12.0), 1

    plans: tuple[Actions, ...] = (
        *(("continue",), ("change-left", "continue"), ("change-right", "continue")),
        *(("continue-next-exit",), ("stop", "continue"), ("exit-left",)),
    )
    seen = {
        0: Seen(0.0, 0.0, ((0.0, 9.0), (10.0, 13.0))),
        1: Seen(40.0, 3.5, ((0.0, 9.0), (10.0, 12.0)), "bus"),
        2: Seen(190.0, 12.0, ((0.0, 4.0),), "truck", 3.1416),
    }
    return Moment(World(aims, plans, simulate), seen, time)


def risky(time: float) -> Moment:
    """Nothing is safe: to go on is as bad as to move over, and to stop takes us nowhere."""
    aims = {
        1: (
            Aim("exit-right", 0.4, (Way(("exit-right",)),)),
            Aim("continue", 0.6, (Way(("continue",)),)),
        )
    }

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        if plan[0] == "stop":
            return End("dead"), 2
        if 1 in chosen and chosen[1][0] == "exit-right":
            return End("collision", collided_with=1), 1
        return End(time=12.0 if plan[0] == "continue" else 14.0), 1

    def pace(plan: Actions) -> tuple[float, ...]:
        braking = plan[0] != "change-left"
        return tuple(max(13.0 - (1.2 * k if braking else 0.0), 4.0) for k in range(26))

    hard = ((0.0, 13.0), (8.0, 13.0), (9.5, 4.0))
    seen = {0: Seen(0.0, 0.0, hard), 1: Seen(25.0, 3.5, ((0.0, 13.0), (9.0, 6.0)))}
    plans: tuple[Actions, ...] = (*BOTH, ("stop", "continue"))
    return Moment(World(aims, plans, simulate, (NO_RIGHT,)), seen, time, pace=pace)


def wavering(time: float) -> Moment:
    """Somebody may well come out before us, for a moment; before and after, hardly."""
    likely = 0.4 if 5.0 < time < 7.0 else 0.01
    aims = {
        1: (
            Aim("exit-right", likely, (Way(("exit-right",)),)),
            Aim("stop", 1.0 - likely, (Way(("stop",)),)),
        )
    }

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        if plan[0] == "continue" and chosen.get(1, ("",))[0] == "exit-right":
            return End("collision", collided_with=1), 1
        return End(time=12.0 if plan[0] == "continue" else 20.0), len(plan)

    seen = {
        0: Seen(0.0, 0.0, ((0.0, 9.0), (4.0, 9.0), (8.0, 5.0))),
        1: Seen(110.0, 6.0, ((0.0, 0.0),)),
    }
    plans: tuple[Actions, ...] = (("continue",), ("stop", "continue"))
    world = World(aims, plans, simulate, (), plans[1 if likely > 0.1 else 0])
    return Moment(world, seen, time)


def hopeless(time: float) -> Moment:
    """No road from here leads to where we want to go."""

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        return End("dead"), 1

    seen = {0: Seen(0.0, 0.0, ((0.0, 3.0), (10.0, 8.0)))}
    refused = (NO_RIGHT, NotApplicable((), "change-left", "a vehicle is beside us"))
    plans: tuple[Actions, ...] = (("continue",), ("stop", "continue"))
    return Moment(World({}, plans, simulate, refused), seen, time)


def over(time: float) -> Moment:
    """A change of lane for which nothing speaks, and nothing against it."""

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        return End(time=12.0), len(plan)

    aims = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}
    seen = {0: Seen(0.0, 0.0, ((0.0, 12.0),)), 1: Seen(0.0, 3.5, ((0.0, 12.0),))}
    world = World(aims, BOTH, simulate, (NO_RIGHT,), ("change-left", "continue"))
    return Moment(world, seen, time, under_way="change-left" if 4.0 < time < 8.0 else None)


def rides() -> dict[str, RecordedRide]:
    """The rides by name."""
    times = tuple(KINDS)
    plan = {time: (round(time) // 10 + 1,) for time in times}
    moved = (
        Event("action-started", 4.0, "change-left", 4),
        Event("action-committed", 4.2, "change-left", 4),
    )
    done = (
        Event("action-ended", 7.0, "change-left", 4),
        Event("action-started", 7.0, "continue", 8),
    )
    return {
        "hindered": ride_of(map(hindered, times), (BEGUN,), 67.0, plan),
        "obstructed": ride_of(map(obstructed, times), (BEGUN,), 67.0, plan),
        "plenty": ride_of(map(plenty, (6.0, 10.0)), (BEGUN,), 10.0),
        "risky": ride_of(map(risky, (6.0, 7.0, 8.0, 10.0)), (BEGUN,), 10.0),
        "hopeless": ride_of(map(hopeless, (6.0, 10.0)), (BEGUN,), 10.0),
        "wavering": ride_of(map(wavering, (2.0, 4.0, 6.0, 8.0, 10.0)), (BEGUN,), 10.0),
        "over": ride_of(map(over, (4.0, 6.0, 8.0)), (BEGUN, *moved, *done), 8.0),
    }
