"""Descriptions: the vehicle or vehicles that fit what is said of them.

Each constraint that a vehicle does not meet has its cost; who meets them all beats a near miss.
Those in view at the time spoken of come first, then those in view now, seen lately, seen ever.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import NoSuchVehicle
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import Described, Ego, Nobody, Thing, Vehicle, Vehicles
from xavi_dialogue.nlu.grounding.context import Fits, Grounder, Unclear, Window
from xavi_dialogue.nlu.grounding.things import choosing, looks, scene
from xavi_dialogue.nlu.grounding.things.crowd import of_them
from xavi_dialogue.nlu.grounding.things.match import Match
from xavi_dialogue.nlu.grounding.things.passing import comes, goes_past, passing_cost, placed
from xavi_dialogue.nlu.grounding.things.relative import Clause, clause_of
from xavi_dialogue.nlu.grounding.things.seen_from import seen_from
from xavi_dialogue.nlu.grounding.things.such import Condition, condition_of

ACCEPT: Final = 0.55  # cost up to which a description fits
GOOD: Final = 0.3  # cost, with all that speaks against it, up to which nobody else is looked for
MISFIT: Final = 0.35  # cost of not having done what the sentence says
RECENT: Final = 10.0  # [s] for which somebody who is gone is still spoken of
MISSING: Final = 0.8  # cost of a reading that speaks of somebody who is not there
MISDESCRIBED: Final = 0.4  # cost of a reading that describes somebody wrongly
DOUBTED: Final = 0.2  # cost of a description of which the clause fits nobody
BLANK: Final = 0.4  # cost of a description that says nothing: rather a word of it was missed
STAGES: Final = (0.0, 0.05, 0.1, 0.2)
SINCE: Final = 1.0  # [s] over which it is judged whether somebody comes nearer
KNOWN: Final = 3  # vehicles offered where none fits


@dataclass(frozen=True, slots=True)
class Search:
    """What is looked for, and when."""

    described: Described
    grounder: Grounder
    moment: float  # [s]
    clause: Clause | None
    fits: Fits | None
    reference: Thing | None  # from which the bearing is seen; None: from us
    condition: Condition | None = None
    among: tuple[int, ...] | None = None  # who are meant, or some of them; None: anybody

    @property
    def present_only(self) -> bool:
        """Whether nothing is said that could be true of somebody who is not in view."""
        such = self.described.such
        now = such is None or getattr(such, "tense", "past") == "present"
        return self.clause is None and now and self.fits is None

    def match(self, vehicle: int, stage: float) -> Match | None:
        """Weigh a vehicle; None where it was never seen."""
        context, wanted = self.grounder.context, self.described
        look = context.look(vehicle, self.moment) or context.look(vehicle, context.now)
        if look is None:
            return None
        misses: dict[str, float] = {
            "kind": looks.kind_cost(wanted.kind, look),
            "colour": looks.colour_cost(wanted.colour, look),
            "size": looks.size_cost(wanted.size, look),
        }
        if sum(misses.values()) > 2.0 * ACCEPT:
            return Match(vehicle, look, misses, stage)
        done = None if self.clause is None else self.clause.episode(vehicle)
        if self.clause is not None:
            seen = done is None or comes(self.described)
            misses["doing"] = _undone(self, look) if seen else self.clause.cost(vehicle)
        if self.condition is not None:
            misses["such"] = self.condition.cost(vehicle)
        deed = None if self.fits is None else self.fits(vehicle)
        misses["bearing"] = self._bearing(vehicle, look, deed or done)
        if wanted.origin is not None:
            misses["origin"] = looks.origin_cost(wanted.origin, self._earlier(vehicle))
        against = stage + (MISFIT if self.fits is not None and deed is None else 0.0)
        return Match(vehicle, look, misses, against, done, deed)

    def _bearing(self, vehicle: int, look: Look, deed: Episode | None) -> float:
        bearing = self.described.bearing
        if bearing is None:
            return 0.0
        context = self.grounder.context
        named = self.described.colour is not None or self.described.kind not in _ANY
        restricted = named and self.described.definite  # else whether there is one is asked
        if self.reference is not None:
            cost = seen_from(context, bearing, self.reference, vehicle, self.moment)
            return (0.5 if restricted else 1.0) * cost
        found = [looks.bearing_cost(bearing, look)]
        if not look.in_view:
            found[0] = max(found[0], 0.4)
        if self.described.plural and look.in_view:
            deed = None  # "all these on the right have stopped"
        for time in (context.now, *(() if deed is None else (deed.begin, deed.end))):
            then = None if time is None or time == look.time else context.look(vehicle, time)
            if then is not None and then.in_view:
                found.append(0.05 + looks.bearing_cost(bearing, then))
        best = min(found)
        return 0.5 * best if restricted and best > ACCEPT else best

    def _earlier(self, vehicle: int) -> tuple[Look, ...]:
        context = self.grounder.context
        times = [self.moment - back for back in (0.0, 2.0, 4.0, 8.0, 12.0)]
        found = (context.look(vehicle, t) for t in times if t >= context.begin)
        return tuple(look for look in found if look is not None)


_ANY: Final = ("vehicle", "car")


def is_such(thing: Thing, such: Thing, g: Grounder, window: Window) -> bool:
    """Tell whether a vehicle fits a description that others may fit too."""
    if not isinstance(thing, Vehicle) or not isinstance(such, Described):
        return False
    match = _search(such, g, window, None).match(thing.number, 0.0)
    return match is not None and match.cost < ACCEPT


def described(thing: Described, g: Grounder, window: Window, fits: Fits | None) -> Thing:
    """Resolve a description."""
    if thing == Described():
        g.notes.cost += BLANK
    thing = of_them(placed(thing), g.context)
    search = _search(thing, g, window, fits)
    found = _candidates(search)
    good = [m for m in found if m.cost < ACCEPT]
    if not thing.definite and not thing.plural and fits is not None:
        good = [m for m in good if m.deed is not None]
    if good:
        return _resolved(search, good)
    if not thing.definite:
        return Nobody(described=thing if search.reference is None else _seen_by(search))
    return _by_noun(search) or _near_miss(search, found)


def _seen_by(search: Search) -> Described:
    """Give what is said of somebody, with whom it is said in respect of: "behind the lorry"."""
    return replace(search.described, of=search.reference)


def _search(thing: Described, g: Grounder, window: Window, fits: Fits | None) -> Search:
    moment = min(window.end, g.context.now) if not window.ahead else g.context.now
    one = thing.definite or not thing.plural
    clause = None if thing.doing is None else clause_of(thing.doing, g, window, nearly=one)
    reference = None if thing.of is None else g.thing(thing.of, window)
    if not isinstance(reference, Vehicle):
        reference = None
    such = None if thing.such is None else condition_of(thing.such, g, window, moment)
    return Search(thing, g, moment, clause, fits, reference, such, _among(thing, g, window))


def _among(thing: Described, g: Grounder, window: Window) -> tuple[int, ...] | None:
    """Give those of whom some are meant: "how many of them"; None: not said."""
    those = None if thing.among is None else g.thing(thing.among, window)
    return those.numbers if isinstance(those, Vehicles) else None


def _by_noun(search: Search) -> Vehicle | None:
    """Take the one vehicle in view that a noun phrase fits, whatever its clause says of it."""
    thing = search.described
    clause = thing.doing is not None or thing.such is not None
    if not clause or thing.plural or (thing.colour is None and thing.kind in _ANY):
        return None
    plain = Search(replace(thing, doing=None, such=None), search.grounder, search.moment,
                   None, None, search.reference)  # fmt: skip
    seen = search.grounder.context.in_view(search.grounder.context.now)
    fits = [m for v in seen if (m := plain.match(v, 0.0)) is not None and m.cost < GOOD]
    if len(fits) != 1:
        return None
    search.grounder.notes.cost += DOUBTED
    return Vehicle(fits[0].vehicle)


def _candidates(search: Search) -> list[Match]:
    found: dict[int, Match] = {}
    for stage, vehicles in _pools(search):
        for vehicle in vehicles:
            if vehicle not in found and (match := search.match(vehicle, stage)) is not None:
                found[vehicle] = match
        if not _every(search) and any(_will_do(search, m) for m in found.values()):
            break
    return sorted(found.values(), key=lambda m: (round(m.total, 3), m.vehicle))


def _will_do(search: Search, match: Match) -> bool:
    """Tell whether nobody else need be looked for: who is not named must have done it."""
    known = search.described.definite or search.described.plural or search.fits is None
    return match.total < GOOD and (match.deed is not None or known)


def _every(search: Search) -> bool:
    """Tell whether all are meant who ever did something: "the cars that we passed"."""
    thing = search.described
    return thing.plural and thing.doing is not None and thing.doing.tense in ("past", "perfect")


def _pools(search: Search) -> Iterator[tuple[float, tuple[int, ...]]]:
    context, moment = search.grounder.context, search.moment
    if search.among is not None:
        yield STAGES[0], search.among
        return
    met = scene.on_foot(context, moment) if choosing.walks(search.described) else ()
    yield STAGES[0], (*context.in_view(moment), *met)
    if moment < context.now - 0.5:
        yield STAGES[1], context.in_view(context.now)
    if not search.described.definite and search.present_only:
        return
    seen = [(v, context.look(v, moment)) for v in context.world.vehicles]
    recent = [
        v for v, look in seen
        if look is not None and moment - (look.seen if look.seen is not None else moment) <= RECENT
    ]  # fmt: skip
    yield STAGES[2], tuple(recent)
    yield STAGES[3], context.world.vehicles


def _undone(search: Search, look: Look) -> float:
    """Weigh that somebody has not done what is said of him: who is seen to come is said to."""
    if comes(search.described):
        before = search.grounder.context.look(look.vehicle, search.moment - SINCE)
        nears = look.oncoming or look.bearing.startswith("crossing") or _catches_up(search, look)
        near = before is None or before.distance > look.distance
        if (near and nears) or (look.left > 0.0 and _goes_first(search, look.vehicle)):
            return 0.0
        return 0.4 if search.described.definite else ACCEPT
    if goes_past(search.described.doing) and not _every(search):
        return passing_cost(search.grounder.context, look, search.moment)
    return 1.0


def _goes_first(search: Search, vehicle: int) -> bool:
    """Tell whether somebody has right of way over us, so that he comes to where we are going."""
    world = search.grounder.context.world
    return world.relation("has-priority-over", Vehicle(vehicle), Ego(), search.moment) is True


def _catches_up(search: Search, look: Look) -> bool:
    """Tell whether somebody may be said to come who is behind us: where he can go past."""
    road = search.grounder.context.world.road(search.moment)
    mine = None if road is None else road.places.get(EGO)
    beside = mine is not None and mine.lanes > 1
    sought = (search.described.bearing or "").startswith("behind")
    return look.bearing.startswith("behind") and (sought or beside)


def _resolved(search: Search, good: list[Match]) -> Thing:
    g, thing = search.grounder, search.described
    others = [m for m in good if m.vehicle not in _spoken_of(search)] if thing.other else good
    if not others:
        return Nobody(described=thing) if not thing.definite else _missing(search, None)
    others = choosing.crossing(g.context, thing, others, search.moment) or others
    ranked = thing.rank is not None or thing.extreme is not None
    if thing.plural or ((thing.number or 1) > 1 and not ranked):
        chosen = choosing.several(g.context, thing, others, search.moment)
        return Vehicle(chosen[0]) if len(chosen) == 1 else Vehicles(chosen)
    others = choosing.just_named(g.context, thing, others) or others
    options = choosing.choose(g.context, thing, others, search.moment, search.reference)
    chosen_match = next(m for m in others if m.vehicle == options[0])
    g.notes.cost += chosen_match.cost
    if len(options) > 1 and thing.definite:
        g.notes.unclear.append(Unclear(thing, options, search.moment))
    return Vehicle(options[0])


def _spoken_of(search: Search) -> tuple[int, ...]:
    """Give whom "the other one" is not: the vehicle, or the group, that is most salient."""
    for mention in search.grounder.context.discourse.mentions:
        if isinstance(mention.thing, Vehicle):
            return (mention.thing.number,)
    return ()


def _near_miss(search: Search, found: list[Match]) -> Thing:
    """Take the one vehicle of which a single word is wrong; else there is none."""
    near = [m for m in found if m.wrong in (("colour",), ("kind",)) and m.stage < STAGES[3]]
    near.sort(key=_unlikely)
    best = [m for m in near if _unlikely(m) <= _unlikely(near[0]) + 0.15]
    if len(best) > 1 and search.fits is not None:
        best = [m for m in best if m.deed is not None]
    if len(best) != 1 or not _telling(search, best[0], found):
        return _missing(search, None)
    return _missing(search, best[0])


def _unlikely(match: Match) -> float:
    """Weigh a wrong word: who speaks of a lorry rather mistakes its colour than its kind."""
    return match.total + (0.3 if "kind" in match.wrong else 0.0)


def _telling(search: Search, match: Match, found: list[Match]) -> bool:
    """Tell whether what is right of a description is enough to tell whom it means."""
    thing = search.described
    told: list[object] = [
        thing.size,
        thing.bearing,
        thing.origin,
        thing.doing,
        thing.extreme,
        thing.rank,
    ]
    if "kind" not in match.wrong and thing.kind not in _ANY:
        told.append("kind")
    if "colour" not in match.wrong:
        told.append(thing.colour)
    visible = [m for m in found if m.look.in_view]
    alone = len(visible) == 1 and match in visible
    return any(part is not None for part in told) or alone


def _missing(search: Search, match: Match | None) -> Thing:
    g = search.grounder
    near = scene.nearest(g.context, g.context.in_view(search.moment), search.moment)
    g.notes.missing.append(
        NoSuchVehicle(
            thing=search.described,
            time=search.moment,
            known=near[:KNOWN],
            misdescribed=None if match is None else match.look,
        )
    )
    g.notes.cost += MISSING if match is None else MISDESCRIBED
    return search.described if match is None else Vehicle(match.vehicle)
