"""Nearing: whether we reach somebody in front, and whether somebody comes closer or passes us."""

from typing import Final

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import PlaceReason
from xavi_dialogue.domain.facts import Fact, Look, Measure, Relating
from xavi_dialogue.domain.terms import Ego, Event, Now, Unsaid, Vehicle
from xavi_dialogue.explain.answers.expectations.foreseen import chance
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import EXPECTED, Finding, known
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.naming import is_us, look_of, number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.ride.priority import priority_at, rule_between

BESIDE: Final = 2.0  # [m] minimum offset sideways of a vehicle in another lane
ALONG: Final = ("ahead", "behind", "beside")  # how bearings begin of vehicles that drive our way
BEFORE_US: Final = ("cross", "pull-out")
POSSIBLE: Final = 0.1  # minimum probability from which the rule is stated as well
SINCE: Final = 1.0  # [s] between the distances that show whether a vehicle comes closer
ASIDE_IN: Final = 0.6  # [s] between the places that show whether a vehicle drives sideways
ASIDE: Final = 0.2  # [m] minimum movement sideways in that time
CLOSER: Final = 0.2  # [m] minimum by which a vehicle has come closer in that time


def nears(asked: Asked, event: Event) -> Finding | None:
    """Check whether we are going to reach a vehicle in front, by both speeds now."""
    look = look_of(asked, event.object, asked.now) if event.object is not None else None
    if look is None or not look.in_view:
        return None
    beside = event.action == "overtake" and abs(look.left) >= BESIDE  # we need not change lanes
    if event.action not in ("approach", "pass") and not beside:
        return None
    if look.oncoming or look.ahead <= 0.0:
        return None
    speeds, ours = _speeds(asked, look)
    return None if ours is None else Finding(ours > look.speed, speeds)


def past_leader(asked: Asked, event: Event) -> Event:
    """Read passing a vehicle that drives ahead in our lane as overtaking: we have to leave it."""
    look = look_of(asked, event.object, asked.now) if event.object is not None else None
    if event.action != "pass" or not is_us(event.actor) or look is None or not look.in_view:
        return event
    ahead = look.ahead > 0.0 and abs(look.left) < BESIDE and not look.oncoming
    queued = asked.world.measure("speed", Ego(), asked.now).value == 0.0  # we stand behind it
    moving = look.bearing.startswith("ahead") and (look.speed > 0.0 or queued)
    return replace(event, action="overtake") if ahead and moving else event


def settled(asked: Asked, event: Event, going: tuple[Fact, ...]) -> Finding | None:
    """Check what is to come by how both drive now, or by who comes first; None for all else."""
    return (
        passes(asked, event)
        or stays(asked, event, going)
        or comes_before(asked, event)
        or moves_over(asked, event)
    )


def moves_over(asked: Asked, event: Event) -> Finding | None:
    """Return that a vehicle changes lanes, if it indicates to that side and drives sideways."""
    side = {"change-left": "left", "change-right": "right", "change-lane": event.side}
    if event.action not in side:
        return None
    now, wanted = asked.now, side[event.action]
    shown = asked.world.episodes(event.actor, "signal", now, now)
    lit = [e for e in shown if e.end is None and e.side == (wanted or e.side)]
    look, before = look_of(asked, event.actor, now), look_of(asked, event.actor, now - ASIDE_IN)
    if not lit or look is None or before is None or not (look.in_view and before.in_view):
        return None
    aside = look.left - before.left if lit[-1].side == "left" else before.left - look.left
    return Finding(True, tuple(lit[-1:])) if aside > ASIDE else None


def passes(asked: Asked, event: Event) -> Finding | None:
    """Check whether a vehicle in another lane is about to pass us, by both speeds.

    None if it drives in our lane, or another way.
    """
    look = look_of(asked, event.actor, asked.now)
    if event.action not in ("pass", "overtake") or look is None or not look.in_view:
        return None
    if abs(look.left) < BESIDE or look.bearing.partition("-")[0] not in ALONG:
        return None
    if event.object is not None and not is_us(event.object):
        return None
    if look.ahead > look.length:
        return Finding(False, (look,))  # it is in front of us already
    shown = asked.world.episodes(event.actor, "signal", asked.now - SINCE)
    if any(e.side == ("right" if look.left > 0.0 else "left") for e in shown):
        return None  # it is about to move behind us
    speeds, ours = _speeds(asked, look)
    return None if ours is None else Finding(look.speed > ours, speeds)


