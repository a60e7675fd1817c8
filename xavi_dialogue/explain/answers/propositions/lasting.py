"""Lasting: how long a state holds or held: behind us, in our lane, in view, at a standstill."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Lasted, Staying
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import HowLong
from xavi_dialogue.domain.terms import (
    At,
    Compares,
    Ego,
    Event,
    Feature,
    Happens,
    Is,
    Not,
    Now,
    Proposition,
    Related,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.expectations.foreseen import EXPECTED, HALTS, chance
from xavi_dialogue.explain.answers.expectations.plans import MOVES, steps
from xavi_dialogue.explain.answers.measuring.durations import (
    event_lasting,
    halted,
    lasting,
    remaining_wait,
    stands,
)
from xavi_dialogue.explain.answers.propositions.weighing import weigh
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import UNSAID, is_ahead, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us
from xavi_dialogue.explain.answers.ride.passages import taken
from xavi_dialogue.explain.answers.ride.places import time_to_go

STEP = 0.5  # [s] between the times that are checked
BREAK = 1.5  # [s] maximum interruption of a state
HOLDING = ("queue", "light")  # to be in one, or at one, is to wait
MANY = 240  # maximum of times that are checked


def how_long(question: HowLong, asked: Asked) -> Answer:
    """Return how long something lasted, has lasted so far, or is expected to last.

    Raises:
        Unanswered: it did not happen.
    """
    of = question.of
    held = isinstance(of, Related) and isinstance(of.to, Feature) and of.to.kind in HOLDING
    if isinstance(of, Related) and is_us(of.thing) and held:
        of = Event("wait", time=of.time, tense=of.tense)
    if isinstance(of, Related) and of.relation in ("behind", "ahead-of") and _to_come(of, asked):
        back, front = (of.thing, of.to) if of.relation == "behind" else (of.to, of.thing)
        if is_us(back) and isinstance(front, Vehicle):
            return staying(asked, front)
    match of:
        case Is(state="stationary", thing=Ego(), time=WholeRide() as time, tense=tense):
            return event_lasting(Event("stand", Ego(), time=time, tense=tense), asked)  # in all
    if not isinstance(of, Event):
        stood = _stands_there(of, asked)
        return state_lasting(of, asked) if stood is None else lasting(asked, stood)
    if is_us(of.actor) and _to_come(of, asked):
        leader = of.object if isinstance(of.object, Vehicle) else in_front(asked)
        behind = of.action == "follow" or (of.action in HALTS and not halted(asked))
        if behind and leader is not None:
            return staying(asked, leader)
    if of.action == "follow" and isinstance(of.object, Ego | Vehicle):
        return state_lasting(Related("behind", of.actor, of.object, of.time, of.tense), asked)
    if of.action == "see" and is_us(of.actor) and isinstance(of.object, Vehicle):
        return state_lasting(Is("visible", of.object, time=of.time, tense=of.tense), asked)
    return event_lasting(of, asked)


def _stands_there(of: Proposition, asked: Asked) -> Episode | None:
    """Find the standstill of somebody, for a question how long they have been there."""
    match of:
        case Is(state="present", thing=Vehicle() as who, time=Now() | Unsaid() | WholeRide()):
            stood = asked.world.episodes(who, ("stop", "stand"))
            return next((e for e in reversed(stood) if e.end is None), None)
    return None


def _to_come(of: Event | Related, asked: Asked) -> bool:
    """Check whether the question is how long something goes on from now."""
    if is_ahead(asked, of.time, of.tense):
        return True
    going = isinstance(of.time, Now | Unsaid) and of.tense == "present"
    return going and isinstance(of, Event) and "already" not in of.manner


def staying(asked: Asked, leader: Vehicle) -> Staying:
    """Return how long we plan to stay behind somebody: until we change lanes, or they turn off."""
    if stands(asked):
        return Staying(leader, left=remaining_wait(asked))
    for action, begin in steps(asked):
        if action in MOVES:
            return Staying(leader, action, begin)
    off = chance(asked, Event("turn", leader), asked.now)
    if off is not None and off >= EXPECTED:
        return Staying(leader, off=off)
    return Staying(leader, left=time_to_go(asked, asked.now))


def in_front(asked: Asked) -> Vehicle | None:
    """Return the vehicle that we follow now."""
    followed = asked.world.episodes(Ego(), ("follow",))
    on = [e.object for e in followed if e.end is None and isinstance(e.object, Vehicle)]
    return on[-1] if on else None


def state_lasting(of: Proposition, asked: Asked) -> Answer:
    """Return since when a state holds, or how long it held the last time.

    For a state that never held, the answer is whether it does.
    """
    if isinstance(of, Happens):
        return event_lasting(of.event, asked)
    if (through := taken(of, asked)) is not None:
        return through
    time = getattr(of, "time", UNSAID)
    tense = getattr(of, "tense", "present")
    about = window(asked, time, "perfect")
    on = isinstance(time, Now | Unsaid) or not is_past(asked, time, tense)
    end = asked.now if on else about.end
    begin = max(asked.world.begin, end - MANY * STEP)
    count = int((end - begin) / STEP)
    last: float | None = None
    first = end
    for k in range(count + 1):
        at = end - k * STEP
        holds = weigh(at_time(of, at), asked).holds
        if holds:
            last = at if last is None else last
            first = at
        elif last is not None and first - at > BREAK:
            break
    if last is None:
        return weigh(of, asked).verdict(of)
    going = asked.now - last <= BREAK
    return Lasted(of, first, None if going else last, asked.now, first - asked.world.begin < STEP)


def at_time(of: Proposition, at: float) -> Proposition:
    """Return a state with a moment [s] as its time."""
    if isinstance(of, Not):
        return Not(at_time(of.content, at))
    if isinstance(of, Compares):
        return replace(of, left=replace(of.left, time=At(at)))
    return replace(of, time=At(at)) if hasattr(of, "time") else of
