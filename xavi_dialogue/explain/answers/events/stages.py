"""Stages: whether somebody stands or moves, is stuck or late, and whether something is over."""

from xavi_dialogue.domain.facts import Fact
from xavi_dialogue.domain.terms import Ego, Event, Happens, Is, Thing
from xavi_dialogue.explain.answers.events.happens import happens
from xavi_dialogue.explain.answers.measuring.durations import remaining_wait, stands
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import instant, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us, look_of, number, somebodies
from xavi_dialogue.explain.answers.reference.occasions import PLAIN, occasion
from xavi_dialogue.explain.answers.ride.places import time_to_go
from xavi_dialogue.explain.history.thresholds import MOVING, STANDING

STUCK = 5.0  # [s] at a standstill from which a vehicle is stuck


def actor(of: Is) -> Thing:
    """Return whose state is meant; ours if nobody is named."""
    if of.thing is not None:
        return of.thing
    return Ego() if of.event is None else of.event.actor


def still(of: Is, asked: Asked) -> Finding:
    """Check whether somebody stands, or moves."""
    about = window(asked, of.time, of.tense)
    past = is_past(asked, of.time, of.tense)
    if past and not about.instant:
        event = Event("stand" if of.state == "stationary" else "move", actor(of), time=of.time)
        return happens(Happens(event), asked)
    who = (somebodies(asked, actor(of), about.end) or (Ego(),))[0]
    speed = asked.world.measure("speed", who, instant(asked, of.time, of.tense))
    if speed.value is None:
        look = look_of(asked, who, asked.now)
        return unknown(speed.gap or "not-recorded", *(() if look is None else (look,)))
    return Finding((speed.value < STANDING) == (of.state == "stationary"), (speed,))


def over(of: Is, asked: Asked) -> Finding:
    """Check whether what the question refers to is over."""
    vehicle = number(of.thing)
    found = None if of.event is None else occasion(asked, of.event)
    if found is not None:
        return Finding(found.end is not None and found.end < asked.now, (found,))
    if vehicle is not None:
        look = asked.world.look(vehicle, asked.now)
        passed = look is not None and (not look.in_view or look.ahead < 0.0)
        return Finding(passed, () if look is None else (look,))
    if asked.ride.arrived or asked.ride.ended:
        return Finding(True)
    told = [
        e
        for e in asked.world.episodes()
        if e.action not in PLAIN
        and e.action != "speed-up"
        and (isinstance(e.actor, Ego) or isinstance(e.object, Ego))
    ]
    past = asked.past
    inside = [e for e in told if past is None or asked.meets(e.begin, e.end)]
    on = [e for e in inside if e.end is None]
    last = [e for e in on or inside if isinstance(e.actor, Ego)] or on or inside
    return Finding(not on, tuple(last[-1:]))


def late(of: Is, asked: Asked) -> Finding:
    """Return that it is not known whether we are late: no record has a time of appointment."""
    return unknown("unknown-plans", *known(time_to_go(asked, asked.now)))


def stuck(of: Is, asked: Asked) -> Finding:
    """Check whether somebody has been standing for long."""
    who = actor(of)
    event = Event("stand", who, time=of.time, tense="present")
    found = occasion(asked, event)
    moving = asked.world.measure("speed", who, asked.now).value or 0.0
    if found is None or (of.tense == "present" and moving >= MOVING):
        speed = asked.world.measure("speed", (somebodies(asked, who, asked.now) or (Ego(),))[0],
                                    asked.now)  # fmt: skip
        return Finding(False, known(speed))
    waiting = occasion(asked, Event("wait", who, tense="present"))
    wait = (remaining_wait(asked),) if is_us(who) and stands(asked) else ()
    facts: tuple[Fact, ...] = (waiting or found, *known(*wait))
    return Finding(asked.now - found.begin >= STUCK, facts)
