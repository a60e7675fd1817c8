"""Safety: right of way, comfort, and how close others came, in words."""

import msgspec

from xavi_dialogue.domain.answers import Closeness, Comfort, Priority
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.agreement import verbs
from xavi_dialogue.nlg.content.clauses.facts import RISK, episode_message
from xavi_dialogue.nlg.content.clauses.measures import measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.observed.dangers import plan_assured
from xavi_dialogue.nlg.content.observed.turns import these
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Number, Quantity, Who

NEAR = 1.0  # [m] distance below which a vehicle came very close
ROOM = 5.0  # [m] distance below which nobody can say from it that there is room
CLOSE = 2.5  # [m] distance below which it came close
URGENT = 1.5  # [s] time to collision below which it was a near miss
MANY = 3  # minimum of vehicles that are not named one by one
_COUNTS = {3: "three", 4: "four", 5: "five", 6: "six", 7: "seven", 8: "eight"}
#: Rules by which the other has right of way, though it stands and lets us go first.
STOOD = ("it-stands", "we-first-stood")
FLAT = ("no", "yes, it was safe")  # replies that hard braking rules out
EVEN = 0.5  # risk of a collision from which nothing is called safe
RISKY = 0.05  # minimum risk of a collision that is called a risk
FAR = 40.0  # [m] distance from which nobody counts as close


def plan_priority(answer: Priority, context: SpeechContext) -> Plan:
    """Plan who has right of way by the rules, and who actually went first."""
    past = answer.first is not None or context.now - answer.time > PRESENT
    at = answer.time if past else None
    many = (answer.vehicle or 0, *answer.others)
    named = Vehicles(many) if answer.others else Vehicle(answer.vehicle or 0)
    who = Who(named, at) if answer.vehicle is not None else None
    words, kept = verbs(past, many=True), _kept(answer)
    if answer.others:
        words |= {"has": words["have"], "has_to": words["have_to"]}
    first = message(
        "RULE",
        rule=answer.rule,
        ring=answer.ring,
        light=answer.light,
        green=answer.green,
        walkers=answer.walkers,
        all=_COUNTS.get(len(many)) if len(many) >= MANY and answer.holds is not None else None,
        who=who,
        kept=kept,
        asked=answer.holds is not None and kept not in STOOD,
        holds=answer.holds,
        claim=answer.claim,
        why=answer.why,
        several=bool(answer.others),
        after=these(answer.after),
        after_has="have" if answer.after[1:] else "has",
        apart=these(answer.apart),
        numbered=answer.number,
        number=Number(len(many), "vehicle") if answer.vehicle is not None else None,
        **words,
    )
    if not answer.blame:
        return Plan((first, message("BY_THE_MAP")) if answer.grounds else (first,))
    return _blamed(answer, first, past, context)


def _blamed(answer: Priority, rule: Message, past: bool, context: SpeechContext) -> Plan:
    """Plan the reply to a question of fault or law: the rule and what was done, but no verdict."""
    told: list[Message] = []
    if answer.legal and answer.limit is not None and answer.limit.value is not None:
        told.append(_within(answer.limit, context))
    if answer.rule != "none" and (answer.vehicle is not None or not answer.legal):
        told.append(rule)
    told += [episode_message(deed, context) for deed in answer.deeds[:1] if not told]
    calm = answer.conflict is False and not told
    over = answer.legal and bool(told) and bool(told[0].slots.get("over"))
    told = told[:1] if over else told
    blame = message("BLAME", conflict=answer.conflict, calm=calm, legal=answer.legal, over=over,
                    told=tuple(told[:2]))  # fmt: skip
    return Plan((blame,))


def _kept(answer: Priority) -> str | None:
    """Return who of the two went first, and whether that was by the rule."""
    if answer.first is None and answer.rule == "give-way" and answer.stood:
        return "it-stands"
    if answer.first is None or answer.vehicle is None:
        return None
    ours = isinstance(answer.first, Ego)
    if answer.rule == "priority":
        return "it-did" if ours else "it-first"
    if answer.rule == "give-way":
        first = "we-first-stood" if answer.stood else "we-first"
        return first if ours else "we-did" if answer.waited is not None else "it-before"
    return ("we-first" if ours else "it-went") if answer.rule in ("equal", "depends") else None


def _within(limit: Measure, context: SpeechContext) -> Message:
    assert limit.value is not None
    past = context.now - limit.time > PRESENT
    ours = isinstance(limit.thing, Ego)
    speed = limit.value if limit.attribute == "speed" else (limit.reference or 0.0)
    bound = limit.reference if limit.attribute == "speed" else limit.value
    return message(
        "WITHIN_LIMIT",
        over=bound is not None and speed > bound + 0.3,
        speed=Quantity(speed, "m/s"),
        limit=Quantity(bound or 0.0, "m/s"),
        who=Who(limit.thing, limit.time if past else None, ride=True),
        were=verbs(past, many=ours)["be"],
        past=past,
    )


def plan_comfort(answer: Comfort, context: SpeechContext) -> Plan:
    """Plan how comfortable the ride was."""
    first = measure_message(answer.peak, context)
    if answer.peak.value is not None and answer.peak.attribute in ("deceleration", "comfort"):
        slots = {**first.slots, "hard": answer.hard, "did_not": "did not", "deed": answer.deed}
        slots |= {"peak_at": Moment(answer.peak.time), "is": "was"}
        first = Message("MEASURE_COMFORT", slots)
    details: list[Message] = []
    if answer.episode is not None:
        details.append(episode_message(answer.episode, context))
    if answer.jerk is not None:
        details.append(measure_message(answer.jerk, context))
    return Plan((first,), (), tuple(details)) if not answer.hard else Plan((first,), tuple(details))


