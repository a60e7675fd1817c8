"""Identify: who or what a thing is, and for whom something holds."""

from typing import Literal, TypeVar

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    DidNotHappen,
    Identified,
    Located,
    NotRecorded,
    Priority,
)
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.facts import Episode, Fact, Look, Relating
from xavi_dialogue.domain.meaning import Identify, Which
from xavi_dialogue.domain.rewriting import with_wanted
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Nobody,
    Passenger,
    Proposition,
    Related,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName, Bearing, Kind, Relation
from xavi_dialogue.explain.answers.events.beliefs import time_of
from xavi_dialogue.explain.answers.events.picking import (
    extreme_of,
    in_line,
    is_placed,
    is_to_come,
    lately_lost,
    owed_by_other,
    spent,
)
from xavi_dialogue.explain.answers.expectations.foreseen import YIELDS
from xavi_dialogue.explain.answers.propositions.comparisons import who_came
from xavi_dialogue.explain.answers.propositions.duties import who_first
from xavi_dialogue.explain.answers.propositions.weighing import weigh
from xavi_dialogue.explain.answers.reasons.others import why
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding, known
from xavi_dialogue.explain.answers.reference.moments import Window, instant, is_ahead, window
from xavi_dialogue.explain.answers.reference.naming import (
    first_look,
    is_building,
    looks,
    of_kind,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import PLAIN, occasion, occasions, overlaps
from xavi_dialogue.explain.answers.ride.places import locate

Term = TypeVar("Term", bound=Value)
MOST = 4  # maximum of vehicles whose conduct is stated
BESIDE = 2.0  # [m] minimum sideways distance of somebody in another lane
STRAIGHT: dict[Relation, Bearing] = {"ahead-of": "ahead", "behind": "behind"}
REACH = 30.0  # [m] maximum distance behind us of somebody who is about to pass
GOING: tuple[ActionName, ...] = ("go", "move", "enter", "cross", "turn", "continue")
LIKELY = 0.3  # minimum probability of an action for one who may be meant by "who is going to"


def identify(question: Identify, asked: Asked) -> Answer:
    """Return what a thing is: how it looks, where it is and what it is doing.

    Raises:
        Unanswered: it is unknown.
    """
    return identified(asked, question.thing, asked.moment)


def identified(asked: Asked, thing: Thing, at: float) -> Answer:
    """Return who or what a thing is at a time [s].

    Raises:
        Unanswered: it is unknown.
    """
    match thing:
        case Nobody():
            return Identified((), none=True)
        case Vehicle() | Vehicles() | Everyone():
            who = somebodies(asked, thing, at)
            numbers = tuple(v.number for v in who if isinstance(v, Vehicle))
            seen = tuple(x for v in numbers if (x := first_look(asked, v, at)) is not None)
            return Identified(seen, facts=_conduct(asked, numbers, at), none=not seen)
        case Ego() | Passenger():
            return Identified((), facts=known(asked.world.measure("speed", Ego(), at)))
    return locate(asked, thing, at)


def which(question: Which, asked: Asked) -> Answer:
    """Return for whom something holds, held or will hold.

    Raises:
        Unanswered: it presupposes something that did not happen.
    """
    such = question.such
    if such is None:
        return identified(asked, question.thing, asked.moment)
    near = who_came(question, asked)
    if near is not None:
        return near
    rule = who_first(asked, such) if isinstance(such, Related) else None
    if rule is not None and rule.rule != "none":
        return rule
    owed = owed_by_other(such)
    given = None if owed is None else _let_go(question, owed, asked)
    if given is not None:
        return given
    first = who_first(asked, such)
    if first is not None:
        return first
    if isinstance(such, Happens) and "first" in such.event.manner and such.event.action in GOING:
        such = Is("first", such.event.actor, time=such.event.time, tense=_tense(such.event))
    if isinstance(such, Happens) and not is_ahead(asked, such.event.time, such.event.tense):
        return _who_did(question, such, asked)
    return _who_is(question, such, asked)


def _let_go(question: Which, owed: Happens, asked: Asked) -> Identified | None:
    """Find the one that a vehicle let go first; None if no such thing was seen."""
    try:
        found = _who_did(replace(question, thing=Wanted()), owed, asked)
    except Unanswered:
        return None
    return found if isinstance(found, Identified) and not found.none else None


def _who_did(question: Which, such: Happens, asked: Asked) -> Answer:
    """Find for whom an event is known, by its episodes in the time asked about."""
    event = _open(such.event)
    found = [
        (e, who)
        for candidate in _candidates(question, asked, ever=True)
        for e, who in _told(asked, event, candidate)
    ]
    about = window(asked, event.time, event.tense)
    if event.tense == "present" and about.end >= asked.now:
        about = Window(asked.now, asked.now)
    near = about.widened() if about.instant else about
    inside = [(e, who) for e, who in found if overlaps(asked, e, near)]
    said = asked.past is not None and asked.past.said
    picked = inside or ([] if said or event.tense == "present" else found)
    if not picked:
        return _nobody(question, such, asked)
    picked.sort(key=lambda pair: pair[0].begin)
    ours = any(isinstance(who, Ego) for _, who in picked)
    numbers = dict.fromkeys(who.number for _, who in picked if isinstance(who, Vehicle))
    seen = {v: next(e for e, who in picked if who == Vehicle(v)).begin for v in numbers}
    shown = (first_look(asked, v, at) for v, at in seen.items())
    facts: tuple[Fact, ...] = tuple(e for e, _ in picked)
    return Identified(
        tuple(x for x in shown if x is not None), such, facts, none=not numbers and not ours
    )


def _told(asked: Asked, event: Event, who: Ego | Vehicle) -> list[tuple[Episode, Ego | Vehicle]]:
    single = with_wanted(event, who)
    if single.actor == single.object:
        return []
    return [(e, who) for e in occasions(asked, single) if is_placed(asked, single, e)]


def _nobody(question: Which, such: Proposition, asked: Asked) -> Answer:
    """Return that nobody did it, with what the one who is named did."""
    event = such.event if isinstance(such, Happens) else None
    if event is not None and isinstance(event.actor, Ego) and _wants(event.object):
        alone = replace(event, object=None)
        done = occasion(asked, alone)
        if done is None:
            mine = asked.world.episodes(actor=Ego())
            told = tuple(e for e in mine if e.action not in PLAIN)[-1:]
            raise Unanswered(DidNotHappen(alone, told))
        return Identified((), such, (done,), none=True)
    if event is not None and isinstance(event.actor, Vehicle) and event.action in YIELDS:
        return _waits_for(event, asked)
    if event is not None and event.action in ("pass", "overtake") and _wants(event.actor):
        near = _coming_past(asked)
        return Identified(near, such, _conduct(asked, _numbers(near), asked.now), none=not near)
    return Identified((), such, none=True)


def _waits_for(event: Event, asked: Asked) -> Answer:
    """Return whom somebody must let go first who is not seen to wait; else why it slows or stands.

    Raises:
        Unanswered: it does neither, or was never seen.
    """
    owed = weigh(Related("must-yield-to", event.actor, Ego()), asked)
    rule = owed.answer if event.tense == "present" and owed.holds else None
    if isinstance(rule, Priority) and not isinstance(rule.first, Vehicle):
        return replace(rule, holds=None)
    return why(replace(event, action="wait", object=None), asked, negated=False)


def _coming_past(asked: Asked) -> tuple[Look, ...]:
    """Return the closest of those that pass us, or are about to, in another lane."""
    ours = asked.world.measure("speed", Ego(), asked.now).value or 0.0
    found = [
        look
        for look in looks(asked, asked.world.in_view(asked.now), asked.now)
        if abs(look.left) > BESIDE
        and look.ahead <= look.length
        and look.ahead >= -REACH
        and (look.oncoming or look.speed > ours + 0.5)
        and not look.bearing.startswith("crossing")
    ]
    return tuple(sorted(found, key=lambda look: look.distance))[:1]


def _numbers(seen: tuple[Look, ...]) -> tuple[int, ...]:
    return tuple(look.vehicle for look in seen)


def _hides(asked: Asked, such: Related, at: float) -> bool:
    """Check whether a vehicle hides at a time [s] a place from which somebody might come."""
    trace = asked.ride.at(at)
    if such.relation != "behind" or trace is None or not isinstance(such.to, Vehicle):
        return False
    return any(one.behind == such.to.number for one in trace.phantoms)


def _who_is(question: Which, such: Proposition, asked: Asked) -> Answer:
    """Find for whom a state or relation holds, or who is likeliest to do something."""
    if isinstance(such, Related) and such.relation == "behind" and is_building(such.to):
        raise Unanswered(NotRecorded("out-of-sight"))
    at = instant(asked, time_of(such), "present")
    ahead = isinstance(such, Happens)
    unseen = isinstance(such, Is) and such.state in ("hidden", "lost")
    found: list[tuple[float, Ego | Vehicle, Finding]] = []
    for candidate in _candidates(question, asked, ever=unseen):
        try:
            one = weigh(with_wanted(such, candidate), asked)
        except Unanswered:
            continue
        if isinstance(one.answer, Priority) and not is_to_come(such):
            return one.answer
        chance = one.probability if one.probability is not None else float(bool(one.holds))
        if one.holds or (ahead and chance >= LIKELY):
            found.append((chance, candidate, one))
    found.sort(key=lambda entry: -entry[0])
    numbers = tuple(who.number for _, who, _ in found if isinstance(who, Vehicle))
    seen = extreme_of(question.thing, looks(asked, numbers, at))
    if not numbers and isinstance(such, Related) and _hides(asked, such, at):
        raise Unanswered(NotRecorded("out-of-sight", such.to))
    if unseen:
        lost = tuple(x for x in seen if lately_lost(asked, x))
        if lost:
            return Located(Vehicles(_numbers(lost)), lost, gap="out-of-view")
        return Identified((), such, none=True)
    many = isinstance(such, Related) and such.relation not in STRAIGHT and len(seen) > MOST
    if many or (_seen_merely(such) and len(seen) > 1):
        return Identified(tuple(sorted(seen, key=lambda look: look.distance)))
    if isinstance(such, Related):
        other = isinstance(such.to, Vehicle)
        seen = in_line(such, seen, asked, at) if other else _plainest(such, seen)
        if such.relation in STRAIGHT and not getattr(question.thing, "plural", False):
            seen = seen[:1]
    facts = tuple(f for _, _, one in found for f in (*one.facts, *one.believed))
    shown = {look.vehicle for look in seen}
    facts = tuple(f for f in facts if not isinstance(f, Look | Relating))
    if isinstance(such, Related):
        facts = _conduct(asked, tuple(shown)[:1], at) or facts
    ours = any(isinstance(who, Ego) for _, who, _ in found)
    return Identified(seen, such, facts[: 2 * MOST], none=not seen and not ours)


def _seen_merely(such: Proposition) -> bool:
    """Check whether the question is who is there at all."""
    match such:
        case Is(state="present" | "visible"):
            return True
        case Related(relation="near" | "can-see"):
            return True
    return False


def _plainest(such: Related, seen: tuple[Look, ...]) -> tuple[Look, ...]:
    """Return of those at a place the ones that are exactly there, if any; the closest first."""
    bearing = STRAIGHT.get(such.relation)
    straight = [look for look in seen if look.bearing == bearing]
    return tuple(sorted(straight or seen, key=lambda look: look.distance))


def _candidates(question: Which, asked: Asked, *, ever: bool) -> tuple[Ego | Vehicle, ...]:
    """Find who may be meant: those of the kind asked for; the ego too if no kind is named."""
    thing, world = question.thing, asked.world
    at = asked.moment
    if question.among:
        return tuple(v for one in question.among for v in somebodies(asked, one, at))
    match thing:
        case Vehicle() | Vehicles():
            return somebodies(asked, thing, at)
        case Wanted(kind=kind) | Everyone(kind=kind) | Described(kind=kind):
            every = world.vehicles if ever else world.in_view(at)
            numbers = _of_kind(asked, every, kind, at)
            colour = thing.colour if isinstance(thing, Described) else None
            if colour is not None:
                numbers = tuple(x.vehicle for x in looks(asked, numbers, at) if x.colour == colour)
            others = tuple(Vehicle(v) for v in numbers)
            return (*others, Ego()) if kind == "vehicle" else others
    return tuple(Vehicle(v) for v in world.in_view(at))


def _of_kind(asked: Asked, vehicles: tuple[int, ...], kind: Kind, at: float) -> tuple[int, ...]:
    """Return those of a kind; any vehicles for a kind that passengers use loosely."""
    strict = of_kind(asked, vehicles, kind, at, strict=True)
    return strict or of_kind(asked, vehicles, kind, at)


def _open(event: Event) -> Event:
    """Return an event without the part that is asked for; its actor is the one to find."""
    parts = (event.actor, event.object)
    return event if any(_wants(part) for part in parts) else replace(event, actor=Wanted())


def _tense(event: Event) -> Literal["past", "present"]:
    """Return the tense of an event for a state."""
    return "past" if event.tense in ("past", "perfect") else "present"


def _wants(thing: Thing | None) -> bool:
    return isinstance(thing, Wanted)


def _conduct(asked: Asked, numbers: tuple[int, ...], at: float) -> tuple[Fact, ...]:
    """Return what a few vehicles are doing at a time [s]: their speeds and their actions."""
    if len(numbers) > MOST:
        return ()
    found: list[Fact] = []
    for v in numbers:
        found += known(asked.world.measure("speed", Vehicle(v), at))
        on = [
            e
            for e in asked.world.episodes(actor=Vehicle(v), begin=at - 0.5, end=at)
            if (e.end is None or e.end >= at - 0.5) and not spent(asked, e, at)
        ]
        found += [e for e in on if e.action not in PLAIN or e.action == "follow"][-1:]
    return tuple(found)
