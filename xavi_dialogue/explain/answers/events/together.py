"""Together: whether several road users all crossed our way, or are all behind us."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Counted
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Now,
    Related,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.measuring.closeness import nearest_vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.naming import is_us, looks
from xavi_dialogue.explain.answers.reference.naming import number as number_of

ACROSS = 0.5  # [s] since its end in which crossing counts as going on


def together(asked: Asked, event: Event) -> Finding | None:
    """Check whether several did something that each does by itself; None for other events."""
    if event.modal is not None or (asked.past is not None and asked.past.said):
        return None
    match event:
        case Event(action="cross", actor=Vehicles(numbers=who)) if event.tense != "future":
            return _crossing(asked, event, who)
        case Event(action="pass" | "overtake", object=Vehicles(numbers=who)) if is_us(event.actor):
            return _behind(asked, event, who)
    return None


def nearest_of(asked: Asked, event: Event, about: Window) -> int | None:
    """Return of several who take part in an event the one that came closest to us."""
    for thing in (event.actor, event.object):
        if isinstance(thing, Vehicles):
            return nearest_vehicle(asked, about, among=thing.numbers)
    return None


def _crossing(asked: Asked, event: Event, who: tuple[int, ...]) -> Finding | None:
    """Count who is crossing our way, for the question whether all are, or have done so."""
    last = [
        max((e for e in asked.world.episodes(Vehicle(v), ("cross",), object=Ego())),
            key=lambda e: e.begin, default=None)
        for v in who
    ]  # fmt: skip
    on = sum(
        e is not None and (e.end is None or e.end >= asked.now - ACROSS) and e.begin <= asked.now
        for e in last
    )
    if not on:
        if event.tense == "present":
            told = forecast(asked, map(Vehicle, who))
            return None if told is None else Finding(None, answer=told)
        return _crossed(event, tuple(e for e in last if e is not None))
    kinds = {look.kind for look in looks(asked, who, asked.now)}
    kind = kinds.pop() if len(kinds) == 1 else "vehicle"
    such = Described(
        kind, doing=Event("cross", Wanted(kind), tense="present"), plural=True, definite=False
    )
    holds = event.tense == "present" and on == len(who)
    return Finding(holds, answer=Counted(Vehicles(who), on, such=such, said=holds))


def _crossed(event: Event, done: tuple[Episode, ...]) -> Finding | None:
    """Tell those of several who have crossed our way, while none of them is crossing it."""
    who = tuple(number for e in done if (number := number_of(e.actor)) is not None)
    if not who:
        return None
    actor = Vehicles(who) if len(who) > 1 else Vehicle(who[0])
    facts = done if len(who) == 1 else ()
    that = Happens(replace(event, actor=actor))
    return Finding(True, answer=Finding(True, facts).verdict(that))


def _behind(asked: Asked, event: Event, who: tuple[int, ...]) -> Finding | None:
    """Check whether all of several are behind us, who is out of view included."""
    if event.tense not in ("present", "perfect") or not isinstance(
        event.time, Unsaid | Now | WholeRide
    ):
        return None
    seen = [look for look in looks(asked, who, asked.now) if look.in_view]
    if not seen or any(look.oncoming for look in seen):
        return None
    first: Look = max(seen, key=lambda look: look.ahead)
    behind = first.ahead < -first.length
    that = Related("behind", Vehicles(who) if behind else Vehicle(first.vehicle), Ego())
    if not behind:
        return Finding(False, (first,))
    return Finding(True, answer=Finding(True).verdict(that))
