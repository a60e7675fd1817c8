"""Safety: right of way, comfort, and how close others came."""

import msgspec

from xavi_dialogue.domain.answers import Closeness, Comfort, Priority
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.nlg.content.agreement import verbs
from xavi_dialogue.nlg.content.facts import episode_message
from xavi_dialogue.nlg.content.measures import measure_message
from xavi_dialogue.nlg.content.plan import Plan
from xavi_dialogue.nlg.content.tenses import PRESENT
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Quantity, Who

NEAR = 1.0  # [m] closer than which a vehicle came very close
CLOSE = 2.5  # [m] and close
URGENT = 1.5  # [s] time to collision below which it was tight
RISKY = 0.05  # risk of a collision from which it is called one


def plan_priority(answer: Priority, context: SpeechContext) -> Plan:
    """Plan who has right of way by the rules, and who went first in fact."""
    past = context.now - answer.time > PRESENT
    at = answer.time if past else None
    who = Who(Vehicle(answer.vehicle), at) if answer.vehicle is not None else None
    words = verbs(past, many=True)
    first = message(
        "RULE",
        rule=answer.rule,
        who=who,
        when=Moment(answer.time) if past else None,
        **words,
    )
    details: list[Message] = []
    if answer.first is not None:
        we = isinstance(answer.first, Ego)
        details.append(message("WENT_FIRST", we=we, who=Who(answer.first, at)))
    if answer.waited is not None:
        details.append(episode_message(answer.waited, context))
    details += [episode_message(deed, context) for deed in answer.deeds]
    if answer.limit is not None and answer.limit.value is not None:
        details.append(_within(answer.limit, words))
    if answer.blame:
        calm = answer.conflict is False
        blame = message("BLAME", conflict=answer.conflict, calm=calm)
        return Plan((blame,), (*(() if answer.rule == "none" else (first,)), *details))
    return Plan((first,), tuple(details))


def _within(limit: Measure, words: dict[str, str]) -> Message:
    assert limit.value is not None
    speed = limit.value if limit.attribute == "speed" else (limit.reference or 0.0)
    bound = limit.reference if limit.attribute == "speed" else limit.value
    return message(
        "WITHIN_LIMIT",
        over=bound is not None and speed > bound + 0.3,
        speed=Quantity(speed, "m/s"),
        limit=Quantity(bound or 0.0, "m/s"),
        were=words["were"],
    )


def plan_comfort(answer: Comfort, context: SpeechContext) -> Plan:
    """Plan how hard the ride was."""
    first = measure_message(answer.peak, context)
    if answer.peak.value is not None and answer.peak.attribute in ("deceleration", "comfort"):
        slots = {**first.slots, "hard": answer.hard, "did_not": "did not"}
        slots |= {"peak_at": Moment(answer.peak.time), "is": "was"}
        first = Message("MEASURE_COMFORT", slots)
    details: list[Message] = []
    if answer.episode is not None:
        details.append(episode_message(answer.episode, context))
    if answer.jerk is not None:
        details.append(measure_message(answer.jerk, context))
    return Plan((first,), (), tuple(details)) if not answer.hard else Plan((first,), tuple(details))


def braked_message(answer: Comfort, context: SpeechContext) -> Message:
    """Make the message of how hard we braked, as a plain fact."""
    slots = measure_message(answer.peak, context).slots
    return Message("BRAKED_UP_TO", {**slots, "peak_at": Moment(answer.peak.time)})


def plan_closeness(answer: Closeness, context: SpeechContext) -> Plan:
    """Plan how close a vehicle came, as the answer to whether it was safe."""
    closest = answer.closest if answer.closest and answer.closest.value is not None else None
    vehicle = answer.vehicle
    at = closest.time if closest is not None and answer.past else None
    first = message(
        "CLOSENESS",
        lead=_lead(answer),
        who=Who(Vehicle(vehicle), at) if vehicle is not None else None,
        closest=Quantity(closest.value, "m") if closest and closest.value is not None else None,
        past=answer.past,
        peak_at=Moment(closest.time) if closest is not None and answer.past else None,
    )
    details: list[Message] = []
    if answer.risk is not None and (closest is None or (answer.asked == "hit" and not answer.past)):
        risk = message("CLOSENESS", lead=_lead(answer), risk=Chance(answer.risk), past=answer.past)
        return Plan((risk,), (Message("DISTANT", first.slots),) if closest is not None else ())
    left = answer.ttc.value if answer.ttc is not None else None
    if left is not None and left <= 2 * URGENT:
        details.append(message("TIME_LEFT", ttc=Quantity(left, "s")))
    if answer.risk is not None:
        details.append(message("RISK", risk=Chance(answer.risk), past=answer.past))
    return Plan((first,), tuple(details))


def _lead(answer: Closeness) -> str | None:
    """The answer to the question itself, where the numbers bear it out."""
    metres = answer.closest.value if answer.closest is not None else None
    left = answer.ttc.value if answer.ttc is not None else None
    risk = answer.risk or 0.0
    if metres is None and answer.risk is None:
        return None
    tight = (metres is not None and metres < NEAR) or (left is not None and left < URGENT)
    tight = tight or risk >= RISKY
    near = metres is not None and metres < CLOSE
    match answer.asked:
        case "hit":
            if answer.past:
                return "yes, we touched" if metres is not None and metres <= 0.0 else "no"
            return "there is a risk" if risk >= RISKY else "I do not expect that"
        case "close":
            return "yes, that was close" if near and answer.past else "yes" if near else "no"
        case "dangerous":
            return "it was tight" if tight and answer.past else "it is tight" if tight else "no"
    if tight:
        return "it was tight" if answer.past else "it is tight, and I am taking care"
    return "yes, it was safe" if answer.past else "yes, it is safe"


def calming(answer: Closeness, context: SpeechContext) -> tuple[Message, ...]:
    """What a worried passenger is told of it: the distance or the risk, as a plain fact."""
    closest = answer.closest.value if answer.closest is not None else None
    if closest is None:
        if answer.risk is None:
            return ()
        return (message("RISK", risk=Chance(answer.risk), past=answer.past),)
    first, *_ = plan_closeness(msgspec.structs.replace(answer, risk=None), context).core
    return (Message("DISTANT", first.slots),) if isinstance(first, Message) else ()
