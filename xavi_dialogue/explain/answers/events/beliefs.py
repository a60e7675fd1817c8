"""Beliefs: what was believed of a vehicle at a time, how and why that changed, what it then did."""

from collections.abc import Sequence
from itertools import pairwise

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Beliefs, NotRecorded, Priority, Verdict
from xavi_dialogue.domain.facts import Belief, Episode, Fact
from xavi_dialogue.domain.meaning import HowSure
from xavi_dialogue.domain.terms import (
    Believed,
    Event,
    Happens,
    Is,
    Not,
    Proposition,
    Related,
    Time,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.explain.answers.expectations.foreseen import (
    besides,
    came_of,
    chance,
    collision_chance,
    unconsidered,
)
from xavi_dialogue.explain.answers.expectations.plans import foreseen
from xavi_dialogue.explain.answers.measuring.closeness import How, closeness
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, instant, is_ahead, window
from xavi_dialogue.explain.answers.reference.naming import first_look, known, number
from xavi_dialogue.explain.answers.reference.occasions import occasion, occasions
from xavi_dialogue.explain.answers.ride.priority import right_of_way

UNSAID = Unsaid()
LIKELY = 0.5  # minimum probability of what was expected
MOVED = 0.08  # minimum change of a probability that has moved


def how_sure(question: HowSure, asked: Asked) -> Answer:
    """Return how probable something was or is, for the car.

    Raises:
        Unanswered: the record has no belief of it.
    """
    of = question.of
    while isinstance(of, Believed):
        of = of.content
    if isinstance(of, Not):
        found = how_sure(replace(question, of=of.content), asked)
        return denied(found) if isinstance(found, Beliefs) else found
    time = question.time if not isinstance(question.time, Unsaid) else time_of(of)
    match of:
        case Happens(event=event) if number(event.actor) is not None:
            under_way = _under_way(asked, event, time)
            at = asked_time(asked, event, time)
            return under_way or unconsidered(asked, event, at) or beliefs_of(asked, event, time)
        case Happens(event=Event(action="collide")):
            at = instant(asked, time)
            return Verdict(of, None, probability=collision_chance(asked, at))
        case Happens(event=event):
            expected = foreseen(asked, event)
            share = None if expected is None else expected.share
            return Verdict(of, None if share is None else share >= 0.5, probability=share)
        case Related(relation="has-priority-over") if (rule := ruled(asked, of)) is not None:
            return rule
        case Related(thing=thing) if (other := number(thing)) is not None:
            return history_of(asked, other, None, time)
        case Is(thing=thing) if number(thing) is not None and of.state in ("safe", "dangerous"):
            how: How = "safe" if of.state == "safe" else "dangerous"
            return closeness(asked, number(thing), window(asked, time), how)
    vehicle = _vehicle_in(of) or least_sure(asked, asked.now)
    if vehicle is None:
        raise Unanswered(NotRecorded("not-recorded", about="probability"))
    return history_of(asked, vehicle, None, time)


def denied(found: Beliefs) -> Beliefs:
    """Turn how probable conduct is into how probable it is that it does not come."""
    if found.of is None or found.probability is None:
        return found
    return replace(found, probability=1.0 - found.probability, denied=True, besides=())


def ruled(asked: Asked, of: Related) -> Priority | None:
    """Return who goes first by the rules of the road; None if they do not settle it."""
    told = right_of_way(asked, of.thing, of.to, Window(asked.now, asked.now))
    return told if told.rule in ("priority", "give-way") else None


def _under_way(asked: Asked, event: Event, time: Time) -> Verdict | None:
    """Return that somebody does so now, which needs no probability; None: nobody does."""
    if event.tense == "past" or instant(asked, time, "present") < asked.now - SHORT:
        return None
    found = occasion(asked, replace(event, tense="present"))
    on = found is not None and found.end is None and event.action != "do"
    now = Happens(replace(event, tense="present", modal=None))
    return Verdict(now, True, (found,)) if found is not None and on else None


def beliefs_of(asked: Asked, event: Event, time: Time = UNSAID) -> Beliefs:
    """Return what was believed of the conduct that is asked about.

    Raises:
        Unanswered: the vehicle was never seen, or nothing was believed of it.
    """
    vehicle = known(asked, Vehicle(number(event.actor) or 0), asked.now).number
    return history_of(asked, vehicle, event, time)


def history_of(asked: Asked, vehicle: int, event: Event | None, time: Time = UNSAID) -> Beliefs:
    """Return the beliefs about a vehicle that changed, with that of the time asked about.

    Raises:
        Unanswered: nothing was ever believed of the vehicle.
    """
    world = asked.world
    at = asked_time(asked, event, time)
    every = world.beliefs(vehicle, world.begin, asked.now)
    if not every:
        raise Unanswered(NotRecorded("not-recorded", Vehicle(vehicle), about="probability"))
    told = Event("continue", Vehicle(vehicle)) if event is None else event
    history, curve = moved(asked, vehicle, event, every)
    span = steepest(curve)
    current = world.belief(vehicle, at)
    if event is None:
        share = current.expectations[0].probability if current and current.expectations else None
    else:
        share = chance(asked, event, at)
    if current is not None and current not in history:
        history = tuple(sorted((*history, current), key=lambda b: b.time))
    came = occasion(asked, told) if event is not None else None
    if came is None or came.begin < at - SHORT:
        came = came_of(asked, vehicle, at)
    why = None if span is None else _conduct(asked, vehicle, span)
    return Beliefs(
        vehicle, event, history, share, None if current is None else current.time, why, span, came,
        besides=() if event is None else besides(current, event),
    )  # fmt: skip


def foreknown(asked: Asked, event: Event, time: Time) -> Finding:
    """Check whether conduct was expected before it came, since when, and what came."""
    vehicle = number(event.actor) or 0
    then = event.modal == "would"  # "were you sure it would turn": it may have done so since
    lately = replace(event, tense="past", modal=None, time=Unsaid()) if then else event
    came = occasion(asked, lately)
    event = replace(event, manner=())  # no prediction has how hard a vehicle brakes
    about = window(asked, time)
    said = asked.past is not None or not isinstance(time, Unsaid)
    at = instant(asked, time, "past") if said else asked.now
    if came is not None and (not said or came.begin <= about.end + SHORT):
        at = min(at, came.begin - 0.2)
    share, belief = chance(asked, event, at), asked.world.belief(vehicle, at)
    facts: tuple[Fact, ...] = () if came is None else (came,)
    shown = () if belief is None else (belief,)
    left_out = unconsidered(asked, replace(event, tense="past"), at)
    if left_out is not None:
        return Finding(False, facts, None, shown, answer=left_out)
    if share is None:
        look = first_look(asked, vehicle, at)
        return Finding(None, (*facts, *(() if look is None else (look,))), "not-recorded", shown)
    since, before = held_since(asked, event, at)
    told = Beliefs(
        vehicle, event, shown, probability=share, time=at,
        besides=besides(belief, event), knew=True, came=came, since=since, before=before,
    )  # fmt: skip
    return Finding(share >= LIKELY, facts, None, shown, probability=share, answer=told)


def held_since(asked: Asked, event: Event, at: float) -> tuple[float | None, float | None]:
    """Return since when [s] an event was likely up to a time [s], and its probability before.

    None if it was likely from the first on, or not at all.
    """
    vehicle = number(event.actor) or 0
    since, before = None, None
    for belief in asked.world.beliefs(vehicle, asked.world.begin, at):
        share = chance(asked, event, belief.time)
        if share is None:
            continue
        if share < LIKELY:
            since, before = None, share
        elif since is None:
            since = belief.time
    return (since, before) if before is not None and since is not None else (None, None)


def since_when(asked: Asked, event: Event) -> Beliefs:
    """Return since when conduct of a vehicle has been believed more likely than not.

    Raises:
        Unanswered: the vehicle was never seen, or nothing was believed of it.
    """
    found = beliefs_of(asked, event, event.time)
    done = occasions(asked, event)
    end = done[-1].begin if done else asked.now
    since: Belief | None = None
    for belief in asked.world.beliefs(found.vehicle, asked.world.begin, end):
        likely = (_share(asked, belief, event) or 0.0) >= LIKELY
        since = (since or belief) if likely else None
    if since is None:
        return found
    share = _share(asked, since, event)
    return replace(found, since=since.time, time=since.time, probability=share)


def asked_time(asked: Asked, event: Event | None, time: Time) -> float:
    """Return the time [s] asked about: as said, else when a past event last began, else now."""
    if is_ahead(asked, time, "present"):
        return asked.now
    at = instant(asked, time, "past")
    if at < asked.now - SHORT or event is None or not isinstance(time, Unsaid):
        return at
    done = occasions(asked, event)
    if event.tense in ("past", "perfect") and done:
        return done[-1].begin
    return at


def moved(
    asked: Asked, vehicle: int, event: Event | None, every: Sequence[Belief]
) -> tuple[tuple[Belief, ...], tuple[tuple[float, float], ...]]:
    """Return the beliefs that changed, and the probability over time [s]."""
    kept: list[Belief] = []
    curve: list[tuple[float, float]] = []
    for belief in every:
        share = _share(asked, belief, event)
        if share is None:
            continue
        last = curve[-1][1] if curve else None
        other = bool(kept) and _top(kept[-1]) != _top(belief) and event is None
        curve.append((belief.time, share))
        if last is None or other or abs(share - (_share(asked, kept[-1], event) or 0.0)) >= MOVED:
            kept.append(belief)
    return tuple(kept), tuple(curve)


def steepest(curve: Sequence[tuple[float, float]]) -> tuple[float, float] | None:
    """Return the times [s] between which a probability moved most; None if it hardly did."""
    pairs = list(pairwise(curve))
    one = max(pairs, key=lambda pair: abs(pair[1][1] - pair[0][1]), default=None)
    if one is None or abs(one[1][1] - one[0][1]) < MOVED:
        return None
    return one[0][0], one[1][0]


def time_of(of: Proposition | None) -> Time:
    """Return the time within a proposition."""
    match of:
        case Happens(event=event):
            return event.time
        case Not(content=content) | Believed(content=content):
            return time_of(content)
        case Related(time=time) | Is(time=time):
            return time
    return Unsaid()


def _share(asked: Asked, belief: Belief, event: Event | None) -> float | None:
    if event is None:
        return belief.expectations[0].probability if belief.expectations else None
    return chance(asked, event, belief.time)


def _top(belief: Belief) -> tuple[str, ...]:
    return belief.expectations[0].actions if belief.expectations else ()


def _conduct(asked: Asked, vehicle: int, span: tuple[float, float]) -> Episode | None:
    """Return the last action of the vehicle while the belief moved most, or just before."""
    found = asked.world.episodes(actor=Vehicle(vehicle), begin=span[0] - SHORT, end=span[1])
    plain = (
        "move", "continue", "keep-lane", "follow", "see", "come", "appear", "disappear", "approach",
    )  # fmt: skip
    fresh = [e for e in found if e.begin <= span[1] and e.action not in plain]
    return max(fresh, key=lambda e: e.begin, default=None)


def _vehicle_in(of: Proposition | None) -> int | None:
    match of:
        case Related(thing=thing, to=to):
            return number(thing) or number(to)
        case Is(thing=thing):
            return number(thing)
    return None


def least_sure(asked: Asked, at: float) -> int | None:
    """Return the vehicle about which the decision at a time [s] is least sure."""
    found = [
        (belief.expectations[0].probability, vehicle)
        for vehicle in asked.world.in_view(at)
        if (belief := asked.world.belief(vehicle, at)) is not None and belief.expectations
    ]
    return min(found, default=(0.0, None))[1]
