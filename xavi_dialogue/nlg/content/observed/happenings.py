"""Happenings: what happened, as a list, a summary or a time."""

from dataclasses import replace
from itertools import groupby

import msgspec

from xavi_dialogue.domain.answers import Happenings
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Thing
from xavi_dialogue.nlg.content.clauses.clauses import episode_clause, event_clause
from xavi_dialogue.nlg.content.clauses.facts import episode_message
from xavi_dialogue.nlg.content.clauses.measures import measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.observed.people import clocks, span_slots, times
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Moment, Quantity, Tense, Who

LISTED = 12  # maximum of episodes in a list of one kind
NOTABLE = 6  # maximum of episodes in a list of whatever happened: the most important ones
TOLD = 8  # maximum of episodes in a summary
TOLD_MORE = 14
SOON = 1.0  # [s] maximum time between two episodes that are joined by "then"
APART = 15.0  # [s] between two episodes from which on they stand in two sentences
IN_SENTENCE = 3  # maximum of episodes in one sentence
YIELDING = ("give-way", "wait", "let-go")
OTHERS = 2.5  # importance of others who let us go first
#: Importance of actions in a summary; those not listed have none.
WEIGHTS = {
    "collide": 9.0, "nearly-collide": 8.0, "overtake": 6.0, "exit-left": 6.0, "exit-right": 6.0,
    "turn": 6.0, "enter": 3.0, "leave": 5.0, "change-left": 5.0, "change-right": 5.0,
    "change-lane": 5.0, "give-way": 5.0, "wait": 5.0, "stop": 4.5, "arrive": 6.0, "cut-in": 6.0,
    "pull-out": 5.0, "brake": 4.0, "slow-down": 2.0, "stand": 3.5, "exit-straight": 3.0,
    "swerve": 6.0, "let-go": 4.0, "block": 4.0, "u-turn": 6.0, "merge": 5.0,
    "follow": 5.0, "continue-next-exit": 1.5, "pass": 2.0, "change-plan": 1.0, "go": 1.0,
}  # fmt: skip


def plan_happenings(answer: Happenings, context: SpeechContext) -> Plan:
    """Plan an account of episodes."""
    if not answer.episodes:
        return _nothing(answer, context)
    match answer.form:
        case "list":
            return _list(answer, context)
        case "summary" | "doing":
            return _summary(answer, context)
        case "when":
            return _when(answer, context)
        case "how-long":
            return _how_long(answer, context)
        case "first" | "last":
            one = answer.episodes[0 if answer.form == "first" else -1]
            it = episode_message(one, context, when=False)
            return Plan((message("FIRST", order=answer.form, when=Moment(one.begin), it=it),))


def _nothing(answer: Happenings, context: SpeechContext) -> Plan:
    """Plan the statement that nothing of the sort happened."""
    span = span_slots(answer.since, answer.until, context)
    clause: Clause | None = None
    if answer.asked is not None:
        tense: Tense = "perfect" if span.get("whole") else "past"
        clause = event_clause(answer.asked, context.now, tense=tense, negated=True)
    measures = tuple(measure_message(m, context) for m in answer.measures)
    return Plan((message("NOTHING", clause=clause, **span),), measures)


def _list(answer: Happenings, context: SpeechContext) -> Plan:
    one_kind = answer.asked is not None
    shown = answer.episodes[:LISTED] if one_kind else _weightiest(answer.episodes, NOTABLE)
    often = one_kind and all(isinstance(e.actor, Ego) for e in answer.episodes)
    items = [_item(e, context, ends=one_kind) for e in shown]
    left = len(answer.episodes) - len(shown)
    if left:
        items.append(message("AND_MORE", number=str(left)))
    ride = _ride(answer.measures)
    count = times(len(answer.episodes)) if often else None
    return Plan((*ride, message("LIST", items=tuple(items), times=count)))


def _item(episode: Episode, context: SpeechContext, *, ends: bool = False) -> Message:
    told = episode_message(episode, context, when=False, tense=_tense(episode, context))
    until = episode.end if ends and episode.end is not None else None
    end = None if until is None or until - episode.begin < SOON else Moment(until)
    return Message("EPISODE_ITEM", {**told.slots, "begin": Moment(episode.begin), "end": end})


