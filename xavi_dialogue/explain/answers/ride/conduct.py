"""Conduct: what can be seen of somebody's driving when no episode of that name is recorded."""

import math

from msgspec.structs import replace

from sim.roads.network import angle_between
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.measuring.hard_braking import braked_hard
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known
from xavi_dialogue.explain.answers.reference.moments import Window, is_ahead, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.ride.priority import rule_between

HALTING: tuple[ActionName, ...] = ("stop", "brake", "slow-down")
BENDING: tuple[ActionName, ...] = (
    "exit-left", "exit-right", "change-left", "change-right", "continue-next-exit",
)  # fmt: skip
TRACK = 2.0  # [m] maximum distance from our path of somebody who drives where we drove
ALONG = 0.6  # [rad] maximum difference from our heading there
BACK = 8.0  # [s] maximum time since we were there
SOON = 150.0  # [m] minimum distance of the next turn while we go straight on
LATELY = 6.0  # [s] maximum time since a lane change that counts as recent
ASIDE = 1.0  # [m] minimum sideways distance of somebody in the lane that we change to
CLOSE, CLOSE_GAP = 1.5, 8.0  # [s], [m] maximum headway and gap of moving in close ahead
FIRM = 1.0  # [m/s2] minimum deceleration of somebody who is stopping


CHANGING: tuple[ActionName, ...] = ("change-left", "change-right", "change-lane")


def conduct(asked: Asked, event: Event) -> Finding | None:
    """Weigh an event by positions and speeds; None if they add nothing."""
    if is_ahead(asked, event.time, event.tense):
        return None
    if (found := _for_us(asked, event)) is not None:
        return found
    if event.modal is not None:
        return None
    vehicle, other = number(event.actor), number(event.object)
    into = event.action in ("cut-in", "pull-out") and is_us(event.actor)
    if into and other is not None:
        found = _cutting_in(asked, replace(event, action="cut-in"), other)
        if found is not None or event.action == "cut-in":
            return found
    if event.action == "overtake" and is_us(event.actor) and event.tense == "present":
        return _passing(asked, event, other) if other else None
    ahead = event.where.to if event.where and event.where.relation == "ahead-of" else None
    if event.action in CHANGING and is_us(event.actor) and isinstance(ahead, Vehicle):
        cut = Event("cut-in", Ego(), ahead, time=event.time, tense=event.tense)
        return _cutting_in(asked, cut, ahead.number) or _cut_in(asked, cut, ahead)
    if event.action == "follow" and is_us(event.actor) and other is not None:
        return _moving_behind(asked, event, other)
    if vehicle is None:
        straight = event.action in ("exit-straight", "continue") and event.tense == "present"
        return _straight(asked) if straight and is_us(event.actor) else None
    if event.action == "follow" and is_us(event.object) and not _over(asked, event):
        return _following(asked, event, vehicle)
    if event.action in HALTING:
        return _halting(asked, event, vehicle)
    return None


def _for_us(asked: Asked, event: Event) -> Finding | None:
    """Return how close it came if somebody braked hard near us; the record lacks for whom."""
    nobody_named = number(event.actor) is None and not is_us(event.actor)
    if not nobody_named or event.action not in HALTING or not is_us(event.object):
        return None
    about = window(asked, event.time, event.tense)
    if all(is_us(e.actor) for e in braked_hard(asked, None, about)):
        return None
    return Finding(None, answer=closeness(asked, None, about, "dangerous"))


def _cutting_in(asked: Asked, event: Event, behind: int) -> Finding | None:
    """Weigh that a recent lane change of ours was close ahead of somebody."""
    if occasion(asked, event) is not None:
        return None
    changes = asked.world.episodes(
        actor=Ego(), actions=("change-left", "change-right"), begin=asked.now - LATELY
    )
    look = asked.world.look(behind, asked.now)
    if not changes or look is None or look.ahead >= 0.0 or look.oncoming:
        return None
    change = changes[-1]
    before = asked.world.look(behind, max(change.begin, asked.world.begin))
    aside = 0.0 if before is None else before.left
    towards = aside > ASIDE if change.action == "change-left" else aside < -ASIDE
    if not towards or look.distance > max(look.speed * CLOSE, CLOSE_GAP):
        return None
    braked = occasion(asked, Event("brake", Vehicle(behind), time=event.time))
    late = braked is not None and braked.begin >= change.begin
    return Finding(True, (change, *((braked,) if braked is not None and late else ())))


