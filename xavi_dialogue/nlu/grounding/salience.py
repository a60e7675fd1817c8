"""Salience: how present the things that were spoken of are."""

from collections.abc import Iterable, Sequence
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.discourse import Discourse, GroundedAct, Mention
from xavi_dialogue.domain.meaning import Ask, Claim
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import At, Event, Feature, Thing, Vehicle, Vehicles

DECAY: Final = 0.6  # of salience with each turn
FRESH: Final = 1.5  # more salience within the turn, so that it outdoes the turn before
BY_CAR: Final = 0.97  # share of the salience of what the car named, not the passenger
FADED: Final = 0.05  # below which a thing is no longer spoken of
JUST: Final = 0.3  # [s] before now up to which a time is now
IN_FORCE: Final = 1.0  # [s] before now up to which what was decided is still in force
ROLES: Final = {"subject": 1.0, "cause": 0.95, "object": 0.85, "other": 0.7}


def salience(role: str | None) -> float:
    """Weigh a thing by the part that it has in what was just said."""
    return ROLES.get(role or "other", ROLES["other"])


def mention(thing: Thing, turn: int, role: str | None, by_car: bool = False) -> Mention:
    """Make the mention of a thing in this turn."""
    weight = salience(role) * (BY_CAR if by_car else 1.0)
    return Mention(thing=thing, turn=turn, by_car=by_car, salience=weight, role=role)


def ordered(mentions: Iterable[Mention]) -> tuple[Mention, ...]:
    """Sort mentions: most salient first, of equals the later one, then by role."""
    return tuple(sorted(mentions, key=lambda m: (-m.salience, -m.turn, -salience(m.role))))


def decayed(mentions: Iterable[Mention]) -> tuple[Mention, ...]:
    """Let mentions fade by one turn, and drop what has faded away."""
    later = (replace(m, salience=m.salience * DECAY) for m in mentions)
    return ordered(m for m in later if m.salience >= FADED)


def renewed(mentions: Sequence[Mention], new: Iterable[Mention]) -> tuple[Mention, ...]:
    """Add mentions; each thing is kept once, as salient as it ever was among them."""
    found: dict[Thing, Mention] = {}
    for one in (*mentions, *new):
        known = found.get(one.thing)
        if known is None or one.salience >= known.salience:
            found[one.thing] = one
    return ordered(found.values())


def mentions_of(act: object, turn: int, by_car: bool = False) -> tuple[Mention, ...]:
    """List the vehicles in a grounded act or answer by the part that they have in it."""
    roles: dict[Thing, str] = {}
    found = list(parts(act, (Event, Vehicle, Vehicles)))
    for event in found:
        if isinstance(event, Event) and isinstance(event.actor, Vehicle | Vehicles):
            roles.setdefault(event.actor, "subject")
        if isinstance(event, Event) and isinstance(event.object, Vehicle | Vehicles):
            roles.setdefault(event.object, "object")
    for kind in (Vehicle, Vehicles):
        for one in found:
            if isinstance(one, kind):
                roles.setdefault(one, "subject")
    for light in parts(act, Feature):
        if light.kind == "light":
            roles.setdefault(Feature("light", of=light.of), "subject")
    return tuple(mention(thing, turn, role, by_car) for thing, role in roles.items())


def vehicles_of(mentions: Iterable[Mention]) -> tuple[tuple[int, float], ...]:
    """List the vehicles spoken of with their salience; those of a group have less of it."""
    found: dict[int, float] = {}
    for one in mentions:
        if isinstance(one.thing, Vehicle):
            found[one.thing.number] = max(found.get(one.thing.number, 0.0), one.salience)
        elif isinstance(one.thing, Vehicles):
            for number in one.thing.numbers:
                found.setdefault(number, 0.8 * one.salience)
    return tuple(sorted(found.items(), key=lambda pair: -pair[1]))


def group(mentions: Iterable[Mention]) -> tuple[int, ...]:
    """Give the group of vehicles that was spoken of last, if any."""
    groups = (m.thing for m in mentions if isinstance(m.thing, Vehicles))
    return next((g.numbers for g in groups if len(g.numbers) > 1), ())


def naming(discourse: Discourse, said: object) -> Discourse:
    """Give the discourse within a turn after something grounded that was said in it."""
    top = max((m.salience for m in discourse.mentions), default=0.0)
    new = (replace(m, salience=top + m.salience + FRESH) for m in mentions_of(said, discourse.turn))
    return replace(discourse, mentions=renewed(discourse.mentions, new))


def after(discourse: Discourse, done: GroundedAct) -> Discourse:
    """Give the discourse within a turn after one of its acts, for the acts that follow it."""
    found = naming(discourse, done.act)
    if done.span is not None and not done.span.ahead and done.span.end - done.span.begin < 60.0:
        found = replace(found, episode=(done.span.begin, done.span.end))
    match done.act:
        case Ask(question=question):
            return replace(found, question=question)
        case Claim(that=that):
            return replace(found, propositions=(that, *found.propositions))
    return found


def named_time(done: GroundedAct, now: float) -> tuple[float, float] | None:
    """Give the time [s] that an act names, where that lies behind."""
    at, span = next(parts(done.act, At), None), done.span
    if at is not None:
        return (at.at, at.at) if at.at < now - JUST else None
    if span is None or not span.said or span.end >= now - JUST:
        return None
    return span.begin, span.end
