"""Foreseen: how probable an event was for the car at a time, by its beliefs and its plan."""

from msgspec.structs import replace

from planner.record.trace import (
    Action,
    HeldUp,
    PlanTrace,
    TrajectoryPrediction,
    VehiclePrediction,
)
from sim.scene import EGO
from xavi_dialogue.domain.answers import Bound
from xavi_dialogue.domain.facts import Belief, Episode, Expectation
from xavi_dialogue.domain.terms import Ego, Event, Feature, Road, Unsaid, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.precedence import before_us, first, into_our_road
from xavi_dialogue.explain.answers.expectations.taken import last_turn, took
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasions, overlaps
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.history.motion import branches_off, foresees
from xavi_dialogue.explain.history.ride import Unanswered, prediction

EXPECTED = 0.5  # minimum probability of what was expected
MOVING = 1.0  # [m/s] minimum speed, or gain in speed, of a vehicle that goes
OPEN = 0.1  # minimum probability of another alternative that an answer adds
CLEAR = 0.6  # minimum probability of a belief that may have been wrong
BEFORE = 10.0  # [s] before an event in which it may have been predicted
CHANGING = frozenset[ActionName](("change-left", "change-right", "change-lane"))
SOLE = 0.95  # minimum prior of a road that was the only one considered

#: By action of a question without a side: the macro actions that predict it.
TURNING: tuple[Action, ...] = ("exit-left", "exit-right", "exit-straight", "continue-next-exit")
MEANINGS: dict[ActionName, tuple[Action, ...]] = {
    "continue": ("continue", "exit-straight"),
    "exit-straight": ("continue", "exit-straight"),
    "keep-lane": ("continue",),
    "pass": ("continue", "exit-straight"),
    "turn": ("exit-left", "exit-right"),
    "leave": ("exit-left", "exit-right", "exit-straight"),
    "change-lane": ("change-left", "change-right"),
    "cut-in": ("change-left", "change-right"),
    "merge": ("change-left", "change-right"),
    "overtake": ("change-left", "change-right"),
}
HALTS: frozenset[ActionName] = frozenset(("stop", "stand", "wait"))
STARTS: frozenset[ActionName] = frozenset(("go", "move", "pull-out", "enter", "cross"))
#: Actions that mean a vehicle goes ahead of us.
CROSSING: frozenset[ActionName] = frozenset(("pull-out", "enter", "cross"))
YIELDS: frozenset[ActionName] = frozenset(("give-way", "let-go", "wait"))
SLOWING: frozenset[ActionName] = frozenset(("stop", "slow-down", "brake"))
GIVEN = 8.0  # [s] after which somebody who stopped gave way to us for another reason


def chance(asked: Asked, event: Event, at: float) -> float | None:
    """Return how probable it was at a time [s] that a vehicle does something; None: unknown."""
    vehicle = number(event.actor)
    if vehicle is None:
        return None
    if event.action in ("collide", "nearly-collide"):
        return collision_chance(asked, at, vehicle)
    if stops_for_another(event):
        return None
    if event.action in SLOWING and (is_us(event.object) or _for_us(asked, vehicle, at)):
        event = replace(event, action="give-way", object=Ego())  # "will he stop for us?"
    if event.action in CROSSING and event.object == Feature("way"):
        event = replace(event, action="cross", object=None)  # "will it cut across our path?"
    event = _alongside(asked, event, vehicle, at)
    trace = asked.ride.at(at, vehicle)
    known = None if trace is None else prediction(trace, vehicle)
    if trace is None or known is None or not considers(known, event):
        return None
    total, any_known = 0.0, False
    for goal in known.goals:
        for way in goal.trajectories:
            does = _on_branch(event) if branches_off(goal, way) else None
            does = _meeting_us(trace, way, event) if does is None else does
            does = foretells(way, event) if does is None else does
            if does is None:
                continue
            any_known = True
            total += goal.probability * way.probability if does else 0.0
    return min(total, 1.0) if any_known else None


def stops_for_another(event: Event) -> bool:
    """Check whether somebody would stop for others, which no prediction tells: only for us."""
    return event.action in SLOWING and isinstance(event.object, Vehicle | Vehicles)


def _for_us(asked: Asked, vehicle: int, at: float) -> bool:
    """Check whether a vehicle gave way to us soon after a time [s]: that is what it stopped for."""
    given = asked.world.episodes(Vehicle(vehicle), ("give-way",), at, at + GIVEN, object=Ego())
    return bool(given)


def unconsidered(asked: Asked, event: Event, at: float) -> Bound | None:
    """Return that a decision up to a time [s] did not consider a turn or exit; else None.

    What a vehicle had done by then does not count: it is not predicted any more.
    """
    vehicle = number(event.actor)
    trace = None if vehicle is None else asked.ride.at(at, vehicle)
    known = None if trace is None or vehicle is None else prediction(trace, vehicle)
    if vehicle is None or known is None or not _ignored(known, event):
        return None
    done = replace(event, time=Unsaid(), tense="past", modal=None)
    if any(one.begin <= at for one in occasions(asked, done)):
        return None
    who, belief = Vehicle(vehicle), asked.world.belief(vehicle, at)
    shown = asked.world.episodes(actor=who, actions=("signal",), begin=at - SHORT, end=at)
    lit = [e for e in shown if e.end is None or e.end > at]
    return Bound(who, belief, unconsidered=event, signal=lit[-1] if lit else None)


