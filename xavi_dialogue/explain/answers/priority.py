"""Priority: who has or had right of way, who went first, and the facts behind a question of fault.

The rule follows from the road (`RoadFacts`), and from whom way was given to in fact. It is told
who had to yield and who did; whose fault something is, is not.
"""

import math
from itertools import pairwise
from typing import Literal, TypeAlias

from planner.road import RoadFacts
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, NotRecorded, Priority
from xavi_dialogue.domain.facts import Episode, Measure, Somebody
from xavi_dialogue.domain.meaning import Fault
from xavi_dialogue.domain.terms import Ego, Happens, Proposition, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.comfort import HARD, stretch
from xavi_dialogue.explain.answers.moments import Window, window
from xavi_dialogue.explain.answers.naming import known, number
from xavi_dialogue.explain.answers.occasions import PLAIN, occasion, overlaps

Rule: TypeAlias = Literal["priority", "give-way", "equal", "depends", "none"]
CROSSINGS: tuple[ActionName, ...] = (
    "exit-left",
    "exit-right",
    "exit-straight",
    "continue-next-exit",
    "enter",
    "turn",
)
MINOR: tuple[ActionName, ...] = ("speed-up", "change-plan", "leave")
NEAR = 6.0  # [s] before and after a crossing in which way is given for it
MEETING = 2.5  # [m] within which two lines meet
MOVING = 0.5  # [m/s] from which a vehicle drives along its line
LEAD = 3.0  # [s] before a crossing at which its rule is read off


def fault(question: Fault, asked: Asked) -> Answer:
    """Tell the facts that a question of fault or law turns on.

    Raises:
        Unanswered: a vehicle is unknown, or nothing is recorded of it.
    """
    event = question.of.event if isinstance(question.of, Happens) else None
    episode = None if event is None else occasion(asked, event)
    about = window(asked, tense="past") if episode is None else stretch(asked, episode)
    vehicle = number(question.suspect)
    if vehicle is None and event is not None:
        vehicle = number(event.actor) or number(event.object)
    if episode is None and _whole(asked, about):
        about = _last_crossing(asked, about)
    return priority_at(asked, vehicle, about, blame=True)


def right_of_way(asked: Asked, thing: Thing | None, to: Thing | None, about: Window) -> Priority:
    """Tell who goes first of two, or of us and whoever crosses our way.

    Raises:
        Unanswered: a vehicle is unknown, or the record does not hold it.
    """
    vehicle = number(thing) or number(to)
    return priority_at(asked, vehicle, about)


def priority_at(
    asked: Asked, vehicle: int | None, about: Window, *, blame: bool = False
) -> Priority:
    """Tell who has or had right of way in a stretch of the ride, and who went first.

    Raises:
        Unanswered: the vehicle is unknown, or the record does not hold it.
    """
    if vehicle is not None:
        known(asked, Vehicle(vehicle), about.end)
    time = _rule_time(asked, about)
    near = Window(time - NEAR, max(about.end, time) + NEAR)
    waited = _waited(asked, vehicle, near)
    if vehicle is None and waited is not None:
        vehicle = number(waited.object)
    rule = rule_for(asked.world.road(time), vehicle, waited is not None)
    if rule is None and not blame:
        raise Unanswered(NotRecorded("not-recorded", about="right-of-way", since=time))
    crossing = rule in ("priority", "give-way", "equal", "depends")
    first = went_first(asked, vehicle, near, waited) if crossing else None
    return Priority(
        time, rule or "none", vehicle, first, waited, blame,
        conflict=_conflict(asked, vehicle, near) if blame else None,
        limit=_limit(asked, about) if blame else None,
        deeds=_deeds(asked, vehicle, about) if blame else (),
    )  # fmt: skip


def rule_for(road: RoadFacts | None, vehicle: int | None, gave_way: bool) -> Rule | None:
    """Give the rule for us against a vehicle, or all at the next junction; None: not recorded."""
    if road is None:
        return "give-way" if gave_way else None
    for fact in road.priority:
        if fact.vehicle == vehicle:
            rules: dict[str, Rule] = {"ego": "priority", "vehicle": "give-way"}
            return rules.get(fact.who, "depends")
    if vehicle is not None and gave_way:
        return "give-way"
    if _same_way(road, vehicle):
        return "none"
    if vehicle is not None and road.places.get(vehicle) is not None:
        return "none"
    return road.route[0].rule if road.route else "none"


def _same_way(road: RoadFacts, vehicle: int | None) -> bool:
    """Tell whether a vehicle drives on our road, in our direction, outside junctions."""
    ours, theirs = road.places.get(EGO), None if vehicle is None else road.places.get(vehicle)
    if ours is None or theirs is None or ours.in_junction:
        return False
    return ours.edge == theirs.edge


def went_first(
    asked: Asked, vehicle: int | None, near: Window, waited: Episode | None
) -> Somebody | None:
    """Tell who went first: where their lines meet, else out of the junction; else who waited."""
    if vehicle is None:
        return None
    mine, theirs = line_order(asked, vehicle, near) or (
        _left(asked, EGO, near), _left(asked, vehicle, near)
    )  # fmt: skip
    if mine is not None or theirs is not None:
        ours = theirs is None or (mine is not None and mine < theirs)
        if ours and not any(near.begin <= t for t in entries(asked)):
            return None
        return Ego() if ours else Vehicle(vehicle)
    over = waited is not None and waited.end is not None and waited.standing
    return Vehicle(vehicle) if over else None