def _summary(answer: Happenings, context: SpeechContext) -> Plan:
    """Plan a summary of two to five sentences: the most important episodes in order of time."""
    most = TOLD_MORE if context.detail == "more" else TOLD
    if context.detail == "less":
        most = IN_SENTENCE
    told = _weightiest(answer.episodes, most)
    first = _ride(answer.measures)
    rows = _rows(sorted(told, key=lambda e: _order(e, context)), context)
    before = [None, *(row[-1] for row in rows)]
    sentences = [_row(row, last, context) for row, last in zip(rows, before, strict=False)]
    others = tuple(
        measure_message(m, context)
        for m in answer.measures
        if m.attribute not in ("time", "duration", "distance-driven")
    )
    return Plan((*first, *sentences), others[:1], others[1:])


def _order(episode: Episode, context: SpeechContext) -> tuple[bool, bool]:
    """Return the order of an episode in a summary: what is going on last, our own first in it."""
    present = _tense(episode, context) == "present"
    return present, present and not isinstance(episode.actor, Ego)


def _weightiest(episodes: tuple[Episode, ...], most: int) -> list[Episode]:
    order = {id(e): k for k, e in enumerate(episodes)}
    ranked = sorted(episodes, key=lambda e: (-weight(e), order[id(e)]))
    kept = [e for e in ranked if weight(e) > 0.0][:most] or ranked[:most]
    return sorted(kept, key=lambda e: (e.begin, order[id(e)]))


def weight(episode: Episode) -> float:
    """Return the importance of an episode for a passenger."""
    own = 0.5 if isinstance(episode.actor, Ego) else 0.0
    if not own and episode.action in YIELDING:
        return OTHERS
    return WEIGHTS.get(episode.action, 0.0) + (own if episode.action in WEIGHTS else 0.0)


def _rows(episodes: list[Episode], context: SpeechContext) -> list[list[Episode]]:
    """Return the episodes by sentence: successive ones of one actor, a few at a time."""
    rows: list[list[Episode]] = []

    def subject(episode: Episode) -> tuple[object, ...]:
        ride, tense = _rides(episode, context), _tense(episode, context)
        return (type(episode.actor).__name__, _number(episode.actor), ride, tense)

    for _, group in groupby(episodes, key=subject):
        rows.append([])
        for episode in group:
            late = bool(rows[-1]) and episode.begin - rows[-1][-1].begin > APART
            if late or len(rows[-1]) == IN_SENTENCE:
                rows.append([])
            rows[-1].append(episode)
    return rows


def _number(thing: Thing) -> int:
    return getattr(thing, "number", 0)


def _row(row: list[Episode], last: Episode | None, context: SpeechContext) -> Message:
    groups = [list(group) for _, group in groupby(row, key=_alike)]
    first, *others = (_together(group) for group in groups)
    often = [times(len(group)) if len(group) > 1 else None for group in groups]
    lead = episode_message(first, context, lead=True, tense=_tense(first, context))
    now = _tense(first, context) == "present"
    soon = last is not None and not now and first.begin - last.begin < SOON
    said = last is not None and _tense(last, context) == "present"
    slots = {**lead.slots, "soon": soon, "often": often[0], "now": lead.slots["now"] and not said}
    parts = [Message("EPISODE_LEAD", slots)]
    for episode, count in zip(others, often[1:], strict=True):
        told = episode_message(episode, context, when=False, tense=_tense(episode, context))
        told = Message(told.rule, {**told.slots, "often": count})
        rule = "EPISODE_WHILE" if _tense(first, context) == "present" else "EPISODE_NEXT"
        parts.append(Message(rule, told.slots))
    return message("ROW_NOW" if now else "ROW", parts=tuple(parts))


def _alike(episode: Episode) -> tuple[object, ...]:
    return (episode.action, episode.object, episode.side)


