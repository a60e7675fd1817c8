"""Requests: what the car does instead of what it is asked to do, or why it cannot do that."""

import dataclasses

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Declined,
    Measures,
    MotionCause,
    MotionReason,
    NeedRollout,
    Options,
    Slowing,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Request
from xavi_dialogue.domain.terms import Ego, Event, Lane, Now, Vehicle
from xavi_dialogue.domain.vocabulary import BEYOND, GENTLE, ActionName
from xavi_dialogue.explain.answers.events.acting import activity
from xavi_dialogue.explain.answers.expectations.foreseen import (
    HALTS,
    STARTS,
    TURNING,
    YIELDS,
    macros,
    sided,
)
from xavi_dialogue.explain.answers.expectations.plans import foreseen, plan_ahead
from xavi_dialogue.explain.answers.expectations.slowing import speed_ahead
from xavi_dialogue.explain.answers.measuring.durations import remaining_wait, stands
from xavi_dialogue.explain.answers.measuring.nearing import past_leader
from xavi_dialogue.explain.answers.reasons import choices, motions, refraining
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import known
from xavi_dialogue.explain.answers.reference.naming import number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.suppositions.risks import barred
from xavi_dialogue.explain.answers.talk import speed_of
from xavi_dialogue.explain.causes.plans.options import options_at

#: Requests that are answered by our speed, and those that are answered by our arrival.
SPEEDS: frozenset[ActionName] = frozenset(("slow-down", "speed-up", "brake"))
ENDING: frozenset[ActionName] = frozenset(("stop", "pull-over", "drop-off", "park", "open"))
STAYING: frozenset[ActionName] = frozenset(("continue", "keep-lane", "follow"))
DRIVING: frozenset[ActionName] = frozenset(("go", "move", "continue", "do", "head"))
PACED: frozenset[ActionName] = DRIVING | {"pass", "overtake", "turn", "enter", "cross"}
NEARNESS: frozenset[ActionName] = frozenset(("keep-distance", "approach"))
KEPT = 1.8  # [s] minimum headway at which we keep our distance
ELSEWHERE = "the way to the destination leads elsewhere"
LATELY = 10.0  # [s] in which we braked, where a passenger wants us to do so more gently
SOON = 3.0  # [s] within which a planned action counts as begun
GENTLER: frozenset[ActionName] = frozenset(("slow-down", "brake"))
#: What passengers advise us to do: that is a wish.
ADVISED: frozenset[ActionName] = SPEEDS | NEARNESS | BEYOND | {"wait", "stop"}
TREND = {"slow-down": "slowing", "brake": "slowing", "speed-up": "speeding-up"}


def advises(event: Event) -> bool:
    """Check whether that we should do something is a wish about our driving from now on."""
    owed = event.modal == "must" and event.action in GENTLER | NEARNESS
    advised = event.modal == "should" or (event.modal == "could" and event.action in GENTLER)
    to_come = event.tense in ("present", "future") and (owed or advised)
    return to_come and isinstance(event.actor, Ego) and event.action in ADVISED


