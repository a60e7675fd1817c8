"""Summits: the hardest, closest, slowest, most dangerous moment of the ride, and what it was."""

from collections.abc import Callable, Mapping

from xavi_dialogue.domain.answers import Answer, Summit
from xavi_dialogue.domain.facts import Episode, Look, Measure
from xavi_dialogue.domain.meaning import Peak
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.asked import Asked
from xavi_dialogue.explain.answers.closeness import closest_approach, nearest_vehicle, shortest_time
from xavi_dialogue.explain.answers.moments import Window, window
from xavi_dialogue.explain.answers.naming import first_look
from xavi_dialogue.explain.answers.occasions import duration, overlaps

AROUND = 1.0  # [s] about a moment within which what we did belongs to it
SHORTEST = 3.0  # [s] of time to a collision from which on it was not dangerous
#: What tells most of a moment comes first.
TELLING: tuple[ActionName, ...] = (
    "collide", "nearly-collide", "give-way", "wait", "let-go", "merge", "change-left",
    "change-right", "overtake", "pass", "exit-left", "exit-right", "exit-straight", "enter",
    "leave", "stop", "stand", "brake", "slow-down", "follow",
)  # fmt: skip
YIELDING: tuple[ActionName, ...] = ("give-way", "wait", "let-go")
HALTING: tuple[ActionName, ...] = ("stand", "stop", "wait")


def peak(question: Peak, asked: Asked) -> Answer:
    """Tell the moment at which something was at its most.

    Raises:
        Unanswered: it is of a vehicle that was never seen.
    """
    about = window(asked, question.time)
    if about.instant:
        about = Window(asked.world.begin, asked.now)
    about = Window(max(about.begin, asked.world.begin), min(about.end, asked.now))
    return FINDERS[question.of](question.of, asked, about)


def _at(asked: Asked, of: str, measure: Measure, vehicle: int | None = None) -> Summit:
    """Give a moment by what was measured then."""
    deeds = deeds_at(asked, measure.time)
    if vehicle is not None:
        deeds = tuple(e for e in deeds if e.object == Vehicle(vehicle))
    look = None if vehicle is None else asked.world.look(vehicle, measure.time)
    return Summit(of, measure.time, deeds, measure, () if look is None else (look,))


def deeds_at(asked: Asked, at: float) -> tuple[Episode, ...]:
    """List what we did at a time [s], the most telling first."""
    near = Window(at - AROUND, at + AROUND)
    found = [e for e in asked.world.episodes(actor=Ego()) if overlaps(asked, e, near)]
    told = [e for e in found if e.action in TELLING]
    return tuple(sorted(told, key=lambda e: (TELLING.index(e.action), e.begin)))


def _closest(of: str, asked: Asked, about: Window) -> Summit:
    vehicle = nearest_vehicle(asked, about)
    if vehicle is None:
        return Summit(of)
    return _at(asked, of, closest_approach(asked, vehicle, about), vehicle)


def _dangerous(of: str, asked: Asked, about: Window) -> Summit:
    """Give the moment with the least time to react; else when we had to mind others most."""
    times = ((v, shortest_time(asked, v, about)) for v in asked.world.vehicles)
    short = [(m.value, v, m) for v, m in times if m is not None and m.value is not None]
    if short:
        least, vehicle, found = min(short, key=lambda one: one[:2])
        if least <= SHORTEST:
            return _at(asked, of, found, vehicle)
    return _minding(of, asked, about) or _closest(of, asked, about)


def _slowest(of: str, asked: Asked, about: Window) -> Summit:
    return _at(asked, of, asked.world.extreme("speed", Ego(), "lowest", about.begin, about.end))


def _fastest(of: str, asked: Asked, about: Window) -> Summit:
    return _at(asked, of, asked.world.extreme("speed", Ego(), "highest", about.begin, about.end))


def _braking(of: str, asked: Asked, about: Window) -> Summit:
    found = asked.world.extreme("deceleration", Ego(), "highest", about.begin, about.end)
    if found.gap is not None or not found.value:
        return Summit(of)
    return _at(asked, of, found)


def _waiting(of: str, asked: Asked, about: Window) -> Summit:
    """Give the longest time that we stood, else that we gave way."""
    for actions in (HALTING, YIELDING):
        found = asked.world.episodes(Ego(), actions, about.begin, about.end)
        if found:
            longest = max(found, key=lambda e: (duration(asked, e), -e.begin))
            return _of_deed(asked, of, longest)
    return Summit(of)


def _hardest(of: str, asked: Asked, about: Window) -> Summit:
    """Give where we had to mind most others at once, else where it was most dangerous."""
    return _minding(of, asked, about) or _dangerous(of, asked, about)


def _minding(of: str, asked: Asked, about: Window) -> Summit | None:
    """Give where we gave way to most others at once, else where we changed lanes among others."""
    yields = asked.world.episodes(Ego(), YIELDING, about.begin, about.end)
    moves = asked.world.episodes(Ego(), ("change-left", "change-right"), about.begin, about.end)
    known = [e for e in (*yields, *moves) if e.action != "wait" or isinstance(e.object, Vehicle)]
    if not known:
        return None
    hardest = max(known, key=lambda e: (_minded(asked, e), duration(asked, e), -e.begin))
    return _of_deed(asked, of, hardest)


def _minded(asked: Asked, deed: Episode) -> int:
    """Count those to whom we gave way at about the time of a deed."""
    return len(_partners(asked, deed)) * 2 + (deed.action in YIELDING)


def _partners(asked: Asked, deed: Episode) -> tuple[int, ...]:
    end = asked.now if deed.end is None else deed.end
    near = Window(deed.begin - AROUND, end + AROUND)
    others = asked.world.episodes(Ego(), YIELDING, near.begin, near.end)
    found = [e.object.number for e in (deed, *others) if isinstance(e.object, Vehicle)]
    return tuple(dict.fromkeys(found))


def _of_deed(asked: Asked, of: str, deed: Episode) -> Summit:
    """Give the moment of a deed, with all on whose account it was."""
    seen = (first_look(asked, v, deed.begin) for v in _partners(asked, deed))
    looks: tuple[Look, ...] = tuple(look for look in seen if look is not None)
    rest = tuple(e for e in deeds_at(asked, deed.begin) if e != deed)
    length = Measure("duration", Ego(), deed.begin, value=round(duration(asked, deed), 1))
    return Summit(of, deed.begin, (deed, *rest), length, looks)


FINDERS: Mapping[str, Callable[[str, Asked, Window], Summit]] = {
    "closeness": _closest,
    "danger": _dangerous,
    "slowness": _slowest,
    "speed": _fastest,
    "braking": _braking,
    "waiting": _waiting,
    "difficulty": _hardest,
}