def _together(episodes: list[Episode]) -> Episode:
    """Return one episode for several similar ones, with only what they share."""
    first = episodes[0]
    if len(episodes) == 1:
        return first
    return msgspec.structs.replace(first, speed_from=None, speed_to=None, end=first.begin)


def _rides(episode: Episode, context: SpeechContext) -> bool:
    subject = episode_clause(episode, context.now).subject
    return isinstance(subject, Who) and subject.ride


def _tense(episode: Episode, context: SpeechContext) -> Tense:
    """Return the tense of an episode; what has ended is past, even if only just."""
    return "past" if episode.end is not None else episode_clause(episode, context.now).tense


def _ride(measures: tuple[Measure, ...]) -> tuple[Message, ...]:
    """Return the duration and distance of the ride."""
    known = {m.attribute: m for m in measures if m.value is not None}
    time = known.get("time") or known.get("duration")
    distance = known.get("distance-driven")
    if time is None and distance is None:
        return ()
    slots = {
        "time": Quantity(time.value, "s") if time and time.value is not None else None,
        "distance": Quantity(distance.value, "m") if distance and distance.value else None,
    }
    return (message("RIDE", **slots),) if any(slots.values()) else ()


def _when(answer: Happenings, context: SpeechContext) -> Plan:
    first, *others = answer.episodes
    measures = tuple(measure_message(m, context) for m in answer.measures)
    if others:
        clause = episode_clause(first, context.now, tense="past")
        if len({e.action for e in answer.episodes}) > 1:
            return Plan((_items(answer.episodes, context),), measures)
        moments = [e.begin for e in answer.episodes[:LISTED]]
        often = times(len(answer.episodes))
        told = message("WHEN_MANY", clause=clause, times=often, whens=clocks(moments))
        return Plan((told,), measures)
    if first.begin > context.now:
        told = message("WHEN_FUTURE", clause=episode_clause(first, context.now, tense="future"),
                       when=Moment(first.begin))  # fmt: skip
        return Plan((told,), measures)
    ago = context.now - first.begin
    told = message(
        "WHEN_ONE",
        clause=episode_clause(first, context.now, tense="past"),
        when=Moment(first.begin),
        ago=Quantity(ago, "s") if ago >= PRESENT else None,
    )
    return Plan((told,), measures)


def _how_long(answer: Happenings, context: SpeechContext) -> Plan:
    lengths = [(e.end if e.end is not None else context.now) - e.begin for e in answer.episodes]
    first = answer.episodes[0]
    if len(answer.episodes) > 1:
        if len({e.action for e in answer.episodes}) > 1:
            return Plan((_items(answer.episodes, context),))
        clause = episode_clause(first, context.now, tense="past")
        told = message("LASTED_MANY", clause=clause, times=times(len(lengths)),
                       length=Quantity(sum(lengths), "s"))  # fmt: skip
        return Plan((told,), (_items(answer.episodes, context),))
    going_on = first.end is None or first.end >= context.now
    if going_on and first.action == "stop":
        first = msgspec.structs.replace(first, action="stand")
    clause = episode_clause(first, context.now, tense="perfect" if going_on else "past")
    if going_on:
        clause = _progressive(clause)
    told = message(
        "LASTED_ONE",
        clause=clause,
        going_on=going_on,
        length=Quantity(lengths[0], "s"),
        begin=Moment(first.begin),
        end=Moment(first.end if first.end is not None else context.now),
    )
    others = (m for m in answer.measures if m.attribute != "duration" and not _so_far(m, context))
    return Plan((told,), tuple(measure_message(m, context) for m in others))


def _so_far(one: Measure, context: SpeechContext) -> bool:
    """Check whether a measure is how long somebody has waited, not how long it will still take."""
    waited = one.attribute == "waiting-time" and one.extreme != "total"
    return waited and (one.until is None or one.until <= context.now)


def _items(episodes: tuple[Episode, ...], context: SpeechContext) -> Message:
    return message("LIST_OF", items=tuple(_item(e, context) for e in episodes[:LISTED]))


def _progressive(clause: Clause) -> Clause:
    return replace(clause, progressive=True)
