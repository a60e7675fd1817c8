"""Accounts: lists and summaries of the ride, of a stretch of it, or of a vehicle."""

from collections.abc import Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Beliefs, Happenings, Helpful, Identified, Verdict
from xavi_dialogue.domain.facts import Belief, Episode, Look, Measure
from xavi_dialogue.domain.meaning import Listing, Summarise
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Is,
    Junction,
    Nobody,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.events.beliefs import history_of
from xavi_dialogue.explain.answers.events.decisions import decided_at
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.propositions.identify import identified
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import known as valued
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, window
from xavi_dialogue.explain.answers.reference.naming import (
    first_look,
    is_us,
    number,
    of_kind,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import (
    belongs,
    did_not_happen,
    duration,
    occasion,
    occasions,
    overlaps,
    with_let_first,
)
from xavi_dialogue.explain.answers.ride.comfort import stretch
from xavi_dialogue.explain.answers.ride.condensing import condensed
from xavi_dialogue.explain.answers.ride.delays import for_whom
from xavi_dialogue.explain.answers.ride.mistakes import mistakes
from xavi_dialogue.explain.answers.ride.onward import WAYS, turns_left
from xavi_dialogue.explain.answers.ride.places import gone, time_to_go

TOLD = 8  # maximum number of episodes in a summary
APPROACH = 4.0  # [s] maximum time between episodes at one junction
LEADING = 5.0  # [s] before the last episode in which others belong to it
LISTED = 40  # maximum number of episodes in a list
MACROS: frozenset[ActionName] = frozenset(
    ("change-left", "change-right", "exit-left", "exit-right", "exit-straight",
     "continue-next-exit", "stop")
)  # fmt: skip
_SLOWING = ("slow-down", "brake", "stop", "stand", "wait", "give-way")
_WAITING = {"give-way", "wait"}
_SHIFTING = ("cut-in", "change-left", "change-right")
_HALTS = ("wait", "stop", "stand")
BRIEF = 0.8  # [s] duration below which a halt is not stated
DEED = 2.0  # minimum weight of an episode of another vehicle
#: How much an episode matters in a summary.
WEIGHT: dict[ActionName, float] = {
    "collide": 20.0, "nearly-collide": 12.0, "arrive": 6.0, "give-way": 6.0, "cut-in": 6.0,
    "follow": 5.0, "overtake": 5.0, "leave": 5.0, "wait": 5.0, "stop": 5.0, "stand": 4.0,
    "enter": 3.0,
    "exit-left": 5.0, "exit-right": 5.0, "exit-straight": 3.0, "continue-next-exit": 5.0,
    "change-left": 4.0, "change-right": 4.0, "pull-out": 4.0, "change-plan": 3.0, "brake": 4.0,
    "pass": 2.0, "cross": 3.0, "slow-down": 2.0, "speed-up": 0.5, "disappear": 0.5, "appear": 0.5,
}  # fmt: skip


def listing(question: Listing, asked: Asked) -> Answer:
    """Return the list of things that is asked for, except for options and reasons (`causal`).

    Raises:
        Unanswered: there is nothing of the sort in the record.
    """
    about = window(asked, question.time)
    match question.of:
        case "vehicles":
            return _vehicles(asked, about, question.about)
        case "beliefs":
            return _beliefs(asked, question, about)
        case "wrong-predictions":
            return _mistakes(asked, question.about, about)
        case "capabilities":
            return Helpful()
    if question.of == "decisions" and about.instant:
        return decided_at(asked, about.middle)
    actor = _actor(asked, question.about)
    if question.of == "stops":
        return _of_kind(asked, Event("stop", actor if actor is not None else Ego()), about)
    if question.event is not None:
        return _of_kind(asked, question.event, about)
    return Happenings(
        "list", _listed(asked, question.of, actor, about), actor, about.begin, about.end
    )


def _of_kind(asked: Asked, event: Event, about: Window) -> Happenings:
    """Return the list of the episodes in a stretch of the ride that an event describes."""
    every = with_let_first(asked, event, occasions(asked, event))
    found = tuple(for_whom(asked, e) for e in every if belongs(asked, e, about))
    if not found and event.action == "brake":
        return _of_kind(asked, replace(event, action="slow-down"), about)
    return Happenings("list", found, event.actor, about.begin, about.end, asked=event)


def summarise(question: Summarise, asked: Asked) -> Answer:
    """Return what mattered of the ride, an interval, a vehicle, or an episode.

    Raises:
        Unanswered: the episode did not happen.
    """
    about = window(asked, question.time)
    if isinstance(question.about, Event):
        if question.about.tense == "future" and question.about.action in WAYS:
            return turns_left(asked, question.about)
        found = occasion(asked, question.about)
        if found is None:
            raise did_not_happen(asked, question.about)
        return summary(asked, None, stretch(asked, found).widened(2.0))
    if isinstance(question.about, Vehicle) and isinstance(question.time, Unsaid):
        look = asked.world.look(question.about.number, asked.now)
        if look is not None and not look.in_view and asked.past is None:
            return gone(asked, question.about)
    if isinstance(question.time, WholeRide):
        about = Window(asked.world.begin, asked.now)
    if isinstance(question.about, Junction):
        about = _with_approach(asked, about)
    ride = isinstance(question.time, WholeRide | Unsaid) and number(question.about) is None
    return summary(asked, question.about, about, ride=ride and about.end >= asked.now)


def _with_approach(asked: Asked, about: Window) -> Window:
    """Extend the stretch of a junction by our waiting or slowing down before it."""
    begin = about.begin
    halts: tuple[ActionName, ...] = ("give-way", "wait", "stop", "stand", "brake")
    for episode in reversed(asked.world.episodes(Ego(), halts, end=about.begin)):
        end = asked.now if episode.end is None else episode.end
        if end >= begin - APPROACH:
            begin = min(begin, episode.begin)
    return Window(begin, about.end, about.said)


def summary(asked: Asked, about: Thing | None, time: Window, *, ride: bool = False) -> Happenings:
    """Return the episodes that matter of a stretch of the ride, of all of it, or of a vehicle."""
    near = time.widened(2.0) if time.instant else time
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    vehicle = number(about)
    told = list(asked.world.account(begin, end))
    if time.said and not time.instant:
        told = [e for e in told if belongs(asked, e, time)]
    if not told and not time.said and not (asked.past is not None and asked.past.said):
        told = _before(asked, begin)
        begin = min((e.begin for e in told), default=begin)
    if vehicle is not None:
        told = _deeds(asked, vehicle, begin, end)
        told += [e for e in asked.world.account(begin, end) if number(e.object) == vehicle]
    told = [e for e in told if e.action not in _HALTS or duration(asked, e) >= BRIEF] or told
    if ride:
        told = [e for e in told if e.end is not None or e.action not in ("brake", "slow-down")]
        told = condensed(asked, told) if vehicle is None else told
    chosen = select(asked, [_over(asked, e) for e in told], TOLD)
    measures = _of_ride(asked, begin, end) if ride and vehicle is None else ()
    actor = about if vehicle is not None else None
    looks = taking_part(asked, chosen)
    if vehicle is not None and all(look.vehicle != vehicle for look in looks):
        look = first_look(asked, vehicle, begin)
        looks = looks if look is None else (look, *looks)
    return Happenings("summary", chosen, actor, begin, end, measures, looks)


def _over(asked: Asked, episode: Episode) -> Episode:
    """Return an episode as over, if it went on when we arrived."""
    if episode.end is not None or episode.action == "arrive" or not asked.ride.arrived:
        return episode
    arrival = next(e.sim_time for e in asked.ride.events if e.kind == "arrived")
    return replace(episode, end=max(episode.begin, arrival))


def _before(asked: Asked, at: float) -> list[Episode]:
    """Return what happened last before a time [s]: the last episode, and what led up to it."""
    earlier = [e for e in asked.world.account(asked.world.begin, at) if e.begin <= at]
    last = max((e.begin for e in earlier), default=at)
    return [e for e in earlier if e.begin >= last - LEADING]


def select(asked: Asked, told: Sequence[Episode], most: int) -> tuple[Episode, ...]:
    """Choose the episodes that matter most, in order of time."""
    ranked = sorted(told, key=lambda e: (-_weight(asked, e), e.begin))
    chosen: list[Episode] = []
    for episode in ranked:
        if len(chosen) < most and not any(_same(asked, episode, other) for other in chosen):
            chosen.append(episode)
    return tuple(sorted(chosen, key=lambda e: (e.begin, e.action == "give-way")))


def _weight(asked: Asked, episode: Episode) -> float:
    weight = WEIGHT.get(episode.action, 0.2)
    if isinstance(episode.actor, Ego):
        weight *= 1.5
    if episode.peak is not None and episode.peak >= 4.0:
        weight += 3.0
    return weight + min(duration(asked, episode) / 20.0, 0.5)


def _same(asked: Asked, one: Episode, other: Episode) -> bool:
    """Check whether two episodes say the same: one actor, overlapping times, similar actions."""
    both = any(one.action in alike and other.action in alike for alike in (_SLOWING, _SHIFTING))
    if one.object != other.object and {one.action, other.action} <= _WAITING:
        return False
    if {one.action, other.action} & {"give-way"} and {one.action, other.action} & {"brake"}:
        both = False  # one says for whom, one how much
    return (
        one.actor == other.actor
        and (both or one.action == other.action)
        and overlaps(asked, one, stretch(asked, other))
    )


def _deeds(asked: Asked, vehicle: int, begin: float, end: float) -> list[Episode]:
    """Return what a vehicle did in a stretch of the ride; if nothing matters, everything."""
    every = asked.world.episodes(actor=Vehicle(vehicle), begin=begin, end=end)
    return [e for e in every if WEIGHT.get(e.action, 0.0) >= DEED] or list(every)


def _of_ride(asked: Asked, begin: float, end: float) -> tuple[Measure, ...]:
    """Return the duration, distance and highest speed of the ride, and the time still to go."""
    world = asked.world
    time = Measure("duration", Ego(), begin, value=end - begin, until=end, extreme="total")
    driven = world.measure("distance-driven", Ego(), end)
    fastest = world.extreme("speed", Ego(), "highest", begin, end)
    left = () if asked.ride.arrived else (time_to_go(asked, asked.now),)
    return (time, *valued(driven, fastest, *left))


def _listed(asked: Asked, of: str, actor: Thing | None, about: Window) -> tuple[Episode, ...]:
    begin, end = max(about.begin, asked.world.begin), min(about.end, asked.now)
    if of == "decisions":
        mine = asked.world.episodes(actor=Ego(), begin=begin, end=end)
        return tuple(e for e in mine if e.action in MACROS and belongs(asked, e, about))
    told = list(asked.world.account(begin, end))
    vehicle = number(actor)
    if vehicle is not None:
        return select(asked, _deeds(asked, vehicle, begin, end), LISTED)
    if is_us(actor):
        told = [e for e in told if isinstance(e.actor, Ego)]
    return tuple(sorted(told, key=lambda e: e.begin))[:LISTED]


def _vehicles(asked: Asked, about: Window, whom: Thing | None) -> Answer:
    """Return the vehicles in view; for a stretch of the ride, all that were seen in it."""
    world = asked.world
    if about.end - about.begin <= SHORT or asked.past is None:
        numbers, at = world.in_view(asked.moment), asked.moment
    else:
        at = about.end
        times = [t.sim_time for t in asked.ride.traces if about.begin <= t.sim_time <= about.end]
        numbers = tuple(sorted({v for t in times for v in world.in_view(t)}))
    match whom:
        case Vehicle() | Vehicles():
            return identified(asked, whom, at)
        case Nobody(described=Described()):
            return Identified((), none=True)
        case Everyone(kind=kind):
            numbers = of_kind(asked, numbers, kind, at)
    found = (first_look(asked, v, at) for v in numbers)
    seen = tuple(sorted((x for x in found if x is not None), key=lambda look: look.distance))
    return Identified(seen, none=not seen)


def _beliefs(asked: Asked, question: Listing, about: Window) -> Answer:
    """Return what we expect of a vehicle and how that changed; or of all vehicles in view."""
    vehicle = number(question.about)
    if vehicle is not None:
        found: Beliefs = history_of(asked, vehicle, None, question.time)
        return found if found.time is not None else replace(found, time=found.history[0].time)
    if isinstance(question.about, Vehicles) and isinstance(question.time, Unsaid | WholeRide):
        foretold = forecast(asked, map(Vehicle, question.about.numbers))
        if foretold is not None:
            return foretold
    at = asked.moment if asked.past is not None else asked.now
    seen = tuple(x for v in asked.world.in_view(at) if (x := asked.world.look(v, at)) is not None)
    beliefs = (asked.world.belief(look.vehicle, at) for look in seen)
    facts: tuple[Belief, ...] = tuple(b for b in beliefs if b is not None)
    return Identified(seen, facts=facts, none=not seen)


def _mistakes(asked: Asked, thing: Thing | None, about: Window) -> Verdict:
    """Return our expectations of others that turned out wrong."""
    found = mistakes(asked, number(thing), about)
    return Verdict(
        Is("wrong", thing if thing is not None else Ego(), tense="perfect"), bool(found),
        tuple(e for _, e in found), believed=tuple(b for b, _ in found), mistaken=bool(found),
    )  # fmt: skip


def _actor(asked: Asked, thing: Thing | None) -> Thing | None:
    if thing is None or isinstance(thing, Everyone | Vehicles):
        return None
    who = somebodies(asked, thing, asked.now)
    return who[0] if who else None


def taking_part(asked: Asked, episodes: Sequence[Episode]) -> tuple[Look, ...]:
    """Return each vehicle that takes part, as it was seen when its first episode began."""
    first: dict[int, float] = {}
    for episode in episodes:
        for thing in (episode.actor, episode.object):
            if (vehicle := number(thing)) is not None and vehicle not in first:
                first[vehicle] = episode.begin
    found = (first_look(asked, v, at) for v, at in first.items())
    return tuple(x for x in found if x is not None)
