"""Pulling up: whether another vehicle, or we, stop in time for the other one.

For one that comes up behind another, the distance decides; for one on a crossing way, the rule.
"""

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import PullingUp
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import chance, collision_chance
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window, is_ahead
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.ride.priority import priority_at, rule_between
from xavi_dialogue.explain.answers.suppositions.reacting import for_anybody
from xavi_dialogue.explain.causes.driving.stopping import stopping_distance
from xavi_dialogue.explain.facts.approach import following
from xavi_dialogue.explain.facts.measures.between import leader
from xavi_dialogue.explain.history.restraints import restraint_at
from xavi_dialogue.explain.history.thresholds import STANDING

HALTS: frozenset[ActionName] = frozenset(("stop", "brake", "stand"))
HARDLY = 0.1  # probability below which one with right of way is not expected to let us go
SOON = 2.5  # [s] maximum time in which one that brakes on comes to a standstill


def pulls_up(asked: Asked, event: Event) -> Finding | None:
    """Weigh that somebody stops in time; None if the question is not that."""
    if event.action not in HALTS or not _of_now(asked, event):
        return None
    able = event.modal in ("can", "could") or "early" in event.manner
    if is_us(event.actor):
        return _we_stop(asked, event) if able else None
    vehicle = number(event.actor)
    look = None if vehicle is None else asked.world.look(vehicle, asked.now)
    if vehicle is None or look is None or not look.in_view or asked.now < asked.world.begin:
        return None
    if look.speed < STANDING:
        return Finding(True, answer=PullingUp(vehicle, "stands")) if able else None
    behind = _comes_up(asked, vehicle, EGO) or (able and _follows(asked, vehicle))
    now = Window(asked.now, asked.now)
    met = rule_between(asked, vehicle, now)
    if met is not None and isinstance(priority_at(asked, vehicle, now).first, Vehicle):
        met = None  # it has gone by already
    if not able and not is_us(event.object) and not behind and met is None:
        return None
    found = PullingUp(
        vehicle, "apart", behind=behind,
        braking=_braking(asked, vehicle),
        distance=asked.world.measure("distance", Ego(), asked.now, Vehicle(vehicle)),
        speed=asked.world.measure("speed", Vehicle(vehicle), asked.now),
        risk=collision_chance(asked, asked.now, vehicle),
    )  # fmt: skip
    return Finding(None, answer=_from_behind(asked, found) if behind else _crossing(asked, found))


def _of_now(asked: Asked, event: Event) -> bool:
    """Check whether the question is about what is about to happen."""
    could = event.modal == "could" and "early" in event.manner  # "could we stop in time?"
    if asked.past is not None or (event.tense in ("past", "perfect") and not could):
        return False
    return is_ahead(asked, event.time, event.tense) or event.modal in ("can", "could")


def _comes_up(asked: Asked, one: int, other: int) -> bool:
    """Check whether one drives behind the other on the same path."""
    line = following(asked.world.states, one, other, asked.now)
    return line is not None and line.behind == one


def _follows(asked: Asked, vehicle: int) -> bool:
    """Check whether a vehicle drives our way behind us, possibly in another lane."""
    seen = asked.world.states.offset(EGO, vehicle, asked.now)
    return seen is not None and seen.same_way and seen.ahead + seen.clear < 0.0


def _braking(asked: Asked, vehicle: int) -> Episode | None:
    """Find the braking of a vehicle that is under way."""
    found = asked.world.episodes(actor=Vehicle(vehicle), actions=("brake",))
    return next((e for e in reversed(found) if e.end is None), None)


def _from_behind(asked: Asked, found: PullingUp) -> PullingUp:
    """Judge by the distance that a vehicle has for braking to our speed."""
    ours = asked.world.measure("speed", Ego(), asked.now).value or 0.0
    closing = max((found.speed.value if found.speed and found.speed.value else 0.0) - ours, 0.0)
    needed = stopping_distance(closing)
    room = found.distance.value if found.distance is not None else None
    enough = room is None or needed <= room
    how = "brakes" if found.braking is not None and enough else "able" if enough else "unable"
    return replace(found, how=how, needed=needed)


def _crossing(asked: Asked, found: PullingUp) -> PullingUp:
    """Judge by the right of way, and by what the vehicle is expected to do."""
    met = rule_between(asked, found.vehicle, Window(asked.now, asked.now))
    rule = None if met is None else met[1]
    share = chance(asked, Event("let-go", Vehicle(found.vehicle), Ego()), asked.now)
    found = replace(found, chance=share)
    goes = rule == "give-way" and share is not None and share < HARDLY
    if not goes and _halts_soon(asked, found):  # one that goes first may brake for a bend
        return replace(found, how="brakes")
    if rule == "give-way":
        return replace(found, how="goes-first")
    if rule == "priority":
        return replace(found, how="owes")
    return replace(found, how="apart" if found.braking is None else "brakes")


def _halts_soon(asked: Asked, found: PullingUp) -> bool:
    """Check whether a vehicle would stand within SOON seconds if it brakes on as it does."""
    speed = None if found.speed is None else found.speed.value
    rate = asked.world.measure("deceleration", Vehicle(found.vehicle), asked.now).value
    if found.braking is None or speed is None or rate is None:
        return False
    return speed <= rate * SOON


def _we_stop(asked: Asked, event: Event) -> Finding | None:
    """Judge whether we can stop behind the vehicle ahead of us, or before whom we let go first."""
    named = number(event.object) or (None if event.where is None else number(event.where.to))
    held = restraint_at(asked.ride, asked.now)
    first = None if held is None or held.by != "right-of-way" else held.vehicle
    ahead = named if named is not None else first or leader(asked.world.states, EGO, asked.now)
    if ahead is None or (ahead != first and not _comes_up(asked, EGO, ahead)):
        told = for_anybody(event, asked) if "early" in event.manner else None
        return None if told is None else Finding(None, answer=told)
    speed = asked.world.measure("speed", Ego(), asked.now)
    if speed.value is None or speed.value < STANDING:
        return None
    gap = asked.world.measure(
        "distance" if ahead == first else "gap", Ego(), asked.now, Vehicle(ahead)
    )
    theirs = asked.world.measure("speed", Vehicle(ahead), asked.now).value or 0.0
    theirs = 0.0 if ahead == first else theirs  # it goes across our way
    needed = stopping_distance(speed.value)
    enough = gap.value is None or stopping_distance(max(speed.value - theirs, 0.0)) <= gap.value
    try:
        risk = collision_chance(asked, asked.now, ahead)
    except Unanswered:
        risk = None
    return Finding(None, answer=PullingUp(
        ahead, "able" if enough else "unable", ours=True, braking=_our_braking(asked),
        distance=gap, speed=speed, needed=needed, risk=risk,
    ))  # fmt: skip


def _our_braking(asked: Asked) -> Episode | None:
    found = asked.world.episodes(actor=Ego(), actions=("brake",))
    return next((e for e in reversed(found) if e.end is None), None)
