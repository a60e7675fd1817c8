"""Scene: who stands out at a moment, among those in view or among those who fit a description."""

from collections.abc import Iterable, Iterator
from typing import Final

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import Described, Ego, Nobody, Now, Thing, Time, Vehicle
from xavi_dialogue.nlu.grounding.context import Context, Fits
from xavi_dialogue.nlu.grounding.salience import vehicles_of

CLEARLY: Final = 0.6  # the nearest counts alone if it is nearer than this share of the next
LATELY: Final = 8.0  # [s] in which an episode still makes a vehicle stand out
LEADER: Final = 70.0  # [m] up to which somebody ahead of us is our leader
APPROACH_TIME: Final = 1.0  # [s] over which it is judged whether somebody comes nearer
MENTIONED: Final = 0.3  # salience from which somebody stands out by it
#: What two vehicles do that interact.
INTERACTING: Final = frozenset(
    (
        *("give-way", "wait", "let-go", "follow", "keep-distance", "brake", "slow-down", "stop"),
        *("overtake", "pass", "cut-in", "pull-out", "block", "avoid", "swerve", "collide"),
        *("nearly-collide", "approach", "merge", "cross", "stand"),
    )
)


def on_foot(context: Context, moment: float) -> tuple[int, ...]:
    """List the people who cross our way at a time, crossed it lately or are about to."""
    met = context.world.crossing(moment) or context.world.crossing(context.now)
    looks = (context.look(vehicle, moment) for vehicle in met)
    return tuple(look.vehicle for look in looks if look is not None and look.kind in ON_FOOT)


def interacting(context: Context, moment: float, fits: Fits | None = None) -> int | None:
    """Find the vehicle that is meant where the scene alone tells: who has to do with us."""
    ranked = list(dict.fromkeys(_ranked(context, moment)))
    if fits is not None:
        chosen = next((vehicle for vehicle in ranked if fits(vehicle) is not None), None)
        if chosen is None:
            others = (v for v in context.world.vehicles if v not in ranked)
            chosen = _latest(fits(v) for v in others)
        if chosen is not None:
            return chosen
    return ranked[0] if ranked else None


def _latest(episodes: Iterable[Episode | None]) -> int | None:
    known = [e for e in episodes if e is not None]
    last = max(known, key=lambda e: e.begin, default=None)
    if last is None:
        return None
    for thing in (last.actor, last.object):
        if isinstance(thing, Vehicle):
            return thing.number
    return None


def _ranked(context: Context, moment: float) -> Iterator[int]:
    since = max(context.begin, moment - LATELY)
    for episode in reversed(context.deeds(Ego(), since, moment)):
        if isinstance(episode.object, Vehicle) and episode.action in INTERACTING:
            yield episode.object.number
    looks = nearest(context, context.in_view(moment), moment)
    for look in looks:
        if look.bearing == "ahead" and look.distance < LEADER:
            yield look.vehicle
            break
    for look in looks:
        yield look.vehicle


def nearest(context: Context, vehicles: Iterable[int], moment: float) -> tuple[Look, ...]:
    """List the looks of vehicles, nearest first."""
    looks = (context.look(vehicle, moment) for vehicle in vehicles)
    known = (look for look in looks if look is not None)
    return tuple(sorted(known, key=lambda look: (round(look.distance, 1), look.vehicle)))


def prominence(context: Context, vehicle: int, moment: float) -> float:
    """Weigh how much a vehicle stands out, as a distance [m]: lower is more prominent."""
    look = context.look(vehicle, moment)
    if look is None:
        return 1e4
    found = max(look.distance, 2.0)
    if not look.in_view:
        found *= 3.0
    if look.ahead < 0.0:
        found *= 1.5
    before = context.look(vehicle, moment - APPROACH_TIME)
    if before is not None and before.in_view and before.distance > look.distance + 0.5:
        found *= 0.7
    if dict(vehicles_of(context.discourse.mentions)).get(vehicle, 0.0) >= MENTIONED:
        found *= 0.4
    since = max(context.begin, moment - LATELY)
    for episode in context.deeds(Ego(), since, moment):
        if episode.object == Vehicle(vehicle) and episode.action in INTERACTING:
            return found * 0.4
    return found


def most_prominent(
    context: Context, vehicles: Iterable[int], moment: float
) -> tuple[tuple[int, ...], bool]:
    """Sort vehicles by prominence, and tell whether the first stands out clearly."""
    weighed = sorted((prominence(context, v, moment), v) for v in vehicles)
    order = tuple(vehicle for _, vehicle in weighed)
    clear = len(weighed) < 2 or weighed[0][0] <= CLEARLY * weighed[1][0]
    return order, clear


def in_sight(found: Thing, spoken: Thing, time: Time, context: Context) -> Thing:
    """Leave out who has just gone out of view, where it is asked whether anybody is there now."""
    if not isinstance(spoken, Described) or spoken.definite or not isinstance(time, Now):
        return found
    if not isinstance(found, Vehicle):
        return found
    look = context.look(found.number, context.now)
    return found if look is None or look.in_view else Nobody(spoken)