def _cut_in(asked: Asked, event: Event, behind: Vehicle) -> Finding | None:
    """Return that we moved in ahead of somebody, and that they braked then."""
    changes = asked.world.episodes(actor=Ego(), actions=CHANGING, begin=asked.now - LATELY)
    held = occasion(asked, event) or next(iter(changes[-1:]), None)
    braked = occasion(asked, Event("brake", behind, time=event.time))
    late = held is not None and braked is not None and braked.begin >= held.begin - 1.0
    if held is None or not (late or held.action == "cut-in"):
        return None
    return Finding(True, (held, braked) if late and braked is not None else (held,))


def _moving_behind(asked: Asked, event: Event, leader: int) -> Finding | None:
    """Weigh that we are changing to the lane in which somebody drives ahead."""
    look = asked.world.look(leader, asked.now)
    if _over(asked, event) or look is None or look.ahead <= 0.0 or look.oncoming:
        return None
    found = asked.world.episodes(actor=Ego(), actions=("change-left", "change-right"),
                                 begin=asked.now - LATELY)  # fmt: skip
    change = next((e for e in reversed(found) if e.end is None), None)
    if change is None or occasion(asked, event) is not None:
        return None
    towards = look.left > ASIDE if change.action == "change-left" else look.left < -ASIDE
    return Finding(True, (change,)) if towards else None


def _passing(asked: Asked, event: Event, other: int) -> Finding | None:
    """Weigh that we are about to pass somebody: faster, next to their path or leaving it."""
    look = asked.world.look(other, asked.now)
    if look is None or not look.in_view or look.oncoming or occasion(asked, event) is not None:
        return None
    speed = asked.world.measure("speed", Ego(), asked.now)
    change = asked.world.episodes(actor=Ego(), actions=("change-left",), begin=asked.now - LATELY)
    aside = bool(change) or abs(look.left) > ASIDE
    if speed.value is None or speed.value <= look.speed or not aside or look.ahead < 0.0:
        return None
    return Finding(True, known(speed) if not change else (change[-1],))


def _over(asked: Asked, event: Event) -> bool:
    return is_past(asked, event.time, event.tense)


def _straight(asked: Asked) -> Finding | None:
    """Weigh that we go straight on: nothing else is under way, and no turn comes soon."""
    own = asked.world.episodes(actor=Ego(), actions=BENDING, begin=asked.now - 0.2)
    if any(e.end is None and e.begin <= asked.now for e in own):
        return None
    turn = asked.world.measure("turn", Ego(), asked.now)
    far = turn.value if turn.gap is None else None
    turning = turn.gap is None and turn.side in ("left", "right")
    near = turning and (far is None or far <= SOON)
    return Finding(not near, known(turn))


def _following(asked: Asked, event: Event, vehicle: int) -> Finding | None:
    """Weigh that somebody drives where we drove shortly before, as the next one after us."""
    if occasion(asked, event) is not None:
        return None
    since = _on_our_line(asked, vehicle)
    if since is None:
        return None
    others = (_on_our_line(asked, v) for v in asked.world.in_view(asked.now) if v != vehicle)
    if any(other is not None and other > since for other in others):
        return None
    gap = asked.world.measure("distance", Ego(), asked.now, Vehicle(vehicle))
    return Finding(True, known(gap))


def _on_our_line(asked: Asked, vehicle: int) -> float | None:
    """Return when [s] we were where a vehicle is now; None if never, or long ago."""
    look = asked.world.look(vehicle, asked.now)
    theirs, ours = asked.ride.motion(vehicle), asked.ride.motion(EGO)
    last = theirs.index(asked.now)
    if look is None or not look.in_view or last is None:
        return None
    near = [
        k
        for k in ours.within(asked.now - BACK, asked.now - 0.5)
        if math.dist(ours.position[k], theirs.position[last]) <= TRACK
        and abs(angle_between(ours.heading[k], theirs.heading[last])) <= ALONG
    ]
    return ours.time[near[-1]] if near else None


def _halting(asked: Asked, event: Event, vehicle: int) -> Finding | None:
    """Weigh that somebody stops, or stops for us, by their braking and the right of way."""
    if occasion(asked, event) is not None:
        return None
    past = _over(asked, event)
    plain = replace(event, object=None, where=None)
    held = occasion(asked, plain) or _braking(asked, plain, past)
    if held is None:
        return None
    if event.object is None:
        return Finding(True, (held,)) if event.action == "stop" and not past else None
    if not is_us(event.object):
        return None
    about = window(asked, event.time, "past") if past else Window(asked.now, asked.now)
    rule = rule_between(asked, vehicle, about)
    return Finding(True, (held,)) if rule is not None and rule[1] == "priority" else None


def _braking(asked: Asked, event: Event, past: bool) -> Episode | None:
    """Return the braking with which somebody comes to a stop."""
    found = occasion(asked, replace(event, action="brake"))
    if found is None or (found.peak or 0.0) < FIRM:
        return None
    return found if past or found.end is None or found.end >= asked.now - 0.5 else None
