"""Priority: who has or had right of way, who went first, and facts for questions of fault.

The answer states who had to yield by the road's rule and who did, but not whose fault something is.
"""

from typing import Any, Literal, TypeAlias, cast

from msgspec.structs import replace as changed

from planner.record.places import RoadFacts
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, NotRecorded, Priority
from xavi_dialogue.domain.facts import Episode, Measure, Somebody
from xavi_dialogue.domain.meaning import Fault, Question
from xavi_dialogue.domain.terms import Ego, Happens, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.precedence import (
    at_ring,
    green_ahead,
    on_ring,
    red_ahead,
)
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, window
from xavi_dialogue.explain.answers.reference.naming import known, number, somebodies
from xavi_dialogue.explain.answers.reference.occasions import PLAIN, occasion, overlaps
from xavi_dialogue.explain.answers.ride.comfort import HARD, stretch
from xavi_dialogue.explain.answers.ride.crossings import (
    NEAR,
    crossing_now,
    entries,
    let_by,
    meets_ahead,
    met_about,
    passes_by,
    stood,
    went_first,
)
from xavi_dialogue.explain.answers.ride.cycling import likely_let, rides_first
from xavi_dialogue.explain.answers.ride.walking import about_to_cross, walks_first
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.explain.history.traffic_lights import rule_at

Rule: TypeAlias = Literal[
    "priority", "give-way", "equal", "depends", "none", "we-change", "it-changes"
]
CROSSINGS: tuple[ActionName, ...] = (
    "exit-left", "exit-right", "exit-straight", "continue-next-exit", "enter", "turn",
)  # fmt: skip
MINOR: tuple[ActionName, ...] = ("speed-up", "change-plan", "leave")
#: By rule: whether we must let the other one go first.
BY_SIGNS = frozenset[Rule](("priority", "equal", "depends"))
YIELDS: dict[str, bool] = {
    "priority": False, "give-way": True, "we-change": True, "it-changes": False,
}  # fmt: skip
CHANGES: tuple[ActionName, ...] = ("change-left", "change-right", "merge")
ASIDE = 1.5  # [m] minimum sideways distance of somebody in another lane
LEAD = 3.0  # [s] before a crossing, when its rule is read


def fault(question: Fault, asked: Asked) -> Answer:
    """Return the facts for a question of fault or law.

    Raises:
        Unanswered: a vehicle is unknown, or nothing is recorded of it.
    """
    event = question.of.event if isinstance(question.of, Happens) else None
    episode = None if event is None else occasion(asked, event)
    about = window(asked, tense="past") if episode is None else stretch(asked, episode)
    vehicle = _foremost(asked, question.suspect, about)
    if vehicle is None and event is not None:
        vehicle = number(event.actor) or number(event.object)
    whole = episode is None and _whole(asked, about)
    near = _last_crossing(asked, about) if whole else about
    found = priority_at(asked, vehicle, near, blame=True)
    if not question.legal:
        return found
    driver = number(question.suspect)
    limit = _limit(asked, about, Ego() if driver is None else Vehicle(driver))
    return changed(found, legal=True, limit=limit)


def _foremost(asked: Asked, thing: Thing | None, about: Window) -> int | None:
    """Return the vehicle that is meant; of several, one that goes first, if there is one."""
    if not isinstance(thing, Vehicles) or not thing.numbers:
        return number(thing)
    before = (n for n in thing.numbers if priority_at(asked, n, about).rule == "give-way")
    return next(before, thing.numbers[0])


def lawful(asked: Asked, about: Window | None, vehicle: int | None = None) -> Priority:
    """Return facts on whether we, or a vehicle, may do that: the limit, and who goes first.

    Raises:
        Unanswered: the record does not hold it.
    """
    near = Window(asked.now, asked.now) if about is None else about
    whole = about is not None and _whole(asked, about)
    crossing = _last_crossing(asked, near) if whole else near
    found = priority_at(asked, vehicle, crossing, blame=True)
    who = Ego() if vehicle is None else Vehicle(vehicle)
    return changed(found, legal=True, limit=_limit(asked, near, who), deeds=())


def right_of_way(asked: Asked, thing: Thing | None, to: Thing | None, about: Window) -> Priority:
    """Return who goes first of two, or of us and those whose way crosses ours.

    Raises:
        Unanswered: a vehicle is unknown, or the record does not hold it.
    """
    vehicle = _foremost(asked, thing, about) or _foremost(asked, to, about)
    return priority_at(asked, vehicle, about)


