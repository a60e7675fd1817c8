"""Mistakes: expectations of others that turned out wrong, and whether anything went wrong."""

from collections.abc import Iterator
from itertools import groupby

from msgspec.structs import replace

from planner.prediction.goals import BRANCHES
from xavi_dialogue.domain.facts import Belief, Episode, Expectation
from xavi_dialogue.domain.terms import Ego, Event, Is, Lane, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import came_of, wrong_belief
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import away, overlaps, taken_place
from xavi_dialogue.explain.answers.ride.comfort import HARD, stretch
from xavi_dialogue.explain.answers.sight.room import lane_fits
from xavi_dialogue.explain.history.predicted_roads import Wrong, wrong_predictions

LEAST = 0.05  # [s] between a decision and what follows it
#: Actions that show which way a vehicle went.
WAYS: tuple[ActionName, ...] = (
    "exit-left",
    "exit-right",
    "exit-straight",
    "leave",
    "change-left",
    "change-right",
)

TURNS: tuple[ActionName, ...] = ("exit-left", "exit-right", "exit-straight", "leave")


def mistakes(
    asked: Asked, vehicle: int | None, about: Window
) -> tuple[tuple[Belief, Episode], ...]:
    """List the beliefs that later events contradict, each with the event, oldest first.

    The roads on which vehicles were seen tell where they went; of those whose roads no decision
    holds, their turns and lane changes do.

    Args:
        asked: the act and its setting.
        vehicle: the vehicle that they are about; None: any.
        about: when the events happened.
    """
    who = asked.world.vehicles if vehicle is None else (vehicle,)
    near = about.widened() if about.instant else about
    roads = {v for t in asked.ride.traces if t.road is not None for v in t.road.places}
    found = [
        (belief, came)
        for belief, came in _by_roads(asked)
        if belief.vehicle in who and overlaps(asked, came, near)
    ]
    for one in who:
        if one in roads:
            continue
        for came in asked.world.episodes(actor=Vehicle(one), actions=WAYS):
            if not overlaps(asked, came, near):
                continue
            event = Event(came.action, Vehicle(one))
            spent = Window(came.begin, came.begin)
            wrong = wrong_belief(asked, event, spent, came=True)
            if wrong is not None:
                found.append((wrong, came))
    return tuple(sorted(found, key=lambda pair: pair[1].begin))


def _by_roads(asked: Asked) -> Iterator[tuple[Belief, Episode]]:
    """Yield the surest of the beliefs that expected a vehicle on another road than it took."""
    every = sorted(wrong_predictions(asked.ride.traces), key=_way)
    for (vehicle, *_), group in groupby(every, key=_way):
        worst = max(group, key=lambda one: one.expected.probability)
        belief = asked.world.belief(vehicle, worst.trace.sim_time)
        if belief is None:
            continue
        place, chance = worst.expected.edge, worst.expected.probability
        there = [e for e in belief.expectations if e.place == place]
        actions = there[0].actions if there else (worst.expected.kind,)
        first = Expectation(actions, chance, place)
        others = tuple(e for e in belief.expectations if e.place != place)
        yield replace(belief, expectations=(first, *others)), _taken(asked, worst, belief)


def _way(one: Wrong) -> tuple[int, float, str, str]:
    return one.vehicle, one.came_at, one.expected.edge, one.truth.edge


def _taken(asked: Asked, one: Wrong, belief: Belief) -> Episode:
    """Return the turn, or the exit of a roundabout, by which a vehicle came to its road."""
    until = one.came_at + SHORT
    turns = asked.world.episodes(Vehicle(one.vehicle), TURNS, one.trace.sim_time, until)
    if one.truth.place in BRANCHES.values():  # a road that branches off is no turn
        return Episode(Vehicle(one.vehicle), "leave", one.came_at, one.came_at)
    if not turns:
        return Episode(Vehicle(one.vehicle), one.truth.kind, one.came_at, one.came_at)
    at = Window(one.came_at, one.came_at)
    taken = min(turns, key=lambda e: (away(asked, e, at), abs(e.begin - one.came_at)))
    ways = [e.actions for e in belief.expectations if e.place == one.truth.edge]
    passed = sum(action == "continue-next-exit" for action in (ways or [()])[0])
    ring = taken.action == "leave" and taken.exit is None and ways
    return replace(taken, exit=passed + 1) if ring else taken


