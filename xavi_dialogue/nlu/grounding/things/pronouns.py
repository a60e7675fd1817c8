"""Pronouns: "it", "he", "they", "that one", by what was spoken of, else by the scene."""

from typing import Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import NoSuchVehicle
from xavi_dialogue.domain.terms import Ego, Everyone, Pronoun, Thing, Vehicle, Vehicles
from xavi_dialogue.nlu.grounding.context import Fits, Grounder, Unclear, Window
from xavi_dialogue.nlu.grounding.salience import FRESH, group, vehicles_of
from xavi_dialogue.nlu.grounding.things.descriptions import MISSING
from xavi_dialogue.nlu.grounding.things.scene import interacting, most_prominent, nearest, on_foot

CLEAR: Final = 0.3  # salience from which a vehicle may be one of "both"
PAIR: Final = 2
LOST: Final = 0.1  # salience below which a pronoun does not reach back
GONE: Final = 0.5  # the same for one that is not in view then
FORGOTTEN: Final = 10.0  # [s] since the last question after which who is gone is not meant now
LATELY: Final = 5.0  # [s] since the last question after which "they" are those who cross now
RIVAL: Final = 0.6  # share of the salience of one on foot with which another is rather "it"
MISFIT: Final = 0.62  # share of its salience that is left to who did not do what is said
LEVEL: Final = 0.98  # ratio of two saliences that do not differ
FROM_SCENE: Final = 0.1  # cost of a pronoun for which only the scene has a vehicle


def pronoun(thing: Pronoun, g: Grounder, window: Window, fits: Fits | None) -> Thing:
    """Resolve a pronoun that stands for vehicles."""
    mentions = g.context.discourse.mentions
    together = group(mentions)
    moment = g.context.now if window.ahead else min(window.end, g.context.now)
    if thing.form == "them-all":
        spoken = together or _with_others(_spoken(g), g, moment) or on_foot(g.context, moment)
        seen = g.context.world.in_view(min(window.end, g.context.now))
        if len(spoken) < PAIR <= len(seen) <= PAIR:  # "have you seen both?"
            spoken = seen
        return Vehicles(spoken) if len(spoken) > 1 else Everyone()
    if thing.form == "they" and together and _group_leads(g):
        return Vehicles(together)
    weighed = _weighed(thing, g, fits, moment)
    if thing.form == "they" and moment >= g.context.now:
        weighed = _people_first(weighed, g, moment)
    if thing.form == "they" and weighed and _by_car(weighed[0][1], g):
        crowd = _with_others((weighed[0][1],), g, moment)
        if len(crowd) > 1:
            return Vehicles(crowd)
    met = () if thing.form == "it" else on_foot(g.context, moment)
    anew = bool(weighed) and moment >= g.context.now and _is_anew(thing, weighed[0][1], met, g)
    if weighed and not anew:
        return _salient(thing, g, weighed, moment)
    if thing.form == "they" and len(met) > 1:
        return Vehicles(met)
    if thing.form in ("he", "she", "they") and met:
        return Vehicle(nearest(g.context, met, moment)[0].vehicle)
    found = interacting(g.context, moment, fits)
    if found is None:
        found = interacting(g.context, g.context.now, fits)
    if thing.form == "it" and found is not None and walks(found, g):
        return Ego()  # nobody on foot is "it", so our car is
    if found is None:
        g.notes.missing.append(NoSuchVehicle(thing=thing, time=moment))
        g.notes.cost += MISSING
        return thing
    g.notes.cost += FROM_SCENE
    return Vehicle(found)


def _people_first(
    weighed: list[tuple[float, int]], g: Grounder, moment: float
) -> list[tuple[float, int]]:
    """Take those on foot who were spoken of before a vehicle that was named in an earlier turn."""
    discourse = g.context.discourse
    now = {n for m in discourse.mentions if m.turn == discourse.turn for n in _numbers(m.thing)}
    if not weighed or weighed[0][1] in now or walks(weighed[0][1], g):
        return weighed
    seen = g.context.world.in_view(moment)
    people = [(share, one) for share, one in weighed if one in seen and walks(one, g)]
    return people or weighed