def line_order(asked: Asked, vehicle: int, near: Window) -> tuple[float, float] | None:
    """Tell when [s] we and a vehicle came to where our lines meet; None where they do not."""
    ours, other = asked.ride.motion(EGO), asked.ride.motion(vehicle)
    mine = [k for k in ours.within(near.begin, near.end) if ours.speed[k] > MOVING]
    theirs = [k for k in other.within(near.begin, near.end) if other.speed[k] > MOVING]
    meetings = [
        (math.dist(ours.position[i], other.position[k]), ours.time[i], other.time[k])
        for i in mine
        for k in theirs
    ]
    close = [m for m in meetings if m[0] <= MEETING]
    if not close:
        return None
    _, first, second = min(close, key=lambda m: min(m[1], m[2]))
    return first, second


def where_rule_holds(asked: Asked, of: Proposition | None, about: Window) -> Window:
    """Give the stretch of the ride whose right of way is asked about: the last crossing, or now."""
    del of
    return _last_crossing(asked, about) if _whole(asked, about) else about


def _inside(asked: Asked, vehicle: int, near: Window) -> list[tuple[float, bool]]:
    """Tell whether a vehicle was inside a junction, at each decision of a stretch of the ride."""
    found = []
    for trace in asked.ride.traces:
        if trace.road is not None and near.begin <= trace.sim_time <= near.end:
            place = trace.road.places.get(vehicle)
            if place is not None:
                found.append((trace.sim_time, place.in_junction or place.roundabout))
    return found


def _left(asked: Asked, vehicle: int, near: Window) -> float | None:
    """Tell when [s] a vehicle was first seen out of a junction or roundabout that it was in."""
    pairs = pairwise(_inside(asked, vehicle, near))
    return next((later[0] for before, later in pairs if before[1] and not later[1]), None)


def entries(asked: Asked) -> list[float]:
    """Tell when [s] we were first seen inside each junction that we crossed so far."""
    inside = _inside(asked, EGO, Window(asked.world.begin, asked.now))
    first = [inside[0][0]] if inside and inside[0][1] else []
    return first + [later[0] for before, later in pairwise(inside) if later[1] and not before[1]]


def _rule_time(asked: Asked, about: Window) -> float:
    """Tell when [s] the rule is read off: shortly before we came into the junction; else then."""
    if about.instant and about.end >= asked.now - 0.1:
        return asked.now
    near = [t for t in entries(asked) if about.begin - NEAR <= t <= about.end + NEAR]
    if near:
        entry = min(near, key=lambda t: max(about.begin - t, t - about.end, 0.0))
        return max(entry - LEAD, asked.world.begin)
    found = asked.world.episodes(actor=Ego(), actions=CROSSINGS)
    crossing = next((e for e in found if overlaps(asked, e, about)), None)
    return about.begin if crossing is None else max(crossing.begin, asked.world.begin)


def _last_crossing(asked: Asked, about: Window) -> Window:
    entered = entries(asked)
    if entered:
        return Window(entered[-1], entered[-1])
    begun = asked.world.episodes(actor=Ego(), actions=CROSSINGS)
    return stretch(asked, begun[-1]) if begun else Window(about.end, about.end)


def _waited(asked: Asked, vehicle: int | None, near: Window) -> Episode | None:
    """Give our giving way within a stretch of the ride: to a vehicle, or to anybody."""
    found = [
        e
        for e in asked.world.episodes(actor=Ego(), actions=("give-way", "wait"))
        if e.how in (None, "right-of-way")
        and overlaps(asked, e, near)
        and (vehicle is None or number(e.object) == vehicle)
    ]
    return next((e for e in found if isinstance(e.object, Vehicle)), None)


def _conflict(asked: Asked, vehicle: int | None, near: Window) -> bool | None:
    """Tell whether one of both had to brake hard; None where it is not known."""
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    who: tuple[Somebody, ...] = (Ego(),) if vehicle is None else (Ego(), Vehicle(vehicle))
    peaks = [asked.world.extreme("deceleration", one, "highest", begin, end) for one in who]
    values = [m.value for m in peaks if m.gap is None and m.value is not None]
    return max(values) >= HARD if values else None


def _limit(asked: Asked, about: Window) -> Measure | None:
    """Give our highest speed then, beside the limit."""
    near = about.widened() if about.instant else about
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    found = asked.world.extreme("speed", Ego(), "highest", begin, end)
    if found.gap is not None or found.reference is not None:
        return found if found.gap is None else None
    limit = asked.world.measure("limit", Ego(), found.time)
    if limit.gap is not None:
        return None
    return Measure(
        "speed", Ego(), found.time, value=found.value, extreme="highest", reference=limit.value
    )


def _deeds(asked: Asked, vehicle: int | None, about: Window) -> tuple[Episode, ...]:
    """Tell what the vehicle and we did then that bears on it."""
    near = about.widened(NEAR / 2.0)
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    names = [Ego()] if vehicle is None else [Vehicle(vehicle), Ego()]
    found = [
        e
        for e in asked.world.account(begin, end)
        if e.actor in names and e.action not in PLAIN and e.action not in MINOR
    ]
    return tuple(found[:4])


def _whole(asked: Asked, about: Window) -> bool:
    return about.begin <= asked.world.begin and about.end >= asked.now - 0.1
