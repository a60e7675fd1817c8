"""Places: where somebody or something is or was, and where somebody is going."""

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, Bound, Identified, Located, NotRecorded, PlanAhead
from xavi_dialogue.domain.facts import Belief, Episode, Measure
from xavi_dialogue.domain.meaning import Where, Whither
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Event,
    Everyone,
    Exit,
    Junction,
    Lane,
    Next,
    Nobody,
    Passenger,
    Road,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import ActionName, Attribute
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.expectations.foreseen import HALTS, YIELDS, came_of
from xavi_dialogue.explain.answers.expectations.plans import current_plan, plan_ahead
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import SHORT, instant
from xavi_dialogue.explain.answers.reference.naming import (
    check_sense,
    first_look,
    is_us,
    looks,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import taken_place
from xavi_dialogue.explain.answers.ride.onward import next_halt, next_turning, route_ahead
from xavi_dialogue.explain.causes.vehicles.announced import announced
from xavi_dialogue.explain.history.nearing import still_to

TOLD = 2  # maximum of vehicles whose places one answer states
HERE: tuple[Attribute, ...] = ("lane", "turn", "distance-to-go")
#: Actions that say where somebody has gone.
LEAVING: frozenset[ActionName] = frozenset(
    ("go", "move", "head", "leave", "disappear", "turn", "continue")
)
WAY: tuple[Attribute, ...] = ("turn", "exit-number", "distance-to-go", "time-to-go")


def where(question: Where, asked: Asked) -> Answer:
    """Return where a thing is or was, or where an event took place.

    Raises:
        Unanswered: it is unknown, or did not take place.
    """
    of = question.of
    if isinstance(of, Event):
        if isinstance(of.actor, Vehicle) and of.action in LEAVING and of.object is None:
            return gone(asked, of.actor)
        if isinstance(of.actor, Everyone) and of.action in LEAVING:
            return _vehicles(asked, Vehicles(_left_behind(asked)), asked.now)
        if _may_come(of):
            return next_halt(asked)
        return took_place(asked, of)
    at = instant(asked, question.time)
    if isinstance(of, Everyone) and not asked.world.in_view(at):
        return Identified((), none=True)
    return locate(asked, of, at)


def locate(asked: Asked, thing: Thing, at: float) -> Answer:
    """Return where a thing is at a time [s].

    Raises:
        Unanswered: it is unknown.
    """
    check_sense(thing)
    match thing:
        case Vehicle() | Vehicles() | Everyone():
            return _vehicles(asked, thing, at)
        case Destination():
            return Located(thing, (), to_go(asked, at))
        case Ego() | Passenger() | Lane() | Road():
            return Located(Ego(), (), here(asked, at))
        case Junction(turning=True) if at >= asked.now - SHORT and (turn := next_turning(asked)):
            return turn
        case Junction():
            found = (junction(asked, thing, at), *measured(asked, ("turn", "exit-number"), at))
            return Located(thing, (), told(found), gap=found[0].gap)
        case Exit():
            return Located(thing, (), told(measured(asked, ("exit-number", "turn"), at)))
        case Nobody():
            return Located(thing, looks(asked, asked.world.in_view(at), at))
    raise Unanswered(NotRecorded("not-recorded", thing=thing, about="place"))


def _may_come(event: Event) -> bool:
    """Check whether the question is where we may have to stop or give way, not where we did."""
    halting = is_us(event.actor) and event.action in HALTS | YIELDS | {"brake", "slow-down"}
    ahead = event.tense == "future" or event.modal is not None or isinstance(event.time, Next)
    return halting and ahead and event.tense not in ("past", "perfect")


EVEN = 0.5  # minimum probability of a goal that is stated as expected


def whither(question: Whither, asked: Asked) -> Answer:
    """Return where somebody is going, was going, or has gone.

    Raises:
        Unanswered: it was never seen.
    """
    at = instant(asked, question.time)
    found = somebodies(asked, question.actor, at)
    if not found or isinstance(found[0], Ego):
        return our_way(asked, at)
    vehicle = found[0].number
    past = asked.now - at > SHORT
    if len(found) > 1 and not past and (expected := forecast(asked, found)) is not None:
        return expected
    look = asked.world.look(vehicle, asked.now)
    lost = look is not None and not look.in_view
    belief = asked.world.belief(vehicle, at)
    went = came_of(asked, vehicle, at) if past or lost else None
    if not past and not lost and (shown := _shows(asked, vehicle, belief)) is not None:
        return shown
    if went is None and lost:
        went = _last_way(asked, vehicle)
    return Bound(found[0], belief, went, look if lost or past else None)


def _shows(asked: Asked, vehicle: int, belief: Belief | None) -> Answer | None:
    """Return what the indicator of a vehicle announces, if no expectation is certain."""
    likeliest = belief.expectations[:1] if belief is not None else ()
    lit = [e for e in asked.world.episodes(Vehicle(vehicle), "signal") if e.end is None]
    if not lit or any(one.probability >= EVEN for one in likeliest):
        return None
    return announced(asked.ride, asked.world, vehicle, lit[-1], asked.now)


def gone(asked: Asked, who: Vehicle) -> Bound:
    """Return where a vehicle has gone: its last turn, and where it is or was last seen."""
    look = asked.world.look(who.number, asked.now)
    return Bound(who, None, _last_way(asked, who.number), look)


def our_way(asked: Asked, at: float) -> Answer:
    """Return our way: the next junction, and the rest of the distance; or that we have arrived."""
    if asked.ride.arrived and at >= asked.now - SHORT:
        return PlanAhead((), arrived=True)
    if at < asked.now - SHORT:
        return Bound(Ego(), measures=told(measured(asked, ("distance-to-go",), at)))
    if asked.world.road(asked.now) is not None and (route := route_ahead(asked)) is not None:
        return route
    ring = junction(asked, Junction("roundabout", 1), at)
    known = measured(asked, WAY, at)
    if ring.gap is not None:  # the exit that was taken is past
        known = tuple(m for m in known if m.attribute != "exit-number")
    return Bound(Ego(), measures=told((*known, ring)))


def next_turn(asked: Asked, at: float) -> PlanAhead:
    """Return what comes next, and which way we take there."""
    return plan_ahead(asked) if at >= asked.now - SHORT else PlanAhead((), here(asked, at))


def here(asked: Asked, at: float) -> tuple[Measure, ...]:
    """Return where we are at a time [s]: the lane, the distances to what comes next and the end."""
    road = asked.world.road(at)
    step = road.route[0] if road is not None and road.route else None
    found = list(measured(asked, ("lane",), at))
    place = road.places.get(EGO) if road is not None else None
    if place is not None and place.in_junction and not place.roundabout:
        found += at_junction(asked, at)
    elif step is not None:
        inside = place is not None and place.roundabout
        goal: Thing = Exit(step.exit) if inside else Junction(step.kind, 1, at)
        found.append(_to_junction(asked, goal, step.distance, at))
    return told((*found, *to_go(asked, at)))


def at_junction(asked: Asked, at: float) -> tuple[Measure, ...]:
    """Return how far before the next junction we were at a time [s], or that we were in one."""
    road = asked.world.road(at)
    if road is None:
        return ()
    place = road.places.get(EGO)
    if place is not None and place.in_junction and not place.roundabout:
        return (Measure("distance", Ego(), at, value=0.0, to=Junction(time=at)),)
    if not road.route:
        return ()
    step = Junction(road.route[0].kind, 1, at)
    return told((asked.world.measure("distance", Ego(), at, step),))


def junction(asked: Asked, thing: Junction, at: float) -> Measure:
    """Return the distance of a junction or roundabout ahead, or that none is recorded."""
    road = asked.world.road(at)
    if road is None:
        return Measure("distance", Ego(), at, to=thing, gap="not-recorded")
    fits = [s for s in road.route if thing.form == "junction" or s.kind == "roundabout"]
    rank = (thing.rank or 1) - 1
    if thing.rank == -1 and fits:
        rank = len(fits) - 1
    if not 0 <= rank < len(fits):
        return Measure("distance", Ego(), at, to=thing, gap="not-applicable")
    return _to_junction(asked, thing, fits[rank].distance, at)


def to_go(asked: Asked, at: float) -> tuple[Measure, ...]:
    """Return how far and how long it is to the destination."""
    world = asked.world
    return (world.measure("distance-to-go", Ego(), at, Destination()), time_to_go(asked, at))


def time_to_go(asked: Asked, at: float) -> Measure:
    """Return how long it is to the destination: as recorded, else as the plan expects."""
    found = asked.world.measure("time-to-go", Ego(), at, Destination())
    if found.gap is None or at < asked.now - SHORT:
        return found
    if asked.ride.arrived:
        return Measure("time-to-go", Ego(), at, value=0.0, to=Destination())
    known = current_plan(asked)
    if known is None or found.gap == "no-way":
        return found
    trace, plan = known
    if plan.likeliest == "dead":
        return replace(found, gap="no-way")
    passed, times = at - trace.sim_time, plan.present("time")
    if trace.waypoint is not None or plan.likeliest != "done" or not times:
        least = min((t for _, _, t in times), default=trace.settings.horizon) - passed
        least = trace.settings.horizon - passed if plan.likeliest == "termination" else least
        return Measure(
            "time-to-go", Ego(), at, value=max(least, 0.0), to=Destination(),
            low=max(least, 0.0), at_least=True,
        )  # fmt: skip
    expected = plan.expectation("time") or 0.0
    values = sorted(max(t - passed, 0.0) for _, _, t in times)
    return Measure(
        "time-to-go", Ego(), at, value=max(expected - passed, 0.0), to=Destination(),
        low=values[0], high=values[-1],
    )  # fmt: skip


def measured(asked: Asked, attributes: tuple[Attribute, ...], at: float) -> tuple[Measure, ...]:
    """Return several measures of our car at a time [s]."""
    return tuple(
        time_to_go(asked, at)
        if attribute == "time-to-go"
        else asked.world.measure(attribute, Ego(), at, _aim(attribute))
        for attribute in attributes
    )


def told(measures: tuple[Measure, ...]) -> tuple[Measure, ...]:
    """Return the measures that have a value; if none has, those that state a reason."""
    known = tuple(m for m in measures if m.gap is None)
    return known or tuple(m for m in measures if m.gap == "no-way")[:1] or measures


def took_place(asked: Asked, event: Event) -> Located:
    """Return where an event took place: the place of its episode, and where we were then.

    Raises:
        Unanswered: it did not take place.
    """
    episode = taken_place(asked, event)
    return place_of(asked, episode)


def place_of(asked: Asked, episode: Episode) -> Located:
    """Return where an episode took place, by where it began."""
    at = episode.begin
    if isinstance(episode.actor, Vehicle):
        look = first_look(asked, episode.actor.number, at)
        return Located(episode.actor, () if look is None else (look,), here(asked, at))
    thing: Thing = episode.place if episode.place is not None else Ego()
    return Located(thing, (), here(asked, at))


def _vehicles(asked: Asked, thing: Thing, at: float) -> Located:
    found = somebodies(asked, thing, at)
    numbers = tuple(v.number for v in found if isinstance(v, Vehicle))
    seen = looks(asked, numbers, at)
    if not seen and numbers:
        first = (first_look(asked, v, at) for v in numbers)
        return Located(thing, tuple(x for x in first if x is not None), gap="out-of-view")
    lost = bool(seen) and not any(look.in_view for look in seen)
    return Located(thing, seen, gap="out-of-view" if lost else None)


def _left_behind(asked: Asked) -> tuple[int, ...]:
    """Return who is no longer around us: those out of view, else those behind us."""
    seen = looks(asked, asked.world.vehicles, asked.now)
    lost = sorted((x for x in seen if not x.in_view), key=lambda x: -(x.seen or 0.0))
    gone_by = tuple(look.vehicle for look in seen if look.ahead < 0.0)
    return tuple(look.vehicle for look in lost[:TOLD]) or gone_by[:TOLD]


def _last_way(asked: Asked, vehicle: int) -> Episode | None:
    """Return the last turn of a vehicle before it was out of view."""
    ways: tuple[ActionName, ...] = (
        "exit-left",
        "exit-right",
        "exit-straight",
        "change-left",
        "change-right",
    )
    found = asked.world.episodes(actor=Vehicle(vehicle), actions=ways)
    return found[-1] if found else None


def _to_junction(asked: Asked, thing: Thing, distance: float, at: float) -> Measure:
    """Return the distance to a junction: as last recorded, minus what we have driven since."""
    left = still_to(asked.ride, distance, at)
    return Measure("distance", Ego(), at, value=max(left, 0.0), to=thing)


def _aim(attribute: Attribute) -> Destination | None:
    return Destination() if attribute in ("distance-to-go", "time-to-go") else None