def is_behind(asked: Asked, event: Event, at: float) -> bool:
    """Check whether an event is asked about as past, or is no longer predicted."""
    return event.tense == "past" or chance(asked, event, at) is None


def considers(known: VehiclePrediction, event: Event) -> bool:
    """Check whether a prediction bears on an event.

    It does not on turns that it leaves out, nor on going ahead of one whose way it does not meet.
    """
    if event.action not in CROSSING or not isinstance(event.object, Vehicle):
        return not _ignored(known, event)
    return any(_yields(w.held_up, event) for goal in known.goals for w in goal.trajectories)


def _ignored(known: VehiclePrediction, event: Event) -> bool:
    """Check whether an event is a turn or exit, and only the road ahead was considered."""
    names = macros(event)
    if not names or not set(names) <= set(TURNING):
        return False
    ways = [(goal, way) for goal in known.goals for way in goal.trajectories]
    found = any(branches_off(*one) or contains(one[1].actions, event) for one in ways)
    return not found and all(g.prior >= SOLE for g in known.goals if g.edge is not None)


def _alongside(asked: Asked, event: Event, vehicle: int, at: float) -> Event:
    """Read "pull out" and "cut in" of a vehicle that drives our way as a change of lanes."""
    look = asked.world.look(vehicle, at)
    if event.action not in ("pull-out", "cut-in") or look is None or look.speed < MOVING:
        return event
    if look.oncoming or look.bearing.partition("-")[0] not in ("ahead", "behind", "beside"):
        return event
    road = asked.world.road(at)
    place = None if road is None else road.places.get(vehicle)
    if place is not None and place.roundabout:
        return event
    if event.action == "pull-out" and look.bearing in ("ahead", "behind"):
        return replace(event, action="change-lane")  # from before or behind us, to another lane
    return replace(event, action="change-right" if look.left > 0.0 else "change-left")


def _meeting_us(trace: PlanTrace, way: TrajectoryPrediction, event: Event) -> bool | None:
    """Check whether a predicted way leads before us, behind us or into our road, as the event says.

    None for all other events, or if that is not known.
    """
    ours = event.object is None or is_us(event.object)
    if event.action == "enter" and event.object == Road("own"):
        return into_our_road(trace, way)
    if not ours or event.action not in ("pull-out", "cross", *YIELDS):
        return None
    if event.action not in YIELDS:
        return before_us(trace, way)
    came = first(trace, way)
    return None if came in (None, "nobody") else came == "we"


def foretells(way: TrajectoryPrediction, event: Event) -> bool | None:
    """Check whether a predicted way contains an event; None if ways do not show such events."""
    action = sided(event)
    if action == "cross" and "cross" in way.actions:
        return True  # of people on foot, for whom crossing is a predicted action
    if action in YIELDS:
        return _yields(way.held_up, event) or (action == "wait" and foresees(way, "stop"))
    if action in ("stop", "stand"):
        stands = bool(way.speed) and way.speed[0] < MOVING  # and stays where it lets us go first
        return foresees(way, "stop") or (stands and _yields(way.held_up, event))
    if action == "brake":
        return foresees(way, "slow-down")
    if action in ("slow-down", "speed-up"):
        return foresees(way, action)
    if action in CROSSING and _yields(way.held_up, event):
        return False  # it goes after us
    if action in STARTS:
        return (
            None
            if not way.speed
            else max(way.speed) >= way.speed[0] + MOVING
            or (way.speed[0] >= MOVING and not foresees(way, "stop"))
        )
    return contains(way.actions, event)


def _on_branch(event: Event) -> bool | None:
    """Check whether taking a road that branches off is the event; None: that does not show it."""
    if event.action == "leave":
        return True
    return False if event.action in ("continue", "exit-straight", "keep-lane") else None


def contains(actions: tuple[ActionName, ...], event: Event) -> bool | None:
    """Check whether actions contain an event; leaving means at the next exit. None: unknown."""
    names = macros(event)
    if sided(event) != event.action or event.action != "leave":
        return any(step in names for step in actions) if names else None
    return next((step in names for step in actions if step != "continue"), False)


def macros(event: Event) -> tuple[Action, ...]:
    """Return the macro actions that an event stands for, with its side; () for all else."""
    action = sided(event)
    if action in MEANINGS:
        return MEANINGS[action]
    own: dict[str, Action] = {a: a for a in ("change-left", "change-right", "stop", *TURNING)}
    return (own[action],) if action in own else ()


