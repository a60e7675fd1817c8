"""Slowing: whether we stop or slow down for somebody, in the rollouts of our plan."""

from planner.record.trace import PlanTrace, Rollout
from xavi_dialogue.domain.answers import Slowing
from xavi_dialogue.domain.terms import Ego, Event, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import EXPECTED, HALTS
from xavi_dialogue.explain.answers.expectations.plans import current_plan, foreseen, slowest_ahead
from xavi_dialogue.explain.answers.expectations.precedence import First, first
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import somebodies
from xavi_dialogue.explain.causes.vehicles.course import expected
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.nearing import junctions_ahead
from xavi_dialogue.explain.history.ride import prediction
from xavi_dialogue.explain.history.thresholds import STANDING
from xavi_dialogue.explain.history.traffic_lights import rule_at

SLOWS: frozenset[ActionName] = HALTS | {"brake", "slow-down", "give-way", "let-go"}
POSSIBLE = 0.1  # least share of the rollouts for saying that somebody may hold us up
SURE = 0.8  # probability that is enough to state who comes first
NEXT = 150.0  # [m] ahead, within which a junction is meant by "the next one"
SLOWER = 1.5  # [m/s] by which we must slow down for passengers to call it slower


def slowing(asked: Asked, event: Event) -> Slowing | None:
    """Return whether we stop or slow down, and for those asked about; None: not asked.

    Also None if no rollout is known, or if nobody is named and we stop or slowing is asked about.
    """
    if event.action not in SLOWS or not asked.ride.traces:
        return None
    stop, slow = foreseen(asked, Event("stop")), slowest_ahead(asked)
    speed = asked.world.measure("speed", Ego(), asked.now).value
    if slow is None or speed is None or speed < STANDING:
        return None
    others = _others(asked, event.object)
    if event.object is not None and not others:
        return None
    stops = stop is not None and stop.share >= EXPECTED
    if not others and (stops or event.action not in HALTS):
        return None
    shares = {v: _held(asked, v) for v in others}
    held = tuple(v for v, share in shares.items() if share >= POSSIBLE)
    slower = speed - slow >= SLOWER
    return Slowing(
        held or others, stops,
        held=max(shares[v] for v in held) if held else 0.0,
        slows=event.action not in HALTS,
        slow=slow if slower else None,
        time=stop.moment if stop is not None and stops else None,
        share=stop.share if stop is not None and stops else None,
        order=None if held or not others else _order(asked, others),
        yields=not others and event.action in HALTS and _yields(asked),
    )  # fmt: skip


def speed_ahead(asked: Asked) -> Slowing | None:
    """Return how fast we are going to be where we are slowest next; None: about as fast as now."""
    if not asked.ride.traces or asked.past is not None:
        return None
    stop, slow = foreseen(asked, Event("stop")), slowest_ahead(asked)
    speed = asked.world.measure("speed", Ego(), asked.now).value
    if slow is None or speed is None or speed - slow < SLOWER:
        return None
    if stop is None or stop.share < EXPECTED:
        slower = foreseen(asked, Event("slow-down"))
        begin = None if slower is None else slower.moment
        return Slowing((), False, 0.0, slows=True, slow=slow, time=begin)
    return Slowing((), True, 0.0, slow=slow, time=stop.moment, share=stop.share)


def _yields(asked: Asked) -> bool:
    """Check whether we have to give way to somebody at the next junction, or where roads merge."""
    road = asked.world.road(asked.now)
    if road is None:
        return False
    near = [step for step in junctions_ahead(asked.ride, asked.now)[:1] if step.distance <= NEXT]
    owed = any(fact.who != "ego" for fact in road.priority)
    return owed or any(rule_at(road, step) != "priority" for step in near)


def _others(asked: Asked, thing: Thing | None) -> tuple[int, ...]:
    """Return the numbers of the vehicles and people that a term stands for."""
    if thing is None:
        return ()
    found = somebodies(asked, thing, asked.now)
    return tuple(v.number for v in found if isinstance(v, Vehicle))


def _held(asked: Asked, vehicle: int) -> float:
    """Return the share of the rollouts of our plan in which a vehicle or person holds us up."""
    known = current_plan(asked)
    if known is None:
        return 0.0

    def mark(rollout: Rollout, _: Motion) -> float | None:
        return next((h.since for h in rollout.held_up if h.vehicle == vehicle), None)

    found = expected(*known, mark)
    return 0.0 if found is None else found.share


def _order(asked: Asked, others: tuple[int, ...]) -> First | None:
    """Return who comes first where our ways meet, by the likeliest for each; None: they differ."""
    trace = asked.ride.latest
    found = {_likeliest_order(trace, vehicle) for vehicle in others}
    if len(found) > 1:
        found -= {"nobody"}  # those who do not come into our way do not count
    return found.pop() if len(found) == 1 else None


def _likeliest_order(trace: PlanTrace, vehicle: int) -> First | None:
    known = prediction(trace, vehicle)
    if known is None:
        return None
    ways = [(g.probability * w.probability, w) for g in known.goals for w in g.trajectories]
    share: dict[First, float] = {}
    for chance, way in ways:
        came = first(trace, way)
        if came is not None:
            share[came] = share.get(came, 0.0) + chance
    best = max(share, key=lambda one: share[one], default=None)
    return best if best is not None and share[best] >= SURE else None