def wrong(of: Is, asked: Asked) -> Finding:
    """Weigh that we were wrong in what we expected of a vehicle, or of anybody."""
    if isinstance(of.thing, Lane):
        return lane_fits(asked)
    if of.event is not None and is_us(of.event.actor):
        return _trouble(of, asked, of.event)
    about, vehicle = window(asked, of.time, "past"), number(of.thing)
    found = mistakes(asked, vehicle, about)
    if not found:
        right = Finding(of.state == "right")
        return right if vehicle is None else _borne_out(of, asked, vehicle, about)
    belief, came = found[-1]  # the question is about the latest
    if vehicle is not None:
        return _at_last(of, asked, belief, came)
    return Finding(of.state == "wrong", (came,), None, (belief,), mistaken=True)


def _at_last(of: Is, asked: Asked, belief: Belief, came: Episode) -> Finding:
    """Weigh what we expected of a vehicle right before it acted; a wrong belief is on record."""
    before = came.begin - LEAST
    wrong = [
        one
        for one in wrong_predictions(asked.ride.traces)
        if one.vehicle == belief.vehicle and one.trace.sim_time <= before < one.came_at + SHORT
    ]
    last = asked.world.belief(belief.vehicle, before)
    mistaken = max((one.trace.sim_time for one in wrong), default=belief.time)
    if last is None or not wrong:
        return Finding(of.state == "wrong", (came,), None, (belief,), mistaken=True)
    if last.time > mistaken + LEAST:
        return Finding(of.state == "right", (came,), None, (last,))
    return Finding(of.state == "wrong", (came,), None, (last,), mistaken=True)


def _borne_out(of: Is, asked: Asked, vehicle: int, about: Window) -> Finding:
    """Return what we believed of a vehicle, if that happened or is still open."""
    whole = asked.past is None and not about.instant
    ways = asked.world.episodes(actor=Vehicle(vehicle), actions=WAYS)
    at = ways[-1].begin - SHORT if whole and ways else asked.now if whole else about.begin
    belief = asked.world.belief(vehicle, at)
    if belief is None:
        return unknown("not-recorded")
    came = came_of(asked, vehicle, belief.time)
    if came is None or came.action == "stop":
        return Finding(None, (belief, *(() if came is None else (came,))), "in-future")
    return Finding(of.state == "right", (came,), None, (belief,))


def _trouble(of: Is, asked: Asked, event: Event) -> Finding:
    """Weigh that something went wrong in what we did: a collision, or hard braking."""
    found = taken_place(asked, event)
    crashed = asked.world.episodes(actor=Ego(), actions=("collide", "nearly-collide"))
    near = [e for e in crashed if overlaps(asked, e, stretch(asked, found).widened())]
    amiss = bool(near) or (found.peak or 0.0) >= HARD
    return Finding(amiss == (of.state == "wrong"), (found, *near))


def broken_down(of: Is, asked: Asked) -> Finding:
    """Return signs that a vehicle has broken down or not: how long it stands, and for whom."""
    if isinstance(of.thing, Ego):
        return Finding(False, known(asked.world.measure("speed", Ego(), asked.now)))
    who = number(of.thing)
    if who is None:
        return unknown("not-recorded")
    speed = asked.world.measure("speed", Vehicle(who), asked.now).value
    if speed is None:
        return unknown("out-of-view")
    if speed > 0.0:
        return Finding(False, known(asked.world.measure("speed", Vehicle(who), asked.now)))
    waits: tuple[ActionName, ...] = ("give-way", "wait")
    on = [e for e in asked.world.episodes(actor=Vehicle(who), actions=waits) if e.end is None]
    if on:
        return Finding(False, tuple(on[-1:]))
    stands = [
        replace(e, action="stand")
        for e in asked.world.episodes(actor=Vehicle(who), actions=("stand", "stop"))
        if e.end is None
    ]
    return unknown("not-sensed", *stands[-1:])
