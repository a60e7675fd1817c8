"""Facts: any fact of the record as a clause."""

import math
from collections.abc import Sequence

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import (
    Belief,
    Episode,
    Expectation,
    Fact,
    Look,
    Measure,
    OptionValue,
    Relating,
)
from xavi_dialogue.domain.terms import Ego, Event, Related, Vehicle
from xavi_dialogue.domain.traffic_lights import Crossed, Foreseen, Shown
from xavi_dialogue.nlg.content.clauses.clauses import doing, episode_clause
from xavi_dialogue.nlg.content.clauses.manoeuvres import MOST_PASSED
from xavi_dialogue.nlg.content.clauses.measures import measure_message
from xavi_dialogue.nlg.content.clauses.propositions import clause_of
from xavi_dialogue.nlg.content.clauses.tenses import since, tense_at
from xavi_dialogue.nlg.content.clauses.traffic_lights import (
    crossed_slots,
    foreseen_message,
    light_message,
)
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import afoot, word
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Quantity, Range, Tense, Who

RISK = 0.01  # minimum probability of a collision that is stated
CHANGED = 1.4  # [m/s] minimum change of speed that is stated
TOLD = 0.1  # minimum probability of an alternative that is named
EXPECTED = 0.55  # minimum probability of what somebody is said to be expected to do
BESIDES = 2  # maximum of likely alternatives that are stated
LONG = 1.5  # [s] minimum time of standing or waiting that is stated
LASTING = frozenset(("stand", "wait", "block", "follow"))


def fact_message(fact: Fact, context: SpeechContext, *, when: bool = True) -> Message:
    """Return a fact as a clause."""
    match fact:
        case Episode():
            return episode_message(fact, context, when=when)
        case Measure():
            return measure_message(fact, context, when=when)
        case Belief():
            return belief_message(fact, context)
        case Look():
            return look_message(fact, context)
        case OptionValue():
            return option_message(fact)
        case Shown():
            return light_message(fact, context)
        case Crossed():
            return message("PASSED_AT", **crossed_slots(fact))
        case Foreseen():
            return foreseen_message(fact, context)
        case Relating():
            tense = tense_at(fact.time, context.now)
            that = Related(fact.relation, fact.thing, fact.to, tense=_domain(tense))  # type: ignore[arg-type]
            clause = clause_of(that, context.now, negated=not fact.holds, tense=tense)
            return message("PLAIN", it=clause)


def _domain(tense: Tense) -> str:
    return tense if tense in ("past", "present", "future") else "past"


def episode_message(
    episode: Episode,
    context: SpeechContext,
    *,
    when: bool = True,
    lead: bool = False,
    tense: Tense | None = None,
) -> Message:
    """Return an episode as a clause: what was done, from and to which speed, and when.

    Args:
        episode: the episode.
        context: the situation.
        when: state the time.
        lead: put the time in front: "at 0:12, I slowed down".
        tense: use this one instead of its own.
    """
    clause = episode_clause(episode, context.now, tense=tense)
    rule = "EPISODE_LEAD" if lead else "EPISODE"
    return message(
        rule,
        clause=clause,
        when=Moment(_told_of(episode)) if when and clause.tense == "past" else None,
        **_speeds(episode),
        lasted=_lasted(episode),
        object=episode.object is not None,
        now=clause.tense == "present",
        unsure=not episode.sure,
    )


def _told_of(episode: Episode) -> float:
    """Return the time [s] at which an episode is stated; of braking to a standstill, its end."""
    halted = bool(_speeds(episode).get("stand"))
    return episode.end if halted and episode.end is not None else episode.begin


def _speeds(episode: Episode) -> dict[str, object]:
    start, end = episode.speed_from, episode.speed_to
    if episode.action not in ("slow-down", "brake", "speed-up", "stop"):
        return {}
    if start is None or end is None or abs(start - end) < CHANGED:
        return {}
    if episode.action == "stop" or episode.standing:
        return {"stand": episode.action != "stop"}
    return {"speeds": Range(Quantity(start, "m/s"), Quantity(end, "m/s"))}


def _lasted(episode: Episode) -> Quantity | None:
    if episode.action not in LASTING or episode.end is None:
        return None
    length = episode.end - episode.begin
    return Quantity(length, "s") if length >= LONG else None


