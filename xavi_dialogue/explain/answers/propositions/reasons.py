"""Reasons: answers to "why?" about our choices, how we drive, states, and others."""

from msgspec import structs

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    DidNotHappen,
    MotionReason,
    NeedRollout,
    NotApplicable,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.domain.meaning import HowAvoid, Why
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Believed,
    Caused,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Proposition,
    Related,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName, Attribute, State
from xavi_dialogue.explain.answers.expectations.plans import is_halting
from xavi_dialogue.explain.answers.propositions import standings
from xavi_dialogue.explain.answers.reasons import (
    choices,
    going,
    motions,
    nobody_else,
    not_going,
    others,
    refraining,
    signalling,
)
from xavi_dialogue.explain.answers.reasons.suspected import of_suspects, road_last
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window, window
from xavi_dialogue.explain.answers.reference.reading import (
    check_able,
    check_seen,
    event_of,
    is_own,
    is_past,
    manner_of,
    unwrapped,
    vehicle_in,
)
from xavi_dialogue.explain.answers.ride import onward
from xavi_dialogue.explain.answers.ride.delays import held_up
from xavi_dialogue.explain.answers.ride.priority import priority_at
from xavi_dialogue.explain.answers.suppositions import deciding, undone
from xavi_dialogue.explain.answers.suppositions.own_suppositions import of_us
from xavi_dialogue.explain.causes.plans.terms import RISK

GOING = frozenset[ActionName](("go", "move", "enter", "cross", "pass", "come", "approach"))
ONWARD = frozenset[ActionName](("go", "move", "continue"))  # what a stop puts off
#: Names for moving in between others: by a lane change, or by a turn into a road.
JOINING = frozenset[ActionName](("cut-in", "pull-out", "merge", "enter"))
CHANGING = frozenset[ActionName](("change-left", "change-right", "change-lane"))
CROSSINGS = frozenset[ActionName](
    ("turn", "exit-left", "exit-right", "exit-straight", "continue-next-exit", "leave")
)
SLOW = frozenset[State](("slow", "late", "stuck", "stationary"))
#: Actions of somebody who stays in their lane.
KEEPING = frozenset[ActionName](
    ("follow", "keep-distance", "approach", "keep-lane", "wait", "stand", "move", "slow-down")
)
#: Actions that somebody with priority need not take.
YIELDING = frozenset[ActionName](
    ("stop", "wait", "give-way", "let-go", "slow-down", "brake", "stand")
)
HOLDING = frozenset[ActionName](("follow", "keep-distance", "approach"))
#: States of what we could do, which its risk decides first.
WEIGHED = frozenset[State](("safe", "dangerous", "worth-it"))
#: Durations of ours that are explained by waiting.
LASTING = frozenset[Attribute](("duration", "delay", "waiting-time"))


def why(question: Why, scene: Asked) -> Answer:
    """Return why something is or was so.

    Raises:
        Unanswered: it was not so; or the record lacks it; or rollouts are needed.
    """
    if question.suspect == SOMEBODY_ELSE:
        return nobody_else.mattered(scene, why(structs.replace(question, suspect=None), scene))
    question = road_last(question)
    of, negated = unwrapped(question.of)
    blamed = check_seen(scene, question.suspect)
    of_causes = question.suspect is not None or isinstance(of, Caused)
    if isinstance(of, Caused):
        blamed = blamed or check_seen(scene, of.cause)
        of, negated = unwrapped(of.effect) if of.effect is not None else (None, negated)
    found = _why(of, scene, question, negated=negated)
    if of_causes and isinstance(found, ChoiceReason | MotionReason):
        found = structs.replace(found, of_causes=True)
    return of_suspects(found, question, blamed, scene)


def _why(of: Proposition | None, scene: Asked, question: Why, *, negated: bool) -> Answer:
    match of:
        case Happens(event) if not negated and _goes_first(event):
            past = scene.past or Span(scene.now, scene.now)
            return priority_at(scene, vehicle_in(event.actor), Window(past.begin, past.end))
        case Related("has-priority-over", thing) if vehicle_in(thing) is not None:
            past = scene.past or Span(scene.now, scene.now)
            return priority_at(scene, vehicle_in(thing), Window(past.begin, past.end))
        case Happens(event) if negated and (rule := _need_not(event, scene)) is not None:
            return rule
        case Happens(event) if not is_own(event.actor) and vehicle_in(event.actor) is not None:
            return others.why(event, scene, negated=negated)
        case Happens(event):
            return own_not(event, scene, question) if negated else own(event, scene, question)
        case Is():
            return _state(of, scene, question, negated=negated)
        case Related("on", Ego(), Lane("left" | "right" as side)) if negated:
            change: ActionName = "change-left" if side == "left" else "change-right"
            return own_not(Event(change, time=of.time, tense=of.tense), scene, question)
        case Related():
            return standings.related(of, scene)
        case Compares(Measured("speed", thing, tense=tense), "less" | "same") if (
            not negated and vehicle_in(thing) is not None
        ):  # "why is he slower than us?", "why does the lorry drive only 80?"
            return _state(Is("slow", thing, tense=tense), scene, question, negated=False)
        case Compares(left=left) if motions.is_our_speed(of):
            ahead = of.comparator == "more" and is_own(left.thing)
            behind = of.comparator == "less" and not is_own(left.thing)
            return motions.fast(scene) if ahead or behind else motions.slow(scene)
        case Compares(left=Measured(attribute="duration", time=WholeRide() as whole)):
            return held_up(scene, window(scene, whole, "past"), lights=True)
        case Compares(left=left) if left.attribute in LASTING and vehicle_in(left.thing) is None:
            return motions.motion(Event("wait", tense=left.tense, time=left.time), scene)
        case Compares(left=left) if left.attribute in ("gap", "headway", "distance"):
            return motions.slow(scene, "close")
        case Has(attribute="lane") if is_own(of.thing):
            return choices.in_lane(scene)
        case Has(attribute="indicator" | "brake-lights"):
            return standings.signalling(of, scene)
        case Believed(content):
            return others.believed(content, scene)
        case Exists():
            return standings.fact(of, scene)
    return choices.why(None, scene)


