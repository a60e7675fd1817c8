"""Beliefs and values: expectations of others, valued options, and comparisons, in words."""

from collections.abc import Mapping
from typing import get_args

from xavi_dialogue.domain.answers import Beliefs, Compared, Options
from xavi_dialogue.domain.facts import Belief, Measure, OptionValue
from xavi_dialogue.domain.terms import Ego, Event, Proposition, Thing, Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import doing, event_clause
from xavi_dialogue.nlg.content.clauses.facts import (
    belief_message,
    besides_of,
    episode_message,
    option_message,
    verbs_of,
)
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.measures import UNITS, measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.propositions import clause_of, eventful
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT, since
from xavi_dialogue.nlg.content.reasons.contrasts import consequence_slots
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Quantity, Who

MOVED = 0.1  # minimum change of probability that is stated
NAMED = 5  # maximum of options named
NARROW = 1.0  # [s] maximum difference in value of a decision that is called close, though not a tie
#: Words for how well something was known, by minimum probability, highest first.
_KNOWN = ((0.95, "sure"), (0.65, "likely"), (0.35, "guess"), (0.0, "no"))


def plan_beliefs(answer: Beliefs, context: SpeechContext) -> Plan:
    """Plan what was believed of a vehicle, how that changed, and what the vehicle did."""
    latest = answer.history[-1] if answer.history else None
    at = answer.time if answer.time is not None else latest.time if latest else context.now
    past = context.now - at > since(context)
    moved, came = _moved(answer, context), _came(answer, context) if past else None
    wanted = (moved, came) if answer.changed else (came,)
    details = tuple(d for d in wanted if d is not None)
    more = () if moved is None or answer.changed else (moved,)
    vehicle = Vehicle(answer.vehicle)
    if answer.knew and answer.of is not None and answer.probability is not None:
        return Plan((_knew(answer, answer.probability, context),))
    if answer.of is not None and answer.probability is not None and answer.since is not None:
        clause = event_clause(answer.of, context.now, tense="future")
        told = message("BELIEVED_SINCE", who=Who(vehicle, answer.since), of=clause,
                       when=Moment(answer.since), chance=Chance(answer.probability))  # fmt: skip
        return Plan((told,), () if moved is None else (moved,))
    if answer.of is not None and answer.probability is not None:
        clause = event_clause(answer.of, context.now, tense="future")
        first = message(
            "BELIEVED_OF",
            past=past,
            when=Moment(at),
            who=Who(vehicle, at if past else None),
            of=clause,
            chance=Chance(answer.probability),
            denied=answer.denied,
            **besides_of(answer.besides, past=past),
        )
        return Plan((first,), details, more)
    if latest is None or not latest.expectations:
        return Plan((message("NO_BELIEF", who=Who(vehicle)),), details, more)
    chosen = min(answer.history, key=lambda b: abs(b.time - at))
    return Plan((belief_message(chosen, context),), details, more)


def _knew(answer: Beliefs, share: float, context: SpeechContext) -> Message:
    """State whether we knew what somebody would do: how probable it was for us, and since when."""
    at = answer.time if answer.time is not None else context.now
    past = answer.came is not None or context.now - at > since(context)
    grade = next(word for least, word in _KNOWN if share >= least)
    earlier = answer.since is not None and answer.before is not None
    assert answer.of is not None
    return message(
        "KNEW",
        past=past,
        grade=grade,
        when=Moment(at),
        who=Who(Vehicle(answer.vehicle), at if past else None),
        of=event_clause(answer.of, context.now, tense="future"),
        chance=Chance(share),
        since=Moment(answer.since) if earlier and answer.since is not None else None,
        before=Chance(answer.before) if earlier and answer.before is not None else None,
        **besides_of(answer.besides, past=past),
    )


