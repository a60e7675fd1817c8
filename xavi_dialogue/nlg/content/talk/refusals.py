"""Refusals: what prevents an answer, with the true reason, in everyday words."""

import re

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    CannotSay,
    NoSuchVehicle,
    NotApplicable,
    NotRecorded,
    NotUnderstood,
    TooLittle,
    Unavailable,
)
from xavi_dialogue.domain.terms import Described, Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.clauses import doing
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_vehicle, always
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import table
from xavi_dialogue.nlg.surface.values import Clause, Moment, Number, Owned, Who, Without

NO_LANE = "there is no lane to the left"  # in the words of the trace
MOST = 3  # maximum of known vehicles that are named
#: Topics after which it helps to state what can be asked.
LOST = ("off-topic", "opinion", "non-english", "not-understood")


def proposed(context: SpeechContext) -> tuple[tuple[Message, ...], tuple[str, ...]]:
    """Return what can be asked, as a sentence and as suggestions, except recent proposals."""
    found = always(context, 1)
    if not found:
        return (), ()
    return (message("COULD_ASK", what=found[0]),), found


def plan_not_understood(answer: NotUnderstood, context: SpeechContext) -> Plan:
    """Plan that nothing was understood, and because of which words."""
    words = tuple(f'"{word}"' for word in answer.words)
    first = message(
        "NOT_UNDERSTOOD",
        words=words or None,
        many=len(words) > 1,
        rest=answer.rest,
        quote=f'"{answer.quote}"' if answer.quote else None,
    )
    if answer.rest or answer.quote:
        return Plan((first,))
    shown, found = proposed(context)
    return Plan((first,), shown, (), (), found)


def plan_no_such_vehicle(answer: NoSuchVehicle, context: SpeechContext) -> Plan:
    """Plan that nobody fits the description, and who could be meant."""
    past = context.now - answer.time > PRESENT
    thing = answer.thing
    known = tuple(look.vehicle for look in answer.known[:MOST])
    slots: dict[str, object] = {"past": past, "number": None, "described": None, "doing": False}
    if isinstance(thing, Vehicle):
        slots["number"] = str(thing.number)
    if isinstance(thing, Described):
        bare = replace(thing, definite=False, number=None, rank=None, extreme=None)
        slots |= {"described": Without(bare), "doing": thing.doing is not None}
    if answer.misdescribed is not None:
        vehicle = answer.misdescribed.vehicle
        slots["who"] = Who(Vehicle(vehicle), answer.time)
        return Plan((Message("MISDESCRIBED", slots),), (), (), (), about_vehicle(vehicle))
    first = Message("NO_SUCH_VEHICLE", slots)
    if not known:
        return Plan((first,))
    others = Who(Vehicles(known) if len(known) > 1 else Vehicle(known[0]), answer.time)
    rest = message("KNOWN_ONES", who=others, past=past, more=len(answer.known) > MOST)
    return Plan((first,), (rest,), (), (), about_vehicle(known[0]))


def plan_not_applicable(answer: NotApplicable, context: SpeechContext) -> Plan:
    """Plan why something could not be done, by the road."""
    past = answer.time is not None and context.now - answer.time > PRESENT
    verbs = own_verbs(answer.asked[:1], ("change-left",) if _lanes(answer) else ())
    first = message(
        "NOT_APPLICABLE",
        past=past,
        speed=answer.reason.startswith("speed is no choice"),
        verbs=verbs or None,
        reason=reason_in_words(answer.reason, past=past),
        oncoming=answer.overtaking and answer.reason == NO_LANE,
    )
    return Plan((first,))


def _lanes(answer: NotApplicable) -> bool:
    return answer.asked == ("continue",) and "lane to the" in answer.reason


def reason_in_words(reason: str, *, past: bool) -> str:
    """Return the planner's reason in the first person, and in the past tense if it is past."""
    found = table("causes")["reason"].get(reason)
    if found is not None:
        return str(found["then" if past else "now"])
    words = re.sub(r"\bits (?=lane|road|way|path|goal)", "my ", reason)
    words = re.sub(r"^it (is|was|would|must)\b", r"I \1", words).replace("I is", "I am")
    if not past:
        return words
    for now, then in table("causes")["past"].items():
        words = re.sub(rf"\b{now}\b", then, words)
    return words


def plan_too_little(answer: TooLittle, context: SpeechContext) -> Plan:
    """Plan that there is too little evidence, or too small an effect."""
    verbs = own_verbs(answer.asked, answer.chosen) if answer.asked else None
    just_that = bool(answer.asked) and answer.chosen[: len(answer.asked)] == answer.asked
    first = message(
        "TOO_LITTLE",
        reason=answer.reason,
        verbs=verbs,
        just_that=just_that,
        none=answer.distinct == 0,
        found=Number(answer.distinct, "situation") if answer.distinct else None,
        needed=Number(answer.needed, "situation") if answer.needed else None,
    )
    return Plan((first,))


def plan_not_recorded(answer: NotRecorded, context: SpeechContext) -> Plan:
    """Plan that the record does not contain it, and why."""
    attributes = table("doings")["attribute"]
    known = answer.about in attributes
    noun = str(attributes[answer.about]) if known and answer.about is not None else None
    who = None if answer.thing is None else Who(answer.thing, answer.since, ride=True)
    about: object = None if noun is None else f"the {noun}"
    if noun is not None and who is not None:
        about = Owned(who, noun)
    since, until = answer.since, answer.until
    first = message(
        "NOT_RECORDED",
        gap=answer.gap,
        who=who if isinstance(answer.thing, Vehicle) else None,
        about=about,
        since=None if since is None else Moment(max(since, 0.0)),
        until=None if until is None else Moment(until),
    )
    return Plan((first,))


def plan_cannot_say(answer: CannotSay, context: SpeechContext) -> Plan:
    """Plan that the car does not speak about a topic, each topic in its own words."""
    verb = None
    if answer.words in table("doings")["action"]:
        verb = Clause(Who(), doing(answer.words, ego=True))  # type: ignore[arg-type]
    action = answer.reason == "not-an-action" or (answer.topic == "capability" and verb is not None)
    topic = "not-an-action" if action else answer.topic
    first = message("CANNOT_SAY", topic=topic, verb=verb)
    if answer.topic not in LOST:
        return Plan((first,))
    shown, found = proposed(context)
    return Plan((first,), shown, (), (), found)


def plan_unavailable(answer: Unavailable, context: SpeechContext) -> Plan:
    """Plan that the planner behind the answer failed."""
    return Plan((message("UNAVAILABLE", reason=answer.reason, roadless=answer.roadless),))