def _goes_first(event: Event) -> bool:
    """Check whether another vehicle is said to go first, so that right of way is the reason."""
    going = event.action in GOING and manner_of(event, "first") is not None
    return going and vehicle_in(event.actor) is not None


def _need_not(event: Event, scene: Asked) -> Answer | None:
    """Answer why another vehicle does not stop or give way, if it has priority; else None."""
    vehicle = None if is_own(event.actor) else vehicle_in(event.actor)
    if vehicle is None or event.action not in YIELDING:
        return None
    past = scene.past or Span(scene.now, scene.now)
    try:
        rule = priority_at(scene, vehicle, Window(past.begin, past.end))
    except Unanswered:
        return None
    return rule if rule.rule == "give-way" else None


def own(event: Event, scene: Asked, question: Why | None = None) -> Answer:
    """Return why we did something, or drove in some way.

    Raises:
        Unanswered: we did not; or the record lacks it; or rollouts are needed.
    """
    check_able(event)
    going.check_moving(event, scene)
    if event.action in ("collide", "nearly-collide"):
        return deciding.how_avoid(HowAvoid(Happens(event)), scene)  # nobody decides to collide
    if (lane := motions.along_lane(event, scene)) is not None:
        return lane
    event = going.sideways(event, scene)
    instead = None if question is None else question.instead
    if event.action in GOING | {"continue"}:
        if manner_of(event, "suddenly") is not None and manner_of(event, "slowly") is not None:
            return motions.motion(event, scene, asked="slow-down")
        if manner_of(event, "slowly") is not None:
            return motions.standing_or_slow(scene, event)
        if manner_of(event, "fast") is not None:
            return motions.fast(scene)
    other = event_of(instead)
    if other is not None and event.action in CHANGING and other.action in KEEPING:
        instead = Happens(Event("keep-lane"))  # "rather than slow down behind him"
        other = event_of(instead)
    if other is not None and other.action in ONWARD and event.action in ("stop", "wait"):
        instead = other = None  # the reason for a stop names what it puts off
    if other is not None and choices.is_kept_from(other, event, KEEPING):
        return choices.why_not(structs.replace(other, tense=event.tense), scene)
    if event.action == "signal":
        return signalling.why_signal(event.side, scene, past=is_past(scene, event))
    blamed = question is not None and question.suspect is not None
    if not blamed and (past_it := refraining.not_passed(event, scene)) is not None:
        return past_it
    if event.action in HOLDING:
        return motions.slow(scene, manner_of(event, "close", "far") or "slowly", event)
    if event.action == "continue" and not is_past(scene, event):
        return choices.straight(scene)
    if event.action == "keep-lane":
        return choices.in_lane(scene)
    ahead = event.where is not None and event.where.relation == "ahead-of"
    ahead |= vehicle_in(event.object) is not None
    if event.action in JOINING or (ahead and event.action in CROSSINGS):
        return _joined(event, scene, instead)
    if event.action in not_going.WAY and not_going.tells_way(event):  # the way that we take
        return choices.why(structs.replace(event, action="do"), scene, instead)
    if event.action in CROSSINGS and manner_of(event, "suddenly", "early", "late") is not None:
        return going.went(event, scene)
    if event.action in GOING:
        return going.went(event, scene)
    if instead is not None and not choices.is_choice(event):
        foil = event_of(instead)
        if foil is not None and choices.is_choice(foil):
            return choices.why_not(foil, scene)
    if not choices.is_choice(event) or event.action in ("block", "avoid"):
        return motions.motion(event, scene)
    return choices.why(event, scene, instead)


