"""Jointly: suppositions about several vehicles at once, taken from a proposition."""

from dataclasses import dataclass

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import CannotSay
from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Is,
    Nobody,
    Not,
    Proposition,
    Related,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import check_seen, is_own, unwrapped

#: States of another vehicle whose denial means that it is absent or gone.
ABSENT = ("present", "visible")


@dataclass(frozen=True, slots=True)
class Joint:
    """The supposition about the vehicles `numbers`; `left_out` are those that do not fit in."""

    numbers: tuple[int, ...]
    event: Event | None  # of the first of them; None: they are absent
    negated: bool = False
    left_out: tuple[int, ...] = ()
    everybody: bool = False  # all others are absent


def is_absence(of: Proposition | None, *, negated: bool) -> bool:
    """Check whether a proposition, or its denial, means that a vehicle is absent."""
    match of:
        case Exists() | Related():
            return negated
        case Is(state="hidden"):
            return not negated
        case Is(state=state):
            return negated and state in ABSENT
        case Happens(event):
            return (event.action == "appear" and negated) or event.action == "disappear"
    return False


def joint(of: Proposition, scene: Asked) -> Joint | None:
    """Read a supposition about several vehicles, or all; None if it is about one, or about us.

    Raises:
        Unanswered: one of them was never seen; or it is about us and others at once.
    """
    if _of_nobody(of):
        everybody = _around(scene)
        return Joint(everybody, None, everybody=True) if everybody else None
    parts = [one for part in _parts(of) for one in _singly(part)]
    if len(parts) < 2:
        return None
    supposed = [(_number(part, scene), *unwrapped(part)) for part in parts]
    others = [one for one in supposed if one[0] is not None]
    if len(supposed) > len(others) > 0:
        raise Unanswered(CannotSay("unsupported-condition"))
    if len(others) < 2:
        return None
    _, content, negated = others[0]
    kind = _kind(content, negated=negated)
    alike = [v for v, of_it, denied in others if _kind(of_it, negated=denied) == kind]
    numbers = tuple(dict.fromkeys(v for v in alike if v is not None))
    either = isinstance(of, Both) and of.join == "or"
    numbers = numbers[:1] if either else numbers
    left = tuple(v for v in dict.fromkeys(o[0] for o in others) if v is not None)
    left = tuple(v for v in left if v not in numbers)
    event = content.event if isinstance(content, Happens) and kind != "away" else None
    if kind != "away" and event is None:
        raise Unanswered(CannotSay("unsupported-condition"))
    return Joint(numbers, event, negated=negated and event is not None, left_out=left)


def _parts(of: Proposition) -> tuple[Proposition, ...]:
    """Return the parts that hold together; the denial of all is read as that of each."""
    match of:
        case Both(contents=contents):
            return tuple(part for one in contents for part in _parts(one))
        case Not(content=Both(contents=contents)):
            return tuple(part for one in contents for part in _parts(Not(one)))
    return (of,)


def _singly(of: Proposition) -> tuple[Proposition, ...]:
    """Return one proposition for each of several vehicles that it is about."""
    match of:
        case Not(content=content):
            return tuple(Not(one) for one in _singly(content))
        case Happens(event=Event(actor=Vehicles(numbers=numbers)) as event):
            return tuple(Happens(replace(event, actor=Vehicle(n))) for n in numbers)
        case Exists(thing=Vehicles(numbers=numbers)) | Is(thing=Vehicles(numbers=numbers)):
            return tuple(replace(of, thing=Vehicle(n)) for n in numbers)
    return (of,)


def _number(of: Proposition, scene: Asked) -> int | None:
    """Return the vehicle that a supposition is about; None if it is about us, or nobody."""
    content, _ = unwrapped(of)
    match content:
        case Happens(event) if not is_own(event.actor):
            return check_seen(scene, event.actor)
        case Exists(thing) | Is(thing=thing) | Related(thing=thing):
            return check_seen(scene, thing)
    return None


def _kind(of: Proposition | None, *, negated: bool) -> object:
    """Return a key for suppositions that are the same except for the vehicle."""
    if is_absence(of, negated=negated):
        return "away"
    if isinstance(of, Happens):
        return replace(of.event, actor=Ego()), negated
    return of, negated


def _of_nobody(of: Proposition) -> bool:
    """Check whether the supposition is that nobody else is there."""
    content, negated = unwrapped(of)
    match content:
        case Exists(thing=Nobody(described=None)):
            return not negated
        case Is(state=state, thing=Nobody(described=None)):
            return not negated and state in ABSENT
        case Exists(thing=Everyone()) | Is(thing=Everyone()):
            return is_absence(content, negated=negated)
        case Exists(thing=Described(other=True, plural=True, kind="vehicle" | "car")):
            return negated
    return False


def _around(scene: Asked) -> tuple[int, ...]:
    """Return the vehicles that are known to the decision at the time asked about."""
    trace = scene.ride.at(scene.moment)
    return () if trace is None else tuple(sorted(v for v in trace.scene if v != EGO))
