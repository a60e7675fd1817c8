"""Peak moments: the hardest, closest, slowest, most dangerous moment of the ride."""

from collections.abc import Callable, Mapping

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Happenings, PeakMoment
from xavi_dialogue.domain.facts import Episode, Look, Measure
from xavi_dialogue.domain.meaning import HowMany, Peak
from xavi_dialogue.domain.terms import Ego, Event, Feature, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName, Extreme
from xavi_dialogue.explain.answers.measuring.closeness import (
    closest_approach,
    highest_risk,
    nearest_vehicle,
    shortest_time,
)
from xavi_dialogue.explain.answers.measuring.counting import how_many
from xavi_dialogue.explain.answers.measuring.tight_turns import tightest
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window, window
from xavi_dialogue.explain.answers.reference.naming import first_look, number
from xavi_dialogue.explain.answers.reference.occasions import duration, merged, overlaps, within
from xavi_dialogue.explain.answers.ride.delays import for_whom, held_up

AROUND = 1.0  # [s] around a moment in which what we did belongs to it
SHORTEST = 3.0  # [s] maximum time to a collision that was dangerous
#: Actions that describe a moment, the most telling first.
TELLING: tuple[ActionName, ...] = (
    "collide", "nearly-collide", "give-way", "wait", "let-go", "merge", "change-left",
    "change-right", "overtake", "pass", "exit-left", "exit-right", "exit-straight", "enter",
    "leave", "stop", "stand", "brake", "slow-down", "follow",
)  # fmt: skip
YIELDING: tuple[ActionName, ...] = ("give-way", "wait", "let-go")
SLOWING: tuple[ActionName, ...] = ("brake", "slow-down")
HALTING: tuple[ActionName, ...] = ("stand", "stop", "wait")


def peak(question: Peak, asked: Asked) -> Answer:
    """Return the moment at which something was at its most.

    Raises:
        Unanswered: the question is about a vehicle that was never seen.
    """
    about = window(asked, question.time)
    if about.instant:
        about = Window(asked.world.begin, asked.now)
    about = Window(max(about.begin, asked.world.begin), min(about.end, asked.now))
    if question.of == "tightness":
        return tightest(question.deed or Event("turn"), asked, about)
    if question.deed is not None:
        return _among(question, question.deed, asked, about)
    if question.number > 1 and question.of in RANKS:
        return _several(question, asked, about)
    return FINDERS[question.of](question.of, asked, about)


def _among(question: Peak, deed: Event, asked: Asked, about: Window) -> Answer:
    """Return when we were slowest or fastest of all times that we did something."""
    found = within(asked, deed, about)
    if not found:
        return how_many(HowMany(deed), asked)
    lowest = question.of == "slowness"
    kind: Extreme = "lowest" if lowest else "highest"
    speeds = (
        (asked.world.extreme("speed", Ego(), kind, e.begin, e.end or asked.now), e) for e in found
    )
    known = [(m.value, m, e) for m, e in speeds if m.value is not None]
    if not known:
        return PeakMoment(question.of)
    _, measure, most = (min if lowest else max)(known, key=lambda one: one[0])
    return PeakMoment(question.of, measure.time, (most,), measure, among=len(known) > 1)


def _several(question: Peak, asked: Asked, about: Window) -> Happenings:
    """Return the times at which something was at its most, in order of time, and for whom."""
    actions, rank = RANKS[question.of]
    every = asked.world.episodes(Ego(), actions, about.begin, about.end)
    found = merged(asked, [e for e in every if e.action in actions])
    most = sorted(found, key=lambda e: (-rank(asked, e), e.begin))[: question.number]
    told = tuple(for_whom(asked, e) for e in sorted(most, key=lambda e: e.begin))
    event = Event(actions[0])
    return Happenings("list", told, Ego(), about.begin, about.end, asked=event)


def _drop(asked: Asked, deed: Episode) -> float:
    """Return by how much [m/s] we slowed down."""
    del asked
    if deed.speed_from is None or deed.speed_to is None:
        return 0.0
    return deed.speed_from - deed.speed_to


