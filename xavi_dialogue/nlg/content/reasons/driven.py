"""Driven: one reason for how we drove, as a clause."""

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.traffic_lights import COLOURS
from xavi_dialogue.nlg.content.reasons.contrasts import SURE, chances
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Moment, Quantity, Who

STANDING = 0.5  # [m/s]
TURNED = ("given-up", "next-move")
GONE = ("ahead", "left", "right", "behind", "behind-left", "behind-right")
ASIDE = ("ahead-left", "ahead-right")  # where a vehicle sets the pace in the lane we enter
PACED = ("leader", "blocked", "lane-ahead")  # reasons for which a speed or a standstill is stated
HELD = ("stop", "stand", "wait", "give-way", "slow-down", "brake")  # what a red light leads to
CHANGED = 1.0  # [m/s] minimum difference between the speed now and when it slowed us


def speed_told(value: float | None, context: SpeechContext) -> Quantity | None:
    """Return the speed to be stated; None if no numbers are wanted."""
    if value is None or context.detail == "simpler":
        return None
    return Quantity(value, "m/s")


def motion_cause(
    cause: MotionCause,
    time: float,
    context: SpeechContext,
    *,
    past: bool,
    deed: str = "",
    since: float | None = None,
) -> Message:
    """Return one reason for how we drove as a clause.

    Args:
        cause: the reason.
        time: [s] at which vehicles are described.
        context: the situation.
        past: state it in the past tense.
        deed: what we did for that reason.
        since: [s] when the speed of the reason was seen; None: now.
    """
    ahead = cause.kind in ("leader", "cut-in", "blocked", "lane-beside", "lane-ahead")
    theirs, over = _pace(cause, since, context, past=past)
    who, aside = None, False
    foreseen = cause.kind == "cut-in" and cause.did is None and not _sure(cause)
    if cause.vehicle is not None:
        look = context.look(cause.vehicle, time)
        beside = look is not None and look.bearing in ASIDE
        aside = cause.kind == "leader" and beside and speed_told(theirs, context) is not None
        who = Who(Vehicle(cause.vehicle), time, placed=aside or foreseen or not ahead)
    stands = theirs is not None and theirs < STANDING
    unit = "m/s" if cause.kind == "limit" else "m"
    value = None if cause.value is None else Quantity(cause.value, unit)  # type: ignore[arg-type]
    simple = context.detail == "simpler"
    return message(
        "DRIVEN_BY",
        kind=cause.kind,
        who=who,
        between=None if cause.between is None else Who(Vehicle(cause.between), time),
        past=past or over or is_gone(cause, context),
        turn=own_verbs(cause.actions) if cause.kind in TURNED and cause.actions else None,
        stands=stands,
        aside=aside,
        speed=speed_told(theirs, context),
        value=value,
        number=None if simple else value,
        lower=deed in ("slow-down", "brake"),
        higher=deed == "speed-up",
        foreseen=foreseen,
        side=cause.side,
        **_shown(cause, past=past, held=deed in HELD),
        **chances(cause.probability if cause.probability is not None else 1.0, context),
    )


def _pace(
    cause: MotionCause, since: float | None, context: SpeechContext, *, past: bool
) -> tuple[float | None, bool]:
    """Return the speed [m/s] to be stated of a vehicle, and whether it is past.

    The present tense takes its speed now. If the vehicle is faster now, or out of view, the hold-up
    is past, and the speed then is stated.
    """
    then = cause.speed
    if past or since is None or then is None or cause.vehicle is None or cause.kind not in PACED:
        return then, past
    seen, now = context.look(cause.vehicle, since), context.look(cause.vehicle)
    if seen is None or now is None or not now.in_view:
        return then, True
    change = now.speed - seen.speed
    if abs(change) <= CHANGED:
        return then, False
    return (then, True) if change > 0.0 else (now.speed, False)


def _shown(cause: MotionCause, *, past: bool, held: bool) -> dict[str, object]:
    """Return the slots for the traffic light that holds us.

    A light that has turned green is a reason for setting off; for standing, it was red until then.
    """
    shown = cause.shown
    if shown is None:
        return {}
    if held and shown.colour == "green" and shown.begun:
        shown = replace(shown, colour="red", end=shown.begin, ended=True)
    turned = shown.colour == "amber" and shown.begun
    freed = shown.colour == "green" and shown.begun
    over = shown.end is not None and shown.ended and not past and not freed
    until = Moment(shown.end) if over and shown.end is not None else None
    colour = COLOURS[shown.colour]
    return {"colour": colour, "turned": turned and past, "until": until, "freed": freed}


def is_gone(cause: MotionCause, context: SpeechContext) -> bool:
    """Check whether one that had to go first has gone: out of view, behind, or past our way."""
    if cause.kind != "right-of-way" or cause.vehicle is None:
        return False
    look = context.look(cause.vehicle)
    if look is not None and look.in_view and look.kind in ON_FOOT and look.bearing == "ahead":
        return False
    return look is None or not look.in_view or look.bearing in GONE


def _sure(cause: MotionCause) -> bool:
    return cause.probability is None or cause.probability >= SURE