def _moved(answer: Beliefs, context: SpeechContext) -> Message | None:
    """Return the largest change of the belief, and what the vehicle did meanwhile."""
    if answer.turning is None or answer.denied or len(answer.history) < 2:
        return None
    begin, end = answer.turning
    before = max((b for b in answer.history if b.time <= begin), key=_when, default=None)
    before = answer.history[0] if before is None else before
    after = min(answer.history, key=lambda b: abs(b.time - end))
    start, stop = _share(before, answer, after), _share(after, answer, after)
    if start is None or stop is None or abs(start - stop) < MOVED:
        return None
    why = episode_message(answer.why, context, when=False, tense="past") if answer.why else None
    return Message("BELIEF_MOVED", {
        "from": Chance(start), "to": Chance(stop), "begin": Moment(begin), "end": Moment(end),
        "why": why, "gone": None if why is not None else _gone(after, answer),
    })  # fmt: skip


def _gone(after: Belief, answer: Beliefs) -> tuple[Clause, ...] | None:
    """Return the conduct asked about, if it was no longer possible in the end."""
    wanted = _actions(answer.of)
    if not wanted or any(_within(wanted, e.actions) for e in after.expectations):
        return None
    return verbs_of(wanted)


def _when(belief: Belief) -> float:
    return belief.time


def _share(belief: Belief, answer: Beliefs, latest: Belief) -> float | None:
    """Return the probability of the conduct asked about, or of the likeliest one in the end."""
    if not latest.expectations:
        return None
    wanted = _actions(answer.of) or latest.expectations[0].actions
    return sum(e.probability for e in belief.expectations if _within(wanted, e.actions))


def _actions(event: Event | None) -> tuple[str, ...]:
    if event is None:
        return ()
    if event.action == "turn" and event.side is not None:
        return (f"exit-{event.side}",)
    return (event.action,)


def _within(wanted: tuple[str, ...], actions: tuple[str, ...]) -> bool:
    return wanted == actions or (len(wanted) == 1 and wanted[0] in actions)


def _came(answer: Beliefs, context: SpeechContext) -> Message | None:
    if answer.came is None:
        return None
    return message("CAME_TRUE", came=episode_message(answer.came, context))


def plan_options(answer: Options, context: SpeechContext) -> Plan:
    """Plan the options of a decision, and what was expected of each."""
    if not answer.options:
        return Plan((message("OPTIONS_NONE"),))
    if answer.risk:
        told = option_message(answer.options[0], risk=True)
        hits = str(answer.hits) if answer.hits else None
        whole = Chance(answer.options[0].collision)
        more = {"hits": hits, "drives": str(answer.drives), "whole": whole, "past": answer.earlier}
        return Plan((message(told.rule, **told.slots, **more),))
    chosen = next((o for o in answer.options if o.chosen), answer.options[0])
    others = [o for o in answer.options if o.action != chosen.action]
    verb = _verb(chosen.action)
    if not others:
        return Plan((message("OPTIONS_ONE", chosen=verb),))
    if answer.rival is not None:
        return _rival(answer, chosen, others[0], context)
    if answer.counted:
        return Plan((_count(answer, verb),))
    first = message(
        "OPTIONS_MANY",
        besides=answer.besides,
        when=Moment(answer.decided) if answer.earlier else None,
        chosen=verb,
        others=tuple(_verb(o.action) for o in others[:NAMED]),
        all=tuple(_verb(o.action) for o in answer.options[:NAMED]),
    )
    scores = tuple(option_message(o) for o in others)
    shown = (message("ITEMS", items=scores[:NAMED]),)
    return Plan((first,), shown)


def _count(answer: Options, chosen: Clause) -> Message:
    """Return how many options there were, and all of them."""
    return message(
        "OPTIONS_COUNTED",
        number=str(len(answer.options)),
        when=Moment(answer.decided) if answer.earlier else None,
        chosen=chosen,
        all=tuple(_verb(o.action) for o in answer.options),
    )