def _joined(event: Event, scene: Asked, instead: Proposition | None) -> Answer:
    """Return why we moved in, pulled out or entered a road: by a lane change, or at a junction."""
    other = event.object if event.where is None else event.where.to
    if vehicle_in(other) is not None and going.crossed(scene) is not None:
        return going.went(structs.replace(event, action="go", object=other, where=None), scene)
    crossed = going.crossed(scene)
    try:
        found = choices.why(event, scene, instead)
    except Unanswered as unanswered:
        if not isinstance(unanswered.result, DidNotHappen) or crossed is None:
            raise
        return going.went(structs.replace(event, action="go"), scene)
    deed = found.deed if isinstance(found, ChoiceReason) else None
    if event.action == "cut-in" or deed is None or crossed is None:
        return found
    later = deed.begin < crossed.time <= scene.moment  # the later one is meant
    return going.went(structs.replace(event, action="go"), scene) if later else found


def _by_latest(found: Answer, scene: Asked) -> Answer:
    """Use the decision in force as evidence for what goes on, because it weighed the foil."""
    if not isinstance(found, MotionReason):
        return found
    return structs.replace(found, evidence=Evidence(traces=(scene.ride.latest.trace_id,)))


def _is_risky(event: Event, scene: Asked) -> bool:
    """Check whether what we did not do has a risk, which the answer states first."""
    try:
        found = choices.why_not(event, scene)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return False
    return isinstance(found, ChoiceReason) and found.contrast.collision >= RISK


def own_not(event: Event, scene: Asked, question: Why | None = None) -> Answer:
    """Return why we did not do something, or do not.

    Raises:
        Unanswered: we did; or it was not possible; or the record lacks it; or rollouts are needed.
    """
    check_able(event)
    if (stays := onward.stays_on(scene, event)) is not None:
        return stays
    if event.then is not None and event.then.action in JOINING | CHANGING:
        return not_going.not_joining(structs.replace(event.then, tense=event.tense), scene, None)
    if event.action == "speed-up" or manner_of(event, "fast") is not None:
        return motions.standing_or_slow(scene)
    halts = event.action == "stop" and event.tense == "present" and is_halting(scene)
    if halts and not _is_risky(event, scene):
        return _by_latest(own(Event("brake", tense="present"), scene), scene)
    if event.action in GOING:
        return not_going.not_going(event, scene)
    if refraining.is_refraining(event):
        return refraining.refrained(event, scene)
    left = refraining.left_lane(event, scene)
    if left is not None:
        return choices.why_not(Event("keep-lane"), scene, left)
    instead = None if question is None else event_of(question.instead)
    if event.action in JOINING:
        return not_going.not_joining(event, scene, instead)
    try:
        return choices.why_not(event, scene, instead)
    except Unanswered as unanswered:
        thin = unanswered.result
        if event.action not in ("overtake", "pass") or not isinstance(thin, NotApplicable):
            raise
        raise Unanswered(structs.replace(thin, overtaking=True)) from None


def _undone(event: Event, state: State, scene: Asked) -> Answer:
    """Return what speaks against something that we do not do: its risk, if it has one."""
    choice = event.action not in undone.GOING
    if choice and (state == "worth-it" or _is_risky(event, scene)):
        return own_not(event, scene)
    forms: dict[State, Asking] = {"safe": "safe", "dangerous": "dangerous"}
    return of_us(event, scene, forms.get(state, "better"))


def _state(of: Is, scene: Asked, question: Why, *, negated: bool) -> Answer:
    if of.event is not None and of.state in WEIGHED and undone.is_undone(of.event, scene):
        return _undone(of.event, of.state, undone.of_now(of.event, scene))
    if of.event is not None and of.state in ("necessary", "worth-it", "better", "right"):
        return choices.needed(of.event, scene)
    if of.event is not None and is_own(of.event.actor):
        return own(of.event, scene, question)
    vehicle = vehicle_in(of.thing)
    still = (of.state == "moving") if negated else (of.state == "stationary")
    if still and of.tense == "present" and is_own(of.thing or Ego()) and vehicle is None:
        moving = not_going.moving_on(scene)
        if moving is not None:
            return moving
    if of.state in ("moving", "fast") and negated and vehicle is None:
        return motions.standing_or_slow(scene, Event("move", tense=of.tense))
    if of.thing is not None and vehicle is not None and of.state in SLOW | {"moving", "fast"}:
        still = of.state in ("stationary", "stuck") or (negated and of.state == "moving")
        action: ActionName = "stand" if still else "slow-down"
        event = Event(action, of.thing, tense=of.tense)
        if of.state == "slow" and scene.past is None and not others.slows(scene, vehicle):
            return others.slowly(scene, vehicle)
        return others.why(event, scene, negated=False)
    if of.state in SLOW and is_own(of.thing):
        if of.tense == "present" and motions.is_slowing(scene):
            return motions.motion(Event("slow-down", tense="present"), scene)
        return motions.standing_or_slow(scene, Event("move", tense=of.tense))
    if of.state == "fast" and is_own(of.thing):
        return motions.fast(scene)
    if of.state in ("close", "far"):
        return motions.slow(scene, "close" if of.state == "close" else "far")
    return standings.fact(of, scene)