def _peak(asked: Asked, deed: Episode) -> float:
    """Return how hard [m/s2] we braked."""
    del asked
    return deed.peak or 0.0


def _loss(asked: Asked, deed: Episode) -> float:
    """Return how much time [s] slowing down cost, until we were as fast again."""
    return asked.world.delay(deed).value or 0.0


def _at(asked: Asked, of: str, measure: Measure, vehicle: int | None = None) -> PeakMoment:
    """Return the moment of a measure, with what we did then."""
    deeds = deeds_at(asked, measure.time)
    if vehicle is not None:
        deeds = tuple(e for e in deeds if e.object == Vehicle(vehicle))
    look = None if vehicle is None else asked.world.look(vehicle, measure.time)
    return PeakMoment(of, measure.time, deeds, measure, () if look is None else (look,))


def deeds_at(asked: Asked, at: float) -> tuple[Episode, ...]:
    """List what we did at a time [s], the most telling first."""
    near = Window(at - AROUND, at + AROUND)
    found = [e for e in asked.world.episodes(actor=Ego()) if overlaps(asked, e, near)]
    told = [for_whom(asked, e) for e in found if e.action in TELLING]
    return tuple(sorted(told, key=lambda e: (TELLING.index(e.action), e.begin)))


def _closest(of: str, asked: Asked, about: Window) -> PeakMoment:
    vehicle = nearest_vehicle(asked, about)
    if vehicle is None:
        return PeakMoment(of)
    return _at(asked, of, closest_approach(asked, vehicle, about), vehicle)


def _dangerous(of: str, asked: Asked, about: Window) -> PeakMoment:
    """Return the moment with the least time to react, else when we had to mind others most."""
    times = ((v, shortest_time(asked, v, about)) for v in asked.world.vehicles)
    short = [(m.value, v, m) for v, m in times if m is not None and m.value is not None]
    if short:
        least, vehicle, found = min(short, key=lambda one: one[:2])
        if least <= SHORTEST:
            return _at(asked, of, found, vehicle)
    return _minding(of, asked, about) or _closest(of, asked, about)


def _riskiest(of: str, asked: Asked, about: Window) -> PeakMoment:
    """Return the decision with the highest chance of a collision of its plan."""
    risk, at = highest_risk(asked, about)
    if risk is None:
        return PeakMoment(of)
    return _at(asked, of, Measure("probability", Ego(), at, value=risk))


def _slowest(of: str, asked: Asked, about: Window) -> PeakMoment:
    return _at(asked, of, asked.world.extreme("speed", Ego(), "lowest", about.begin, about.end))


def _fastest(of: str, asked: Asked, about: Window) -> PeakMoment:
    return _at(asked, of, asked.world.extreme("speed", Ego(), "highest", about.begin, about.end))


def _braking(of: str, asked: Asked, about: Window) -> PeakMoment:
    found = asked.world.extreme("deceleration", Ego(), "highest", about.begin, about.end)
    if found.gap is not None or not found.value:
        return PeakMoment(of)
    moment = _at(asked, of, found)
    kept = [e for e in moment.deeds if e.action != "pass"]  # nobody is braked for by passing
    for_others = [e for e in kept if e.action in SLOWING and e.object is not None]
    rest = [e for e in kept if e not in for_others]
    return replace(moment, deeds=(*for_others, *rest))


def _slowing(of: str, asked: Asked, about: Window) -> PeakMoment:
    """Return the slowing down in which we lost most speed."""
    found = asked.world.episodes(Ego(), SLOWING, about.begin, about.end)
    if not found:
        return PeakMoment(of)
    most = for_whom(asked, max(found, key=lambda e: (_drop(asked, e), -e.begin)))
    drop = Measure("speed-change", Ego(), most.begin, value=_drop(asked, most))
    return PeakMoment(of, most.begin, (most,), drop)


