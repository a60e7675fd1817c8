"""Supposing: what would have been if we, or another vehicle, had done otherwise."""

from dataclasses import replace

from msgspec import structs

from xavi_dialogue.domain.answers import (
    Answer,
    CannotSay,
    ChoiceReason,
    DidNotHappen,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Doing, Question, WhatIf, Whether
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Next,
    Now,
    Proposition,
    Related,
    Time,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers import choices, going, motions
from xavi_dialogue.explain.answers.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.closeness import closeness
from xavi_dialogue.explain.answers.foils import foil_at
from xavi_dialogue.explain.answers.moments import Window
from xavi_dialogue.explain.answers.reading import (
    check_seen,
    event_of,
    is_own,
    is_past,
    manner_of,
    subject,
    unwrapped,
)
from xavi_dialogue.explain.causes.actions import DRIVING, names_of, same
from xavi_dialogue.explain.causes.conduct import conduct_names, probability
from xavi_dialogue.explain.causes.contrast import SameAsPlan, against_best, contrast
from xavi_dialogue.explain.causes.natural import on_way
from xavi_dialogue.explain.causes.premise import happened, manoeuvre, premise
from xavi_dialogue.explain.causes.suppositions import (
    Supposed,
    known_to,
    otherwise,
    share_of,
    without,
)
from xavi_dialogue.explain.history.ride import ROUNDING, planned

POSSIBLE = 0.02  # probability from which it is open whether somebody does something
LIKELY = 0.5  # probability from which the ego is said to do something
GOING = frozenset[ActionName](("go", "move", "enter", "cross", "speed-up", "continue"))
#: States and relations of another vehicle that mean that it were not there, or gone.
ABSENT = ("present", "visible")


def what_if(question: WhatIf, scene: Asked) -> Answer:
    """Tell what would have been, or would be, under a supposition.

    Raises:
        Unanswered: it cannot be supposed; or it is what was; or rollouts are needed.
    """
    of, negated = unwrapped(question.supposed)
    vehicle = _whom(scene, of)
    if vehicle is not None:
        return _of_other(question, scene, of, vehicle, negated=negated)
    event = event_of(of)
    if event is None or not is_own(event.actor):
        raise Unanswered(CannotSay("unsupported-condition"))
    return _undone(event, scene) if negated else _of_us(event, scene)


def _whom(scene: Asked, of: Proposition | None) -> int | None:
    match of:
        case Happens(event):
            return check_seen(scene, event.actor)
        case Exists(thing) | Related(thing=thing) | Is(thing=thing):
            return check_seen(scene, thing)
    return None


# --- of us ----------------------------------------------------------------------------------------


def _of_us(event: Event, scene: Asked) -> Answer:
    """What would have come of another action of ours."""
    past = is_past(scene, event) or event.modal == "would"
    if event.action in GOING and (not _stopped(scene) or manner_of(event, "fast") is not None):
        return going.unslowed(event, scene)
    try:
        found, foil = foil_at(event, scene)
        against = contrast(scene.ride, found.trace, foil, found.node)
        against = on_way(found.trace, against, found.node)
    except SameAsPlan as same_:
        against = against_best(scene.ride, same_.trace)
        return SupposedOfUs(against, done=True, past=past)
    except Unanswered as unanswered:
        result = unanswered.result
        if isinstance(result, DidNotHappen) and result.instead:
            return _done(event, scene, past=past)
        raise
    nearest = event.action if event.action in ("brake", "slow-down") else None
    return SupposedOfUs(against, past=past, asked=nearest)


def _stopped(scene: Asked) -> bool:
    """Whether a stop was chosen, so that driving on was the other choice."""
    trace = scene.ride.at(scene.moment)
    return trace is not None and "stop" in planned(trace)[:1]


def _done(event: Event, scene: Asked, *, past: bool) -> Answer:
    """It is just what was done: with what else there was."""
    found = premise(scene.ride, replace(subject(scene, event), is_past=True))
    return SupposedOfUs(against_best(scene.ride, found.trace, found.node), done=True, past=past)


def _undone(event: Event, scene: Asked) -> Answer:
    """What would have been had we not done what we did: the best alternative."""
    names = names_of(event)
    if happened(scene.ride, names, scene.span) is None and set(names) & DRIVING:
        return going.unslowed(event, scene)  # no choice of its own
    reason = choices.why(event, scene)
    assert isinstance(reason, ChoiceReason)
    return SupposedOfUs(reason.contrast, past=reason.past)


# --- of another -----------------------------------------------------------------------------------


def _of_other(
    question: WhatIf, scene: Asked, of: Proposition | None, vehicle: int, *, negated: bool
) -> Answer:
    event = event_of(of)
    then = _then(question.then)
    driven = _driven(scene, then)
    past = _past(scene, event, then) and not _asks_now(question.then)
    moment = _moment(scene, then, driven, past=past)
    if event is not None and event.action in ("collide", "nearly-collide"):
        return closeness(scene, vehicle, Window(scene.now, scene.now), "hit", past=False)
    gone = _is_absence(of, negated=negated)
    if gone or event is None:
        found = without(scene.ride, vehicle, moment)
        supposed = None
    else:
        names = conduct_names(event)
        if past:
            moment = _open_until(scene, vehicle, event, moment)
        found = otherwise(scene.ride, vehicle, names, moment, negated=negated)
        supposed = event
        if found.proxy is not None and not negated and event.action in ("brake", "slow-down"):
            supposed = structs.replace(event, action=found.proxy, manner=())
    still = _still(scene, found, then, driven)
    return SupposedOfOther(
        vehicle=vehicle,
        supposed=supposed,
        negated=negated and supposed is not None,
        prior=found.prior,
        plan=found.here.plan,
        then=found.there.plan,
        same=found.same,
        contrast=found.contrast,
        past=past,
        asked=then,
        still=still,
    )


def _is_absence(of: Proposition | None, *, negated: bool) -> bool:
    match of:
        case Exists():
            return negated
        case Is(state=state):
            return negated and state in ABSENT
        case Related():
            return negated
        case Happens(event):
            return (event.action == "appear" and negated) or event.action == "disappear"
    return False


def _then(question: Question | None) -> Event | None:
    """What is asked of the supposed world: whether we would still have done something."""
    if isinstance(question, Whether):
        event = event_of(question.that)
        return event if event is not None and is_own(event.actor) else None
    return None


def _driven(scene: Asked, then: Event | None) -> Episode | None:
    """The episode of driving that is asked about, where it is one and no choice."""
    if then is None:
        return None
    if choices.is_choice(then) or happened(scene.ride, ("stop",), scene.span) is not None:
        return None
    for kinds in motions.KINDS.get(then.action, (motions.SLOWING,)):
        found = [e for e in scene.world.episodes(Ego(), kinds) if e.action in kinds]
        chosen = scene.pick(found, lambda e: (e.begin, e.end))
        if chosen is not None:
            return chosen
    return None


def _moment(scene: Asked, then: Event | None, driven: Episode | None, *, past: bool) -> float:
    """The time [s] of the decision that a supposition is about."""
    if driven is not None:
        return driven.begin  # once it is under way, planning again without its cause tells less
    if then is not None and choices.is_choice(then):
        try:
            return premise(scene.ride, subject(scene, then)).trace.sim_time
        except Unanswered:
            return scene.moment
    if past:
        deed = manoeuvre(scene.ride, scene.span)
        if deed is not None and deed.action != "continue":
            try:
                return scene.ride.choice_of(deed).sim_time
            except Unanswered:
                return deed.time
    return scene.moment


def _open_until(scene: Asked, vehicle: int, event: Event, moment: float) -> float:
    """The last time [s] up to a moment at which it was open whether a vehicle would do so.

    The moment itself where it never was: then it is planned again with what is supposed.
    """
    names = conduct_names(event)
    known = [trace for trace in known_to(scene.ride, vehicle, moment) if trace.sim_time <= moment]
    chances = [(t.sim_time, probability(scene.ride, t, vehicle, names)) for t in known]
    open_ = [time for time, chance in chances if POSSIBLE < chance < 1.0 - POSSIBLE]
    return open_[-1] if open_ else moment


def _still(
    scene: Asked, found: Supposed, then: Event | None, driven: Episode | None
) -> bool | None:
    """Whether what is asked about would have come about."""
    if then is None:
        return None
    names = names_of(then)
    if driven is not None or set(names) & DRIVING:
        name: ActionName = _mark(then.action, driven)
        share = share_of(found.again, found.there, name)
        return None if share is None else share >= LIKELY
    plan = found.there.plan[:2] if found.there.plan[:1] == ("continue",) else found.there.plan[:1]
    return any(same(name, step) for name in names for step in plan)


def _mark(action: ActionName, driven: Episode | None) -> ActionName:
    """The change of speed by which a way of driving is told in a rollout."""
    if action in ("stop", "stand") or (driven is not None and driven.standing):
        return "stop"
    return "speed-up" if action == "speed-up" else "slow-down"


def _past(scene: Asked, event: Event | None, then: Event | None) -> bool:
    """Whether it is supposed of what has been: "if he braked now" is not."""
    about = then or event
    if event is not None and _is_now(event.time, scene):
        return False
    if scene.past is not None:
        return True
    return about is not None and about.tense in ("past", "perfect")


def _asks_now(question: Question | None) -> bool:
    """Whether what is asked of the supposed world is what we would do, not have done."""
    return isinstance(question, Doing) and question.tense != "past"


def _is_now(time: Time, scene: Asked) -> bool:
    match time:
        case Now() | Next():
            return True
        case At(at):
            return at >= scene.now - ROUNDING
    return False
