"""Motives: why we slowed, stood, waited or drove so."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import MotionCause, MotionReason
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses import episode_clause
from xavi_dialogue.nlg.content.contrasts import SURE, chances, telling
from xavi_dialogue.nlg.content.evidence import cleared, rests_on
from xavi_dialogue.nlg.content.manoeuvres import denial, other_verbs
from xavi_dialogue.nlg.content.plan import Plan
from xavi_dialogue.nlg.content.proposals import about_cause
from xavi_dialogue.nlg.content.reasons import suspected
from xavi_dialogue.nlg.content.tenses import PRESENT
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Quantity, Who

STANDING = 0.5  # [m/s]
MARGIN = 0.5  # [m/s] over the limit that is no more than rounding
#: Actions that exclude one another.
WAYS = frozenset(("exit-left", "exit-right", "exit-straight", "change-left", "change-right"))
HALTS = frozenset(("stop", "stand", "wait", "give-way", "brake"))
#: What is less than coming to a standstill.
LESS = frozenset(("slow-down", "brake", "move", "follow", "go"))


def plan_motion(answer: MotionReason, context: SpeechContext) -> Plan:
    """Plan why we drove as we did."""
    past = is_past(answer.deed, context)
    verdict = suspected(answer.suspect, answer.suspected, answer.cleared, answer.deed.begin)
    first = _driving(answer, context, past)
    core = [one for one in (verdict, first) if one is not None]
    details = [_expectation(c, answer, context, past=past) for c in answer.causes[:1]]
    details += [_also(c, answer, context, past) for c in answer.causes[1:2]]
    more = [
        *(_also(c, answer, context, past) for c in answer.causes[2:]),
        *(_needed(c, answer, past=past) for c in answer.causes[:1]),
        cleared(answer.cleared, answer.deed.begin, past=past),
        rests_on(answer.evidence, None),
    ]
    return Plan(
        tuple(core),
        tuple(one for one in details if one is not None),
        tuple(one for one in more if one is not None),
        (),
        about_cause(answer),
    )


def is_past(deed: Episode, context: SpeechContext) -> bool:
    """Tell whether something is over."""
    return deed.end is not None and context.now - deed.end > PRESENT


def _driving(answer: MotionReason, context: SpeechContext, past: bool) -> Message:
    """Make the sentence that says why, by what was asked: a deed, its need, or a way of driving."""
    causes = answer.causes or (MotionCause("plan"),)
    slots = {
        "past": past,
        "cause": motion_cause(
            causes[0], answer.deed.begin, context, past=past, deed=answer.deed.action
        ),
        "known": bool(answer.causes),
        "speed": speed_told(answer.deed.speed_to, context),
        "limit": None if answer.limit is None else Quantity(answer.limit, "m/s"),
    }
    pace = answer.deed.action in ("move", "follow", "go", "continue")
    if answer.form == "necessary":
        need = "own" if causes[0].kind in ("plan", "starting") else "yes"
        return message("DRIVING_NEED", need=need, deed=_deed(answer, context, past), **slots)
    if pace and answer.manner == "fast":
        over = _over(answer)
        return message("PACE_FAST", over=over, **slots)
    if pace and answer.manner in ("close", "far", "slowly") and answer.asked == "move":
        slots |= {"slow": answer.premise, "only": answer.manner == "slowly", **_followed(answer)}
        return message("PACE_CLOSE" if answer.manner != "slowly" else "PACE_SLOW", **slots)
    deed = _deed(answer, context, past)
    denied = None
    if not answer.premise and answer.asked is not None and answer.asked != answer.deed.action:
        denied = denial(answer.asked, past=past)
        deed = _only(deed, answer)
    return message("DRIVING", deed=deed, denied=denied, **slots)


def _over(answer: MotionReason) -> bool:
    speed = answer.deed.speed_to
    return speed is not None and answer.limit is not None and speed > answer.limit + MARGIN


def _followed(answer: MotionReason) -> dict[str, object]:
    leader = next((c for c in answer.causes if c.vehicle), None)
    other = answer.deed.object
    if isinstance(other, Vehicle):
        return {"other": Who(other, answer.deed.begin, placed=False)}
    if leader is None or leader.vehicle is None:
        return {"other": None}
    return {"other": Who(Vehicle(leader.vehicle), answer.deed.begin, placed=False)}


def speed_told(value: float | None, context: SpeechContext) -> Quantity | None:
    """The speed to be told; None where no numbers are wanted."""
    if value is None or context.detail == "simpler":
        return None
    return Quantity(value, "m/s")


def _deed(answer: MotionReason, context: SpeechContext, past: bool) -> Clause:
    """What we did; whom it was for is told by the reason."""
    deed = answer.deed
    causes = {cause.vehicle for cause in answer.causes[:1]}
    if isinstance(deed.object, Vehicle) and deed.object.number in causes:
        deed = replace(deed, object=None)
    if deed.action in ("move", "go", "continue") and deed.speed_to is not None:
        verb = "drive slowly" if context.detail == "simpler" else "drive at"
        rest = () if context.detail == "simpler" else (Quantity(deed.speed_to, "m/s"),)
        tense = "past" if past else "present"
        return Clause(Who(ride=True), verb, rest, tense, progressive=True)  # type: ignore[arg-type]
    return episode_clause(deed, context.now, tense="past" if past else "present")


def _only(deed: Clause, answer: MotionReason) -> Clause:
    """The clause with "only", where what was done is less than what the question called it."""
    less = answer.asked in HALTS and answer.deed.action in LESS
    if not less:
        return deed
    subject, verb, rest = deed.subject, deed.verb, deed.rest
    return Clause(subject, verb, rest, deed.tense, deed.progressive, adverb="only")


# --- Causes ---------------------------------------------------------------------------------------


def motion_cause(
    cause: MotionCause, time: float, context: SpeechContext, *, past: bool, deed: str = ""
) -> Message:
    """Make the clause of one reason for how we drove.

    Args:
        cause: the reason.
        time: [s] at which vehicles are described.
        context: the situation.
        past: it is past.
        deed: what we did for that reason.
    """
    ahead = cause.kind in ("leader", "cut-in", "blocked")
    who = None
    if cause.vehicle is not None:
        who = Who(Vehicle(cause.vehicle), time, placed=not ahead)
    stands = cause.speed is not None and cause.speed < STANDING
    unit = "m/s" if cause.kind == "limit" else "m"
    value = None if cause.value is None else Quantity(cause.value, unit)  # type: ignore[arg-type]
    simple = context.detail == "simpler"
    return message(
        "DRIVEN_BY",
        kind=cause.kind,
        who=who,
        past=past,
        stands=stands,
        speed=speed_told(cause.speed, context),
        value=value,
        number=None if simple else value,
        lower=deed in ("slow-down", "brake"),
        higher=deed == "speed-up",
        foreseen=cause.kind == "cut-in" and cause.did is None and not _sure(cause),
        **chances(cause.probability if cause.probability is not None else 1.0, context),
    )


def _sure(cause: MotionCause) -> bool:
    return cause.probability is None or cause.probability >= SURE


def _expectation(
    cause: MotionCause, answer: MotionReason, context: SpeechContext, *, past: bool
) -> Message | None:
    """What we expected of the vehicle, and whether it did so."""
    if cause.vehicle is None or cause.probability is None or not telling(cause.actions):
        return None
    if cause.kind == "leader" and set(cause.actions) <= {"continue", "exit-straight"}:
        return None
    if cause.speed is not None and cause.speed < STANDING and cause.actions[-1] == "stop":
        return None
    did = cause.did
    so = did is not None and did.action in cause.actions
    other_way = did is not None and did.action in WAYS and WAYS & set(cause.actions)
    shown = did if other_way and not so else None
    return message(
        "EXPECTATION",
        who=Who(Vehicle(cause.vehicle), answer.deed.begin),
        past=past or so or shown is not None,
        acts=other_verbs(cause.actions),
        so=so,
        did=episode_clause(shown, context.now, tense="past") if shown is not None else None,
        **chances(cause.probability, context),
    )


def _also(
    cause: MotionCause, answer: MotionReason, context: SpeechContext, past: bool
) -> Message | None:
    if cause.kind == "plan":
        return None
    return message("ALSO_CAUSE", cause=motion_cause(cause, answer.deed.begin, context, past=past))


def _needed(cause: MotionCause, answer: MotionReason, *, past: bool) -> Message | None:
    if cause.vehicle is None or not cause.necessary:
        return None
    who = Who(Vehicle(cause.vehicle), answer.deed.begin)
    return message("WITHOUT_IT", who=who, past=past)
