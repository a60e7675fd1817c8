"""Relations of two things at a time: ahead of, has priority over, is waiting for, can see."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.terms import Ego, Exit, Junction, Lane, Road, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import Relation
from xavi_dialogue.explain.facts import bodies
from xavi_dialogue.explain.facts.actions import somebody
from xavi_dialogue.explain.facts.bearings import Offset, oncoming
from xavi_dialogue.explain.facts.episodes.meetings import crossings, followings
from xavi_dialogue.explain.facts.episodes.waiting import top_holders, waits
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import EPSILON
from xavi_dialogue.explain.history.restraints import held_by
from xavi_dialogue.explain.history.thresholds import NEAR, ROAD_WIDTH, SAME_LANE, STANDING

Told: TypeAlias = bool | None
KMH = 3.6  # [km/h] in 1 m/s


def holds(states: States, relation: Relation, thing: Thing, to: Thing, at: float) -> Told:
    """Check whether a relation holds at a time [s]; None if that cannot be known."""
    first, second = _number(thing), _number(to)
    if relation == "on":
        return None if first is None else _on(states, first, to, at)
    if relation == "same-as":
        return None if first is None or second is None else first == second
    if first is None or second is None:
        return None
    reader = OF_TWO.get(relation)
    return None if reader is None else reader(states, first, second, at)


def _number(thing: Thing) -> int | None:
    match thing:
        case Ego():
            return EGO
        case Vehicle(number):
            return number
        case Vehicles(numbers) if len(numbers) == 1:
            return numbers[0]
    return None


def _placed(fits: Callable[[Offset], bool]) -> Callable[[States, int, int, float], Told]:
    """Return a check of a relation that depends on where the first is, seen from the second."""

    def read(states: States, thing: int, to: int, at: float) -> Told:
        seen = states.offset(to, thing, at)
        return None if seen is None else fits(seen)

    return read


def _ahead(seen: Offset) -> bool:
    near = abs(seen.left) <= max(ROAD_WIDTH, 0.5 * seen.ahead)
    return seen.ahead > 0.0 and near and not _alongside(seen)


def _behind(seen: Offset) -> bool:
    near = abs(seen.left) <= max(ROAD_WIDTH, -0.5 * seen.ahead)
    return seen.ahead < 0.0 and near and not _alongside(seen)


def _alongside(seen: Offset) -> bool:
    """Check whether a vehicle drives our way in a lane beside us, neither ahead nor behind."""
    return seen.same_way and abs(seen.ahead) <= seen.clear and abs(seen.left) > SAME_LANE


def _beside(seen: Offset) -> bool:
    return abs(seen.ahead) <= seen.clear and SAME_LANE < abs(seen.left) <= ROAD_WIDTH


def _near(states: States, thing: int, to: int, at: float) -> Told:
    a, b = states.state(thing, at), states.state(to, at)
    return None if a is None or b is None else bodies.distance(a, b) <= NEAR


def _priority(states: States, thing: int, to: int, at: float) -> Told:
    """Check whether the first has right of way; None if that depends or is not recorded."""
    other = to if thing == EGO else thing
    road = states.road(at)
    if EGO not in (thing, to) or other == EGO or road is None:
        return None
    who = next((fact.who for fact in road.priority if fact.vehicle == other), None)
    if who is None or who == "depends":
        return None
    return (who == "ego") == (thing == EGO)


def _yields(states: States, thing: int, to: int, at: float) -> Told:
    return _priority(states, to, thing, at)


def _waiting(states: States, thing: int, to: int, at: float) -> Told:
    """Check whether the first stands or gives way for the second."""
    if not states.known(thing, at):
        return None
    now = [
        e for e in waits(states, thing) if e.begin - EPSILON <= at <= _end(states, e.end) + EPSILON
    ]
    if any(to in (somebody(e.object) or frozenset()) for e in now):
        return True
    state = states.state(thing, at)
    stands = state is not None and state.speed < STANDING
    if stands and thing != EGO and not now:
        return None  # it stands, but for whom is not known
    return False


def _end(states: States, end: float | None) -> float:
    return states.ride.now if end is None else end


def _sees(states: States, thing: int, to: int, at: float) -> Told:
    """Check whether the first can see the second; known only of the ego."""
    return states.visible(to, at) if thing == EGO else None


def _in_the_way(states: States, thing: int, to: int, at: float) -> Told:
    """Check whether the first holds the second up, or has to be let go first by us."""
    if to == EGO and (held_by(states.ride, thing, at, at) or _walks_before_us(states, thing, at)):
        return True
    trace = states.trace(at)
    if trace is None:
        return None
    return any(who == thing for who, _ in top_holders(states, trace, to))


def _walks_before_us(states: States, thing: int, at: float) -> bool:
    """Check whether somebody on foot is crossing our way in front of us."""
    shape, seen = states.shape(thing), states.offset(EGO, thing, at)
    if shape is None or shape.kind not in ON_FOOT or seen is None or seen.ahead <= 0.0:
        return False
    return any(e.begin <= at <= _end(states, e.end) for e in crossings(states, thing))


def _speeds(sign: float) -> Callable[[States, int, int, float], Told]:
    def read(states: States, thing: int, to: int, at: float) -> Told:
        a, b = states.state(thing, at), states.state(to, at)
        if a is None or b is None:
            return None
        return sign * (round(KMH * a.speed) - round(KMH * b.speed)) > 0  # rounded as stated

    return read


def _on(states: States, vehicle: int, where: Thing, at: float) -> Told:
    """Check whether a road user is on a lane or road, or in a roundabout or junction."""
    shape = states.shape(vehicle)
    if shape is not None and shape.kind in ON_FOOT:
        over = crossings(states, vehicle) if isinstance(where, Junction | Road | Lane) else []
        return any(e.begin <= at <= _end(states, e.end) for e in over)
    here, mine = states.place(vehicle, at), states.place(EGO, at)
    if here is None:
        return None
    if isinstance(where, Junction):
        return here.roundabout if where.form == "roundabout" else here.in_junction
    if isinstance(where, Road):
        return None if mine is None or where.which != "own" else here.edge == mine.edge
    if not isinstance(where, Lane) or isinstance(where, Exit) or mine is None or here.lane is None:
        return None
    whose = mine if where.of is None else states.place(_number(where.of) or EGO, at)
    if whose is None or whose.lane is None:
        return None
    same = here.edge == whose.edge
    match where.which:
        case "own":
            return same and here.lane == whose.lane
        case "left":
            return (
                here.lane == here.lanes - 1 if vehicle == EGO else same and (here.lane > whose.lane)
            )
        case "right":
            return here.lane == 0 if vehicle == EGO else same and here.lane < whose.lane
        case "rightmost":
            return here.lane == 0
        case "leftmost":
            return here.lane == here.lanes - 1
        case "other":
            return not (same and here.lane == whose.lane)
    return None


def _together(states: States, thing: int, to: int, at: float) -> Told:
    """Check whether two drive together: on one road or roundabout, or one behind the other."""
    here, there = states.place(thing, at), states.place(to, at)
    if here is None or there is None:
        alike = False
    else:
        alike = here.edge == there.edge or (here.roundabout and there.roundabout)
    if alike:
        return True
    if EGO not in (thing, to):
        return None
    found = followings(states, to if thing == EGO else thing)
    return any(e.begin <= at <= _end(states, e.end) + EPSILON for e in found)


OF_TWO: Mapping[Relation, Callable[[States, int, int, float], Told]] = {
    "ahead-of": _placed(_ahead),
    "behind": _placed(_behind),
    "left-of": _placed(lambda seen: seen.left > SAME_LANE),
    "right-of": _placed(lambda seen: seen.left < -SAME_LANE),
    "beside": _placed(_beside),
    "near": _near,
    "closer-than": _near,
    "oncoming-to": _placed(oncoming),
    "has-priority-over": _priority,
    "must-yield-to": _yields,
    "waiting-for": _waiting,
    "can-see": _sees,
    "in-the-way-of": _in_the_way,
    "faster-than": _speeds(1.0),
    "slower-than": _speeds(-1.0),
    "with": _together,
}