def sided(event: Event) -> ActionName:
    """Return the action of an event with its side, such as "exit-left" for turning left."""
    if event.action in ("turn", "leave") and event.side is not None:
        sides: dict[str, ActionName] = {
            "left": "exit-left", "right": "exit-right", "straight": "exit-straight"
        }  # fmt: skip
        return sides[event.side]
    if event.action in ("go", "continue") and event.side == "straight":
        return "exit-straight"
    if event.action in ("change-lane", "overtake", "merge") and event.side in ("left", "right"):
        return "change-left" if event.side == "left" else "change-right"
    return event.action


def matches(expected: Expectation, event: Event) -> bool | None:
    """Check whether an expectation contains an event; None if its actions do not show that."""
    return contains(expected.actions, event)


def besides(belief: Belief | None, event: Event) -> tuple[Expectation, ...]:
    """Return what is likely by a belief other than an event, likeliest first."""
    names = macros(event)
    if not names or "stop" in names:
        return ()  # where it goes is no alternative to whether it stops
    found = () if belief is None else belief.expectations
    others = (e for e in found if e.probability >= OPEN and matches(e, event) is False)
    return tuple(e for e in others if event.action not in e.actions)


def wrong_belief(asked: Asked, event: Event, about: Window, came: bool) -> Belief | None:
    """Return the last belief that an event contradicts: what was expected was not what came.

    Args:
        asked: the act and its setting.
        event: what came, or what was asked about and did not come.
        about: when it came or would have come.
        came: whether it came.
    """
    vehicle = number(event.actor)
    if vehicle is None or not macros(event) or event.action in ("overtake", "pass"):
        return None  # passing in its own lane contradicts no expected lane change
    since = max(about.begin - BEFORE, asked.world.begin, last_turn(asked, vehicle, about.begin))
    for belief in reversed(asked.world.beliefs(vehicle, since, about.end)):
        first = belief.expectations[0] if belief.expectations else None
        if first is None or first.probability < CLEAR:
            continue
        same = matches(first, event)
        right = event.action not in CHANGING and took(asked, belief, first)
        if same is not None and same != came and not right:
            return belief
    return None


def went_elsewhere(asked: Asked, belief: Belief) -> bool:
    """Check whether a vehicle was seen to take another way than the likeliest by a belief."""
    done = came_of(asked, belief.vehicle, belief.time)
    if done is None or done.action == "stop":
        return False
    way = Event(done.action, Vehicle(belief.vehicle))
    return matches(belief.expectations[0], way) is not True


def came_of(asked: Asked, vehicle: int, since: float) -> Episode | None:
    """Return the first action of a vehicle after a time [s] that shows where it went.

    A turn may be under way at that time; who stood already did not come to a stop after it.
    """
    ways: tuple[ActionName, ...] = (
        "exit-left",
        "exit-right",
        "exit-straight",
        "change-left",
        "change-right",
        "stop",
    )
    found = asked.world.episodes(actor=Vehicle(vehicle), actions=ways, begin=since)
    then = Window(since, since)
    later = [
        e for e in found
        if e.begin >= since - 0.5 or (e.action != "stop" and overlaps(asked, e, then))
    ]  # fmt: skip
    return min(later, key=lambda e: (ways.index(e.action) > 2, e.begin), default=None)


def is_open(asked: Asked, belief: Belief) -> bool:
    """Check whether it is still open where a vehicle goes, as when it only changed lanes."""
    came = came_of(asked, belief.vehicle, belief.time)
    look = asked.world.look(belief.vehicle, asked.now)
    undecided = came is None or came.action in ("change-left", "change-right")
    return undecided and look is not None and look.in_view


def collision_chance(asked: Asked, at: float, vehicle: int | None = None) -> float | None:
    """Return how probable a collision was under the plan at a time [s]; None: not known."""
    trace = asked.ride.at(at)
    if trace is None or not trace.plan:
        return None
    try:
        found = chances(factual(asked.ride.model(trace), trace))
    except Unanswered:
        return None
    return found.collision if vehicle is None else found.collision_with(vehicle)


def simulated(asked: Asked, at: float, vehicle: int | None = None) -> tuple[int, int]:
    """Return in how many situations the plan at a time [s] was simulated, and how many collided."""
    trace = asked.ride.at(at)
    if trace is None or not trace.plan:
        return 0, 0
    try:
        found = factual(asked.ride.model(trace), trace).results
    except Unanswered:
        return 0, 0
    hit = [r.rollout for r in found if r.rollout.outcome == "collision"]
    return len(found), len([r for r in hit if vehicle in (None, r.collided_with)])


def _yields(stretches: tuple[HeldUp, ...], event: Event) -> bool:
    """Check whether a vehicle goes after the object in some stretches, by default after us."""
    other = None if event.object is None else number(event.object)
    hows = ("right-of-way",) if other is None else ("right-of-way", "cut-in")
    whom = EGO if event.object is None or is_us(event.object) else other
    return any(s.how in hows and s.vehicle == whom for s in stretches)
