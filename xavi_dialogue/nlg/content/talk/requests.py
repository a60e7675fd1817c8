"""Requests: how the car declines to drive otherwise, and what it is about to do anyway."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import ChoiceReason, Declined, Options, Slowing
from xavi_dialogue.domain.vocabulary import BEYOND, GENTLE
from xavi_dialogue.nlg.content.clauses.clauses import event_clause
from xavi_dialogue.nlg.content.clauses.joint_measures import measure_messages
from xavi_dialogue.nlg.content.clauses.measures import SOON
from xavi_dialogue.nlg.content.clauses.plan import Part, Plan
from xavi_dialogue.nlg.content.observed.beliefs import plan_options
from xavi_dialogue.nlg.content.observed.conduct import plan_ahead
from xavi_dialogue.nlg.content.reasons.driven import motion_cause
from xavi_dialogue.nlg.content.reasons.reasons import plan_choice
from xavi_dialogue.nlg.content.talk.refusals import reason_in_words
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Quantity, Who

STAYING = frozenset(("follow", "continue", "keep-lane", "move"))
HOW = frozenset(("hard", "suddenly", "close", "fast", "slowly", "late", "early"))
GOING = frozenset(("go", "move", "continue"))
DRIVING = GOING | {"head", "brake", "turn"}  # actions that may be done gently
#: Actions that are stated without the vehicle concerned: "go before the bus" is going.
BARE = frozenset(("go", "move", "speed-up"))


def plan_declined(answer: Declined, context: SpeechContext) -> Plan:
    """Plan how a request is declined, and what the car is about to do anyway."""
    event, negated = answer.request.event, answer.request.negated
    kept = event.object if event.action not in BARE else None
    where = None if event.where is None or event.where.relation == "same-as" else event.where
    where = None if event.action in ("brake", "slow-down") else where
    told = replace(event, manner=(), object=kept, then=None, where=where)
    clause = event_clause(told, context.now, tense="present")
    if event.action == "keep-distance":
        whom = () if event.object is None else ("from", Who(event.object))
        clause = Clause(clause.subject, "keep", ("more distance", *whom))
    slots: dict[str, object] = {
        "verb": Clause(clause.subject, clause.verb, clause.rest),
        "braking": event.action in ("brake", "slow-down"),
        "negated": negated,
        "open": event.action in ("do", "happen")
        or (event.action in DRIVING and not GENTLE.isdisjoint(event.manner)),
        "unable": not answer.able or event.action in BEYOND,
        "cause": None,
    }
    if answer.cause is not None:
        slots["cause"] = motion_cause(answer.cause, context.now, context, past=False)
    if negated:
        how = event.where is not None or not HOW.isdisjoint(event.manner)
        slots["open"] = bool(slots["open"]) or how
        slots["meant"] = not answer.already
        return Plan((Message("DECLINED_NOT", slots),))
    fact = next(iter(measure_messages(answer.facts, context)), None)
    if answer.already and event.action == "keep-distance" and fact is not None:
        return Plan((Message("KEEPING", {"fact": fact}),))
    if answer.already:
        rule = "ALREADY_MEANT" if event.action in STAYING else "ALREADY"
        doing = answer.doing
        return Plan((message(rule), *(() if doing is None else (doing,))))
    if answer.soon is not None:
        left = Quantity(max(answer.soon - context.now, 0.0), "s")
        slots |= {"left": left, "at_once": left.value < SOON}
        return Plan((Message("ABOUT_TO", slots),))
    slowing = answer.doing is not None and answer.doing.trend == "slowing"
    light = answer.cause is not None and answer.cause.kind == "light"
    if event.action in ("go", "move") and answer.cause is not None and (light or not slowing):
        return Plan((Message("NOT_YET", slots),))
    if event.action in GOING and slowing and answer.cause is not None:
        return Plan((Message("KEEP_GOING", slots),))
    why = answer.cannot
    slots["reason"] = None if why is None else reason_in_words(why, past=False)
    slots["fact"] = fact
    slots["anyway"] = _anyway(answer, context) if answer.reason is None else None
    slots["slow"], against = None, _against(answer.reason, context)
    if isinstance(answer.reason, Slowing):
        slots |= _slowing(answer.reason, context)
    return Plan((Message("DECLINED_VERB", slots), *against))


def _against(
    reason: ChoiceReason | Options | Slowing | None, context: SpeechContext
) -> tuple[Part, ...]:
    """Return what speaks against a request, in sentences of their own."""
    match reason:
        case ChoiceReason():
            return plan_choice(reason, context).core
        case Options():
            return plan_options(reason, context).core
    return ()


def _slowing(reason: Slowing, context: SpeechContext) -> dict[str, object]:
    """Return how far we slow down anyway, or when we stop."""
    left = None if reason.time is None else max(reason.time - context.now, 0.0)
    soon = None if left is None or left < SOON else Quantity(left, "s")
    slow = None if reason.slow is None else Quantity(reason.slow, "m/s")
    return {"slow": slow, "stops": reason.stops, "begin": soon}


def _anyway(answer: Declined, context: SpeechContext) -> Message | None:
    """Return what the car is going to do."""
    unable = not answer.able or answer.request.event.action in BEYOND
    if answer.ahead is None or unable:
        return None
    first = plan_ahead(answer.ahead, context).core[0]
    return first if isinstance(first, Message) else None