def belief_message(belief: Belief, context: SpeechContext) -> Message:
    """Return what is or was expected of a vehicle as a clause, with percentages."""
    past = context.now - belief.time > since(context)
    if not belief.expectations:
        return message("BELIEF_NONE", who=Who(Vehicle(belief.vehicle)), past=past)
    ring = in_ring(belief.expectations)
    look = context.look(belief.vehicle, belief.time)
    walks = look is not None and look.kind in ON_FOOT
    told = _by_words(belief.expectations, ring=ring)
    first, others = told[0], [e for e in told[1:3] if e.probability >= TOLD]
    who = Who(Vehicle(belief.vehicle), belief.time if past else None)
    second = others[0] if others else None
    third = others[1] if len(others) > 1 else None
    if third is not None:  # the last of three stands after "or"
        second, third = third, second
    return message(
        "BELIEF",
        who=who,
        verbs=verbs_of(first.actions, ring=ring, walks=walks),
        chance=Chance(first.probability),
        past=past,
        when=Moment(belief.time) if past else None,
        open=first.probability < EXPECTED,
        other=verbs_of(second.actions, ring=ring, walks=walks) if second else None,
        other_chance=Chance(second.probability) if second else None,
        third=verbs_of(third.actions, ring=ring, walks=walks) if third else None,
        third_chance=Chance(third.probability) if third else None,
    )


def _by_words(expected: Sequence[Expectation], *, ring: bool) -> list[Expectation]:
    """Return expectations with the same words merged into one; likeliest first."""
    found: dict[tuple[Clause, ...], Expectation] = {}
    for one in expected:
        words = verbs_of(one.actions, ring=ring)
        known = found.get(words)
        both = one.probability + (0.0 if known is None else known.probability)
        found[words] = replace(known or one, probability=min(both, 1.0))
    return sorted(found.values(), key=lambda e: -e.probability)


def in_ring(expected: Sequence[Expectation]) -> bool:
    """Check whether expectations show that a vehicle is in a roundabout."""
    return any("continue-next-exit" in e.actions for e in expected)


def besides_of(others: Sequence[Expectation], *, past: bool) -> dict[str, object]:
    """Return what else is or was likely, each with its percentage."""
    ring = in_ring(others)
    told = tuple(
        message("BESIDE", verbs=verbs_of(e.actions, ring=ring), chance=Chance(e.probability),
                past=past)
        for e in _by_words(others, ring=ring)[:BESIDES]
    )  # fmt: skip
    return {"besides": told, "several": len(told) > 1}


def verbs_of(
    actions: tuple[str, ...], ego: bool = False, *, ring: bool = False, walks: bool = False
) -> tuple[Clause, ...]:
    """Return the verb phrases of a series of actions, to be inflected; `ring`: in a roundabout."""
    if walks:
        return tuple(Clause("it", afoot(doing(a))) for a in actions)  # type: ignore[arg-type]
    passed = actions.count("continue-next-exit")
    if (passed or ring) and actions[-1].startswith("exit-"):
        return (Clause("it", word("doings", "leaving", str(min(passed, MOST_PASSED)))),)
    kept = [a for k, a in enumerate(actions) if a != "continue" or len(actions) == 1 or k == -1]
    rest = [a for k, a in enumerate(kept or actions) if k == 0 or a != (kept or actions)[k - 1]]
    return tuple(Clause("it", doing(a, ego=ego)) for a in rest)  # type: ignore[arg-type]


def look_message(look: Look, context: SpeechContext, *, told: bool = False) -> Message:
    """Return where a vehicle is, and how far away, as a clause; if told, only the distance."""
    past = context.now - look.time > since(context) or not look.in_view
    tense: Tense = "past" if past else "present"
    at = look.seen if not look.in_view and look.seen is not None else look.time
    place = word("vehicles", "place", look.bearing)
    who = Who(Vehicle(look.vehicle), look.time, placed=False)
    return message(
        "LOOK",
        clause=Clause(who, "be", (place,), tense),
        far=Quantity(look.distance, "m"),
        when=Moment(at) if past else None,
        lost=not look.in_view,
        placed=told and look.in_view and not past,
        **{"is": "was" if past else "is"},
        place=place,
        who=who,
    )


def option_message(option: OptionValue, *, risk: bool = False) -> Message:
    """Return how an option was valued as a clause; `risk`: only its collision."""
    verb = Clause(Who(), doing(option.action, ego=True))
    delta, least = option.delta, option.exceeds
    return message(
        "OPTION_RISK" if risk else "OPTION",
        verb=verb,
        chosen=option.chosen,
        outcome=option.outcome,
        chance=Chance(option.probability),
        later=Quantity(delta, "s") if delta is not None and delta > 0.25 else None,
        sooner=Quantity(-delta, "s") if delta is not None and delta < -0.25 else None,
        least=None if least is None or least < 1.0 else Quantity(math.floor(least), "s"),
        struck=Who(Vehicle(option.collided_with)) if option.collided_with is not None else None,
        risk=Chance(option.collision) if option.collision >= RISK else None,
    )


def asked_of(event: Event) -> Who:
    """Return the actor of an event as a reference."""
    return Who(event.actor, ride=isinstance(event.actor, Ego))