def priority_at(
    asked: Asked, vehicle: int | None, about: Window, *, blame: bool = False
) -> Priority:
    """Return who has or had right of way in a stretch of the ride, and who went first.

    Raises:
        Unanswered: the vehicle is unknown, or the record does not hold it.
    """
    general = vehicle is None
    if vehicle is not None:
        known(asked, Vehicle(vehicle), about.end)
    present = about.instant and about.end >= asked.now - 0.1
    ringed = general and present and on_ring(asked.world.road(asked.now))
    if vehicle is None and not ringed:
        vehicle = _crossing_now(asked) if present else met_about(asked, about)
    met = None if vehicle is None else rule_between(asked, vehicle, about)
    time = _rule_time(asked, about) if met is None else met[0]
    near = Window(time - NEAR, max(about.end, time) + NEAR)
    waited = _waited(asked, vehicle, near)
    if general and present and (ringed or (waited is not None and waited.end is not None)):
        waited = None
    if vehicle is None and waited is not None:
        vehicle = number(waited.object)
    road = asked.world.road(time)
    whole = rule_for(road, None, gave_way=False)
    rule = met[1] if met else rule_for(road, vehicle, waited is not None)
    if rule == "none" and vehicle is not None:
        rule = _changing(asked, vehicle, about) or rule
    ahead = about.end >= asked.now - SHORT and meets_ahead(asked, vehicle)
    if ahead and rule in ("priority", "give-way") and passes_by(asked, vehicle):
        rule = whole if general else "none"
        vehicle = None if general else vehicle
    comes = general and present and whole == "give-way" and rule == "priority"
    after = (vehicle,) if comes and vehicle is not None else ()  # others may come who go first
    vehicle, rule = (None, whole) if after else (vehicle, rule)
    owed = walks_first(asked, vehicle, about, waited) or rides_first(asked, vehicle, about)
    owed = owed or (present and rule in (None, "none") and likely_let(asked, vehicle))
    rule = "give-way" if owed else rule
    if rule is None and not blame:
        raise Unanswered(NotRecorded("not-recorded", about="right-of-way", since=time))
    crossing = rule in ("priority", "give-way", "equal", "depends")
    first = went_first(asked, vehicle, near, waited) if crossing and not ahead else None
    if crossing and not ahead and vehicle is not None and not about.instant and first is None:
        first = Ego() if stood(asked, vehicle, near) else None  # we are still in the junction
    return Priority(
        time, rule or "none", vehicle, first, waited, blame,
        conflict=_conflict(asked, vehicle, near) if blame else None,
        deeds=_deeds(asked, vehicle, about) if blame else (),
        stood=vehicle is not None and let_by(asked, vehicle, first, near, about),
        ring=general and at_ring(road), after=after,
        light=present and red_ahead(road) and (general or rule in BY_SIGNS),
        green=general and present and green_ahead(road),
    )  # fmt: skip


def _crossing_now(asked: Asked) -> int | None:
    """Return whose way crosses ours now; those on foot whom we are likely to let go are first."""
    seen = sorted(asked.world.in_view(asked.now), key=lambda v: not about_to_cross(asked, v))
    return next((v for v in seen if likely_let(asked, v)), None) or crossing_now(asked)


def goes_first(question: Question, asked: Asked) -> Answer:
    """Return who has right of way, for a question why somebody goes before us.

    Raises:
        Unanswered: the vehicle is unknown, or the record does not hold the rule.
    """
    event: Any = getattr(getattr(question, "of", None), "event", None)
    past = event.tense in ("past", "perfect")
    about = window(asked, event.time, "past") if past else Window(asked.now, asked.now)
    who = [n for v in somebodies(asked, event.actor, asked.now) if (n := number(v)) is not None]
    told = [priority_at(asked, n, about) for n in who] or [priority_at(asked, None, about)]
    return next((one for one in told if one.rule == "give-way"), told[0])


def owed(found: Priority, *, ours_yield: bool) -> Finding:
    """Return whether the rule supports a claim that we, or the others, must yield."""
    yields = YIELDS.get(found.rule)
    if yields is None:
        told = changed(found, holds=False if found.rule == "none" else None)
        return Finding(None, answer=told)
    holds = yields == ours_yield
    return Finding(holds, answer=changed(found, holds=holds))


