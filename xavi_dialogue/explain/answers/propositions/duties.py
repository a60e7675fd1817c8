"""Duties: whether somebody has to, or should, let another go first, and what we should have done.

The record shows the rule, not what we should have done. Advice gets the reason for our choice.
"""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Priority, Verdict
from xavi_dialogue.domain.meaning import Whether, Why
from xavi_dialogue.domain.terms import (
    Both,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Not,
    Proposition,
    Related,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers import causal
from xavi_dialogue.explain.answers.expectations.foreseen import chance
from xavi_dialogue.explain.answers.expectations.precedence import on_ring, red_ahead
from xavi_dialogue.explain.answers.lights.lights_turn import held
from xavi_dialogue.explain.answers.propositions.halting import to_come
from xavi_dialogue.explain.answers.propositions.standing_rules import ever_given
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.ride.priority import owed, priority_at, where_rule_holds

#: Actions of one that lets another go first.
YIELDING: tuple[ActionName, ...] = ("give-way", "let-go", "wait")
#: Those of them that are done for another one, if that one is named.
FOR_ANOTHER: tuple[ActionName, ...] = ("stop", "brake", "slow-down")
GOING: tuple[ActionName, ...] = ("go", "enter", "cross", "merge", "pull-out", "turn", "pass")
#: Actions of one that comes into another one's way.
INTO_PATH: tuple[ActionName, ...] = ("pull-out", "cut-in", "cross", "block")
WAITING: tuple[ActionName, ...] = ("give-way", "wait")
LATELY = 6.0  # [s] since when one that waited for others was not held up by us
LIKELY = 0.5  # minimum probability that somebody is expected to stop for us all the same
DUTIES = frozenset(("must", "should"))
MAY = frozenset(("can", "could", "might"))


def duty(asked: Asked, event: Event) -> Finding | None:
    """Weigh that somebody has to, or should, do something; None if it is not such a duty.

    Raises:
        Unanswered: a vehicle was never seen, or the record does not hold the rule.
    """
    past = event.tense in ("past", "perfect")
    if event.modal == "could" and past and is_us(event.actor):
        return _handed(asked, Whether(Happens(event)))
    if event.modal is None and past and event.action in GOING and "first" in event.manner:
        return _went_first(asked, event)
    if event.modal is None and event.action in INTO_PATH and is_us(event.actor):
        return _before_him(asked, event)
    if event.modal not in DUTIES and not _may_precede(event):
        return _unwilling(asked, event)
    if event.modal == "should" and past and is_us(event.actor) and event.action in YIELDING:
        return _handed(asked, Why(Not(Happens(replace(event, modal=None, time=Unsaid())))))
    pair = _pair(event)
    if pair is None and event.then is not None and _pair(event.then) is not None:
        event = replace(event.then, actor=event.actor, modal=event.modal, tense=event.tense)
        pair = _pair(event)
    if pair is not None:
        return _owed(asked, event, *pair)
    if event.modal == "should" and is_us(event.actor):
        return _advised(asked, event)
    if event.modal == "must" and past and is_us(event.actor):
        return _needed(asked, event)
    return None


def _went_first(asked: Asked, event: Event) -> Finding | None:
    """Return which of the two went first; None if neither has gone, or nobody is named."""
    vehicle = number(event.actor) or number(event.object)
    if vehicle is None:
        return None
    found = priority_at(asked, vehicle, window(asked, event.time, "past"))
    if found.first is None:
        return None if found.rule == "none" else Finding(None, answer=found)
    return _held(found, isinstance(found.first, Ego) == is_us(event.actor))


def _held(rule: Priority, holds: bool) -> Finding:
    return Finding(holds, answer=replace(rule, holds=holds))


def _before_him(asked: Asked, event: Event) -> Finding | None:
    """Return that we went first, for a claim that we came into somebody's way at a junction."""
    vehicle = number(event.object)
    if vehicle is None or event.tense == "future" or occasion(asked, event) is not None:
        return None
    found = priority_at(asked, vehicle, window(asked, event.time, "past"))
    crossing = found.rule in ("give-way", "equal", "depends")
    if crossing and isinstance(found.first, Ego):
        return _held(found, not found.stood)  # if it stood, we took nothing from it
    waits = asked.world.episodes(Vehicle(vehicle), WAITING, begin=asked.now - LATELY)
    held = [e for e in waits if not is_us(e.object)]
    return Finding(False, tuple(held[-1:])) if held and found.first is None else None


def _unwilling(asked: Asked, event: Event) -> Finding | None:
    """Return that somebody goes first by the rule, for a question whether they stop for us."""
    if event.action in ("give-way", "let-go") and is_us(event.actor):
        now = event.tense == "present" and event.modal in (None, "want")
        meant = event.tense == "future" or (now and occasion(asked, event) is None)
        if not meant or number(event.object) is None:
            return _not_given(asked, event)
        owed_him = _owed(asked, replace(event, tense="present"), event.actor, event.object)
        return owed_him if owed_him.holds else None
    towards_us = event.action in (*YIELDING, *FOR_ANOTHER) and is_us(event.object)
    to_come = event.tense in ("present", "future") and event.modal in (None, "will")
    if not towards_us or not to_come or number(event.actor) is None:
        return None
    present = replace(event, tense="present")
    if occasion(asked, present) is not None:
        return None
    found = _owed(asked, present, event.actor, event.object)
    rule = found.answer
    if isinstance(rule, Priority) and rule.rule == "priority" and isinstance(rule.first, Vehicle):
        return None  # it has gone first, though it had to let us
    if found.holds and isinstance(rule, Priority):
        return found  # it slows down to, if it does not stand yet
    likely = (chance(asked, event, asked.now) or 0.0) >= LIKELY
    return found if found.holds is False and isinstance(rule, Priority) and not likely else None


def _not_given(asked: Asked, event: Event) -> Finding | None:
    """Return who had right of way and who went first, if we did not give way; None if we did."""
    past = event.tense in ("past", "perfect") and event.modal is None
    if not past or occasion(asked, event) is not None:
        return None
    vehicle = number(event.object)
    light = None if asked.past is not None and asked.past.said else held(asked)
    if light is not None:
        return Finding(None, answer=light)  # the light holds us, though others go
    about = window(asked, event.time, "past")
    about = about if vehicle is not None else where_rule_holds(asked, about)
    found = priority_at(asked, vehicle, about)
    if vehicle is not None and found.first is None and found.rule == "give-way":
        return _held(found, True)  # we are about it
    ours = isinstance(found.first, Ego) and found.rule == "give-way"
    return _held(found, False) if ours else None


def is_owed(of: Proposition) -> bool:
    """Check whether a proposition says that somebody has to let another go first."""
    return isinstance(of, Happens) and of.event.modal in DUTIES and _pair(of.event) is not None


def _may_precede(event: Event) -> bool:
    """Check whether an event asks whether somebody may go first."""
    return event.modal in MAY and event.action in GOING and "first" in event.manner


def of_order(of: Both) -> Related | None:
    """Return the right of way that "do they go first or do we?" is about; None: else."""
    ours = any(isinstance(part, Happens) and is_us(part.event.actor) for part in of.contents)
    for part in of.contents:
        match part:
            case Related(relation="has-priority-over" | "must-yield-to", tense="present"):
                return part
            case Happens(event=Event(action=action, tense="present", modal=None) as event) if (
                action in GOING and "first" in event.manner
            ):
                return Related("has-priority-over", event.actor, Ego(), event.time)
            case Happens(event=Event(tense="present" | "past" as tense, modal=None) as event) if (
                event.action in YIELDING and number(event.actor) and is_us(event.object)
            ) and (tense == "present" or ours):  # "or we for him?"
                return Related("must-yield-to", event.actor, Ego(), event.time, tense)
    return None


def _pair(event: Event) -> tuple[Thing | None, Thing | None] | None:
    """Return who is to yield and to whom; None if the event is not about that."""
    if event.action in YIELDING:
        return event.actor, event.object
    if event.action in FOR_ANOTHER and number(event.actor) is not None and is_us(event.object):
        past_fact = event.modal == "must" and event.tense in ("past", "perfect")
        return None if past_fact else (event.actor, event.object)
    if event.action in GOING and ("first" in event.manner or number(event.object) is not None):
        return event.object, event.actor
    return None


def _owed(asked: Asked, event: Event, yielder: Thing | None, other: Thing | None) -> Finding:
    """Weigh that one has to yield to another, by the rule between them."""
    several = next((t.numbers for t in (yielder, other) if isinstance(t, Vehicles)), ())
    every = Everyone() if isinstance(yielder, Everyone) or isinstance(other, Everyone) else None
    vehicle = number(yielder) or number(other)
    past = is_past(asked, event.time, event.tense)
    about = window(asked, event.time, "past") if past else Window(asked.now, asked.now)
    ours = is_us(yielder) or (yielder is None and not is_us(other))
    if past and ours and isinstance(event.time, WholeRide):
        return ever_given(asked, event)
    if vehicle is None and other is None and ours and not past:
        told = _to_all(asked, about, yielder, other)
        if told is not None:
            return _held(told, True)
    if vehicle is None:
        about = where_rule_holds(asked, about)
    if several or every is not None:
        if several:
            return owed_to_all(asked, several, about, ours=ours)
        return owed_to_all(asked, asked.world.in_view(about.end), about, ours=ours, every=True)
    found = owed(priority_at(asked, vehicle, about), ours_yield=ours)
    if found.holds is not None or not is_us(yielder):
        return found
    plain = replace(event, modal=None, tense="past" if past else "present")
    held = occasion(asked, plain)
    return found if held is None else Finding(True, (held,))


def owed_to_all(
    asked: Asked, among: tuple[int, ...], about: Window, *, ours: bool, every: bool = False
) -> Finding:
    """Return to whom of several we have to yield, or who of them has to yield to us.

    Args:
        asked: the question and the record.
        among: the vehicles.
        about: when.
        ours: whether we are to yield.
        every: whether they are all who are in view, rather than some that were named.
    """
    rules = {v: priority_at(asked, v, about).rule for v in among}
    wanted = "give-way" if ours else "priority"
    road = asked.world.road(asked.now)
    present = about.end >= asked.now - 0.1
    if present and on_ring(road):
        return owed(priority_at(asked, None, Window(asked.now, asked.now)), ours_yield=ours)
    those = tuple(v for v in among if rules[v] == wanted)
    if not ours:  # say so where people on foot go first
        those = those or tuple(v for v in among if rules[v] == "give-way")
    if not those:
        general = every or not among or (present and red_ahead(road))
        facts = () if road is None else tuple(fact.vehicle for fact in road.priority)
        ruled = (v for v in among if rules[v] != "none" and (v in facts or not present))
        one = None if general else next(ruled, among[0])
        return owed(priority_at(asked, one, about), ours_yield=ours)
    found = owed(priority_at(asked, those[0], about), ours_yield=ours)
    if isinstance(found.answer, Priority):
        told = replace(found.answer, others=those[1:], first=None)
        return Finding(found.holds, answer=told)
    return found


def _advised(asked: Asked, event: Event) -> Finding | None:
    """Return why we do not, or did not, do what we should; or that we do."""
    plain = replace(event, modal=None)
    if event.action in FOR_ANOTHER and event.tense in ("present", "future"):
        present = replace(plain, tense="present", time=Unsaid())
        if occasion(asked, present) is not None:
            return _handed(asked, Why(Happens(present)))
        if (coming := to_come(asked, present)) is not None:
            return Finding(None, answer=coming)
    paced = {"fast", "slowly"} & set(event.manner) or event.action in ("speed-up", "slow-down")
    held = None if event.action in GOING or paced else occasion(asked, plain)
    if held is not None:
        that = Not(Happens(plain))
        return Finding(None, answer=Verdict(that, False, (held,), claim=True, challenge=True))
    return _handed(asked, Why(Not(Happens(plain))))


def _handed(asked: Asked, question: Why | Whether) -> Finding | None:
    """Return the answer of the causal explainers, if they have one."""
    explainer = causal.explainer(question, asked)
    return None if explainer is None else Finding(None, answer=explainer(question, asked))


def _needed(asked: Asked, event: Event) -> Finding | None:
    """Hand a question whether what we did was necessary to the causal explainers."""
    plain = replace(event, modal=None)
    if occasion(asked, plain) is None:
        return None
    return _handed(asked, Whether(Is("necessary", event=plain)))


def who_first(asked: Asked, such: Proposition | None) -> Priority | None:
    """Return who goes first, if the question is that, about anybody; else None.

    Raises:
        Unanswered: a vehicle was never seen, or the record does not hold the rule.
    """
    pair: tuple[Thing | None, Thing | None]
    match such:
        case Related(relation="has-priority-over" | "must-yield-to"):
            pair, time, tense = (such.thing, such.to), such.time, such.tense
        case Is(state="allowed", event=Event() as event) if (found := _may(event)) is not None:
            pair, time, tense = found, event.time, event.tense
        case Happens(event=event) if (found := _pair(event)) is not None and _duty_of(event):
            pair, time, tense = found, event.time, event.tense
        case _:
            return None
    vehicle = next((n for thing in pair if (n := number(thing)) is not None), None)
    past = is_past(asked, time, tense)
    about = window(asked, time, "past") if past else Window(asked.now, asked.now)
    several = next((t.numbers for t in pair if isinstance(t, Vehicles)), ())
    before = (n for n in several if priority_at(asked, n, about).rule == "give-way")
    vehicle = vehicle if vehicle is not None else next(before, None)
    if past and vehicle is None:
        about = where_rule_holds(asked, about)
    if vehicle is None and not past and (every := _to_all(asked, about, *pair)) is not None:
        return every
    told = priority_at(asked, vehicle, about)
    if told.rule == "none" and vehicle is None:
        ride = Window(asked.world.begin, asked.now)
        told = priority_at(asked, None, where_rule_holds(asked, ride))
    return told


def _may(event: Event) -> tuple[Thing | None, Thing | None] | None:
    """Return who is to yield and to whom, if the question is who may do something."""
    if isinstance(event.actor, Wanted) and event.action in GOING:
        return event.object, event.actor
    return _pair(event)


def _to_all(
    asked: Asked, about: Window, yielder: Thing | None, other: Thing | None
) -> Priority | None:
    """Return to whom we have to yield now, or who all has to yield to us; None: nobody."""
    road = asked.world.road(asked.now)
    if road is None or is_us(yielder) == is_us(other) or on_ring(road):
        return None
    near = {fact.vehicle for fact in road.priority}
    among = tuple(v for v in asked.world.in_view(asked.now) if v in near)
    found = owed_to_all(asked, among, about, ours=is_us(yielder), every=True)
    told = found.answer
    return replace(told, holds=None) if isinstance(told, Priority) and found.holds else None


def _duty_of(event: Event) -> bool:
    """Check whether the question is who is to go first, not who did."""
    first = event.action in GOING and event.modal in (None, "can")
    if first and event.tense == "past":  # "who went first, us or the cyclist?"
        return "first" in event.manner and number(event.object) is not None
    return event.modal in DUTIES or (first and event.tense == "present")
