"""Verdicts: whether something holds, and claims checked against the record."""

import dataclasses
from itertools import groupby
from typing import cast

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain import terms
from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.facts import Belief, Episode, Fact, Look, Measure, Relating
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Compares,
    Ego,
    Event,
    Everyone,
    Exists,
    Is,
    Nobody,
    Not,
    Proposition,
    Related,
    Vehicle,
)
from xavi_dialogue.nlg.content.clauses.clauses import episode_clause, event_clause
from xavi_dialogue.nlg.content.clauses.facts import (
    besides_of,
    episode_message,
    fact_message,
    look_message,
    verbs_of,
)
from xavi_dialogue.nlg.content.clauses.joint_measures import measure_messages
from xavi_dialogue.nlg.content.clauses.measures import UNITS, measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.propositions import PLACES, clause_of, eventful, two_times
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.observed.borne_out import bare, telling, tells_it, within_limit
from xavi_dialogue.nlg.content.observed.people import times
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.quantities import number
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Number, Quantity, Tense, Who

ON = frozenset(("signal", "wait", "stand", "follow", "give-way", "let-go", "block"))
LASTS = ON | {"move"}
CERTAIN = 0.95  # minimum probability of a plan that is stated as certain
LIKELY = 0.5  # minimum probability of an event whose time is stated
AT_ONCE = 1.0  # [s] maximum time of what comes at once
IN_ONE = 2  # maximum of facts in the sentence of the verdict
ADMITTED = 2  # maximum number of errors of which it is told what happened


def plan_verdict(answer: Verdict, context: SpeechContext) -> Plan:
    """Plan whether something holds, with the facts that support it or hold instead."""
    if answer.mistaken:
        return _mistaken(answer, context)
    if answer.probability is not None and not _settled(answer):
        return _likelihood(answer, context)
    if answer.holds is None:
        return _unknown(answer, context)
    if isinstance(bare(answer.that), Believed) and answer.believed:
        answer = replace(answer, facts=(*answer.believed[:1], *answer.facts), believed=())
    answer = replace(answer, facts=telling(answer))
    facts = [m for f in together(answer.facts) for m in _facts(f, answer, context)]
    beliefs = tuple(fact_message(b, context) for b in answer.believed[:1])
    challenge = answer.challenge and answer.claim
    slots: dict[str, object] = {"claim": answer.claim, "challenge": challenge}
    slots["either"] = answer.either
    said = clause_of(answer.that, context.now, negated=not answer.holds)
    inside, outside = tuple(facts[:IN_ONE]), tuple(facts[IN_ONE:])
    if two_times(bare(answer.that)) and (then := _now_and_then(answer)) is not None:
        it = message("NOW_AND_THEN", it=said, **then)
        return Plan((message("YES" if answer.holds else "NO", it=it, **slots),))
    limited = within_limit(answer)
    if limited is not None:
        it = Message("MEASURE_SPEED", {**measure_message(limited, context).slots, "told": True})
        slowing = [_coming(f, context) for f in answer.facts if isinstance(f, Episode)]
        core = (message("YES" if answer.holds else "NO", it=it, **slots), *slowing[:1])
        return Plan(core, beliefs)
    seen = [f for f in answer.facts if isinstance(f, Look) and f.in_view]
    if seen and isinstance(bare(answer.that), Exists):
        return _there(answer, seen, said, slots)
    if tells_it(answer, context):
        # The fact says all that the clause would: "Yes, I stopped at 0:21."
        first = message("YES" if answer.holds else "NO", it=facts[0], **slots)
        return Plan((first,), (*facts[1:], *beliefs))
    rule = "YES" if answer.holds else "NO"
    why = all(isinstance(f, Measure | Relating) for f in answer.facts[:IN_ONE])
    first = message(rule, it=said, facts=inside, why=why, **slots)
    return Plan((first,), (*outside, *beliefs))


def _now_and_then(answer: Verdict) -> dict[str, object] | None:
    """Return the value now, and the value at the other time that it is compared with."""
    values = [f for f in answer.facts if isinstance(f, Measure) and f.value is not None]
    if len(values) < 2:
        return None
    now, then = values[0], values[1]
    unit = UNITS.get(now.attribute, "count")
    return {"first": Quantity(now.value or 0.0, unit), "second": Quantity(then.value or 0.0, unit),
            "when": Moment(then.time)}  # fmt: skip


def _settled(answer: Verdict) -> bool:
    """Check whether a verdict is about a fact by now, not about an expectation."""
    return answer.holds is not None and any(isinstance(f, Episode) for f in answer.facts)


