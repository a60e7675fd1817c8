"""Measures: values, extremes and ranges of a measure, by thing and time."""

from itertools import combinations

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Measures, NotRecorded
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import Compare, HowMuch, Peak
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Event,
    Everyone,
    Measured,
    Relative,
    Thing,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName, Attribute
from xavi_dialogue.explain.answers.expectations.approaching import foreseen_closeness
from xavi_dialogue.explain.answers.expectations.slowing import speed_ahead
from xavi_dialogue.explain.answers.measuring.closeness import approaches
from xavi_dialogue.explain.answers.measuring.hard_braking import hardest
from xavi_dialogue.explain.answers.measuring.peak_moments import peak
from xavi_dialogue.explain.answers.measuring.rivals import rivals
from xavi_dialogue.explain.answers.propositions.attributes import SPECIAL
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import (
    RECENT,
    Window,
    instant,
    is_ahead,
    is_past,
    window,
)
from xavi_dialogue.explain.answers.reference.naming import (
    ANY,
    check_sense,
    is_us,
    look_of,
    looks,
    nobody,
    number,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import did_not_happen, occasions, taken_place
from xavi_dialogue.explain.answers.ride.comfort import stretch, with_slowing
from xavi_dialogue.explain.answers.ride.places import at_junction

#: Attributes that change from moment to moment and are numbers.
NUMBERS: frozenset[Attribute] = frozenset(
    ("speed", "acceleration", "deceleration", "gap", "headway", "distance", "time-to-collision",
     "excess", "jerk")
)  # fmt: skip
#: Attributes whose minimum means nothing, because it is always reached.
UPWARDS: frozenset[Attribute] = frozenset(("deceleration", "jerk", "excess"))
PAIRS = 3  # maximum of pairs of vehicles whose distance is stated
#: Gaps of vehicles that were out of sight.
UNSEEN = ("out-of-view", "hidden")
#: Attributes between two things; by default the other one is the ego.
MUTUAL: frozenset[Attribute] = frozenset(("gap", "headway", "distance", "time-to-collision"))
#: Actions after which a question without a name is about the vehicle that was close.
PASSING: frozenset[ActionName] = frozenset(("pass", "overtake", "cross", "come", "approach"))
#: Attributes whose extreme is over all vehicles if none is named.
ANYBODY: frozenset[Attribute] = frozenset(("distance", "time-to-collision"))
#: Attributes that are always about our own way.
OURS: frozenset[Attribute] = frozenset(("distance-to-go", "time-to-go", "arrival-time"))


def how_much(question: HowMuch, asked: Asked) -> Answer:
    """Return the value of a measure.

    Raises:
        Unanswered: its thing is unknown or its event did not happen, or it is not recorded.
    """
    of = question.of
    check_sense(of.thing)
    check_sense(of.to)
    if isinstance(of.time, Relative) and isinstance(of.time.anchor, Event):
        if question.extreme is not None and of.time.anchor.action in PASSING:
            return how_much(replace(question, of=replace(of, time=WholeRide())), asked)
        raise did_not_happen(asked, of.time.anchor)
    if of.attribute == "speed" and of.to is not None:
        return rivals(Compare((of.thing, of.to), "speed"), asked, by=True)
    ahead = of.attribute == "speed" and of.tense == "future" and is_us(of.thing)
    if ahead and of.event is None and (slows := speed_ahead(asked)) is not None:
        return slows  # "how fast will we take the turn?"
    if of.tense == "future" and question.extreme == "lowest" and of.attribute in MUTUAL:
        other = next((t.number for t in (of.to, of.thing) if isinstance(t, Vehicle)), None)
        coming = None if other is None else foreseen_closeness(asked, other)
        if coming is not None:
            return coming
    if of.attribute == "gap" and question.extreme == "lowest" and isinstance(of.to, Vehicle):
        of = replace(of, attribute="distance")  # also for those beside us
    if of.attribute == "delay" and question.extreme == "highest" and of.event is None:
        return peak(Peak("delay", of.time), asked)
    special = SPECIAL.get(of.attribute)
    if special is not None:
        return special(of, asked)
    if of.event is not None:
        return _of_event(question, asked, of.event)
    if question.extreme in ("highest", "lowest", "mean", "total"):
        return Measures(tuple(_extremes(asked, of, question.extreme, window(asked, of.time))))
    found = values(asked, of)
    unsaid = of.tense == "past" and (asked.past is None or not asked.past.said)
    if unsaid and of.attribute in MUTUAL and all(one.gap in UNSEEN for one in found):
        near = _extremes(asked, of, "lowest", Window(asked.world.begin, asked.now))
        found = tuple(one for one in near if one.gap is None) or found
    return Measures(found)


def values(asked: Asked, of: Measured) -> tuple[Measure, ...]:
    """Return the values of a measure for each thing, at its time or over its stretch of ride."""
    at = instant(asked, of.time, of.tense)
    if isinstance(of.thing, Vehicles) and of.thing == of.to:
        return _of_pairs(asked, of, of.thing.numbers, at)
    things = things_of(asked, of, at)
    about = window(asked, of.time, of.tense)
    moving = of.attribute in NUMBERS and is_past(asked, of.time, of.tense)
    if moving and not about.instant and not is_ahead(asked, of.time, of.tense):
        return tuple(m for thing in things for m in _over(asked, of, thing, about))
    return tuple(m for thing in things for m in value_at(asked, of, thing, at))


def _of_pairs(
    asked: Asked, of: Measured, numbers: tuple[int, ...], at: float
) -> tuple[Measure, ...]:
    """Return a value for each pair of several vehicles: their distance."""
    pairs = list(combinations(numbers, 2))[:PAIRS]
    return tuple(
        m for one, other in pairs
        for m in value_at(asked, replace(of, to=Vehicle(other)), Vehicle(one), at)
    )  # fmt: skip


def value_at(asked: Asked, of: Measured, thing: Thing, at: float) -> tuple[Measure, ...]:
    """Return the value at a time [s]; for a thing out of view, also when it was last seen."""
    if of.attribute in OURS and isinstance(thing, Vehicle):
        return (Measure(of.attribute, thing, at, gap="others-thoughts"),)
    one, other = sides(asked, of, thing, at)
    found = asked.world.measure(of.attribute, one, at, other)
    if found.gap is None:
        return (found, *_besides(asked, of.attribute, one, other, at))
    look = look_of(asked, thing, at) or look_of(asked, other, at)
    if found.gap in ("out-of-view", "hidden") and look is not None and look.seen is not None:
        before = asked.world.measure(of.attribute, one, look.seen, other)
        return (found, before) if before.gap is None else (found,)
    if of.attribute in ("gap", "headway", "time-to-collision") and other is not None:
        near = asked.world.measure("distance", one, at, other)
        telling = of.attribute == "time-to-collision" and found.gap == "not-applicable"
        return ((found, near) if telling else (near,)) if near.gap is None else (found,)
    return (found,)


def things_of(asked: Asked, of: Measured, at: float) -> tuple[Thing, ...]:
    """Return the things that are measured: each road user; a place as it is.

    Raises:
        Unanswered: nobody fits, or a vehicle was never seen.
    """
    if nobody(of.thing) or nobody(of.to):
        thing = of.thing if nobody(of.thing) else of.to
        raise Unanswered(NotRecorded("not-applicable", thing=thing, about=of.attribute))
    found = somebodies(asked, of.thing, at) or (of.thing,)
    if of.attribute in OURS and not any(isinstance(one, Vehicle) for one in found):
        return (Ego(),)
    return found


def sides(asked: Asked, of: Measured, thing: Thing, at: float) -> tuple[Thing, Thing | None]:
    """Return the two things that a measure is between; the ego, if only one is named."""
    if of.attribute in OURS:
        return Ego(), Destination() if of.attribute != "arrival-time" else of.to
    if of.attribute not in MUTUAL or of.to is not None:
        return thing, of.to
    if isinstance(thing, Ego):
        return thing, _ahead(asked, at)
    return Ego(), thing


def best_of(asked: Asked, of: Measured, at: float) -> Measure:
    """Return one value of a measure for a comparison, at its time or over its stretch of ride."""
    found = values(asked, of)
    return found[0] if found else Measure(of.attribute, of.thing, at, gap="not-applicable")


def _ahead(asked: Asked, at: float) -> Thing | None:
    """Return the closest vehicle ahead of us; None if there is none."""
    ahead = [
        look
        for look in looks(asked, asked.world.in_view(at), at)
        if look.bearing == "ahead"
        and not look.oncoming
        and asked.world.relation("ahead-of", Vehicle(look.vehicle), Ego(), at)
    ]
    if not ahead:
        return None
    return Vehicle(min(ahead, key=lambda look: (look.distance, look.vehicle)).vehicle)


def _besides(
    asked: Asked, attribute: Attribute, one: Thing, other: Thing | None, at: float
) -> tuple[Measure, ...]:
    """Return measures that complete a value: for a gap, the headway [s]."""
    if attribute != "gap" or other is None:
        return ()
    headway = asked.world.measure("headway", one, at, other)
    return (headway,) if headway.gap is None else ()


def _over(asked: Asked, of: Measured, thing: Thing, about: Window) -> tuple[Measure, ...]:
    """Return the range of a measure over a stretch, from lowest to highest, and the mean."""
    if not about.said and asked.now - about.end <= RECENT:
        about = Window(about.begin, asked.now)
    one, other = sides(asked, of, thing, about.end)
    if of.attribute in ("deceleration", "jerk"):
        return (_extreme(asked, of.attribute, one, "highest", about, other),)
    if of.attribute in MUTUAL:
        return (_nearest(asked, of.attribute, one, "lowest", about, other),)
    low, high, mean = (
        _extreme(asked, of.attribute, one, which, about, other)
        for which in ("lowest", "highest", "mean")
    )
    if high.gap is not None or low.gap is not None:
        return (high,)
    value = mean.value if mean.gap is None else None
    return (
        Measure(
            of.attribute, one, about.begin, value=value, to=other, until=about.end,
            low=low.value, high=high.value, extreme="mean", reference=high.reference,
        ),
    )  # fmt: skip


def _nearest(
    asked: Asked, attribute: Attribute, one: Thing, which: str, about: Window,
    other: Thing | None,
) -> Measure:  # fmt: skip
    """Return the extreme; of the plain distance, if neither was in the other's way."""
    found = _extreme(asked, attribute, one, which, about, other)
    if found.gap is None or attribute not in ("gap", "headway") or other is None:
        return found
    near = _extreme(asked, "distance", one, which, about, other)
    return found if near.gap is not None else near


def _extremes(asked: Asked, of: Measured, which: str, about: Window) -> tuple[Measure, ...]:
    """Return the extreme for each thing over a stretch of the ride, and where we were then."""
    if about.end - about.begin < 0.1:
        about = Window(asked.world.begin, asked.now)
    if isinstance(of.to, Everyone) and of.attribute == "distance":
        return approaches(asked, of.to.kind, about)[:1] or (
            Measure("distance", Ego(), about.end, gap="not-applicable", to=of.to),
        )
    if isinstance(of.thing, Everyone) and of.attribute == "speed":
        return _of_all(asked, of.thing, which, about)
    found: list[Measure] = []
    for thing in things_of(asked, of, about.end):
        if of.attribute in ANYBODY and isinstance(thing, Ego) and of.to is None:
            found.append(_of_anybody(asked, of.attribute, which, about))
            continue
        one, other = sides(asked, of, thing, about.end)
        most = "highest" if of.attribute in UPWARDS else which
        found.append(_nearest(asked, of.attribute, one, most, about, other))
    part = about.begin > asked.world.begin + 0.5 or about.end < asked.now - 0.5
    if part:
        found = [replace(m, until=about.end) if m.until is None else m for m in found]
    marked = (
        isinstance(of.thing, Ego)
        and which in ("highest", "lowest")
        and of.attribute in ("speed", "deceleration")
    )
    if len(found) == 1 and found[0].gap is None and marked:
        found += at_junction(asked, found[0].time)
    return tuple(m for m in found if m.gap is None) or tuple(found)


def _of_all(asked: Asked, kind: Everyone, which: str, about: Window) -> tuple[Measure, ...]:
    """Return the highest or lowest speed of all road users of a kind that we have seen."""
    seen = (look_of(asked, Vehicle(v), about.end) for v in asked.world.vehicles)
    alike = (x.vehicle for x in seen if x is not None and kind.kind in (*ANY, x.kind))
    each = [_extreme(asked, "speed", Vehicle(v), which, about, None) for v in alike]
    best = _best(each, which)
    return tuple(each) if best is None else (best,)


def _of_anybody(asked: Asked, attribute: Attribute, which: str, about: Window) -> Measure:
    """Return the extreme of a measure between us and any vehicle."""
    each = [_extreme(asked, attribute, Ego(), which, about, Vehicle(v))
            for v in asked.world.vehicles]  # fmt: skip
    return _best(each, which) or Measure(attribute, Ego(), about.end, gap="not-applicable")


def _best(each: list[Measure], which: str) -> Measure | None:
    told = [m for m in each if m.gap is None and m.value is not None]
    sign = 1 if which == "lowest" else -1
    return min(told, key=lambda m: (m.value or 0.0) * sign, default=None)


def _extreme(
    asked: Asked, attribute: Attribute, thing: Thing, which: str, about: Window,
    other: Thing | None,
) -> Measure:  # fmt: skip
    near = about.widened() if about.instant else about
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    if other is None and attribute in MUTUAL:
        return Measure(attribute, thing, end, gap="not-applicable")
    name = "highest" if which == "highest" else "lowest" if which == "lowest" else which
    return asked.world.extreme(attribute, thing, name, begin, end, other)  # type: ignore[arg-type]


def _hardest_of(asked: Asked, event: Event) -> Episode | None:
    """Return the occasion of the hardest braking, if the question is about all of the ride."""
    if not isinstance(event.time, WholeRide):
        return None
    braked = [e for e in occasions(asked, event) if e.peak is not None]
    return max(braked, key=lambda e: e.peak or 0.0, default=None)


def _of_event(question: HowMuch, asked: Asked, event: Event) -> Answer:
    """Return a measure of an event over its episode.

    Raises:
        Unanswered: it did not take place.
    """
    of = question.of
    episode = _hardest_of(asked, event) if of.attribute == "deceleration" else None
    episode = episode or taken_place(asked, event)
    about = with_slowing(asked, episode, stretch(asked, episode))
    halted = episode.peak is None and is_us(episode.actor) and not about.instant
    if of.attribute == "deceleration" and halted:
        return Measures((_extreme(asked, "deceleration", Ego(), "highest", about, None),))
    if of.attribute == "deceleration" and episode.peak is not None:
        return Measures((hardest(asked, episode, about),))
    thing = of.thing if number(of.thing) is not None else episode.actor
    if question.extreme in ("highest", "lowest", "mean", "total"):
        return Measures(
            _extremes(asked, Measured(of.attribute, thing, of.to), question.extreme, about)
        )
    if of.attribute in NUMBERS and not about.instant:
        return Measures(_over(asked, of, thing, about))
    return Measures(value_at(asked, of, thing, about.begin))
