"""Choosing: of the vehicles that fit a description, the one or those that are meant."""

from collections.abc import Sequence
from typing import Final

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.terms import Described, Now, Thing, Unsaid, Vehicle, Vehicles
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.salience import group, vehicles_of
from xavi_dialogue.nlu.grounding.things.match import Match
from xavi_dialogue.nlu.grounding.things.scene import MENTIONED, interacting, most_prominent, on_foot

TIE: Final = 0.15  # difference of cost that decides nothing
LATER: Final = 3.0  # [s] by which what was done last is meant
OFFERED: Final = 4  # vehicles among which is asked at most


def several(
    context: Context, wanted: Described, matches: Sequence[Match], moment: float
) -> tuple[int, ...]:
    """List those that a plural means, nearest first."""
    best = matches[0].total
    kept = [m for m in matches if m.total <= best + 2.0 * TIE]
    if wanted.definite and len(kept) < (wanted.number or 1):
        kept = list(matches)  # "have those two crossed?" asks about both
    exact = [m for m in kept if not m.misses.get("kind")]
    kept = exact if len(exact) >= (wanted.number or 1) else kept
    order = sorted(kept, key=lambda m: (m.look.distance, m.vehicle))
    spoken = [n for n in group(context.discourse.mentions) if n in {m.vehicle for m in order}]
    if wanted.number is not None and len(order) > wanted.number == len(spoken):
        return tuple(spoken)
    return tuple(m.vehicle for m in order)[: wanted.number]


def choose(
    context: Context,
    wanted: Described,
    matches: Sequence[Match],
    moment: float,
    reference: Thing | None,
) -> tuple[int, ...]:
    """List whom a singular may mean, likeliest first; one alone where it is clear."""
    tied = [m for m in matches if m.total <= matches[0].total + TIE]
    if wanted.rank is not None:
        return (_ranked(context, wanted, tied or matches),)
    if wanted.extreme is not None:
        return (_extreme(wanted.extreme, tied),)
    if len(tied) == 1:
        return (tied[0].vehicle,)
    offered = _numbers(context.discourse.offered_things)
    among = [m for m in tied if m.vehicle in offered]
    if len(among) == 1:
        return (among[0].vehicle,)
    if wanted.other:
        salient = dict(vehicles_of(context.discourse.mentions))
        known = [m for m in tied if m.vehicle in salient]
        if known:
            return (max(known, key=lambda m: (salient[m.vehicle], -m.vehicle)).vehicle,)
    beside = wanted.bearing is not None and _is_now(wanted)
    last = None if beside else _last_done(tied)
    if last is not None:
        return (last,)
    if wanted.bearing is not None:
        return (_nearest(context, tied, moment, reference),)
    if all(m.deed is not None for m in tied):  # it is true of each of them
        return (max(tied, key=lambda m: (m.deed.begin if m.deed else 0.0, -m.vehicle)).vehicle,)
    return _prominent(context, wanted, tied, moment)


def _is_now(wanted: Described) -> bool:
    """Tell whether it is said what somebody does now: "the car that is standing on our left"."""
    doing = wanted.doing
    return doing is not None and doing.tense == "present" and isinstance(doing.time, Unsaid | Now)


def walks(thing: Described) -> bool:
    """Tell whether people on foot are spoken of as known."""
    return thing.definite and thing.kind in ON_FOOT


def crossing(
    context: Context, thing: Described, good: Sequence[Match], moment: float
) -> list[Match]:
    """Keep those who cross our way where people are spoken of, and not what they do."""
    told = thing.doing, thing.such, thing.of, thing.origin, thing.rank, thing.extreme
    if not walks(thing) or any(part is not None for part in told):
        return []
    met, least = on_foot(context, moment), min(m.cost for m in good) + 2.0 * TIE
    return [m for m in good if m.vehicle in met and m.cost <= least]


