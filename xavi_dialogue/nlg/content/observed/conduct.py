"""Conduct: what somebody is doing, what we are going to do, and where somebody goes, in words."""

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import Activity, Bound, Forecast, MotionCause, PlanAhead
from xavi_dialogue.domain.facts import Belief, Episode, Look, Measure
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import doing, episode_clause, event_clause
from xavi_dialogue.nlg.content.clauses.facts import (
    EXPECTED,
    belief_message,
    episode_message,
    verbs_of,
)
from xavi_dialogue.nlg.content.clauses.measures import STANDING, measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.routes import (
    TURNS,
    Ring,
    ring_of,
    step_clauses,
    way_messages,
)
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT, since
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Number, Quantity, Who

#: Actions that say less than any other that somebody does at the same time.
AT_HAND = 4.0  # [m] distance below which a place is just ahead
TOLD = 0.4  # minimum probability of an expectation that is stated with the conduct
NAMED = 3  # vehicles named of those that do the same
PLAIN = frozenset(("continue", "move", "keep-lane", "go", "continue-next-exit"))
_STOPPING = frozenset(("stop", "brake", "slow-down", "stand", "follow"))
STILL = frozenset(("stand", "stop", "wait", "park"))
CHANGES = frozenset(("slow-down", "speed-up"))
TRENDS = {"slowing": "slowing down", "speeding-up": "speeding up"}
#: Actions whose names include the change of speed.
TELLING = frozenset(("slow-down", "speed-up", "brake", "stop", "stand"))


def plan_activity(answer: Activity, context: SpeechContext) -> Plan:
    """Plan what somebody is doing, and what it is expected to do."""
    past = context.now - answer.time > PRESENT
    ego = isinstance(answer.actor, Ego)
    who = Who(answer.actor, answer.time if past else None)
    slots: dict[str, object] = {
        "who": who,
        "be": ("was" if past else "am" if ego else "is"),
        "when": Moment(answer.time) if past else None,
        "trend": answer.trend,
        "speed": _speed(answer),
        "walks": _walks(answer, context),
        "off": _moves_off(answer),
    }
    if answer.look is not None and not answer.look.in_view and not past:
        return _lost(answer, answer.look, context)
    deeds = _deeds(answer)
    if answer.trend in TRENDS or slots["off"]:
        slots["telling"] = "at" if past else "now at"
    if deeds and deeds[0].action == "signal" and answer.trend is not None:
        slots["also"] = _underway(deeds[0], answer, past)
    elif deeds:
        slots["doing"] = _underway(deeds[0], answer, past)
        signal = (
            None
            if ego or deeds[0].object
            else next((d for d in deeds[1:] if d.action == "signal"), None)
        )
        slots["also"] = None if signal is None else _underway(signal, answer, past)
        telling = deeds[0].action in TELLING
        slots["telling"] = ("at" if past else "now at") if telling else None
        slots["trending"] = None if telling else TRENDS.get(answer.trend or "")
        if deeds[0].action in ("stand", "stop"):
            slots["speed"] = None if (answer.speed or 0.0) < STANDING else slots["speed"]
    elif answer.speed is None and answer.trend is None and answer.look is not None:
        slots["where"] = word("vehicles", "place", answer.look.bearing)
        slots["who"] = Who(answer.actor, who.time, placed=False)
    details = [d for d in (_cause(answer.cause, past), _belief(answer, context)) if d is not None]
    return Plan((message("ACTIVITY", **slots),), tuple(details))


def _lost(answer: Activity, look: Look, context: SpeechContext) -> Plan:
    """Plan the statement that a vehicle is out of view, and where it was last seen."""
    first = message(
        "ACTIVITY",
        lost=Moment(look.seen if look.seen is not None else look.time),
        who=Who(answer.actor, placed=False),
        where=word("vehicles", "place", look.bearing),
    )
    belief = _belief(answer, context)
    return Plan((first,), (belief,) if belief is not None else ())


def _walks(answer: Activity, context: SpeechContext) -> bool:
    actor = answer.actor
    look = context.look(actor.number, answer.time) if isinstance(actor, Vehicle) else None
    return look is not None and look.kind in ON_FOOT


def _speed(answer: Activity) -> Quantity | None:
    if answer.speed is None or answer.trend == "standing":
        return None
    return Quantity(answer.speed, "m/s")