def _rival(
    answer: Options, chosen: OptionValue, rival: OptionValue, context: SpeechContext
) -> Plan:
    """Plan which option was closest to the chosen one, and how close."""
    apart = None
    if chosen.value is not None and rival.value is not None:
        apart = abs(chosen.value - rival.value)
    fatal = rival.outcome in ("dead", "collision")
    verb = own_verbs((rival.action,), (chosen.action,))
    far = answer.closest or context.now - answer.decided > PRESENT
    first = message(
        "RIVAL",
        when=Moment(answer.decided) if far else None,
        closest=answer.closest,
        verb=verb,
        chosen=own_verbs((chosen.action,), (rival.action,)),
        verdict=answer.rival,
        named=answer.named,
        fatal=fatal,
        near=apart is not None and apart < NARROW,
        apart=None if apart is None or fatal else Quantity(apart, "s"),
    )
    told = option_message(rival)
    return Plan((first,), (message(told.rule, **{**told.slots, "verb": verb}),))


def _verb(action: str) -> Clause:
    return Clause(Who(), doing(action, ego=True))  # type: ignore[arg-type]


#: For each measure of comparison: the comparative, and the plain word for a tie.
WORDS: Mapping[str, tuple[str, str]] = {
    "best": ("better", "good"), "time": ("quicker", "quick"), "safety": ("safer", "safe"),
    "comfort": ("smoother", "smooth"), "speed": ("faster", "fast"),
    "distance": ("closer", "far away"), "probability": ("more likely", "likely"),
    "size": ("bigger", "big"),
}  # fmt: skip


def plan_compared(answer: Compared, context: SpeechContext) -> Plan:
    """Plan which of two is better by a measure."""
    comparative, plain = WORDS.get(answer.by, ("better", "good"))
    winner = answer.second if answer.better == "second" else answer.first
    loser = answer.first if answer.better == "second" else answer.second
    subject, be = _compared(winner, context)
    pair = _pair(answer.measures, winner, loser)
    first = message(
        "COMPARED",
        because=_because(answer, context),
        better=answer.better,
        word=comparative,
        plain=plain,
        winner=subject,
        option=subject if isinstance(subject, tuple) and answer.better in _DECIDED else None,
        by=_by(answer),
        be=be,
        measured=pair is not None,
        values=pair,
    )
    rest = () if pair else tuple(measure_message(m, context) for m in answer.measures)
    return Plan((first,), rest)


_DECIDED = ("first", "second")


def _because(answer: Compared, context: SpeechContext) -> Message | None:
    """Return the consequences of the worse option, if it is the one that was not chosen."""
    against = answer.contrast
    if against is None or answer.by != "best" or answer.better not in _DECIDED:
        return None
    if (against.value or 0.0) < 0.0:
        return None
    past = context.now - against.decided > PRESENT
    return Message("CONSEQUENCE", consequence_slots(against, context, past=past, that=False))


def _by(answer: Compared) -> Quantity | None:
    """Return how much quicker the better one is, if times are compared."""
    if answer.by != "time" or answer.contrast is None:
        return None
    deltas = (e.delta for e in answer.contrast.effects if e.component == "time")
    delta = next(deltas, None)
    return Quantity(abs(delta), "s") if delta is not None and abs(delta) >= 0.5 else None


def _compared(thing: Thing | Proposition, context: SpeechContext) -> tuple[object, str]:
    """Return the subject of a comparison and its "be": a thing, or a manoeuvre as a gerund."""
    event = eventful(thing) if not isinstance(thing, get_args(Thing)) else None  # type: ignore[arg-type]
    if event is not None:
        clause = event_clause(event, context.now)
        return (clause,), "would have been" if event.tense == "past" else "would be"
    if isinstance(thing, get_args(Thing)):
        return Who(thing, ride=True), "are" if isinstance(thing, Ego) else "is"
    return clause_of(thing, context.now), "is"  # type: ignore[arg-type]


def _pair(measures: tuple[Measure, ...], winner: object, loser: object) -> Message | None:
    """Return both values of a measure, that of the winner first."""
    one = next((m for m in measures if m.thing == winner and m.value is not None), None)
    two = next((m for m in measures if m.thing == loser and m.value is not None), None)
    if one is None or two is None or one.value is None or two.value is None:
        return None
    unit = UNITS.get(one.attribute, "count")
    return message(
        "COMPARED_VALUE", value=Quantity(one.value, unit), other=Quantity(two.value, unit)
    )
