"""Motives: why we slowed, stood, waited or drove in some way, in words."""

from collections.abc import Iterable

from msgspec.structs import replace

from xavi_dialogue.domain.answers import MotionCause, MotionReason
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import episode_clause
from xavi_dialogue.nlg.content.clauses.manoeuvres import denial, other_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_cause
from xavi_dialogue.nlg.content.clauses.tenses import began, dated, goes_on
from xavi_dialogue.nlg.content.reasons.contrasts import chances, telling
from xavi_dialogue.nlg.content.reasons.driven import STANDING, is_gone, motion_cause, speed_told
from xavi_dialogue.nlg.content.reasons.evidence import (
    cleared,
    hangs_on,
    is_joint,
    is_needed,
    rests_on,
)
from xavi_dialogue.nlg.content.reasons.suspects import suspected
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Moment, Quantity, Who

AT_LIMIT = 0.07  # maximum share of the limit by which a speed at the limit differs from it
COMING = {"crossing-right": "right", "crossing-left": "left"}
YIELDS = frozenset(("give-way", "wait", "let-go"))
CREEPING = 2.6  # [m/s] maximum speed that may be called stopping
STOPS = frozenset(("stop", "stand"))
NEAR = 15.0  # [m] maximum distance of a traffic light that we are at
MARGIN = 0.5  # [m/s] maximum excess over the limit that is only rounding
#: Actions that exclude each other.
WAYS = frozenset(("exit-left", "exit-right", "exit-straight", "change-left", "change-right"))
HALTS = frozenset(("stop", "stand", "wait", "give-way", "brake"))
#: Actions that are less than coming to a standstill.
LESS = frozenset(("slow-down", "brake", "move", "follow", "go"))


def plan_motion(answer: MotionReason, context: SpeechContext) -> Plan:
    """Plan why we drove the way we did."""
    past = answer.past or is_past(answer.deed, context)
    answer = answer if past else _current(answer, context)
    first = _driving(answer, context, past)
    first_of = _vehicles_of(answer.causes[:1])
    told = answer.suspect in first_of or answer.suspect in _vehicles_of(answer.causes[1:2])
    core = suspected(
        first,
        answer.suspect,
        answer.suspected,
        answer.deed.begin,
        answer.cleared,
        answer.besides,
        past=past,
        told=told,
    )
    others = [c for c in answer.causes[1:] if c.vehicle is not None and c.vehicle not in first_of]
    alone = not answer.causes and _nobody(answer)  # then the reason itself states it
    hangs = None if alone else hangs_on(answer.causation, answer.deed.begin, past=past)
    if hangs is not None and is_joint(answer.causation, asked=answer.of_causes):
        whole = answer.of_causes or answer.suspected is not None
        counted = set() if answer.causation is None else set(answer.causation.vehicles)
        besides = _vehicles_of(others[:1])
        brief = () if whole else first_of
        if not whole and counted and counted <= {*first_of, *besides}:
            brief = (*first_of, *besides)  # the answer names each of them
        elif not whole:
            others = [c for c in others if c.vehicle not in counted]
        joint = hangs_on(answer.causation, answer.deed.begin, past=past, brief=brief)
        core = core if joint is None else (*core, joint)  # a single vehicle is not the whole reason
        hangs = None if joint == hangs else hangs
    others = list(answer.causes[1:]) if answer.suspected == "beside" else others
    asked = hangs if answer.of_causes else None
    details = [*(_also(c, answer, context, past) for c in others[:1]), asked]
    more = [
        None if asked else hangs,
        *(_expectation(c, answer, context, past=past) for c in answer.causes[:1]),
        *(_also(c, answer, context, past) for c in answer.causes[1:] if c not in others[:1]),
        *(_needed(c, answer, past=past) for c in answer.causes[:1] if is_needed(answer.causation)),
        cleared(answer.cleared, answer.deed.begin, past=past),
        rests_on(answer.evidence, None),
    ]
    return Plan(
        core,
        tuple(one for one in details if one is not None),
        tuple(one for one in more if one is not None),
        (),
        about_cause(answer),
    )


def _vehicles_of(causes: Iterable[MotionCause]) -> tuple[int, ...]:
    """Return the vehicles that the reasons name."""
    return tuple(v for c in causes for v in (c.vehicle, c.between) if v is not None)


def _current(answer: MotionReason, context: SpeechContext) -> MotionReason:
    """Move reasons that still hold before the one whom we let go first, if that one has gone."""
    if answer.suspect is not None or answer.suspected is not None:
        return answer
    ranked = sorted(answer.causes, key=lambda cause: is_gone(cause, context))
    return replace(answer, causes=tuple(ranked))


def is_past(deed: Episode, context: SpeechContext) -> bool:
    """Check whether an episode is over."""
    return not goes_on(deed, context.now)


