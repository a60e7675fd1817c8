"""Places: junctions, roundabouts, exits and lanes, and when we are or were there."""

from dataclasses import dataclass
from typing import Final

from msgspec.structs import replace

from planner.record.places import RouteStep
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Junction, Lane, Vehicle
from xavi_dialogue.nlu.grounding.context import Context, Grounder, Window

LEAD: Final = 15.0  # [s] before a junction in which somebody crosses there
APART: Final = 4.0  # [s] between episodes at two different places
STILL: Final = 0.5  # [s] for which we count as being at a place that we have just left
BEHIND: Final = 3.0  # [s] before now, from which on a window counts as past
NOWHERE: Final = 0.8  # cost of a reading that speaks of a place that there is not
OTHER_FORM: Final = 0.2  # cost of calling a roundabout a junction


@dataclass(frozen=True, slots=True)
class Visit:
    """A stretch of the ride at one junction."""

    junction: Junction
    begin: float  # [s]
    end: float  # [s]


def visits(context: Context, form: str | None = None) -> tuple[Visit, ...]:
    """List the junctions that we came through, by time; those of a form where one is given."""
    found: list[Visit] = []
    for episode in context.deeds(Ego(), context.begin, context.now):
        if episode.place is None or (form is not None and episode.place.form != form):
            continue
        end = context.now if episode.end is None else episode.end
        last = found[-1] if found else None
        if last is not None and _same_place(last, episode):
            found[-1] = replace_end(last, max(last.end, end))
        else:
            found.append(Visit(episode.place, episode.begin, end))
    if found and found[-1].junction.form == "roundabout" and on_roundabout(context, context.now):
        found[-1] = replace_end(found[-1], context.now)
    return tuple(found)


def crossings(context: Context) -> tuple[Visit, ...]:
    """List the junctions and the other places at which we let somebody cross, by time."""
    found = list(visits(context))
    for episode in context.holds(Event("let-go"), context.begin, context.now):
        end = context.now if episode.end is None else episode.end
        near = (v for v in found if v.begin - LEAD <= end and episode.begin <= v.end)
        if next(near, None) is None:
            found.append(Visit(Junction(time=episode.begin), episode.begin, end))
    return tuple(sorted(found, key=lambda visit: visit.begin))


def replace_end(visit: Visit, end: float) -> Visit:
    """Give a visit another end."""
    return Visit(visit.junction, visit.begin, end)


def _same_place(visit: Visit, episode: Episode) -> bool:
    place = episode.place
    if place is None or place.form != visit.junction.form:
        return False
    if place.time is not None and visit.junction.time is not None:
        return abs(place.time - visit.junction.time) < 1e-3 or episode.begin < visit.end
    return episode.begin <= visit.end + APART


def visit_of(context: Context, junction: Junction) -> Visit | None:
    """Find the stretch of a grounded junction that we have come to."""
    if junction.time is None:
        return None
    at = junction.time
    known = (*visits(context), *crossings(context))
    return next((v for v in known if v.begin - 0.1 <= at <= v.end + 0.1), None)


def junction(thing: Junction, g: Grounder, window: Window) -> Junction:
    """Find the junction that is meant: the last, this or the next one."""
    if thing.time is not None:
        return thing
    behind = visits(g.context, thing.form)
    ahead = _ahead(g.context, thing.form)
    if not behind and not ahead and thing.form == "junction":
        other = replace(thing, form="roundabout")
        if visits(g.context, "roundabout") or _ahead(g.context, "roundabout"):
            g.notes.cost += OTHER_FORM
            return junction(other, g, window)
    here = behind[-1] if behind and behind[-1].end >= g.context.now - STILL else None
    if thing.rank is not None and thing.rank < 0:
        return _past(thing, g, [v for v in behind if v is not here] or list(behind))
    past = (not window.ahead and window.end < g.context.now - BEHIND) or _looks_back(window)
    if thing.rank is None and past and behind:
        earlier = [v for v in behind if v.begin <= window.end + APART]
        return replace(thing, time=(earlier or list(behind))[-1].begin)
    if thing.rank is not None and past and behind:  # "the first one" of the ride so far
        if thing.rank > len(behind) and thing.rank <= len(places := crossings(g.context)):
            return replace(thing, time=places[thing.rank - 1].begin)  # "the second crossing"
        if thing.rank > len(behind):
            g.notes.cost += NOWHERE
            return thing
        return replace(thing, time=behind[thing.rank - 1].begin)
    turns = [k for k, step in enumerate(ahead or (), 1) if step.turn != "exit-straight"]
    rank = thing.rank or (turns[0] if thing.turning and turns else 1)
    if here is not None and rank == 1:
        return replace(thing, time=here.begin)
    if ahead is None or len(ahead) >= rank:
        return replace(thing, rank=rank)
    if thing.rank is None and behind:
        return replace(thing, time=behind[-1].begin)
    g.notes.cost += NOWHERE
    return replace(thing, rank=rank)


def _looks_back(window: Window) -> bool:
    return not window.ahead and window.begin < window.end - BEHIND


def _past(thing: Junction, g: Grounder, behind: list[Visit]) -> Junction:
    back = -(thing.rank or -1)
    if len(behind) < back:
        g.notes.cost += NOWHERE
        return thing
    return replace(thing, time=behind[-back].begin)


def _ahead(context: Context, form: str) -> tuple[RouteStep, ...] | None:
    """List the junctions that are to come; None where the record does not hold them."""
    road = context.world.road(context.now)
    if road is None:
        return None
    return tuple(step for step in road.route if step.kind == form)


def on_roundabout(context: Context, time: float) -> bool | None:
    """Tell whether we are on a roundabout; None: not recorded."""
    road = context.world.road(time)
    place = None if road is None else road.places.get(EGO)
    return None if place is None else place.roundabout


def lane(thing: Lane, g: Grounder, window: Window) -> Lane:
    """Ground whose lane it is."""
    if thing.of is None:
        return thing
    of = g.thing(thing.of, window)
    return replace(thing, of=None if isinstance(of, Ego) else of)


def presence(context: Context, vehicle: Vehicle) -> tuple[float, float] | None:
    """Find from when to when a vehicle was near us, as far as we can tell."""
    deeds = context.deeds(Ego(), context.begin, context.now)
    met = [e for e in deeds if e.object == vehicle]
    theirs = context.deeds(vehicle, context.begin, context.now)
    met += [e for e in theirs if e.object == Ego()]
    if met:
        last = max(met, key=lambda e: e.begin)
        return last.begin, context.now if last.end is None else last.end
    if theirs:
        end = theirs[-1].end
        return theirs[0].begin, context.now if end is None else end
    return None
