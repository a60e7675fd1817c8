"""Others: why another vehicle did something, as far as can be seen or was inferred."""

import dataclasses

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import MotionCause, OtherReason, PlaceReason, SignalReason
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import doing, episode_clause, event_clause
from xavi_dialogue.nlg.content.clauses.manoeuvres import other_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_cause, about_vehicle
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.clauses.traffic_lights import COLOURS
from xavi_dialogue.nlg.content.reasons.contrasts import EVEN, chances, telling
from xavi_dialogue.nlg.content.reasons.driven import STANDING, speed_told
from xavi_dialogue.nlg.content.reasons.motives import CREEPING, HALTS, is_past
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Chance, Clause, Quantity, Who

CERTAIN = 0.95  # minimum probability of a reason that is stated without hedging
#: Names for an action that a question may use without presupposing it.
OPEN = frozenset(("do", "happen", "signal", "see", "appear", "disappear", "block"))
#: Actions that serve to get to a goal.
FOR_GOAL = frozenset(("signal", "exit-left", "exit-right", "exit-straight", "change-left",
                      "change-right"))  # fmt: skip
GOING = frozenset(("go", "move", "continue", "enter", "cross", "speed-up", "come"))
FORESEEN = 0.2  # probability below which what a vehicle indicates was not expected
EVENLY = 0.5  # probability below which something else is as likely as what it indicates


def plan_other(answer: OtherReason, context: SpeechContext) -> Plan:
    """Plan why another vehicle does or did something, as far as can be seen."""
    deed = answer.deed
    if deed is not None and deed.action in FOR_GOAL:  # somebody in its way is not the reason for it
        answer = replace(answer, causes=())
    cause = next(iter(answer.causes), None)
    who = Who(Vehicle(answer.vehicle), None if deed is None else deed.begin)
    past = deed is not None and is_past(deed, context)
    goal = _goal(answer, context)
    slots: dict[str, object] = {
        "who": who,
        "walks": _walks(answer.vehicle, context),
        "past": past,
        "deed": None if deed is None else _their_deed(deed, answer, context),
        "asked": _not_asked(answer, context),
        "cause": None if cause is None else _their_cause(cause, answer, context, past),
        "hedge": None if cause is None else _hedge(cause),
        "ours": {None: None, True: "yes", False: "no"}[answer.ours],
        "parked": cause is not None and cause.kind == "parked",
        "setting_off": cause is not None and cause.kind == "starting",
        **_paced(cause, context),
    }
    if deed is not None and cause is None and goal is not None:
        told = Message("OTHER_GOES", {**slots, **goal.slots, "who": who})
        foreseen = answer.goal is not None and deed.action in answer.goal.expectations[0].actions
        core = Message(told.rule, {**told.slots, "foreseen": foreseen, "past": goal.slots["past"]})
        return Plan((core,), (), (), (), about_cause(answer))
    details = () if goal is None or cause is not None else (goal,)
    if deed is None and cause is None and goal is not None:
        hidden = message("MINDS_HIDDEN", walks=_walks(answer.vehicle, context))
        return Plan((goal,), (hidden,), (), (), about_cause(answer))
    core = Message("OTHER_DID", slots)
    more = [message("ALSO_THEIRS", cause=_their_cause(c, answer, context, past))
            for c in answer.causes[1:2]]  # fmt: skip
    more += [goal] if goal is not None and cause is not None else []
    return Plan((core,), details, tuple(more), (), about_cause(answer))


def _walks(vehicle: int, context: SpeechContext) -> bool:
    """Check whether a vehicle is somebody on foot, who has no driver."""
    look = context.look(vehicle)
    return look is not None and look.kind in ON_FOOT


def _paced(cause: MotionCause | None, context: SpeechContext) -> dict[str, object]:
    """Return the slots of a vehicle that is no faster than we are, with the limit."""
    known = cause is not None and cause.kind == "limit"
    speed, value = (cause.speed, cause.value) if cause is not None and known else (None, None)
    limit = None if value is None else Quantity(value, "m/s")
    return {"no_faster": known, "limit": limit, "speed": speed_told(speed, context)}


