"""Delays: who held us up on the way, and for whom we slowed down, with times."""

from collections.abc import Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Happenings
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import Ego, Event, Feature, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.letting import let_across
from xavi_dialogue.explain.answers.reference.moments import Window, window
from xavi_dialogue.explain.answers.reference.naming import first_look, looks, number
from xavi_dialogue.explain.answers.reference.occasions import duration, overlaps

YIELDS = frozenset[ActionName](("give-way", "wait", "let-go"))
SLOWING = frozenset[ActionName](("brake", "slow-down", "stop"))
TRAILING = 3.0  # [s] minimum time behind somebody that counts as being held up
HELD = 0.9  # share of the limit below which somebody ahead drives slowly
SLOWER = 1.0  # [m/s] minimum difference in speed to somebody that we slow down for
NEAR = 50.0  # [m] maximum distance ahead of them


def held_up(asked: Asked, about: Window, *, lights: bool = False) -> Happenings:
    """List who held us up in a stretch of the ride: those we let go first, or followed.

    Args:
        asked: the setting.
        about: the stretch.
        lights: list the traffic lights that we waited for as well.
    """
    found = [
        e for e in asked.world.episodes(actor=Ego(), begin=about.begin, end=about.end)
        if (number(e.object) is not None or (lights and isinstance(e.object, Feature)))
        and overlaps(asked, e, about)
        and (e.action in YIELDS or (e.action == "follow" and _trails(asked, e)))
    ]  # fmt: skip
    kept: list[Episode] = []
    for one in sorted(found, key=lambda e: (e.begin, e.action != "give-way")):
        if all(e.object != one.object or not _touch(asked, e, one) for e in kept):
            kept.append(one)
    numbers = tuple(dict.fromkeys(v for e in kept if (v := number(e.object)) is not None))
    shown = looks(asked, numbers, about.end)
    event = Event("block", object=Ego())
    return Happenings("list", tuple(kept), None, about.begin, about.end, looks=shown, asked=event)


def let_past(event: Event, asked: Asked) -> tuple[Look, ...]:
    """List those we let go first at a past time, in the order in which they went.

    The time of each is when it was closest to us.
    """
    if event.action not in YIELDS or event.tense not in ("past", "perfect"):
        return ()
    about = window(asked, event.time, event.tense)
    near = about.widened() if about.instant else about
    known = asked.world.episodes(Ego(), YIELDS, near.begin, near.end)
    driven = () if event.action == "wait" else let_across(asked, asked.world.vehicles)
    found = [
        e for e in (*known, *driven)
        if isinstance(e.object, Vehicle) and overlaps(asked, e, near)
    ]  # fmt: skip
    passed: dict[int, float] = {}
    for one in found:
        vehicle = number(one.object)
        if vehicle is None or vehicle in passed:
            continue
        end = asked.now if one.end is None else one.end
        nearest = asked.world.extreme("distance", Ego(), "lowest", one.begin, end, Vehicle(vehicle))
        passed[vehicle] = nearest.time
    order = sorted(passed, key=lambda v: (passed[v], v))
    seen = (first_look(asked, v, passed[v]) for v in order)
    return tuple(look for look in seen if look is not None)


def for_whom(asked: Asked, episode: Episode) -> Episode:
    """Return our slowing with its object: the one that we let go first, or closed up to."""
    if not isinstance(episode.actor, Ego) or episode.object is not None:
        return episode
    if episode.action not in SLOWING:
        return episode
    end = asked.now if episode.end is None else episode.end
    near = asked.world.episodes(actor=Ego(), begin=episode.begin, end=end)
    yielding = _yielding(asked, near, episode.begin, end)
    ahead = [e for e in near if e.action == "follow" and _closes(asked, e, episode.begin)]
    cause = next(iter((*yielding, *ahead)), None)
    return episode if cause is None else replace(episode, object=cause.object)


def _yielding(asked: Asked, near: Sequence[Episode], begin: float, end: float) -> list[Episode]:
    """List whom we let go first in a stretch, who took most of it first; none if a light did."""

    def length(one: Episode) -> float:
        return min(end, asked.now if one.end is None else one.end) - max(begin, one.begin)

    yields = sorted((e for e in near if e.action in YIELDS), key=lambda e: -length(e))
    lit = yields and isinstance(yields[0].object, Feature) and length(yields[0]) > 0.0
    return [] if lit else [e for e in yields if number(e.object) is not None]


def _trails(asked: Asked, episode: Episode) -> bool:
    """Check whether somebody ahead drove well below the limit while we followed."""
    if duration(asked, episode) < TRAILING:
        return False
    end = asked.now if episode.end is None else episode.end
    middle = (episode.begin + end) / 2.0
    leader = number(episode.object)
    look = None if leader is None else asked.world.look(leader, middle)
    if look is not None and look.distance > NEAR:
        return False
    speed = asked.world.measure("speed", episode.object or Ego(), middle).value
    limit = asked.world.measure("limit", Ego(), middle).value
    return speed is not None and limit is not None and speed < HELD * limit


def _closes(asked: Asked, follow: Episode, at: float) -> bool:
    """Check whether we closed up to somebody slower ahead at a time."""
    leader = follow.object
    if not isinstance(leader, Vehicle):
        return False
    look = asked.world.look(leader.number, at)
    speed = asked.world.measure("speed", Ego(), at).value
    if look is None or speed is None or not 0.0 < look.ahead <= NEAR:
        return False
    return look.speed < speed - SLOWER


def _touch(asked: Asked, one: Episode, other: Episode) -> bool:
    end = asked.now if one.end is None else one.end
    return other.begin <= end
