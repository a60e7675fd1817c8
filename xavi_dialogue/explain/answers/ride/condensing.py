"""Condensing: what happened on a ride, with what belongs together as one episode.

Several road users who were let go first, one after the other, are one episode. Driving behind a
slow one for long is an episode, too, as what restrained our driving shows.
"""

from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from planner.record.events import RestraintKind
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle, Vehicles
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.causes.driving.roadside import TURNS, limit_at
from xavi_dialogue.explain.facts.episodes.waiting import went_before
from xavi_dialogue.explain.facts.states import states_of
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.restraints import Restrained, restraints
from xavi_dialogue.explain.history.thresholds import HARD

SHORTEST = 0.6  # [s] of braking for somebody who goes first
NEAR = 2.0  # [s] between episodes that belong together
TOGETHER = 6.0  # [s] maximum time between those let go first in one episode
LONG = 6.0  # [s] minimum duration of driving behind somebody that is told
PAUSE = 3.0  # [s] maximum pause of it
SLOW = 0.7  # share of the limit below which we drive slowly behind somebody
BEHIND = frozenset[RestraintKind](("leader", "cut-in"))


def condensed(asked: Asked, told: Iterable[Episode]) -> list[Episode]:
    """Return the episodes of a ride in order, with what belongs together as one."""
    every = sorted(told, key=lambda e: e.begin)
    known = [e for e in every if isinstance(e.actor, Ego) and e.action == "give-way"]
    yielded = sorted([*known, *_yielded(asked, known)], key=lambda e: e.begin)
    others = [e for e in every if e not in known]
    found = [*_let_go(asked, yielded), *_followed(asked)]
    told_by = [*found, *(e for e in others if isinstance(e.actor, Ego) and e.action in TURNS)]
    others = [e for e in others if not _is_braking(e) or not _explained(asked, e, told_by)]
    return sorted([*others, *found], key=lambda e: e.begin)


def _yielded(asked: Asked, known: list[Episode]) -> Iterator[Episode]:
    """Yield those that we braked for without coming near a standstill, and let go first."""
    for one in restraints(asked.ride):
        end, whom = min(one.end, asked.now), one.restraint.vehicle
        if one.restraint.by != "right-of-way" or whom is None or end - one.begin < SHORTEST:
            continue
        if not went_before(states_of(asked.ride), whom, one.begin, end):
            continue
        if not any(e.object == Vehicle(whom) and _meets(asked, e, one.begin, end) for e in known):
            over = None if one.end > asked.now else end
            yield Episode(Ego(), "give-way", one.begin, over, object=Vehicle(whom))


def _is_braking(episode: Episode) -> bool:
    own = isinstance(episode.actor, Ego) and episode.action in ("brake", "slow-down")
    return own and (episode.peak is None or episode.peak < HARD)


def _explained(asked: Asked, braking: Episode, found: Iterable[Episode]) -> bool:
    return any(_meets(asked, e, braking.begin, _end(asked, braking)) for e in found)


def _meets(asked: Asked, episode: Episode, begin: float, end: float) -> bool:
    return episode.begin <= end + NEAR and _end(asked, episode) >= begin - NEAR


def _let_go(asked: Asked, yielded: list[Episode]) -> Iterator[Episode]:
    """Yield one episode for those that were let go first one after the other."""
    groups: list[list[Episode]] = []
    for episode in yielded:
        if groups and episode.begin - _end(asked, groups[-1][-1]) <= TOGETHER:
            groups[-1].append(episode)
        else:
            groups.append([episode])
    for group in groups:
        whom = (e.object.number for e in group if isinstance(e.object, Vehicle))
        numbers = tuple(dict.fromkeys(whom))
        thing = Vehicles(numbers) if len(numbers) > 1 else group[0].object
        yield replace(group[0], end=group[-1].end, object=thing)


def _followed(asked: Asked) -> Iterator[Episode]:
    """Yield the stretches in which somebody slow drove ahead of us for long."""
    row: list[Restrained] = []
    for one in (*restraints(asked.ride), None):
        behind = one is not None and one.restraint.by in BEHIND
        if one is not None and behind and row and _goes_on(row[-1], one):
            row.append(one)
        elif one is None or behind:
            yield from _slow(asked, row)
            row = [] if one is None else [one]


def _goes_on(before: Restrained, one: Restrained) -> bool:
    same = before.restraint.vehicle == one.restraint.vehicle
    return same and one.begin - before.end <= PAUSE


def _slow(asked: Asked, row: list[Restrained]) -> Iterator[Episode]:
    if not row or row[0].restraint.vehicle is None:
        return
    begin, end = row[0].begin, min(row[-1].end, asked.now)
    middle = (begin + end) / 2.0
    limit, speed = limit_at(asked.ride, middle), speed_at(asked.ride, middle)
    if end - begin < LONG or limit is None or speed is None or speed > SLOW * limit:
        return
    over = None if row[-1].end > asked.now else end
    yield Episode(Ego(), "follow", begin, over, object=Vehicle(row[0].restraint.vehicle))


def _end(asked: Asked, episode: Episode) -> float:
    return asked.now if episode.end is None else episode.end