def _deeds(answer: Activity) -> list[Episode]:
    """Return what somebody does, the most important first."""
    standing, off = answer.trend == "standing", _moves_off(answer)
    deeds = [
        e for e in answer.doing
        if e.action not in PLAIN and not (standing and e.action in _STOPPING)
        and not (off and e.action in STILL)
    ]  # fmt: skip
    if answer.trend is None and not deeds and answer.speed is None:
        deeds = list(answer.doing)
    return sorted(deeds, key=lambda e: (e.action == "signal", e.action in CHANGES, e.begin))


def _moves_off(answer: Activity) -> bool:
    """Check whether somebody who stood until now moves again."""
    stood = any(e.action in STILL for e in answer.doing)
    return stood and (answer.speed or 0.0) >= STANDING and answer.trend != "slowing"


def _underway(deed: Episode, answer: Activity, past: bool) -> Clause:
    clause = episode_clause(deed, answer.time, tense="past" if past else "present")
    subject = Who(answer.actor, answer.time if past else None,
                  ride=isinstance(clause.subject, Who) and clause.subject.ride)  # fmt: skip
    return Clause(subject, clause.verb, clause.rest, clause.tense, progressive=True)


def _cause(cause: MotionCause | None, past: bool) -> Message | None:
    if cause is None or cause.kind not in ("leader", "light", "right-of-way", "blocked"):
        return None
    other = Who(Vehicle(cause.vehicle)) if cause.vehicle is not None else None
    if other is None and cause.kind not in ("light", "leader"):
        return None
    kind = "blocked" if cause.kind == "leader" and other is not None else cause.kind
    tense = {"is": "was" if past else "is", "has": "had" if past else "has"}
    return message("CAUSE_SEEN", kind=kind, other=other, **tense)


def _belief(answer: Activity, context: SpeechContext) -> Message | None:
    if answer.belief is None or not answer.belief.expectations:
        return None
    if answer.belief.expectations[0].probability < TOLD:
        return None
    return belief_message(answer.belief, context)


def plan_ahead(answer: PlanAhead, context: SpeechContext) -> Plan:
    """Plan what we are going to do."""
    if answer.arrived:
        return Plan((message("PLAN_NEXT", arrived=True),))
    ring = ring_of(answer.measures, context.now)
    covered = frozenset(("turn", "exit-number", "distance"))
    others = tuple(_in_all(m, context) for m in answer.measures if m.attribute not in covered)
    if not answer.steps:
        way = tuple(m for m in answer.measures if m.attribute in covered)
        told = message("PLAN_NEXT", none=True, begun=_begun(answer, ring))
        return Plan((told,), (*way_messages(way, context), *others))
    begin = answer.steps[0][1]
    first, *later = step_clauses(tuple(action for action, _ in answer.steps), ring)
    turn = None if ring is not None and first == ring.clause else _same_turn(answer)
    told = message(
        "PLAN_NEXT",
        first=first,
        begun=_begun(answer, ring),
        turn=Quantity(turn.value, "m") if turn is not None and turn.value is not None else None,
        far=_far(ring) if ring is not None and first == ring.clause else None,
        near=turn is not None and (turn.value or 0.0) < AT_HAND,
        when=Moment(begin) if begin > context.now + PRESENT else None,
        others=tuple(later) or None,
    )
    return Plan((told,), (*_elsewhere(answer, turn, ring, context), *others))


def _in_all(one: Measure, context: SpeechContext) -> Message:
    """Return a measure with the destination named, because "there" could mean a junction."""
    told = measure_message(one, context)
    whole = one.attribute == "time-to-go" and one.value is not None
    return message(told.rule, **told.slots, whole=True) if whole else told


def _far(ring: Ring) -> Quantity | None:
    return None if ring.far is None else Quantity(ring.far, "m")


def _begun(answer: PlanAhead, ring: Ring | None) -> Clause | None:
    """Return the action that is under way before the first step."""
    first = answer.steps[0][0] if answer.steps else "continue"
    straight = answer.begun == "exit-straight" and first == "continue"
    if answer.begun is None or answer.begun == first or straight:
        return None
    if ring is not None and ring.next and answer.begun in TURNS:
        return ring.clause
    return Clause(Who(), doing(answer.begun, ego=True))


def _same_turn(answer: PlanAhead) -> Measure | None:
    """Return the turn at the next junction, if the first step is that turn."""
    moves = [action for action, _ in answer.steps if action != "continue"]
    action = moves[0] if moves else "continue" if answer.steps else None
    for one in answer.measures:
        if one.attribute == "turn" and one.value is not None and one.gap is None:
            straight = one.side == "straight" and action in ("continue", "exit-straight")
            if straight or action == f"exit-{one.side}":
                return one
    return None