def braked_message(answer: Comfort, context: SpeechContext) -> Message:
    """Return how hard we braked as a message."""
    slots = measure_message(answer.peak, context).slots
    return Message("BRAKED_UP_TO", {**slots, "peak_at": Moment(answer.peak.time)})


def plan_closeness(answer: Closeness, context: SpeechContext) -> Plan:
    """Plan how close a vehicle came, as the answer to whether it was safe."""
    if answer.grounds is not None:
        return plan_assured(answer, answer.grounds, context)
    closest = answer.closest if answer.closest and answer.closest.value is not None else None
    vehicle = answer.vehicle
    judged = answer.asked in ("safe", "dangerous")
    if closest is not None and (closest.value or 0.0) > FAR and judged and answer.past:
        vehicle = None  # the closest vehicle had nothing to do with us
    at = closest.time if closest is not None and answer.past else None
    lead = _lead(answer)
    first = message(
        "CLOSENESS",
        lead=None if answer.foreseen or (answer.braked and lead in FLAT) else lead,
        who=Who(Vehicle(vehicle), at) if vehicle is not None else None,
        closest=Quantity(closest.value, "m") if closest and closest.value is not None else None,
        past=answer.past,
        giving=these(answer.giving),
        foreseen=answer.foreseen,
        then=answer.ever is not None,
        peak_at=Moment(closest.time) if closest is not None and answer.past else None,
    )
    details: list[Message] = []
    if answer.ever is not None and answer.past and isinstance(answer.ever.to, Vehicle):
        details.append(message("EVER", who=Who(answer.ever.to, answer.ever.time),
                               closest=Quantity(answer.ever.value or 0.0, "m"),
                               peak_at=Moment(answer.ever.time)))  # fmt: skip
    alone = closest is None and not answer.giving
    if answer.degree and answer.risk is not None:
        risk = message("RISK", risk=Chance(answer.risk), past=answer.past)
        return Plan((risk,), () if alone else (Message("DISTANT", first.slots),))
    if answer.risk is not None and (alone or (answer.asked == "hit" and not answer.past)):
        risk = message("CLOSENESS", lead=_lead(answer), risk=Chance(answer.risk), past=answer.past)
        return Plan((risk,))
    left = answer.ttc.value if answer.ttc is not None else None
    urgent = judged and left is not None and left <= URGENT
    if urgent and left is not None:
        details.append(message("TIME_LEFT", ttc=Quantity(left, "s")))
    details += [_braked(one) for one in answer.braked]
    if (
        judged
        and not (urgent and not answer.past)
        and answer.risk is not None
        and (vehicle is not None or answer.giving)
    ):
        of = answer.planned if answer.risk >= RISKY else None
        when = None if of is None else Moment(of)
        details.append(message("RISK", risk=Chance(answer.risk), past=answer.past, at=when))
    return Plan((first,), tuple(details))


def _braked(hard: Episode) -> Message:
    """Return hard braking of ours, or of one with right of way over us, as a message."""
    who = hard.object if isinstance(hard.actor, Ego) else hard.actor
    return message(
        "BRAKED_HARD",
        ours=isinstance(hard.actor, Ego),
        who=Who(who, hard.begin) if isinstance(who, Vehicle) else None,
        value=Quantity(hard.peak or 0.0, "m/s2"),
        peak_at=Moment(hard.begin),
    )


def _lead(answer: Closeness) -> str | None:
    """Return the direct reply to the question, if the numbers support it."""
    metres = answer.closest.value if answer.closest is not None else None
    left = answer.ttc.value if answer.ttc is not None else None
    risk = answer.risk or 0.0
    if metres is None and answer.risk is None:
        return None
    tight = (metres is not None and metres < NEAR) or (left is not None and left < URGENT)
    tight = tight or risk >= RISKY
    if answer.asked in ("safe", "dangerous") and not tight and risk >= RISK:
        return None  # its figure tells
    near = metres is not None and metres < CLOSE
    match answer.asked:
        case "hit":
            if answer.past:
                return "yes, we touched" if metres is not None and metres <= 0.0 else "no"
            return "there is a risk" if risk >= RISK else "I do not expect that"
        case "close":
            return "yes, that was close" if near and answer.past else "yes" if near else "no"
        case "dangerous":
            return "it was tight" if tight and answer.past else "it is tight" if tight else "no"
    beside = metres is not None and metres < ROOM and not answer.past
    if answer.asked == "room" and beside and not tight:
        return None  # how near somebody is does not tell whether there is room to go anywhere
    if answer.asked == "room" and not tight:
        return "yes, there was enough room" if answer.past else "yes, there is enough room"
    if tight and risk >= EVEN:
        return "no"
    if tight:
        return "it was tight" if answer.past else "it is tight"
    return "yes, it was safe" if answer.past else "yes, it is safe"


def calming(answer: Closeness, context: SpeechContext) -> tuple[Message, ...]:
    """Return what to tell a worried passenger: the distance or the risk, as a plain fact."""
    closest = answer.closest.value if answer.closest is not None else None
    if closest is None:
        if answer.risk is None:
            return ()
        return (message("RISK", risk=Chance(answer.risk), past=answer.past),)
    first, *_ = plan_closeness(msgspec.structs.replace(answer, risk=None), context).core
    return (Message("DISTANT", first.slots),) if isinstance(first, Message) else ()