def _losing(of: str, asked: Asked, about: Window) -> PeakMoment:
    """Return the slowing down that cost most time, and all who held us up in it."""
    found = asked.world.episodes(Ego(), SLOWING, about.begin, about.end)
    costs = [(asked.world.delay(e), e) for e in found]
    told = [(m, e) for m, e in costs if m.value]
    if not told:
        return PeakMoment(of)
    cost, deed = max(told, key=lambda one: (one[0].value or 0.0, -one[1].begin))
    held = held_up(asked, Window(deed.begin, cost.until or asked.now), lights=True)
    named = dict.fromkeys(number(e.object) for e in held.episodes)
    seen = (first_look(asked, v, deed.begin) for v in named if v is not None)
    lit = any(isinstance(e.object, Feature) and e.object.kind == "light" for e in held.episodes)
    return PeakMoment(of, deed.begin, (for_whom(asked, deed),), cost,
                  tuple(look for look in seen if look is not None), lit=lit)  # fmt: skip


def _waiting(of: str, asked: Asked, about: Window) -> PeakMoment:
    """Return the longest time that we stood, else that we gave way."""
    for actions in (HALTING, YIELDING):
        every = asked.world.episodes(Ego(), actions, about.begin, about.end)
        found = [e for e in every if e.action in actions]
        if found:
            longest = max(found, key=lambda e: (duration(asked, e), bool(e.object), -e.begin))
            return _of_deed(asked, of, longest)
    return PeakMoment(of)


def _hardest(of: str, asked: Asked, about: Window) -> PeakMoment:
    """Return when we had to mind most others at once, else when it was most dangerous."""
    return _minding(of, asked, about) or _dangerous(of, asked, about)


def _minding(of: str, asked: Asked, about: Window) -> PeakMoment | None:
    """Return when we gave way or changed lanes with most others involved; None: never."""
    yields = asked.world.episodes(Ego(), YIELDING, about.begin, about.end)
    moves = asked.world.episodes(Ego(), ("change-left", "change-right"), about.begin, about.end)
    known = [e for e in (*yields, *moves) if e.action != "wait" or isinstance(e.object, Vehicle)]
    if not known:
        return None
    hardest = max(known, key=lambda e: (_minded(asked, e), duration(asked, e), -e.begin))
    return _of_deed(asked, of, hardest)


def _minded(asked: Asked, deed: Episode) -> int:
    """Return a rank of an episode by the number of vehicles to which we gave way around it."""
    return len(_partners(asked, deed)) * 2 + (deed.action in YIELDING)


def _partners(asked: Asked, deed: Episode) -> tuple[int, ...]:
    end = asked.now if deed.end is None else deed.end
    near = Window(deed.begin - AROUND, end + AROUND)
    others = asked.world.episodes(Ego(), YIELDING, near.begin, near.end)
    found = [e.object.number for e in (deed, *others) if isinstance(e.object, Vehicle)]
    return tuple(dict.fromkeys(found))


def _of_deed(asked: Asked, of: str, deed: Episode) -> PeakMoment:
    """Return the moment of an episode, with all vehicles that it was for."""
    seen = (first_look(asked, v, deed.begin) for v in _partners(asked, deed))
    looks: tuple[Look, ...] = tuple(look for look in seen if look is not None)
    rest = tuple(e for e in deeds_at(asked, deed.begin) if e != deed)
    length = Measure("duration", Ego(), deed.begin, value=round(duration(asked, deed), 1))
    return PeakMoment(of, deed.begin, (deed, *rest), length, looks)


#: By what is asked: the actions that are ranked if several are wanted, and their rank.
RANKS: Mapping[str, tuple[tuple[ActionName, ...], Callable[[Asked, Episode], float]]] = {
    "slowing": (SLOWING, _drop),
    "braking": (SLOWING, _peak),
    "delay": (SLOWING, _loss),
    "waiting": (HALTING, duration),
}
FINDERS: Mapping[str, Callable[[str, Asked, Window], PeakMoment]] = {
    "closeness": _closest,
    "danger": _dangerous,
    "slowness": _slowest,
    "speed": _fastest,
    "braking": _braking,
    "waiting": _waiting,
    "slowing": _slowing,
    "delay": _losing,
    "difficulty": _hardest,
    "risk": _riskiest,
}