def rule_between(asked: Asked, vehicle: int, about: Window) -> tuple[float, Rule] | None:
    """Return the rule between us and a vehicle, and when [s] it held, closest to a stretch.

    None if their ways never met, or not near the time in question.
    """
    found = [
        (trace.sim_time, fact.who)
        for trace in asked.ride.traces
        if trace.road is not None and trace.sim_time <= asked.now
        for fact in trace.road.priority
        if fact.vehicle == vehicle
    ]
    settled = [one for one in found if one[1] != "depends"] or found
    near = about.widened(NEAR) if about.instant else about
    inside = [one for one in settled if near.begin <= one[0] <= near.end]
    if not inside:
        return None
    last = about.end
    time, who = min(inside, key=lambda one: (abs(one[0] - last), -one[0]))
    return time, _WHO[who]


def _changing(asked: Asked, vehicle: int, about: Window) -> Rule | None:
    """Return which of the two changed lanes about then, or is about to."""
    now = about.instant and about.end >= asked.now - 0.1
    near = about if now else about.widened(NEAR)
    for who, rule in ((Ego(), "we-change"), (Vehicle(vehicle), "it-changes")):
        found = asked.world.episodes(actor=who, actions=CHANGES)
        if any(overlaps(asked, e, near) for e in found):
            return cast(Rule, rule)
    if _indicates_to_us(asked, vehicle, about.end):
        return "it-changes"
    trace = asked.ride.at(about.end)
    meant = () if trace is None else planned(trace)[:1]
    return "we-change" if any(step in CHANGES for step in meant) else None


def _indicates_to_us(asked: Asked, vehicle: int, at: float) -> bool:
    """Check whether a vehicle beside or behind us on our road indicates towards our lane."""
    look = asked.world.look(vehicle, at)
    shown = asked.world.episodes(actor=Vehicle(vehicle), actions=("signal",), begin=at, end=at)
    sides = {e.side for e in shown if e.begin <= at and (e.end is None or e.end >= at)}
    road = asked.world.road(at)
    places = {} if road is None else road.places
    here, there = places.get(EGO), places.get(vehicle)
    if look is None or not sides or here is None or there is None or here.edge != there.edge:
        return False
    return ("left" if look.left < 0.0 else "right") in sides and abs(look.left) > ASIDE


_WHO: dict[str, Rule] = {"ego": "priority", "vehicle": "give-way", "depends": "depends"}


def rule_for(road: RoadFacts | None, vehicle: int | None, gave_way: bool) -> Rule | None:
    """Return the rule for us against a vehicle, or all at the next junction; None: not recorded."""
    if road is None:
        return "give-way" if gave_way else None
    for fact in road.priority:
        if fact.vehicle == vehicle:
            return _WHO[fact.who]
    if vehicle is not None and gave_way:
        return "give-way"
    if vehicle is not None:
        return "none"
    return rule_at(road, road.route[0]) if road.route else "none"


def where_rule_holds(asked: Asked, about: Window) -> Window:
    """Return the stretch whose right of way matters: of the whole ride, its last crossing."""
    return _last_crossing(asked, about) if _whole(asked, about) else about


def _rule_time(asked: Asked, about: Window) -> float:
    """Return when [s] the rule is read: shortly before we came to the junction, if we did."""
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
    """Return our giving way within a stretch of the ride: to a vehicle, or to anybody."""
    found = [
        e
        for e in asked.world.episodes(actor=Ego(), actions=("give-way", "wait"))
        if e.how in (None, "right-of-way")
        and overlaps(asked, e, near)
        and (vehicle is None or number(e.object) == vehicle)
    ]
    return next((e for e in found if isinstance(e.object, Vehicle)), None)


def _conflict(asked: Asked, vehicle: int | None, near: Window) -> bool | None:
    """Check whether one of the two had to brake hard; None if it is not known."""
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    who: tuple[Somebody, ...] = (Ego(),) if vehicle is None else (Ego(), Vehicle(vehicle))
    peaks = [asked.world.extreme("deceleration", one, "highest", begin, end) for one in who]
    values = [m.value for m in peaks if m.gap is None and m.value is not None]
    return max(values) >= HARD if values else None


def _limit(asked: Asked, about: Window, who: Somebody) -> Measure | None:
    """Return somebody's highest speed then, with the limit."""
    near = about.widened() if about.instant else about
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    if about.instant and about.end >= asked.now:
        found = asked.world.measure("speed", who, asked.now)
    else:
        found = asked.world.extreme("speed", who, "highest", begin, end)
    if found.gap is not None or found.reference is not None:
        return found if found.gap is None else None
    limit = asked.world.measure("limit", who, found.time)
    if limit.gap is not None:
        return None
    return Measure(
        "speed", who, found.time, value=found.value, extreme="highest", reference=limit.value
    )


def _deeds(asked: Asked, vehicle: int | None, about: Window) -> tuple[Episode, ...]:
    """Return what the vehicle and we did then that bears on the question."""
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
