"""Hidden areas: what we cannot see past, whether somebody might come from there, and what if not.

The planner imagines who might come, as phantoms. An answer names them as a possibility only.
"""

import math
from collections.abc import Callable
from typing import Any, TypeAlias

from planner.record.hidden_record import Phantom
from planner.record.trace import PlanTrace
from xavi_dialogue.domain.answers import Answer, NotRecorded
from xavi_dialogue.domain.hidden_areas import Hider, SightTold, SupposedSeeing
from xavi_dialogue.domain.meaning import Ask, HowKnow, HowSure, Listing, WhatIf, Whether, Which
from xavi_dialogue.domain.terms import (
    Believed,
    Described,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Is,
    Nobody,
    Proposition,
    Related,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.naming import is_building, is_us
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.causes.driving.hidden_areas import holding, opened, seeing_past, side_of
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.history.ride import ROUNDING, planned

Explainer: TypeAlias = Callable[[Any, Asked], Answer]

JUST_NOW = 1.5  # [s] for which a decision still holds
TALL = frozenset(("bus", "truck", "van", "tram"))  # kinds that are too tall to see past
SAME_LINE = 2.0  # [m] maximum sideways distance of two vehicles on one path
TOGETHER = 3.0  # [s] maximum time between decisions about one hidden part


def explainer(act: object, scene: Asked) -> Explainer | None:
    """Find the explainer of an act about hidden parts of the road; None for other acts."""
    if not isinstance(act, Ask):
        return None
    match act.question:
        case WhatIf(supposed) if _seen_past(supposed) is not None:
            return lambda asked, here: _supposed(asked.question, here)
        case Whether(that) if _of_sight(that) is not None:
            return _told("past")
        case Which(such=Related("behind", Wanted(), Vehicle() as hider) as such):
            alone = not _anybody_behind(scene, hider) and such.tense == "present"
            there = bool(_hiding(scene, hider, past=False)) or _covers(scene, such, hider)
            return _told("there") if alone and there else None
        case WhatIf(supposed) if _emerges(supposed) is not None:
            return _told("if")
        case Which(such=Related("ahead-of", Wanted(), Vehicle() as hider) as such) | Whether(
            Exists(Nobody(Described(bearing="ahead", of=Vehicle() as hider))) as such
        ) if such.tense == "present" and _beyond(scene, hider):
            return lambda _, here: SightTold("beyond", (Hider(hider.number, "ahead", None),))
        case HowKnow(
            Exists(Nobody(Described(bearing="ahead", of=Vehicle() as hider)))
            | Related("ahead-of", Nobody(), Vehicle() as hider)
        ) if _beyond(scene, hider):
            return lambda _, here: SightTold("beyond", (Hider(hider.number, "ahead", None),))
        case Listing("hidden"):
            return _told("what")
        case Whether(Exists(thing)) if _is_blind(thing):
            return _told("past")
        case Whether(that) | HowSure(that) if (from_where := _comes_from(that)) is not None:
            if not _hiding(scene, from_where, _is_past(that)):
                return _told("there") if _covers(scene, that, from_where) else None
            if isinstance(act.question, Whether) and _is_deed(that):
                return None if _anybody_new(scene, from_where) else _told("came")
            return _told("there" if _is_there(that) else "chance")
        case HowKnow(of) if (from_where := _comes_from(of)) is not None:
            return _told("known") if _hiding(scene, from_where, _is_past(of)) else None
    return None


def _told(asked: Any) -> Explainer:
    return lambda act, scene: _tell(asked, act.question, scene)


def _tell(asked: Any, question: Any, scene: Asked) -> Answer:
    """Return what is hidden, and who may be there."""
    that = question.such if isinstance(question, Which) else _said(question)
    past = _is_past(that) if that is not None else scene.past is not None
    about = None
    if isinstance(that, Proposition):
        about = _of_sight(that) or _comes_from(that)
    found = _hiding(scene, about, past)
    if not found and isinstance(about, Vehicle) and _covers(scene, that, about):
        return SightTold(asked, (Hider(about.number, "ahead", None),), past)
    if not found:
        return SightTold(asked, (), past)
    first = _first(found, about)
    slowed = any(one in holding(t) for t in found for one in _fitting(t, about))
    now = found[-1].sim_time >= scene.now - JUST_NOW
    told = first if past and not now else found[-1]
    return SightTold(asked, _hiders(told, _fitting(told, about), about), past or not now, slowed)


def _said(question: Any) -> Proposition | None:
    """Return the proposition of a question; None if it only asks for a list."""
    if isinstance(question, Listing):
        return None
    names = ("that", "of", "supposed")
    return next((p for name in names if (p := getattr(question, name, None)) is not None), None)


def _anybody_behind(scene: Asked, hider: Vehicle) -> bool:
    """Check whether anybody is seen behind a vehicle."""
    seen = (Vehicle(v) for v in scene.world.in_view(scene.now) if v != hider.number)
    return any(scene.world.relation("behind", one, hider, scene.now) for one in seen)


def _beyond(scene: Asked, hider: Vehicle) -> bool:
    """Check whether a vehicle ahead is too tall to see past, with nobody in view ahead of it."""
    look = scene.world.look(hider.number, scene.now)
    if look is None or look.ahead <= 0.0 or look.oncoming or not _covers(scene, None, hider):
        return False
    seen = (scene.world.look(v, scene.now) for v in scene.world.in_view(scene.now))
    line = [x for x in seen if x is not None and abs(x.left - look.left) <= SAME_LINE]
    return not any(x.ahead > look.ahead for x in line if x.vehicle != hider.number)


def _covers(scene: Asked, that: Proposition | None, where: Thing) -> bool:
    """Check whether somebody may be behind a vehicle, because it is too tall to see past."""
    look = scene.world.look(where.number, scene.now) if isinstance(where, Vehicle) else None
    tall = look is not None and look.in_view and look.kind in TALL
    return tall and not _is_past(that) and not _is_deed(that)


def _supposed(question: WhatIf, scene: Asked) -> Answer:
    """Return what we would do, or would have done, if we could see past what hides the road.

    Raises:
        Unanswered: the decision must be planned again first, or cannot be.
    """
    about = _seen_past(question.supposed)
    past = _is_past(unwrapped(question.supposed)[0])
    found = _hiding(scene, about, past=True)
    if not found:
        return SupposedSeeing((), scene.now, (), (), 0.0, past)
    trace = _first(found, about)
    seen = _seen(trace, about)
    over = found[-1].sim_time < scene.now - JUST_NOW
    if not seen:  # something else hides them too
        hiders = _hiders(trace, _fitting(trace, about), about)
        plan = planned(trace)
        return SupposedSeeing(hiders, trace.sim_time, plan, plan, 0.0, past or over)
    again = seeing_past(scene.ride, trace, seen)
    if again is None:
        raise Unanswered(NotRecorded("not-recorded", since=trace.sim_time))
    here = factual(scene.ride.model(trace), trace)
    there = factual(scene.ride.model(again), again)
    hiders = _hiders(trace, tuple(trace.phantoms[k] for k in seen), about)
    gained = _duration(here) - _duration(there)
    return SupposedSeeing(
        hiders, trace.sim_time, planned(trace), planned(again), max(gained, 0.0), past or over
    )


def _duration(drive: Any) -> float:
    """Return the expected time [s] of a drive."""
    known = drive.present("time")
    mass = sum(weight for _, weight, _ in known)
    return sum(weight * abs(value) for _, weight, value in known) / mass if mass else 0.0


def _hiding(scene: Asked, about: Thing | None, past: bool) -> list[PlanTrace]:
    """List the decisions about the hidden part in question: present ones, else the last."""
    known = [
        t for t in scene.ride.traces if t.sim_time <= scene.now + ROUNDING and _fitting(t, about)
    ]
    if not known or (not past and known[-1].sim_time < scene.now - JUST_NOW):
        return []
    found = [known[-1]]
    for trace in reversed(known[:-1]):
        if found[0].sim_time - trace.sim_time > TOGETHER:
            break
        found.insert(0, trace)
    return found


def _first(found: list[PlanTrace], about: Thing | None) -> PlanTrace:
    """Return the first decision at which the hidden part made us slower; else the first of all."""
    held = [t for t in found if any(one in _fitting(t, about) for one in holding(t))]
    free = [t for t in held if t.under_way is None]
    return (free or held or found)[0]


def _fitting(trace: PlanTrace, about: Thing | None) -> tuple[Phantom, ...]:
    """Return the phantoms behind a vehicle, behind a building, or behind anything."""
    match about:
        case Vehicle(number=number):
            return tuple(x for x in trace.phantoms if number in (x.behind, *x.beyond))
        case Feature(kind="building"):
            return tuple(x for x in trace.phantoms if x.behind is None or x.walled)
    return trace.phantoms


def _seen(trace: PlanTrace, about: Thing | None) -> tuple[int, ...]:
    """Return the phantoms that we would see past a vehicle, a building or anything, by index."""
    match about:
        case Vehicle(number=number):
            return opened(trace, number)
        case Feature(kind="building"):
            return opened(trace, None)
    return tuple(range(len(trace.phantoms)))


def _hiders(
    trace: PlanTrace, phantoms: tuple[Phantom, ...], about: Thing | None
) -> tuple[Hider, ...]:
    """Return what hides the road on which side, with the probability that somebody is there."""
    nobody: dict[tuple[Any, Any], float] = {}
    for one in phantoms:
        hider = one.behind
        if isinstance(about, Vehicle):
            hider = about.number
        elif isinstance(about, Feature) and about.kind == "building":
            hider = None
        key = (hider, side_of(trace, one))
        nobody[key] = nobody.get(key, 1.0) * (1.0 - one.probability)
    found = (Hider(vehicle, side, round(1.0 - none, 4)) for (vehicle, side), none in nobody.items())
    return tuple(sorted(found, key=lambda one: -(one.probability or 0.0)))


def _anybody_new(scene: Asked, about: Thing) -> bool:
    """Check whether anybody has come into view since the decision about the hidden part."""
    since = _hiding(scene, about, past=True)[0].sim_time
    return any(
        math.isclose(time, since) or time > since
        for time in (_first_seen(scene, v) for v in scene.world.vehicles)
    )


def _first_seen(scene: Asked, vehicle: int) -> float:
    times = (t.sim_time for t in scene.ride.traces if vehicle in t.scene)
    return next(times, scene.now)


# --- What a question is about ---------------------------------------------------------------------


def _seen_past(supposed: Proposition) -> Thing | None:
    """Return what is supposed to be seen past, or a building that is supposed to be absent."""
    of, negated = unwrapped(supposed)
    match of:
        case Related("sees-past", thing, to) if is_us(thing) and not negated:
            return to
        case Exists(thing) if negated and (is_building(thing) or _is_blind(thing)):
            return thing
    return None


def _emerges(supposed: Proposition) -> Thing | None:
    """Return what an unknown road user is supposed to come from behind of."""
    of, negated = unwrapped(supposed)
    return None if negated or _is_there(supposed) else _comes_from(of)


def _of_sight(that: Proposition) -> Thing | None:
    of, _ = unwrapped(that)
    return of.to if isinstance(of, Related) and of.relation == "sees-past" else None


def _is_blind(thing: Thing | None) -> bool:
    if isinstance(thing, Nobody) and thing.described is not None:
        return False
    return isinstance(thing, Feature) and thing.kind == "blind"


def _comes_from(that: Proposition | None) -> Thing | None:
    """Return what an unknown road user is said to be behind, or to come from behind of."""
    of, _ = unwrapped(that)
    if isinstance(of, Believed):
        of, _ = unwrapped(of.content)
    where: Thing | None = None
    match of:
        case Related("behind" | "from", Nobody() | Everyone() | Described() | Wanted(), to):
            where = to
        case Happens(Event(action="come" | "appear" | "pull-out", actor=actor, object=to)) if (
            isinstance(actor, Nobody | Everyone | Described)
        ):
            where = to
        case Happens(Event(actor=Nobody() | Everyone() | Described(), where=Related() as there)):
            where = there.to if there.relation in ("behind", "from") else None
        case Exists(Nobody(Described(bearing="behind", of=to))):
            where = to
    return where if isinstance(where, Vehicle) or is_building(where) or _is_blind(where) else None


def _is_there(that: Proposition | None) -> bool:
    """Check whether the question is if somebody is there, rather than comes from there."""
    of, _ = unwrapped(that)
    if isinstance(of, Believed):
        of, _ = unwrapped(of.content)
    return isinstance(of, Exists) or (isinstance(of, Related) and of.relation == "behind")


def _is_deed(that: Proposition | None) -> bool:
    """Check whether the question is what somebody did, rather than could have done."""
    of, _ = unwrapped(that)
    if isinstance(of, Happens):
        return of.event.tense == "past" and of.event.modal is None
    return isinstance(of, Related) and of.relation == "from" and of.tense == "past"


def _is_past(that: Proposition | None) -> bool:
    of, _ = unwrapped(that)
    if isinstance(of, Happens):
        return of.event.tense in ("past", "perfect")
    return isinstance(of, Related | Exists | Is) and of.tense in ("past", "perfect")
