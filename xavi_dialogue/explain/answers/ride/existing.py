"""Existing: whether there is or was anybody, or anything, that fits a description."""

from xavi_dialogue.domain.answers import Located, NotRecorded, Verdict
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.terms import (
    Described,
    Destination,
    Ego,
    Everyone,
    Exists,
    Exit,
    Feature,
    Junction,
    Lane,
    Nobody,
    Vehicle,
)
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import Window, instant, is_past, window
from xavi_dialogue.explain.answers.reference.naming import (
    check_sense,
    first_look,
    is_building,
    is_us,
    looks,
    of_kind,
    somebodies,
)
from xavi_dialogue.explain.answers.ride.places import junction
from xavi_dialogue.explain.answers.sight.standing_row import standing_row


def exists(of: Exists, asked: Asked) -> Finding:
    """Weigh that there is or was such a thing.

    Raises:
        Unanswered: the thing has no known meaning.
    """
    check_sense(of.thing)
    at = instant(asked, of.time, of.tense)
    about = window(asked, of.time, of.tense)
    match of.thing:
        case Nobody(Described(bearing="behind", of=where)) if is_building(where):
            raise Unanswered(NotRecorded("out-of-sight"))
        case Nobody():
            near = _near(asked, at, of.thing.described)
            if near and _drives_behind(of.thing.described, near[0]):
                there = Exists(Vehicle(near[0].vehicle), of.time, of.tense)
                return Finding(True, near, answer=Verdict(there, True, near))
            return Finding(of.thing.described is None and not near, near)
        case Lane():
            return _lane(asked, of.thing, at)
        case Junction():
            found = junction(asked, of.thing, at)
            if found.gap == "not-recorded":
                return unknown(found.gap)
            return Finding(found.gap is None, known(found))
        case Exit() | Destination():
            value = asked.world.measure("exit-number", Ego(), at)
            return Finding(value.gap is None, known(value))
        case Feature(kind="queue"):
            row = tuple(v.number for v in standing_row(asked, at))
            return Finding(bool(row), looks(asked, row, at))
        case Feature():
            return unknown("not-recorded")
        case Everyone():
            return _anybody(of.thing, asked, about, at)
    found_here = somebodies(asked, of.thing, at)
    numbers = tuple(v.number for v in found_here if isinstance(v, Vehicle))
    if not numbers:
        return unknown("not-recorded")
    seen = looks(asked, numbers, at) or _first(asked, numbers)
    if seen and not any(look.in_view for look in seen) and not about_past(asked, of):
        return Finding(None, answer=Located(of.thing, seen, gap="out-of-view"))
    return Finding(any(look.in_view and look.time <= at for look in seen), seen)


def _drives_behind(described: Described | None, look: Look) -> bool:
    """Check whether one that is said to follow us is behind us, possibly in another lane."""
    deed = None if described is None else described.doing
    if described is None or deed is None or deed.action != "follow":
        return False
    same = described.colour in (None, look.colour) and look.bearing.startswith("behind")
    return same and is_us(deed.object) and not look.oncoming


def about_past(asked: Asked, of: Exists) -> bool:
    """Check whether the question is about the past."""
    return is_past(asked, of.time, of.tense)


def _anybody(thing: Everyone, asked: Asked, about: Window, at: float) -> Finding:
    """Weigh that anybody of a kind is or was in view; None of kinds that are not recorded."""
    ever = asked.world.vehicles if about.end - about.begin > 1.5 else asked.world.in_view(at)
    fits = of_kind(asked, ever, thing.kind, at)
    if not fits and thing.kind in ("pedestrian", "tram"):
        return unknown("not-recorded")
    return Finding(bool(fits), looks(asked, fits, at))


def _near(asked: Asked, at: float, described: Described | None) -> tuple[Look, ...]:
    """Return who is in view when nobody fits: the closest of the kind asked for."""
    kind = "vehicle" if described is None else described.kind
    seen = looks(asked, of_kind(asked, asked.world.in_view(at), kind, at), at)
    return tuple(sorted(seen, key=lambda look: look.distance)[:1])


def _first(asked: Asked, numbers: tuple[int, ...]) -> tuple[Look, ...]:
    found = (first_look(asked, v, asked.world.begin) for v in numbers)
    return tuple(look for look in found if look is not None)


def _lane(asked: Asked, lane: Lane, at: float) -> Finding:
    own = asked.world.measure("lane", Ego(), at)
    if own.gap is not None:
        return unknown(own.gap)
    road = asked.world.road(at)
    place = None if road is None else road.places.get(0)
    if place is None or place.lane is None:
        return unknown("not-recorded")
    there = {
        "left": place.lane + 1 < place.lanes, "right": place.lane > 0, "other": place.lanes > 1,
    }  # fmt: skip
    return Finding(there.get(lane.which, True), (own,))
