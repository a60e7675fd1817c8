"""People: who somebody is, how many there are, and where they are, in words."""

from collections.abc import Sequence
from dataclasses import replace

import msgspec

from xavi_dialogue.domain.answers import Counted, Identified
from xavi_dialogue.domain.facts import Belief, Episode, Fact, Look, Measure
from xavi_dialogue.domain.rewriting import parts, with_wanted
from xavi_dialogue.domain.terms import (
    Described,
    Event,
    Everyone,
    Exit,
    Happens,
    Has,
    Is,
    Nobody,
    Proposition,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Kind
from xavi_dialogue.nlg.content.clauses.clauses import (
    denied,
    episode_clause,
    event_clause,
    relative_clause,
)
from xavi_dialogue.nlg.content.clauses.facts import fact_message
from xavi_dialogue.nlg.content.clauses.measures import STANDING
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.propositions import clause_of, eventful
from xavi_dialogue.nlg.content.clauses.routes import exits_passed
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.observed.occasions import TOWARDS, occasions_counted
from xavi_dialogue.nlg.content.observed.surroundings import is_past, plan_by_kind, telling
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.quantities import clock, number
from xavi_dialogue.nlg.surface.referring import listed
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Clause, Moment, Number, Quantity, Tense, Who

PLAIN = frozenset(("continue", "move", "keep-lane", "go"))
CHANGING = frozenset(("slow-down", "speed-up", "brake", "stop"))
FEW = 3  # maximum of vehicles that are described with their number
MANY = 5  # maximum of vehicles that are described one by one


def plan_identified(answer: Identified, context: SpeechContext) -> Plan:
    """Plan the vehicles for which something holds; or that it holds for nobody."""
    answer = msgspec.structs.replace(answer, facts=_telling(answer.facts))
    facts = tuple(fact_message(f, context) for f in answer.facts)
    if not answer.none and not answer.looks and facts:
        return Plan(facts[:1], facts[1:])  # it holds for us alone
    if answer.none or not answer.looks:
        did = _nobody(answer.such, context.now) if answer.such else None
        return Plan((message("NOBODY", did=did),), facts)
    if answer.such is not None and len(answer.looks) > 1:
        them = Vehicles(tuple(look.vehicle for look in answer.looks))
        clause = clause_of(with_wanted(answer.such, them), context.now)
        known = all(isinstance(f, Measure | Episode) for f in answer.facts)
        named = any(map(telling, answer.looks)) or len(answer.facts) > 2 * MANY
        event = eventful(answer.such)
        named = named or event is None or event.tense not in ("past", "perfect")
        told = () if known and named else _listed(_of_each(answer.facts, facts)) if known else facts
        return Plan((message("PLAIN", it=clause),), told)
    if len(answer.looks) == 1:
        return _one(answer, answer.looks[0], facts, context)
    past = any(not look.in_view for look in answer.looks)
    if past or len(answer.looks) > MANY or not any(map(telling, answer.looks)):
        return plan_by_kind(answer.looks, answer.facts, context)
    whos = tuple(_who(look, context) for look in answer.looks)
    amount = Number(len(answer.looks), "vehicle")
    can = "could" if is_past(answer.looks[0], context) else "can"
    return Plan((message("IDENTIFIED_MANY", can=can, number=amount, looks=whos),), facts)


def _telling(facts: tuple[Fact, ...]) -> tuple[Fact, ...]:
    """Return the facts without those that repeat that a vehicle stands."""
    stands = any(
        isinstance(f, Measure) and f.attribute == "speed" and (f.value or 0.0) < STANDING
        for f in facts
    )
    quiet = ("stop", "stand", "brake", "slow-down")
    return tuple(f for f in facts if not (stands and isinstance(f, Episode) and f.action in quiet))


def _one(
    answer: Identified, look: Look, facts: tuple[Message, ...], context: SpeechContext
) -> Plan:
    who = _who(look, context)
    past = is_past(look, context)
    did = _did(answer.such, look, context)
    if did is not None:
        event = eventful(answer.such) if answer.such is not None else None
        for fact, deed in zip(answer.facts, facts, strict=True):
            if event is not None and isinstance(fact, Episode) and fact.action == event.action:
                return Plan((deed,), _besides(fact.object, answer.facts, facts))
        conduct = {} if event is not None else conduct_slots(answer.facts, look, context)
        if conduct:
            return Plan((message("DID_CONDUCT", it=did, **conduct),))
        told = () if isinstance(answer.such, Has) else facts
        if event is not None and event.action in TOWARDS:  # the vehicle that it waits for is stated
            told = _besides(Vehicle(look.vehicle), answer.facts, facts)
        return Plan((message("PLAIN", it=did),), told)
    lost = Moment(look.seen) if not look.in_view and look.seen is not None else None
    conduct = {} if lost is not None else conduct_slots(answer.facts, look, context)
    first = message("IDENTIFIED", who=who, past=past, seen_last=lost, **conduct)
    if conduct:
        return Plan((first,))
    if facts:
        return Plan((first,), facts)
    verb = "was" if past else "is"
    details = message(
        "IDENTIFIED_FAR",
        **{"is": verb},
        far=Quantity(look.distance, "m"),
        speed=Quantity(look.speed, "m/s") if look.speed >= STANDING else None,
        standing=look.speed < STANDING,
    )
    return Plan((first,), () if lost else (details,))


def _besides(
    told: Thing | None, facts: tuple[Fact, ...], said: tuple[Message, ...]
) -> tuple[Message, ...]:
    """Return those of the other facts that concern somebody else."""
    whom = {told}
    kept: list[Message] = []
    for fact, one in zip(facts, said, strict=True):
        target = fact.object if isinstance(fact, Episode) else None
        if isinstance(fact, Episode) and target in whom:
            continue
        whom.add(target)
        kept.append(one)
    return tuple(kept)


def conduct_slots(facts: tuple[Fact, ...], look: Look, context: SpeechContext) -> dict[str, object]:
    """Return the slots of a vehicle's conduct in few words: its speed, and what is under way."""
    mine = [f for f in facts if not isinstance(f, Belief) and _of(f, look.vehicle)]
    speed = next((f for f in mine if isinstance(f, Measure) and f.attribute == "speed"), None)
    deed = next((f for f in mine if isinstance(f, Episode)), None)
    if (speed is None or speed.value is None) and deed is None:
        return {}
    value = None if speed is None else speed.value
    slots: dict[str, object] = {"standing": value is not None and value < STANDING}
    slots["speed"] = None if value is None else Quantity(value, "m/s")
    if deed is not None and deed.action not in PLAIN:
        slots["doing"] = episode_clause(deed, context.now, tense="present")
        slots["now_at"] = value is not None and deed.action in CHANGING
    return slots


def _of(fact: Fact, vehicle: int) -> bool:
    thing = fact.actor if isinstance(fact, Episode) else getattr(fact, "thing", None)
    return thing == Vehicle(vehicle)


def _who(look: Look, context: SpeechContext) -> Who:
    return Who(Vehicle(look.vehicle), look.time if is_past(look, context) else None)


def _did(such: Proposition | None, look: Look, context: SpeechContext) -> Clause | None:
    """Return the condition that was asked for, with the vehicle in place of "who"."""
    if such is None:
        return None
    return clause_of(with_wanted(such, Vehicle(look.vehicle)), context.now)


def _nobody(such: Proposition, now: float) -> Clause:
    """Return a clause that a condition holds for nobody: "I did not wait for any car"."""
    kind: Kind = next((one.kind for one in parts(such, Wanted)), "vehicle")
    none = Nobody() if kind == "vehicle" else Nobody(Described(kind, definite=False))
    clause = clause_of(with_wanted(such, none), now)
    if isinstance(clause.subject, Who) and isinstance(clause.subject.thing, Nobody):
        return clause
    return replace(clause, rest=tuple(map(denied, clause.rest)), negated=not clause.negated)


def clocks(moments: Sequence[float]) -> str:
    """Return several times of the ride as a list: "at 0:02, 0:09 and 0:14"."""
    return "at " + listed([clock(moment) for moment in moments])


_TIMES = {1: "once", 2: "twice"}


def times(count: int) -> str:
    """Return a number of times: "once", "twice", "three times"."""
    return _TIMES.get(count) or number(Number(count, "time"))


def plan_counted(answer: Counted, context: SpeechContext) -> Plan:
    """Plan how many there are, or how often it happened; whether the number named is right."""
    if answer.said is not None:
        plan = plan_counted(msgspec.structs.replace(answer, said=None), context)
        rule = "YES" if answer.said else "NO"
        return replace(plan, core=(message(rule, it=plan.core[0]), *plan.core[1:]))
    if isinstance(answer.of, Event) and isinstance(answer.of.object, Exit):
        return Plan((exits_passed(answer),))
    apart = (f for f in answer.facts if not isinstance(f, Look) or telling(f))
    facts = tuple(fact_message(f, context) for f in apart)
    span = _span(answer, context)
    if isinstance(answer.of, Event):
        never = answer.count == 0
        tense: Tense = "perfect" if span.get("whole") else "past"
        tense = "future" if answer.of.tense == "future" else tense
        told = event_clause(answer.of, context.now, tense=tense, negated=never)
        whens = occasions_counted(answer)
        first = message("COUNTED_EVENTS", clause=told, never=never, times=times(answer.count),
                        at_least=answer.at_least, whens=whens, one=answer.count == 1,
                        **span)  # fmt: skip
        return Plan((first,), () if whens else _listed(facts))
    such = answer.such if isinstance(answer.such, Described) else None
    kinds = {f.kind for f in answer.facts if isinstance(f, Look)}
    open_ = such is not None and (such.among is not None or such.kind == "vehicle")
    alike = open_ and len(kinds) == 1  # of six people: six
    amount = Number(answer.count, _noun(Everyone(*kinds) if alike else such or answer.of))
    if such is not None and such.doing is not None and such.doing.tense in ("past", "perfect"):
        seen = [f.vehicle for f in answer.facts[:MANY] if isinstance(f, Look) and telling(f)]
        rows = tuple(Who(Vehicle(v), placed=len(seen) < FEW) for v in seen)
        did = relative_clause(msgspec.structs.replace(such.doing, tense="past"), context.now)
        doers = message("COUNTED_DOERS", none=answer.count == 0, one=answer.count == 1,
                        unnamed=not rows, some=0 < len(rows) < answer.count, number=amount,
                        did=did, rows=rows)  # fmt: skip
        return Plan((doers,))
    past = answer.until is not None and context.now - answer.until > PRESENT
    if such is not None and such.doing is not None and answer.count == 0:
        none = _nobody(Happens(such.doing), context.now)
        return Plan((message("COUNTED_EVENTS", clause=none, never=True),))
    if such is not None and such.doing is not None and isinstance(such.doing.actor, Wanted):
        did = event_clause(such.doing, context.now)
        return Plan((message("COUNTED_NOW", number=amount, one=answer.count == 1, did=did),))
    if such is not None and such.such is not None and not _only_there(such.such):
        rows = tuple(Who(Vehicle(f.vehicle)) for f in answer.facts if isinstance(f, Look))
        those = message("COUNTED_SUCH", none=answer.count == 0, number=amount, past=past,
                        rows=rows if len(rows) <= FEW else ())  # fmt: skip
        return Plan((those,))
    first = message("COUNTED_THINGS", past=past, number=amount, **_which(answer.of, context),
                    at_least=answer.at_least, **(span if past else {}))  # fmt: skip
    if len(facts) > FEW:
        return Plan((first,), (), _listed(facts))
    return Plan((first,), _listed(facts))


def _only_there(that: Proposition) -> bool:
    """Check whether the description of what is counted says nothing but that they are there."""
    return isinstance(that, Is) and that.state == "present"


def _of_each(facts: tuple[Fact, ...], said: tuple[Message, ...]) -> tuple[Message, ...]:
    """Return the first of what is said of each vehicle."""
    first: dict[object, Message] = {}
    for fact, one in zip(facts, said, strict=True):
        first.setdefault(getattr(fact, "actor", None), one)
    return tuple(first.values())


def _listed(facts: tuple[Message, ...]) -> tuple[Message, ...]:
    return (message("ITEMS", items=facts),) if facts else ()


def _which(of: Thing, context: SpeechContext) -> dict[str, object]:
    """Return the places and conduct of the things that were counted."""
    if not isinstance(of, Described):
        return {}
    place = word("vehicles", "place", of.bearing) if of.bearing is not None else None
    did = relative_clause(of.doing, context.now) if of.doing is not None else None
    return {"place": place, "did": did}


def _noun(of: Thing) -> str:
    if isinstance(of, Described):
        kind = word("vehicles", "kind", of.kind)
        return f"{of.colour} {kind}" if of.colour else kind
    if isinstance(of, Everyone | Wanted):
        return "other vehicle" if of.kind == "vehicle" else word("vehicles", "kind", of.kind)
    return "vehicle"


def _span(answer: Counted, context: SpeechContext) -> dict[str, object]:
    if answer.since is None and answer.until is None:
        return {}
    begin = answer.since or 0.0
    end = answer.until if answer.until is not None else context.now
    return span_slots(begin, end, context)


def span_slots(begin: float | None, end: float | None, context: SpeechContext) -> dict[str, object]:
    """Return the slots of an interval: the whole ride so far, or between two times."""
    if begin is None and end is None:
        return {}
    first, last = begin or 0.0, context.now if end is None else end
    whole = first <= PRESENT and context.now - last <= PRESENT
    return {"span": True, "whole": whole, "short": last - first < 1.0, "begin": Moment(first),
            "end": Moment(last)}  # fmt: skip