def request(act: Request, asked: Asked) -> Answer:
    """Decline to drive otherwise, with what the car is about to do anyway, or why it cannot.

    Raises:
        Unanswered: it is about something unknown; or rollouts are needed.
    """
    asked = dataclasses.replace(asked, span=None)  # it is of our driving from now on
    act = replace(act, event=past_leader(asked, _to_lane(_paced(asked, act.event))))
    if act.negated and "close" in act.event.manner:  # "do not get so close"
        act = replace(act, event=replace(act.event, action="keep-distance"), negated=False)
    act = replace(act, event=_braking(asked, act.event))
    if act.negated and act.event.action in ("go", "move") and stands(asked):
        act = Request(replace(act.event, action="wait", manner=()))  # "don't drive on yet"
    event = act.event
    able = event.action not in BEYOND
    now = activity(asked, Ego(), asked.now)
    if not asked.ride.traces or _asks_manner(act):
        slower = speed_ahead(asked) if able and not act.negated else None
        facts = () if slower is not None else _speed(asked)
        return Declined(act, able, doing=now, facts=facts, reason=slower)
    ahead = plan_ahead(asked)
    ahead = replace(ahead, measures=tuple(m for m in ahead.measures if m.attribute != "time-to-go"))
    if act.negated:
        meant = able and _meant(asked, event, now.trend)
        cause = _cause(asked) if meant and event.action in HALTS | YIELDS | SPEEDS else None
        return Declined(act, able, ahead, now, already=not meant, cause=cause)
    already = able and _doing(asked, event, now.trend)
    gentler = speed_ahead(asked) if event.action in GENTLER and not already else None
    soon = _coming(asked, event) if able and not already and gentler is None else None
    cannot = _cannot(asked, event) if able and not already and soon is None else None
    if event.action == "overtake" and not already and soon is None and cannot is None:
        staying = refraining.not_passed(replace(event, action="follow"), asked)
        if staying is not None:
            return staying
    hurried = sided(event) in STARTS | {"speed-up", "continue"}
    halting = event.action in ("stop", "wait")  # the answer names whom we brake for anyway
    cause = _cause(asked) if able and (hurried or halting) and soon is None else None
    if hurried and cause is not None and cause.shown is not None and cause.shown.end is not None:
        cause, soon = None, asked.now  # the light that held us has just changed
    already = already and cause is None
    decided = soon is not None or cannot is not None or cause is not None
    open_ = able and not already and not decided
    reason = gentler or (_against(asked, event) if open_ else None)
    told = cause is None and gentler is None and (reason is None or event.action != "brake")
    facts = _instead(asked, event) if told else ()
    return Declined(act, able, ahead, now, already, cannot, soon, facts, cause, reason)


def _against(asked: Asked, event: Event) -> ChoiceReason | Options | Slowing | None:
    """Return what speaks against a request, if the record shows that without further rollouts."""
    braking = event.action == "brake"
    if not (macros(event) or braking) or event.action in ENDING:
        return None
    if (struck := barred(asked, macros(event))) is not None:
        return struck
    try:
        found = choices.why_not(replace(event, actor=Ego(), time=Now(), tense="present"), asked)
    except Unanswered:
        return None
    return found if isinstance(found, ChoiceReason) else None


def _asks_manner(act: Request) -> bool:
    """Check whether only the manner of driving is to change: "drive more gently"."""
    gentle = not GENTLE.isdisjoint(act.event.manner)
    return gentle and not act.negated and act.event.action in DRIVING | {"brake", "turn"}


def _paced(asked: Asked, event: Event) -> Event:
    """Read driving slowly past somebody, or somewhere, as a wish about our speed.

    Where we stand, it is a wish to drive on: "creep forward a bit".
    """
    if event.action in ("move", "go") and "slowly" in event.manner and stands(asked):
        return replace(event, action="go", manner=())
    if event.action in PACED and "slowly" in event.manner:
        return replace(event, action="slow-down", object=None, manner=())
    return event


def _braking(asked: Asked, event: Event) -> Event:
    """Take "brake a little" for braking, where we have not braked lately: no more gently."""
    since = max(asked.world.begin, asked.now - LATELY)
    if event.action != "brake" or asked.world.episodes(Ego(), ("brake",), since, asked.now):
        return event
    return replace(event, manner=tuple(m for m in event.manner if m not in GENTLE))


def _to_lane(event: Event) -> Event:
    """Read "go into the middle lane" as a wish to change lanes."""
    where = None if event.where is None else event.where.to
    lane = next((one for one in (event.object, where) if isinstance(one, Lane)), None)
    if event.action not in ("go", "move", "head") or lane is None or lane.which == "own":
        return event
    sides: dict[str, ActionName] = {"left": "change-left", "right": "change-right"}
    action = sides.get(lane.which, "change-lane")
    return replace(event, action=action, object=None, where=None)


def _meant(asked: Asked, event: Event, trend: str | None) -> bool:
    """Check whether the car does, or plans to do, what it is asked not to do."""
    if _doing(asked, event, trend):
        return True
    found = foreseen(asked, replace(event, actor=Ego(), manner=()))
    return found is not None and found.share >= 0.5