def plan_signal(answer: SignalReason, context: SpeechContext) -> Plan:
    """Plan what an indicator means."""
    came = answer.came
    chance = None if context.detail == "simpler" else answer.probability
    core = message(
        "OTHER_SIGNALS",
        deed=episode_clause(answer.deed, context.now),
        past=is_past(answer.deed, context),
        aims=tuple(doing(action) for action in answer.aims),
        came=None if came is None else _it(episode_clause(came, context.now)),
        chance=None if chance is None else Chance(chance),
        low=chance is not None and chance < FORESEEN,
        open=chance is not None and chance < EVENLY,
    )
    return Plan((core,), (), (), (), about_vehicle(answer.vehicle))


def plan_place(answer: PlaceReason, context: SpeechContext) -> Plan:
    """Plan how a vehicle came to be where it is."""
    deed = answer.deed
    told = None
    if deed is not None:
        told = episode_clause(deed, context.now, tense="past")
        told = told if isinstance(deed.actor, Ego) else _it(told)
    place = word("doings", "relation", answer.relation).lstrip("+!").partition(" ")[2]
    who = Who(Vehicle(answer.vehicle), context.now, placed=told is None)
    core = message("OTHER_PLACED", who=who, deed=told, place=place)
    more = () if told is not None else (message("MINDS_HIDDEN"),)
    return Plan((core,), more, (), (), about_vehicle(answer.vehicle))


def _it(clause: Clause) -> Clause:
    return dataclasses.replace(clause, subject="it")


def _hedge(cause: MotionCause) -> Chance | None:
    """Return how probable the reason is, if that needs to be stated."""
    surely = cause.probability is None or cause.probability >= CERTAIN
    return None if surely or cause.probability is None else Chance(cause.probability)


def _their_deed(deed: Episode, answer: OtherReason, context: SpeechContext) -> Clause:
    """Return what the vehicle did; the reason shows for whom."""
    if deed.action == "move" and deed.speed_to is not None:
        speed = Quantity(deed.speed_to, "m/s")
        verb = "walk" if _walks(answer.vehicle, context) else "drive"
        return Clause(Who(deed.actor, deed.begin), verb, ("at", speed), "present", True)
    causes = {cause.vehicle for cause in answer.causes}
    other = deed.object
    number = other.number if isinstance(other, Vehicle) else 0 if isinstance(other, Ego) else None
    if number in causes:
        deed = replace(deed, object=None)
    return episode_clause(deed, context.now)


def _not_asked(answer: OtherReason, context: SpeechContext) -> Clause | None:
    """Return that it did not do what was asked about, if it did something else."""
    event, deed = answer.asked, answer.deed
    if event is None or deed is None or event.action == deed.action or event.action in OPEN:
        return None
    if deed.action in HALTS and event.action in GOING:
        return None
    slow = deed.speed_to is not None and deed.speed_to <= CREEPING
    if deed.action in ("brake", "slow-down") and event.action in ("stop", "stand") and slow:
        return None  # it is about to
    past = is_past(deed, context)
    return event_clause(event, context.now, tense="past" if past else "present", negated=True)


def _their_cause(
    cause: MotionCause, answer: OtherReason, context: SpeechContext, past: bool
) -> Message:
    us = cause.vehicle == 0
    going_on = answer.deed is None or answer.deed.end is None
    begin = context.now if going_on or answer.deed is None else answer.deed.begin
    other = None if us or cause.vehicle is None else Who(Vehicle(cause.vehicle), begin)
    stands = cause.speed is not None and cause.speed < STANDING
    return message(
        "THEIR_CAUSE",
        kind=cause.kind,
        us=us,
        other=other,
        stands=stands,
        past=past,
        colour=None if cause.shown is None else COLOURS[cause.shown.colour],
        speed=speed_told(cause.speed, context),
    )


def _goal(answer: OtherReason, context: SpeechContext) -> Message | None:
    """Return where it was thought to be going."""
    if answer.goal is None or not answer.goal.expectations:
        return None
    first = answer.goal.expectations[0]
    if not telling(first.actions) or (first.probability < EVEN):
        return None
    return message(
        "EXPECTATION",
        who=Who(Vehicle(answer.vehicle), answer.goal.time),
        past=context.now - answer.goal.time > PRESENT,
        acts=other_verbs(first.actions),
        **chances(first.probability, context),
    )
