"""Measures of what a vehicle is, where it came from, and whether it is seen."""

from msgspec.structs import replace

from sim.roads.network import angle_between
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.vocabulary import Bearing, Side
from xavi_dialogue.explain.facts import beliefs
from xavi_dialogue.explain.facts.actions import SIDES
from xavi_dialogue.explain.facts.bearings import offset
from xavi_dialogue.explain.facts.episodes.ways import ways
from xavi_dialogue.explain.facts.looks import kind_of
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.history.nearing import still_to
from xavi_dialogue.explain.history.thresholds import BIG, OPPOSITE, SAME_WAY, SMALL

#: The expected actions that say where a vehicle goes; the first of them in a sequence counts.
AIMS = ("exit-left", "exit-right", "exit-straight", "continue-next-exit", "stop")


def colour(asked: Asked) -> Measure:
    """Return the colour of a vehicle."""
    shape = asked.states.shape(asked.vehicle)
    if shape is None:
        return asked.none("out-of-view")
    return asked.none("not-sensed") if shape.colour is None else asked.found(None, shape.colour)


def kind(asked: Asked) -> Measure:
    """Return the kind of a vehicle."""
    shape = asked.states.shape(asked.vehicle)
    return asked.none("out-of-view") if shape is None else asked.found(None, kind_of(shape))


def size(asked: Asked) -> Measure:
    """Return the length of a vehicle."""
    shape = asked.states.shape(asked.vehicle)
    if shape is None:
        return asked.none("out-of-view")
    word = "big" if shape.length >= BIG else "small" if shape.length < SMALL else None
    return asked.found(shape.length, word)


def name(asked: Asked) -> Measure:
    """Return the number of a vehicle."""
    return asked.found(float(asked.vehicle))


def origin(asked: Asked) -> Measure:
    """Return where a vehicle came from, seen from us, when it was seen first."""
    if asked.vehicle == EGO:
        return asked.none("not-recorded")
    motion = asked.states.motion(asked.vehicle)
    first = motion.time[0] if motion.time else None
    if first is None or first > asked.at + 1e-6:
        return asked.none("out-of-view")
    state, ego = asked.states.state(asked.vehicle, first), asked.states.state(EGO, first)
    if state is None or ego is None:
        return asked.none("out-of-view")
    turn = angle_between(state.heading, ego.heading)
    word: Bearing
    if abs(turn) <= SAME_WAY:
        word = "ahead" if offset(ego, state).ahead > 0.0 else "behind"
    elif abs(turn) >= OPPOSITE:
        word = "oncoming"
    else:
        word = "right" if turn > 0.0 else "left"
    side: Side | None = "right" if word == "right" else "left" if word == "left" else None
    return replace(asked.found(None, word, first), side=side)


def heading(asked: Asked) -> Measure:
    """Return where a vehicle is going, as an action: its turn since then, else what we believed."""
    if asked.vehicle == EGO:
        return replace(turn(asked), value=None)
    went = next((e for e in _turns(asked) if e.end is None or e.end >= asked.at), None)
    if went is not None and went.begin <= asked.states.ride.now:
        found = replace(asked.found(None, went.action, went.begin), side=went.side)
        return replace(found, until=went.end)
    known = beliefs.belief(asked.states, asked.vehicle, asked.at)
    if known is None:
        return asked.none(asked.gap() or "not-recorded")
    shares: dict[str, float] = {}
    for expected in known.expectations:
        first = next((a for a in expected.actions if a in AIMS), "continue")
        shares[first] = shares.get(first, 0.0) + expected.probability
    if len(shares) > 1:
        shares.pop("stop", None)
    best = max(shares, key=lambda action: shares[action])
    side = next((s for a, s in SIDES.items() if a == best), None)
    return replace(asked.found(min(shares[best], 1.0), best, known.time), side=side)


def _turns(asked: Asked) -> list[Episode]:
    found = ways(asked.states, asked.vehicle)
    kinds = ("exit-left", "exit-right", "exit-straight", "leave")
    return sorted((e for e in found if e.action in kinds), key=lambda e: e.begin)


def visibility(asked: Asked) -> Measure:
    """Return whether a vehicle is in view, hidden or lost; `value`: for how many seconds."""
    states, vehicle = asked.states, asked.vehicle
    if vehicle == EGO:
        return asked.none("not-applicable")
    last = states.last_seen(vehicle, asked.at)
    if last is None:
        return asked.none("out-of-view")
    if states.visible(vehicle, asked.at):
        part = [p for p in states.motion(vehicle).parts() if p.time[0] <= asked.at + 1e-6]
        since = part[-1].time[0] if part else last
        ends = [b for _, b in states.seen(vehicle).hidden if since < b <= asked.at]
        since = max([since, *ends])
        return asked.found(round(asked.at - since, 1), "in-view", since)
    word = "hidden" if states.hidden(vehicle, asked.at) is not None else "lost"
    return asked.found(round(asked.at - last, 1), word, last)


def turn(asked: Asked) -> Measure:
    """Return which way the ego goes at the next junction; `value`: how far [m] that is."""
    road = asked.states.road(asked.at)
    if road is None:
        return asked.none("not-recorded")
    if not road.route:
        return asked.none("not-applicable")
    step = road.route[0]
    left = max(still_to(asked.states.ride, step.distance, asked.at), 0.0)
    found = asked.found(left, step.turn)
    return replace(found, side=SIDES[step.turn], rule=step.rule, count=step.exits)