def _cause(asked: Asked) -> MotionCause | None:
    """Return for whom or what we slow down or stand now.

    Raises:
        Unanswered: rollouts are needed.
    """
    now = activity(asked, Ego(), asked.now)
    slowing = any(e.action in GENTLER and e.end is None for e in now.doing)  # however gently
    if now.trend not in ("standing", "slowing") and not slowing:
        return None
    name: ActionName = "stand" if now.trend == "standing" else "slow-down"
    try:
        found = motions.motion(Event(name, tense="present"), asked)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    causes = found.causes if isinstance(found, MotionReason) else ()
    # A light comes first, then other road users, then a bend or a limit.
    known = sorted(causes, key=lambda cause: (cause.kind != "light", cause.vehicle is None))
    return next((c for c in known if c.kind not in ("plan", "starting")), None)


def _instead(asked: Asked, event: Event) -> tuple[Measure, ...]:
    """Return measures that bear on a request: our speed, when we drive on, when we arrive."""
    action = sided(event)
    if action in SPEEDS or "fast" in event.manner or "slowly" in event.manner:
        return _speed(asked)
    if action in NEARNESS:
        to = event.object if isinstance(event.object, Vehicle) else None
        gap, headway = (asked.world.measure(a, Ego(), asked.now, to) for a in ("gap", "headway"))
        apart = () if to is None else known(asked.world.measure("distance", Ego(), asked.now, to))
        return (*known(gap), *known(headway)) or apart
    if action in ENDING:
        return known(asked.world.measure("arrival-time", Ego(), asked.now))
    if action in STARTS | {"continue"} and stands(asked):
        return known(remaining_wait(asked))
    return ()


def _speed(asked: Asked) -> tuple[Measure, ...]:
    found = speed_of(asked)
    return found.measures if isinstance(found, Measures) else ()


def _doing(asked: Asked, event: Event, trend: str | None) -> bool:
    """Check whether the car already does what it is asked to do."""
    action = sided(event)
    if action == "keep-distance":
        to = event.object if isinstance(event.object, Vehicle) else None
        kept = asked.world.measure("headway", Ego(), asked.now, to).value
        return kept is not None and kept >= KEPT
    if action in TREND:
        return trend == TREND[action]
    if action in HALTS:
        return stands(asked)
    if action in STAYING:
        return _stays(asked, event)
    if action in ("go", "move"):
        halting = foreseen(asked, Event("stop"))
        going = halting is None or halting.share < 0.5
        return not stands(asked) and going and not macros(event)
    if action == "head" and event.object is None:
        return False  # it is not known where to
    found = occasion(asked, replace(event, actor=Ego(), tense="present"))
    return found is not None and found.end is None


def _stays(asked: Asked, event: Event) -> bool:
    """Check whether the car plans to stay in its lane, behind the vehicle of the request."""
    moves = [foreseen(asked, Event(a)) for a in ("change-left", "change-right")]
    moving = max((f.share for f in moves if f is not None), default=0.0)
    whom = number(event.object)
    if whom is None or event.action != "follow":
        return moving < 0.5
    gap = asked.world.measure("gap", Ego(), asked.now, Vehicle(whom))
    look = asked.world.look(whom, asked.now)
    return moving < 0.5 and gap.value is not None and look is not None and look.ahead > 0.0


def _coming(asked: Asked, event: Event) -> float | None:
    """Return when [s] the plan does what is asked, if that is soon."""
    if sided(event) in ("continue", "do", "happen"):
        return None
    if sided(event) in STARTS and not stands(asked):
        return None
    found = foreseen(asked, replace(event, actor=Ego()))
    if found is None or found.share < 0.5 or found.moment > asked.now + SOON:
        return None
    return max(found.moment, asked.now)


def _cannot(asked: Asked, event: Event) -> str | None:
    """Return why the plan cannot do it, according to the last decision; None if it can."""
    trace = asked.ride.latest
    names = macros(event)
    options = {o.action for o in options_at(asked.ride, asked.now)}
    if not names or any(name in options for name in names):
        return None
    reasons = [n.reason for n in trace.not_applicable if not n.node and n.action in names]
    if len(names) > 1 and names[0] in TURNING:
        return ELSEWHERE
    if len(reasons) < len(names) and trace.under_way is None:
        return None
    return next(iter(reasons), None)