def _facts(facts: tuple[Fact, ...], answer: Verdict, context: SpeechContext) -> tuple[Message, ...]:
    """Return the messages of facts that are stated together."""
    measures = tuple(f for f in facts if isinstance(f, Measure))
    if measures:
        if _by_number(answer.that):  # the reference is the number in the question
            measures = tuple(replace(m, reference=None) for m in measures)
        return tuple(measure_messages(measures, context))
    return tuple(_told(f, answer, context) for f in facts)


def _by_number(that: Proposition) -> bool:
    inner = bare(that)
    return isinstance(inner, Compares) and isinstance(inner.right, terms.Quantity)


def together(facts: tuple[Fact, ...]) -> list[tuple[Fact, ...]]:
    """Return the facts in rows; successive measures are stated together."""
    return [tuple(row) for _, row in groupby(facts, key=lambda f: isinstance(f, Measure))]


def _told(fact: Fact, answer: Verdict, context: SpeechContext) -> Message:
    if isinstance(fact, Look) and isinstance(answer.that, Exists) and fact.in_view:
        who = Who(Vehicle(fact.vehicle), fact.time, placed=answer.that.thing == Everyone())
        return message("WHO_FAR", who=who, far=Quantity(fact.distance, "m"))
    if isinstance(fact, Look) and fact.in_view:
        placed = isinstance(answer.that, Related) and answer.that.relation in PLACES
        return look_message(fact, context, told=not placed)
    if isinstance(fact, Episode) and fact.end is None and context.then and fact.action in LASTS:
        told = fact_message(fact, context)  # it was so at the time that the question names
        clause = dataclasses.replace(cast(Clause, told.slots["clause"]), tense="past")
        return Message(told.rule, {**told.slots, "clause": clause})
    if isinstance(fact, Episode) and _since(fact, answer, context):
        told = fact_message(fact, context)
        clause = dataclasses.replace(cast(Clause, told.slots["clause"]), tense="perfect")
        return message("EPISODE_SINCE", clause=clause, since=Moment(fact.begin))
    return fact_message(fact, context)


def _since(fact: Episode, answer: Verdict, context: SpeechContext) -> bool:
    """Check whether something in the past that was asked about has been going on since."""
    event = eventful(answer.that)
    past = event is not None and event.tense in ("past", "perfect")
    return past and fact.end is None and fact.action in ON and context.now - fact.begin > PRESENT


def _coming(one: Episode, context: SpeechContext) -> Message:
    """Return what is being done, or will be done in a moment."""
    if one.begin <= context.now:
        return episode_message(one, context, when=False)
    clause = episode_clause(one, context.now, tense="future")
    return message("WHEN_FUTURE", clause=clause, when=Moment(one.begin))


def _there(answer: Verdict, seen: list[Look], said: Clause, slots: dict[str, object]) -> Plan:
    """Plan who is there, the closest first; or that nobody is, and who is closest.

    Of those behind us, or ahead, the vehicles in our lane come first.
    """
    sides = {look.bearing.partition("-")[0] for look in seen}
    ours = sides if sides in ({"behind"}, {"ahead"}) else set()
    lane = {look.vehicle for look in seen if look.bearing in ours and look.kind not in ON_FOOT}
    near = sorted(seen, key=lambda look: (look.vehicle not in lane, look.distance))
    shown = near[:IN_ONE]
    rows = tuple(
        message("WHO_FAR", who=Who(Vehicle(x.vehicle), x.time), far=Quantity(x.distance, "m"))
        for x in shown
    )
    there = answer.holds != isinstance(answer.that, Not)
    left = number(Number(len(near) - len(shown), "other"))
    more = left if len(near) > len(shown) else None
    told = message("EXISTING", rows=rows, more=more, there=there, it=said)
    return Plan((message("YES" if answer.holds else "NO", it=told, **slots),))


def _unknown(answer: Verdict, context: SpeechContext) -> Plan:
    clause = clause_of(bare(answer.that), context.now)
    facts = tuple(_told(f, answer, context) for f in answer.facts[:1])
    if answer.gap is None:
        return Plan((message("UNKNOWN_BARE", it=clause),), facts)
    past = clause.tense != "present"
    mind = answer.that if isinstance(answer.that, Is) and answer.that.state == "upset" else None
    if mind is not None:
        who = Who(mind.thing) if isinstance(mind.thing, Vehicle) else None
        return Plan((message("UNKNOWN_MIND", who=who, past=past),), facts)
    event = eventful(answer.that)
    if event is not None and event.action == "gesture":
        return Plan((message("UNKNOWN_SIGN", it=clause),), facts)
    return Plan((message("UNKNOWN", it=clause, gap=answer.gap, past=past),), facts)