def apart(thing: Thing, taken: Thing, g: Grounder) -> Grounder:
    """Give the grounder of a pronoun beside somebody else: who is named there is not meant."""
    number = taken.number if isinstance(taken, Vehicle) else None
    if not isinstance(thing, Pronoun) or number is None:
        return g
    discourse = g.context.discourse
    others = tuple(m for m in discourse.mentions if number not in _numbers(m.thing))
    return g.beside(replace(discourse, mentions=others)) if others else g


def _numbers(thing: Thing) -> tuple[int, ...]:
    match thing:
        case Vehicle(number=number):
            return (number,)
        case Vehicles(numbers=numbers):
            return numbers
    return ()


def _spoken(g: Grounder) -> tuple[int, ...]:
    """Give the vehicles that were spoken of one after the other, the latest last."""
    known = set(g.context.world.vehicles)
    lately = [v for v, s in vehicles_of(g.context.discourse.mentions) if s >= CLEAR and v in known]
    return tuple(reversed(lately[:2]))


def _with_others(spoken: tuple[int, ...], g: Grounder, moment: float) -> tuple[int, ...]:
    """Add to one on foot who was spoken of those who cross our way with them."""
    met = on_foot(g.context, moment) if len(spoken) == 1 else ()
    return met if len(met) > 1 and spoken[0] in met else spoken


def _by_car(vehicle: int, g: Grounder) -> bool:
    """Tell whether it was the car alone who named a vehicle, one of several it may have named."""
    known = [m for m in g.context.discourse.mentions if m.thing == Vehicle(vehicle)]
    return all(m.by_car for m in known)


def _group_leads(g: Grounder) -> bool:
    """Tell whether a group was spoken of at least as clearly as any single vehicle.

    People on foot are "they" rather than a vehicle that was named in the same breath.
    """
    mentions = g.context.discourse.mentions
    people = [m for m in mentions if m.salience >= FRESH and isinstance(m.thing, Vehicles)]
    afoot = any(all(walks(n, g) for n in _numbers(m.thing)) for m in people)
    for mention in mentions:
        if isinstance(mention.thing, Vehicles) and len(mention.thing.numbers) > 1:
            return True
        if isinstance(mention.thing, Vehicle) and mention.salience > 0.9:
            return afoot and not walks(mention.thing.number, g)
    return False


def _is_anew(thing: Pronoun, spoken: int, met: tuple[int, ...], g: Grounder) -> bool:
    """Tell whether those who cross our way are meant, and not who was spoken of before them."""
    if not met or spoken in met:
        return False
    several = thing.form == "they" and len(met) > 1
    return (several and _is_long_ago(g, LATELY)) or (walks(spoken, g) and _is_long_ago(g))


def _is_long_ago(g: Grounder, since: float = FORGOTTEN) -> bool:
    """Tell whether the last question is so long ago that the scene counts for more."""
    asked = g.context.discourse.asked_at
    return asked is not None and g.context.now - asked > since


def _weighed(
    thing: Pronoun, g: Grounder, fits: Fits | None, moment: float
) -> list[tuple[float, int]]:
    known = set(g.context.world.vehicles)
    seen = g.context.world.in_view(moment)
    long_ago = _is_long_ago(g)
    found = []
    for vehicle, salience in vehicles_of(g.context.discourse.mentions):
        if vehicle not in known or salience < (LOST if vehicle in seen else GONE):
            continue
        if vehicle not in seen and long_ago and moment >= g.context.now:
            continue
        share = MISFIT if fits is not None and fits(vehicle) is None else 1.0
        found.append((salience * share, vehicle))
    most = max((salience for salience, _ in found), default=0.0)
    driven = [
        pair
        for pair in found
        if thing.form == "it" and not walks(pair[1], g) and pair[0] >= RIVAL * most
    ]
    return sorted(driven or found, key=lambda pair: (-pair[0], pair[1]))


def walks(vehicle: int, g: Grounder) -> bool:
    """Tell whether somebody is on foot, whom people do not call "it"."""
    look = g.context.look(vehicle, g.context.now)
    return look is not None and look.kind in ON_FOOT


def _salient(thing: Pronoun, g: Grounder, weighed: list[tuple[float, int]], moment: float) -> Thing:
    best = weighed[0][0]
    level = [vehicle for salience, vehicle in weighed if salience >= LEVEL * best]
    if len(level) == 1:
        return Vehicle(level[0])
    order, clear = most_prominent(g.context, level, moment)
    if not clear:
        g.notes.unclear.append(Unclear(thing, order[:4], moment))
    return Vehicle(order[0])