def _elsewhere(
    answer: PlanAhead, turn: Measure | None, ring: Ring | None, context: SpeechContext
) -> tuple[Message, ...]:
    """Return the next turn, if the first step is not a turn."""
    actions = {action for action, _ in answer.steps}
    if turn is not None or ring is not None or actions & TURNS:
        return ()
    return tuple(
        measure_message(m, context)
        for m in answer.measures
        if m.attribute == "turn" and m.side != "straight"
    )


def _gone(went: Episode | None, look: Look | None, context: SpeechContext) -> dict[str, object]:
    """Return which way somebody went, and where it is now or was last seen."""
    slots: dict[str, object] = {}
    if went is not None:
        slots["went"] = episode_message(went, context)
    if look is not None:
        slots["who"] = Who(Vehicle(look.vehicle), look.time, placed=False)
        slots["where"] = word("vehicles", "place", look.bearing)
        slots["far"] = Quantity(look.distance, "m")
        seen = look.seen if look.seen is not None else look.time
        slots["lost"] = None if look.in_view else Moment(seen)
    return slots


def plan_bound(answer: Bound, context: SpeechContext) -> Plan:
    """Plan where somebody is going, or has gone."""
    measures = tuple(measure_message(m, context) for m in answer.measures)
    if isinstance(answer.actor, Ego):
        far = next((m.value for m in answer.measures if m.attribute == "distance-to-go"), None)
        others = tuple(
            way_messages(
                tuple(
                    m for m in answer.measures if m.attribute != "distance-to-go" or m.value is None
                ),
                context,
            )
        )
        times = [m.time for m in answer.measures if context.now - m.time > PRESENT]
        when = Moment(times[0]) if times and len(answer.measures) == 1 else None
        if any(m.gap == "no-way" for m in answer.measures):
            return Plan((message("NO_VALUE", gap="no-way"),))
        first = message("BOUND_US", far=Quantity(far, "m") if far is not None else None, when=when)
        return Plan((first,), others)
    went, look = answer.went, answer.look
    if went is not None or (look is not None and answer.belief is None):
        return Plan((message("BOUND_WENT", **_gone(went, look, context)),), measures)
    if answer.belief is None:
        return Plan((message("BELIEF_NONE", who=Who(answer.actor)),), measures)
    if answer.unconsidered is not None:
        return _unconsidered(answer.unconsidered, answer.belief, answer.signal, context)
    return Plan((belief_message(answer.belief, context),), measures)


def plan_forecast(answer: Forecast, context: SpeechContext) -> Plan:
    """Plan what several others are expected to do: who is to do the same in one clause."""
    rows: dict[tuple[Clause, ...], list[tuple[int, float]]] = {}
    for belief in (one for one in answer.beliefs if one.expectations):
        likeliest = max(belief.expectations, key=lambda e: e.probability)
        look = context.look(belief.vehicle, belief.time)
        walks = look is not None and look.kind in ON_FOOT
        unclear = likeliest.probability < EXPECTED
        verbs = () if unclear else verbs_of(likeliest.actions, walks=walks)
        rows.setdefault(verbs, []).append((belief.vehicle, likeliest.probability))
    if not rows:
        return Plan((message("FORECAST_NONE"),))
    order = sorted(rows.items(), key=lambda item: not item[0])
    parts = tuple(
        message(
            "FORECAST_ROW",
            rest=verbs == order[-1][0] and len(rows) > 1,
            who=tuple(Who(Vehicle(vehicle)) for vehicle, _ in row[:NAMED]),
            many=Number(len(row), "other") if len(row) > NAMED else None,
            all=len(rows) == 1,
            verbs=verbs or None,
            chance=Chance(min(chance for _, chance in row)),
            several=len(row) > 1,
        )
        for verbs, row in order
    )
    return Plan(parts[:1], parts[1:2], parts[2:])


def _unconsidered(
    event: Event, belief: Belief, signal: Episode | None, context: SpeechContext
) -> Plan:
    """Plan that conduct was not considered, what was considered, and what is indicated."""
    at = belief.time
    knew = event.tense == "past"  # the question is whether it was expected
    past = knew or context.now - at > since(context)
    first = message(
        "UNCONSIDERED",
        past=past,
        knew=knew,
        when=Moment(at),
        who=Who(Vehicle(belief.vehicle), at if past else None),
        of=event_clause(event, context.now, tense="future"),
        verbs=verbs_of(belief.expectations[0].actions) if belief.expectations else None,
    )
    if signal is None:
        return Plan((first,))
    over = context.now - at > since(context)
    shown = episode_message(signal, context, when=False, tense="past" if over else None)
    return Plan((first, shown))
