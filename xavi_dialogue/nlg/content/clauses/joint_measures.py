"""Joint measures: several values stated together without repetition."""

import dataclasses

from xavi_dialogue.domain.answers import Lasted, Measures, Staying
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Junction, Thing, Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.measures import measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.routes import way_messages
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Quantity, Who

_FEW = 3  # maximum of vehicles whose speeds are stated one by one
_MANY = 2  # maximum of measures in one sentence


def plan_measures(answer: Measures, context: SpeechContext) -> Plan:
    """Plan the values that were asked for."""
    speeds = [m for m in answer.measures if m.attribute == "speed" and m.value is not None]
    if len({str(m.thing) for m in speeds}) > _FEW:
        return Plan((_range(speeds),))
    apart = [m for m in answer.measures if m.attribute == "distance" and m.value is not None]
    if len({str((m.thing, m.to)) for m in apart}) > _FEW and len({m.time for m in apart}) == 1:
        return Plan((_nearest(apart),))
    way = any(m.attribute == "turn" for m in answer.measures) and len(answer.measures) > 1
    told = way_messages(answer.measures, context) if way else None
    parts = tuple(told or measure_messages(answer.measures, context))
    if not parts:
        return Plan((message("NO_VALUE", gap="not-recorded", named="that"),))
    if len(parts) == _MANY:
        return Plan((message("MEASURES", parts=parts, few=True),))
    return Plan(parts)


def plan_lasted(answer: Lasted, context: SpeechContext) -> Plan:
    """Plan how long a state lasted, and since when."""
    until = answer.now if answer.end is None else answer.end
    return Plan((
        message(
            "HELD", length=Quantity(until - answer.begin, "s"), on=answer.end is None,
            whole=answer.at_least, begin=Moment(answer.begin),
            end=Moment(until),
            held=None if answer.held is None else Quantity(until - answer.held, "s"),
        ),
    ))  # fmt: skip


def plan_staying(answer: Staying, context: SpeechContext) -> Plan:
    """Plan how long we stay behind another vehicle."""
    left = answer.left
    if left is not None and left.attribute == "waiting-time":
        return Plan((measure_message(left, context),))
    deed = None if answer.until is None else own_verbs((answer.until,))[0]
    if deed is not None:
        deed = dataclasses.replace(deed, tense="present")
    return Plan((
        message(
            "STAYING", who=Who(answer.behind, placed=False), deed=deed,
            at=None if answer.at is None else Moment(answer.at),
            off=None if answer.off is None else Chance(answer.off),
            left=None if left is None or left.value is None else Quantity(left.value, "s"),
        ),
    ))  # fmt: skip


def _range(speeds: list[Measure]) -> Message:
    """Return the speeds of many vehicles as a range."""
    slow, fast = (pick(speeds, key=lambda m: m.value or 0.0) for pick in (min, max))
    return message(
        "ALL_SPEEDS", low=Quantity(slow.value or 0.0, "m/s"),
        high=Quantity(fast.value or 0.0, "m/s"), slowest=Who(slow.thing), fastest=Who(fast.thing),
    )  # fmt: skip


def _nearest(apart: list[Measure]) -> Message:
    """Return how far the nearest and the farthest of many vehicles are."""
    us = isinstance(apart[0].thing, Ego)
    near, far = (pick(apart, key=lambda m: m.value or 0.0) for pick in (min, max))
    who = near.to if near.to is not None and us else near.thing
    return message(
        "ALL_DISTANCES", nearest=Who(who), low=Quantity(near.value or 0.0, "m"),
        high=Quantity(far.value or 0.0, "m"),
    )  # fmt: skip


def measure_messages(measures: tuple[Measure, ...], context: SpeechContext) -> list[Message]:
    """Return the messages for measures that are stated together, without repetition."""
    limits = any(m.attribute == "limit" and m.value is not None for m in measures)
    limits = limits and len(measures) > 1
    rivals = len({str(m.thing) for m in measures if m.attribute == "speed"})
    parts: list[Message] = []
    said: float | None = None
    for one in _merged(measures):
        if _seen_last(one, measures):
            continue
        if _seen_last_of(one, measures):
            part = measure_message(one, context, gone=True)
            parts.append(message("LAST_VALUE", who=Who(one.thing, placed=False), part=part))
            continue
        bare = (limits and one.attribute in ("speed", "limit")) or (
            rivals > 1 and one.attribute == "speed"
        )
        part = measure_message(one, context, bare=bare, when=one.time != said)
        seconds = _seconds_beside(one, measures)
        if seconds is not None:
            slots = {**part.slots, "seconds": Quantity(seconds, "s")}
            part = Message("MEASURE_GAP_BOTH", slots)
        if parts and _place_of_peak(one, measures):
            if "even" not in parts[-1].slots or not parts[-1].slots["even"]:
                parts[-1] = _placed(parts[-1], one)
            continue
        parts.append(part)
        said = one.time
    return parts


def _place_of_peak(one: Measure, measures: tuple[Measure, ...]) -> bool:
    """Check whether a measure says where another value was reached: so far before a junction."""
    if one.attribute != "distance" or not isinstance(one.to, Junction) or one.value is None:
        return False
    return any(m.extreme is not None and m.time == one.time for m in measures)


def _placed(first: Message, where: Measure) -> Message:
    assert where.value is not None
    far = Quantity(where.value, "m")
    to = where.to or Junction()
    return message("WITH_PLACE", first=first, far=far, to=Who(to), within=is_within(to))


def is_within(place: Thing | None) -> bool:
    """Check whether it is a junction that we were in, not one to which we came later."""
    return isinstance(place, Junction) and place.rank is None and place.time is not None


def _seen_last(one: Measure, measures: tuple[Measure, ...]) -> bool:
    """Check whether a measure without a value is followed by the last value that was seen."""
    gone = one.gap in ("out-of-view", "hidden")
    return gone and any(
        m.attribute == one.attribute and m.thing == one.thing and m.gap is None for m in measures
    )


def _seen_last_of(one: Measure, measures: tuple[Measure, ...]) -> bool:
    """Check whether a measure is the last value of a thing that is not in view any more."""
    if one.gap is not None or not isinstance(one.thing, Vehicle):
        return False
    return any(_seen_last(m, (one,)) for m in measures)


def _seconds_beside(one: Measure, measures: tuple[Measure, ...]) -> float | None:
    """Return the gap in seconds that belongs to a gap in metres."""
    if one.attribute != "gap" or one.value is None or one.extreme is not None:
        return None
    alike = (m for m in measures if m.attribute == "headway" and _same(m, one))
    return next((m.value for m in alike), None)


def _same(one: Measure, two: Measure) -> bool:
    return (one.thing, one.to, one.time, one.extreme) == (two.thing, two.to, two.time, two.extreme)


def _merged(measures: tuple[Measure, ...]) -> tuple[Measure, ...]:
    """Return the measures without gaps in seconds that are stated with the gap in metres."""
    gaps = [m for m in measures if _seconds_beside(m, measures) is not None]
    return tuple(
        m for m in measures if m.attribute != "headway" or not any(_same(m, g) for g in gaps)
    )