def _driving(answer: MotionReason, context: SpeechContext, past: bool) -> Message:
    """Return the sentence why, by the question: about an action, its need, or a way of driving."""
    causes = answer.causes or (MotionCause("plan"),)
    slots = {
        "past": past,
        "yields": answer.deed.action in YIELDS and causes[0].kind == "right-of-way",
        "cause": motion_cause(
            _placed(causes[0], past=past),
            _seen_at(causes[0], answer, context, past=past),
            context,
            past=past,
            deed=answer.deed.action,
            since=answer.deed.begin,
        ),
        "when": began(answer.deed, context) if past else None,
        "known": bool(answer.causes),
        "nobody": not answer.causes and _nobody(answer),
        "speed": speed_told(answer.deed.speed_to, context),
        "limit": None if answer.limit is None else Quantity(answer.limit, "m/s"),
        "at_limit": _at_limit(answer),
        "led": causes[0].kind == "leader" and causes[0].vehicle is not None,
        "peak": None if answer.peak is None else Quantity(answer.peak, "m/s2"),
        "halted": None if answer.halted is None else Moment(answer.halted),
    }
    if answer.form == "why" and slots["yields"] and answer.asked in ("let-go", "give-way"):
        number = causes[0].vehicle
        time = _seen_at(causes[0], answer, context, past=past)
        who = None if number is None else Who(Vehicle(number), time)
        look = None if number is None else context.look(number, time)
        side = None if look is None else COMING.get(look.bearing)
        when = began(answer.deed, context) if past else None
        return message("HAD_PRIORITY", who=who, past=past, side=side, when=when)
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
    if _misnamed(answer):
        assert answer.asked is not None
        denied = denial(answer.asked, past=past)
        deed = _only(deed, answer)
    elif answer.over and answer.asked is not None:
        slots["over"] = denial(answer.asked, past=False)
    return message("DRIVING", deed=deed, denied=denied, did=answer.form == "did", **slots)


def _placed(cause: MotionCause, *, past: bool) -> MotionCause:
    """Return a reason with its distance, unless it is past or right here."""
    near = cause.kind == "light" and (cause.value or 0.0) < NEAR
    gone = near or (past and cause.kind != "limit")
    return replace(cause, value=None) if gone else cause


def _nobody(answer: MotionReason) -> bool:
    """Check whether the question is who makes the difference, and nobody does."""
    found = answer.causation is not None and answer.causation.kind == "none"
    return found and answer.of_causes


def _misnamed(answer: MotionReason) -> bool:
    """Check whether the question called what we did something very different, like stopping."""
    halts = STOPS | YIELDS
    if answer.premise or answer.asked not in halts or answer.deed.action in halts:
        return False
    if any(cause.vehicle is not None for cause in answer.causes[:1]):
        return False
    return answer.deed.speed_to is None or answer.deed.speed_to > CREEPING


def _at_limit(answer: MotionReason) -> bool:
    """Check whether we drove at the limit, apart from rounding."""
    speed, limit = answer.deed.speed_to, answer.limit
    return speed is not None and limit is not None and abs(speed - limit) <= AT_LIMIT * limit


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


def _deed(answer: MotionReason, context: SpeechContext, past: bool) -> Clause:
    """Return what we did; the reason shows for whom."""
    deed = answer.deed
    if isinstance(deed.object, Vehicle) and any(cause.vehicle for cause in answer.causes[:1]):
        deed = replace(deed, object=None)
    if any(cause.kind == "light" for cause in answer.causes[:1]):
        deed = replace(deed, object=None)
    if deed.action == "stop" and deed.end is None and not past:
        deed = replace(deed, action="stand")
    if deed.action in ("move", "go", "continue") and deed.speed_to is not None:
        verb = "drive slowly" if context.detail == "simpler" else "drive at"
        rest = () if context.detail == "simpler" else (Quantity(deed.speed_to, "m/s"),)
        tense = "past" if past else "present"
        return Clause(Who(ride=True), verb, rest, tense, progressive=True)  # type: ignore[arg-type]
    clause = episode_clause(deed, context.now, tense="past" if past else "present")
    return dated(clause, deed, context)


def _only(deed: Clause, answer: MotionReason) -> Clause:
    """Return a clause with "only", if what we did is less than what the question called it."""
    less = answer.asked in HALTS and answer.deed.action in LESS
    if not less:
        return deed
    subject, verb, rest = deed.subject, deed.verb, deed.rest
    return Clause(subject, verb, rest, deed.tense, deed.progressive, adverb="only")


def _expectation(
    cause: MotionCause, answer: MotionReason, context: SpeechContext, *, past: bool
) -> Message | None:
    """Return what we expected of the vehicle, and whether it did that."""
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
    time = _seen_at(cause, answer, context, past=past)
    told = motion_cause(cause, time, context, past=past, since=answer.deed.begin)
    return message("ALSO_CAUSE", cause=told)


def _seen_at(
    cause: MotionCause, answer: MotionReason, context: SpeechContext, *, past: bool
) -> float:
    """Return when [s] the vehicle of a reason is described: now if it goes on in view."""
    times = (answer.deed.begin, context.now) if past else (context.now, answer.deed.begin)
    if cause.vehicle is None:
        return times[0]
    looks = ((time, context.look(cause.vehicle, time)) for time in times)
    return next((time for time, look in looks if look is not None and look.in_view), times[0])


def _needed(cause: MotionCause, answer: MotionReason, *, past: bool) -> Message | None:
    if cause.vehicle is None or not cause.necessary:
        return None
    who = Who(Vehicle(cause.vehicle), answer.deed.begin)
    return message("WITHOUT_IT", who=who, past=past)