def _likelihood(answer: Verdict, context: SpeechContext) -> Plan:
    """Plan the chance of a future event: in words, in percent, and what is likelier."""
    if isinstance(answer.that, Not) and eventful(answer.that) is not None:
        sought = 1.0 - (answer.probability or 0.0)
        answer = replace(answer, that=bare(answer.that), probability=sought)
    assert answer.probability is not None
    event = eventful(answer.that)
    tense: Tense = "present"
    then: Moment | None = None
    if event is not None and not isinstance(answer.that, Not):
        clause = event_clause(event, context.now, tense=tense)
        subject = "anybody" if isinstance(event.actor, Everyone | Nobody) else clause.subject
        then = _then(event, context)
        foreseen: Tense = "future" if then is None else "conditional"
        clause = Clause(subject, clause.verb, clause.rest, foreseen, plural=clause.plural)
    else:
        clause = clause_of(answer.that, context.now, tense="future")
    when = next((f for f in answer.facts if isinstance(f, Measure) and f.attribute == "time"), None)
    facts = tuple(_told(f, answer, context) for f in answer.facts if f is not when)
    if when is not None and when.value is not None and answer.probability >= LIKELY:
        soon = Quantity(max(when.value - context.now, 0.0), "s")
        at_once = soon.value < AT_ONCE
        if answer.either and event is not None and isinstance(event.actor, Ego):
            word = Chance(answer.probability) if answer.probability < CERTAIN else None
            timed = dataclasses.replace(clause, adverb=word or "")
            return Plan((message("TIMED", it=timed, soon=soon, at_once=at_once),), facts)
        facts = (message("LIKELY_WHEN", soon=soon, at_once=at_once), *facts)
    chance = Chance(answer.probability)
    slots = {"it": clause, "chance": chance, "either": answer.either, "claim": answer.claim,
             "when": then, **_likelier(answer)}  # fmt: skip
    chanced = event is not None and event.action in ("collide", "nearly-collide")
    ours = event is not None and isinstance(event.actor, Ego) and not chanced
    if ours and clause.tense == "future":
        if answer.probability >= CERTAIN:
            return Plan((message("YES", **slots),), facts)
        if answer.probability <= 1.0 - CERTAIN:
            return Plan((message("NO", **{**slots, "it": denied(clause)}),), facts)
    return Plan((message("LIKELIHOOD", **slots),), facts)


def _then(event: Event, context: SpeechContext) -> Moment | None:
    """Return the past moment at which a chance was held; None: it is held now."""
    past = isinstance(event.time, At) and event.tense == "past"
    at = event.time.at if isinstance(event.time, At) and past else context.now
    return Moment(at) if context.now - at >= PRESENT else None


def _likelier(answer: Verdict) -> dict[str, object]:
    """Return what is expected of a vehicle instead of something unlikely."""
    belief = next((b for b in answer.believed if b.expectations), None)
    if belief is None or answer.probability is None:
        return {}
    first = belief.expectations[0]
    if first.probability < LIKELY:
        return besides_of(belief.expectations, past=False)
    return {"instead": verbs_of(first.actions), "instead_chance": Chance(first.probability)}


def denied(clause: Clause) -> Clause:
    """Return the negation of a clause."""
    return dataclasses.replace(clause, negated=not clause.negated)


def _mistaken(answer: Verdict, context: SpeechContext) -> Plan:
    """Plan how the car admits an error: what it expected, and what happened."""
    if len(answer.believed) == len(answer.facts) > 1:
        return _often_mistaken(answer, context)
    went = next((f for f in answer.facts if isinstance(f, Episode)), None)
    belief = answer.believed[0] if answer.believed else None
    slots: dict[str, object] = {"claim": answer.claim or answer.challenge, "yes": answer.holds}
    if belief is not None and belief.expectations:
        slots |= _expected(belief, answer.that)
    if went is not None:
        slots["went"] = episode_message(went, context, tense="past")
    others = tuple(fact_message(f, context) for f in answer.facts if f is not went)
    return Plan((message("MISTAKEN", **slots),), others)


def _often_mistaken(answer: Verdict, context: SpeechContext) -> Plan:
    """Plan how the car admits several errors: the latest ones, each with what happened."""
    latest = tuple(zip(answer.believed, answer.facts, strict=True))[-ADMITTED:]
    claim = answer.claim or answer.challenge
    often = times(len(answer.believed))
    lead = message("MISTAKEN_OFTEN", claim=claim, yes=answer.holds, times=often,
                   more=len(answer.believed) > ADMITTED)  # fmt: skip
    told = tuple(
        message(
            "MISJUDGED",
            went=episode_message(fact, context, tense="past"),
            **_expected(belief, answer.that),
        )
        for belief, fact in latest
        if isinstance(fact, Episode) and belief.expectations
    )
    return Plan((lead,), told)


def _expected(belief: Belief, that: Proposition) -> dict[str, object]:
    first = belief.expectations[0]
    return {
        "who": Who(Vehicle(belief.vehicle), belief.time),
        "expected": verbs_of(first.actions),
        "chance": Chance(first.probability),
        "when": Moment(belief.time),
    }
