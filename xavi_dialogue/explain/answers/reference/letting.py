"""Letting: when we let others go first, by what restrained us and who crossed meanwhile."""

from collections.abc import Iterable

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.facts.episodes.waiting import went_before
from xavi_dialogue.explain.facts.states import states_of
from xavi_dialogue.explain.history.restraints import Restrained, held_by, restraints

SHORTEST = 0.6  # [s] of letting somebody go first


def let_across(asked: Asked, vehicles: Iterable[int]) -> tuple[Episode, ...]:
    """Return when we let road users go first, those on foot who crossed with others included."""
    found = [*let_first(asked, vehicles)]
    known = {e.object for e in found}
    for who in map(Vehicle, vehicles):
        if who not in known and _walks(asked, who.number):
            found += _with_others(asked, who)
    return tuple(sorted(found, key=lambda e: e.begin))


def _with_others(asked: Asked, who: Vehicle) -> list[Episode]:
    """Return when somebody on foot crossed our way in front of us while we let others do so."""
    crossed = asked.world.episodes(who, ("cross",), object=Ego())
    held = [
        one
        for one in restraints(asked.ride)
        if one.restraint.by == "right-of-way"
        and one.restraint.light is None
        and _walks(asked, one.restraint.vehicle)
    ]
    return [
        Episode(Ego(), "give-way", one.begin, one.end if one.end <= asked.now else None, who)
        for one in held
        if any(e.begin <= one.end and (e.end is None or e.end >= one.begin) for e in crossed)
        and one.begin <= asked.now
    ][:1]


def _walks(asked: Asked, vehicle: int | None) -> bool:
    look = None if vehicle is None else asked.world.look(vehicle, asked.now)
    return look is not None and look.kind in ON_FOOT


def let_first(asked: Asked, vehicles: Iterable[int]) -> tuple[Episode, ...]:
    """Return when road users whom we had to let go first restrained our driving, oldest first."""
    found = [
        Episode(Ego(), "give-way", one.begin, None if one.end > asked.now else one.end, who)
        for who in map(Vehicle, vehicles)
        for one in held_by(asked.ride, who.number, asked.world.begin, asked.now)
        if one.restraint.light is None  # else the light holds us, though others go
        and min(one.end, asked.now) - one.begin >= SHORTEST
        and _went(asked, who.number, one)
    ]
    return tuple(sorted(found, key=lambda e: e.begin))


def _went(asked: Asked, vehicle: int, one: Restrained) -> bool:
    """Check whether somebody who restrained our driving went before us, or still may."""
    states = states_of(asked.ride)
    return went_before(states, vehicle, one.begin, min(one.end, asked.now))