def comes_before(asked: Asked, event: Event) -> Finding | None:
    """Check whether a vehicle is going to cross our way before us, and who has right of way.

    None if that is not asked, or neither is known.
    """
    vehicle = number(event.actor)
    ours = event.object is None or is_us(event.object)
    look = look_of(asked, event.actor, asked.now) if vehicle is not None else None
    if event.action not in BEFORE_US or vehicle is None or not ours:
        return None
    if look is None or not look.in_view or occasion(asked, replace(event, tense="present")):
        return None
    now = Window(asked.now, asked.now)
    met, share = rule_between(asked, vehicle, now), chance(asked, event, asked.now)
    owed = met is not None and met[1] == "give-way"
    if share is None:
        return Finding(None, answer=priority_at(asked, vehicle, now)) if owed else None
    rule = Relating("has-priority-over", Vehicle(vehicle), Ego(), asked.now, True)
    return Finding(
        share >= EXPECTED, (rule,) if owed and share >= POSSIBLE else (), probability=share
    )


def closes(asked: Asked, event: Event) -> Finding | None:
    """Check whether a vehicle is coming closer to us, by how far away it is and was."""
    timely = event.tense == "present" and isinstance(event.time, Unsaid | Now)
    ours = is_us(event.actor)
    whom, other = (event.object, None) if ours else (event.actor, event.object)
    look = look_of(asked, whom, asked.now)
    if event.action != "approach" or not timely or look is None or not look.in_view:
        return None
    if asked.past is not None or (other is not None and not is_us(other)):
        return None
    before = asked.world.look(look.vehicle, asked.now - SINCE)
    if before is None or not before.in_view:
        return None
    return Finding(before.distance - look.distance > CLOSER, (look,))


def stays(asked: Asked, event: Event, going: tuple[Fact, ...]) -> Finding | None:
    """Return that a standing vehicle stays there until we are past, if it lets us go; else None."""
    if event.action not in ("stand", "stop", "wait") or not going:
        return None
    yields = asked.world.episodes(actor=event.actor, actions=("give-way", "wait"))
    ours = tuple(e for e in yields if isinstance(e.object, Ego) and e.end is None)
    return Finding(True, ours[-1:]) if ours else None


def _speeds(asked: Asked, look: Look) -> tuple[tuple[Measure, ...], float | None]:
    """Return the speeds of ours and another vehicle as measures, and the value of ours [m/s]."""
    both = (asked.world.measure("speed", who, asked.now) for who in (Ego(), Vehicle(look.vehicle)))
    found = known(*both)
    return found, next((m.value for m in found if isinstance(m.thing, Ego)), None)


def keeps(asked: Asked, event: Event) -> Finding | None:
    """Return that we keep a distance to the vehicle that we follow, with the gap; else None."""
    ours = event.action == "keep-distance" and is_us(event.actor)
    found = occasion(asked, event) if ours and event.tense in ("present", "perfect") else None
    if found is None or found.end is not None or (asked.past is not None and asked.past.said):
        return None
    gaps = (asked.world.measure(a, Ego(), asked.now, found.object) for a in ("gap", "headway"))
    return Finding(True, (found, *known(*gaps)))


def trails(asked: Asked, event: Event) -> Finding | None:
    """Return that a vehicle drives our way too far behind us to be following us; else None."""
    look = look_of(asked, event.actor, asked.now)
    timely = event.tense == "present" and isinstance(event.time, Unsaid | Now)
    if event.action != "follow" or not timely or look is None or not look.in_view:
        return None
    if event.object is not None and not is_us(event.object):
        return None
    if not look.bearing.startswith("behind") or look.oncoming or look.speed == 0.0:
        return None
    seen = asked.world.states.offset(EGO, look.vehicle, asked.now)
    if occasion(asked, event) is not None or (seen is not None and not seen.same_way):
        return None
    return Finding(None, answer=PlaceReason(look.vehicle, "behind", None))