def just_named(context: Context, thing: Described, good: Sequence[Match]) -> list[Match]:
    """Keep the one whom the turn before named, where others fit the description as well."""
    discourse = context.discourse
    told = thing.rank, thing.extreme, thing.doing, thing.such, thing.of, thing.bearing
    if not thing.definite or thing.other or any(part is not None for part in told):
        return []
    least = min(m.cost for m in good) + TIE
    alike = {m.vehicle: m for m in good if m.cost <= least}
    latest = [m for m in discourse.mentions if m.turn >= discourse.turn - 1]
    named = (m.thing.number for m in latest if isinstance(m.thing, Vehicle))
    return [alike[number] for number in named if number in alike][:1]


def _prominent(
    context: Context, wanted: Described, tied: Sequence[Match], moment: float
) -> tuple[int, ...]:
    salient = dict(vehicles_of(context.discourse.mentions)) if bare(wanted) else {}
    spoken = [m.vehicle for m in tied if salient.get(m.vehicle, 0.0) >= MENTIONED]
    if spoken:  # "that poor man"
        return (max(spoken, key=lambda n: (salient[n], -n)),)
    order, clear = most_prominent(context, [m.vehicle for m in tied], moment)
    if clear or not wanted.definite or walks(wanted):
        return order[:1]
    if bare(wanted):
        met = interacting(context, moment)
        if met in order:
            return (met,)
    return order[:OFFERED]


def bare(wanted: Described) -> bool:
    """Tell whether a description is little more than a pronoun: "the car", "that vehicle"."""
    plain = Described(kind=wanted.kind, definite=wanted.definite)
    return wanted == plain and wanted.kind in ("vehicle", "car")


def _numbers(things: Sequence[Thing]) -> tuple[int, ...]:
    found: list[int] = []
    for thing in things:
        if isinstance(thing, Vehicle):
            found.append(thing.number)
        elif isinstance(thing, Vehicles):
            found.extend(thing.numbers)
    return tuple(found)


def _ranked(context: Context, wanted: Described, matches: Sequence[Match]) -> int:
    """Count among those that were offered or spoken of together, by what they did, or how near."""
    known = {m.vehicle for m in matches}
    for listed in (
        _numbers(context.discourse.offered_things),
        group(context.discourse.mentions),
    ):
        kept = [n for n in listed if n in known]
        if len(kept) > 1:
            return _at(kept, wanted.rank)
    if all(m.done is not None for m in matches):
        by_time = sorted(matches, key=lambda m: (m.done.begin if m.done else 0.0, m.vehicle))
        return _at([m.vehicle for m in by_time], wanted.rank)
    by_way = sorted(matches, key=lambda m: (m.look.distance, m.vehicle))
    return _at([m.vehicle for m in by_way], wanted.rank)


def _at(order: Sequence[int], rank: int | None) -> int:
    if rank is None or rank == 0:
        return order[0]
    index = rank - 1 if rank > 0 else len(order) + rank
    return order[min(max(index, 0), len(order) - 1)]


def _extreme(extreme: str, matches: Sequence[Match]) -> int:
    def key(look: Look) -> float:
        match extreme:
            case "farthest":
                return -look.distance
            case "fastest":
                return -look.speed
            case "slowest":
                return look.speed
            case "biggest":
                return -look.length
        return look.distance

    return min(matches, key=lambda m: (key(m.look), m.look.distance, m.vehicle)).vehicle


def _last_done(matches: Sequence[Match]) -> int | None:
    """Give who did last what is said, where that was clearly later than all others."""
    for begins in (
        [(m.done.begin, m.vehicle) for m in matches if m.done is not None],
        [(m.deed.begin, m.vehicle) for m in matches if m.deed is not None],
    ):
        order = sorted(begins, reverse=True)
        if len(order) == 1 or (len(order) > 1 and order[0][0] - order[1][0] >= LATER):
            return order[0][1]
    return None


def _nearest(
    context: Context, matches: Sequence[Match], moment: float, reference: Thing | None
) -> int:
    of = context.look(reference.number, moment) if isinstance(reference, Vehicle) else None
    if of is None:
        return min(matches, key=lambda m: (m.look.distance, m.vehicle)).vehicle
    return min(
        matches,
        key=lambda m: (abs(m.look.ahead - of.ahead) + abs(m.look.left - of.left), m.vehicle),
    ).vehicle
