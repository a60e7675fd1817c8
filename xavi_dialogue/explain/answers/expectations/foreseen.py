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
from xavi_dialogue.domain.terms import Event, Feature, Road, Unsaid, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.precedence import before_us, first, into_our_road
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasions, overlaps
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.history.motion import branches_off, foresees
from xavi_dialogue.explain.history.ride import Unanswered, prediction

EXPECTED = 0.5  # probability from which something was expected
MOVING = 1.0  # [m/s] by which a vehicle that goes gains speed
OPEN = 0.1  # probability from which an answer adds another alternative
CLEAR = 0.6  # from which one may be said to have been wrong
BEFORE = 10.0  # [s] before an event that a prediction of it can be from
SOLE = 0.95  # prior from which a road was the only one considered

#: The macro actions that an action of a question is foreseen by, sides apart.
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
#: What is meant of somebody who does so before us.
CROSSING: frozenset[ActionName] = frozenset(("pull-out", "enter", "cross"))
YIELDS: frozenset[ActionName] = frozenset(("give-way", "let-go", "wait"))


def chance(asked: Asked, event: Event, at: float) -> float | None:
    """Tell how probable it was at a time [s] that a vehicle does something; None: unknown."""
    vehicle = number(event.actor)
    if vehicle is None:
        return None
    if event.action in ("collide", "nearly-collide"):
        return collision_chance(asked, at, vehicle)
    if event.action in ("stop", "slow-down", "brake") and is_us(event.object):
        event = replace(event, action="give-way")  # "will he stop for us?"
    if event.action in CROSSING and event.object == Feature("way"):
        event = replace(event, action="cross", object=None)  # "will it cut across our path?"
    event = _alongside(asked, event, vehicle, at)
    trace = asked.ride.at(at, vehicle)
    known = None if trace is None else prediction(trace, vehicle)
    if trace is None or known is None or _ignored(known, event):
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


def unconsidered(asked: Asked, event: Event, at: float) -> Bound | None:
    """Tell of a turn or exit that a decision up to a time [s] left out of account; None: else.

    What a vehicle has done by then is behind it, and was no longer considered.
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
    """Tell whether what was done is asked of as past, or is no longer foreseen."""
    return event.tense == "past" or chance(asked, event, at) is None


def _ignored(known: VehiclePrediction, event: Event) -> bool:
    """Tell whether only the road ahead was considered, where a turn or exit is asked about."""
    names = macros(event)
    if not names or not set(names) <= set(TURNING):
        return False
    ways = [(goal, way) for goal in known.goals for way in goal.trajectories]
    found = any(branches_off(*one) or contains(one[1].actions, event) for one in ways)
    return not found and all(g.prior >= SOLE for g in known.goals if g.edge is not None)


def _alongside(asked: Asked, event: Event, vehicle: int, at: float) -> Event:
    """Take "pull out" and "cut in" of who drives the same way for a change to our side."""
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
    """Tell whether a predicted way leads before us, behind us or into our road, where asked."""
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
    """Tell whether a predicted way contains an event; None where ways tell nothing of such."""
    action = sided(event)
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
    """Tell whether an event is what comes where a road branches off; None: that tells nothing."""
    if event.action == "leave":
        return True
    return False if event.action in ("continue", "exit-straight", "keep-lane") else None


def contains(actions: tuple[ActionName, ...], event: Event) -> bool | None:
    """Tell whether actions are of such an event; leaving means at the next exit. None: unknown."""
    names = macros(event)
    if sided(event) != event.action or event.action != "leave":
        return any(step in names for step in actions) if names else None
    return next((step in names for step in actions if step != "continue"), False)


def macros(event: Event) -> tuple[Action, ...]:
    """Give the macro actions that an event stands for, its side considered; () for all else."""
    action = sided(event)
    if action in MEANINGS:
        return MEANINGS[action]
    own: dict[str, Action] = {a: a for a in ("change-left", "change-right", "stop", *TURNING)}
    return (own[action],) if action in own else ()


def sided(event: Event) -> ActionName:
    """Give the action with the side that was said put into it."""
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
    """Tell whether an expectation is of such an event; None where its actions do not tell."""
    return contains(expected.actions, event)


def besides(belief: Belief | None, event: Event) -> tuple[Expectation, ...]:
    """Give what else than an event is likely by a belief, likeliest first."""
    names = macros(event)
    if not names or "stop" in names:
        return ()  # where it goes is no alternative to whether it stops
    found = () if belief is None else belief.expectations
    others = (e for e in found if e.probability >= OPEN and matches(e, event) is False)
    return tuple(e for e in others if event.action not in e.actions)


def wrong_belief(asked: Asked, event: Event, about: Window, came: bool) -> Belief | None:
    """Give the last belief up to an event that it contradicts: what was expected was not what came.

    Args:
        asked: the act and its setting.
        event: what came, or what was asked about and did not come.
        about: when.
        came: whether it did.
    """
    vehicle = number(event.actor)
    if vehicle is None or not macros(event) or event.action in ("overtake", "pass"):
        return None  # who drives past in his own lane was not foreseen to leave it
    known = asked.world.beliefs(vehicle, max(about.begin - BEFORE, asked.world.begin), about.end)
    for belief in reversed(known):
        first = belief.expectations[0] if belief.expectations else None
        if first is None or first.probability < CLEAR:
            continue
        same = matches(first, event)
        if same is not None and same != came:
            return belief
    return None


def came_of(asked: Asked, vehicle: int, since: float) -> Episode | None:
    """Tell what a vehicle did first after a time [s] that tells where it went."""
    ways: tuple[ActionName, ...] = (
        "exit-left",
        "exit-right",
        "exit-straight",
        "change-left",
        "change-right",
        "stop",
    )
    found = asked.world.episodes(actor=Vehicle(vehicle), actions=ways, begin=since)
    later = [e for e in found if e.begin >= since - 0.5 or overlaps(asked, e, Window(since, since))]
    return min(later, key=lambda e: (ways.index(e.action) > 2, e.begin), default=None)


def is_open(asked: Asked, belief: Belief) -> bool:
    """Tell whether it is yet to be seen where a vehicle goes, as when it only changed lanes."""
    came = came_of(asked, belief.vehicle, belief.time)
    look = asked.world.look(belief.vehicle, asked.now)
    undecided = came is None or came.action in ("change-left", "change-right")
    return undecided and look is not None and look.in_view


def collision_chance(asked: Asked, at: float, vehicle: int | None = None) -> float | None:
    """Tell how probable a collision was under the plan at a time [s]; None: too little is known."""
    trace = asked.ride.at(at)
    if trace is None or not trace.plan:
        return None
    try:
        found = chances(factual(asked.ride.model(trace), trace))
    except Unanswered:
        return None
    return found.collision if vehicle is None else found.collision_with(vehicle)


def simulated(asked: Asked, at: float, vehicle: int | None = None) -> tuple[int, int]:
    """Tell in how many situations the plan at a time [s] was simulated, and how many collided."""
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
    """Tell whether it gives way on such a way: to the object, or to us where none is said."""
    whom = EGO if event.object is None or is_us(event.object) else number(event.object)
    return any(s.how == "right-of-way" and s.vehicle == whom for s in stretches)
