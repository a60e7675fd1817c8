"""Supposing: what would have happened if we, or another vehicle, had acted otherwise."""

from msgspec import structs

from xavi_dialogue.domain.answers import Answer, CannotSay, Measures, SupposedOfOther, TooLittle
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Question, WhatIf, Whether, Why
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Is,
    Nobody,
    Proposition,
    Related,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.events.beliefs import least_sure
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.reading import (
    check_seen,
    event_of,
    is_own,
    manner_of,
    unwrapped,
)
from xavi_dialogue.explain.answers.ride.places import time_to_go
from xavi_dialogue.explain.answers.suppositions import reacting
from xavi_dialogue.explain.answers.suppositions.anybody import of_anybody
from xavi_dialogue.explain.answers.suppositions.forcing import forced
from xavi_dialogue.explain.answers.suppositions.freed import asks_pace, freed
from xavi_dialogue.explain.answers.suppositions.hastening import hastened
from xavi_dialogue.explain.answers.suppositions.jointly import Joint, is_absence, joint
from xavi_dialogue.explain.answers.suppositions.own_suppositions import (
    arrival,
    claimed,
    form_of,
    kept_ahead,
    of_us,
    stays_ahead,
    struck_in,
    undone,
    with_chance,
)
from xavi_dialogue.explain.answers.suppositions.supposed_when import (
    asks_when,
    driven,
    imagined,
    is_new,
    is_over,
    is_turn_ahead,
    moment,
    open_until,
    since_seen,
    was_done,
    without_at,
)
from xavi_dialogue.explain.answers.suppositions.undone import GOING, is_sooner, paced
from xavi_dialogue.explain.causes.driving.suppositions import (
    Supposed,
    is_faster,
    otherwise,
    share_of,
    together,
    within,
    without,
)
from xavi_dialogue.explain.causes.vehicles.actions import DRIVING, names_of, same
from xavi_dialogue.explain.causes.vehicles.conduct import conduct_names

PACED = frozenset[ActionName](("brake", "slow-down", "stop"))
LIKELY = 0.5  # minimum probability of an action that the ego is said to take


def what_if(question: WhatIf, scene: Asked) -> Answer:
    """Return the consequences of a supposition.

    Raises:
        Unanswered: it cannot be supposed; or it is what happened; or rollouts are needed.
    """
    form = form_of(question.then)
    several = joint(question.supposed, scene)
    if several is not None:
        if _asks_of_other(question.then):
            raise Unanswered(CannotSay("unsupported-condition"))
        return _of_several(question, scene, several)
    of, negated = unwrapped(question.supposed)
    if getattr(getattr(of, "thing", None), "described", None) and not negated:
        raise Unanswered(CannotSay("imagined"))
    if _is_free_road(of, negated=negated):
        free = Event("wait", tense="past", modal="would")
        return hastened(free, scene, "arrival" if form == "what-if" else form)
    somebody = of_anybody(of, scene, negated=negated)
    if somebody is not None and not isinstance(somebody, Happens):
        return somebody
    of = somebody or of
    of, negated = _mistaken(scene, of, negated=negated)
    event, vehicle = event_of(of), _whom(scene, of)
    if stays_ahead(event) and not negated:
        if asks_when(question.then) and event.tense in ("present", "future"):
            return Measures((time_to_go(scene, scene.now),))  # as planned: we follow
        of, negated = kept_ahead(event, form)
    if _asks_of_other(question.then):
        if negated and (found := freed(question.then, vehicle, scene)) is not None:
            return found
        if (made := forced(event, question.then, scene, negated=negated)) is not None:
            return made
        raise Unanswered(CannotSay("unsupported-condition"))
    if vehicle is not None:
        return _of_other(question, scene, of, vehicle, negated=negated)
    event = event or _faster(paced(of), question.then)
    if event is not None and isinstance(event.object, Vehicle) and "fast" in event.manner:
        form = "could"
    if event is None or not is_own(event.actor) or _is_beyond(event):
        raise Unanswered(CannotSay("unsupported-condition"))
    struck = struck_in(question.then)
    if negated:
        return with_chance(undone(event, scene, form, struck), struck, scene)
    asked = question.then.that if isinstance(question.then, Whether) else None
    event, scene = imagined(event, question.then, scene)
    found = with_chance(of_us(event, scene, form, struck), struck, scene)
    return claimed(found, asked)


def _is_beyond(event: Event) -> bool:
    """Check whether no plan has it: to be there, or get out, here; to brake sooner or later."""
    paced_else = event.action in PACED and manner_of(event, "early", "late") is not None
    shifted = event.action == "keep-lane" and event.side is not None  # "a bit more to the left"
    return event.action == "arrive" or paced_else or shifted


def _mistaken(
    scene: Asked, of: Proposition | None, *, negated: bool
) -> tuple[Proposition | None, bool]:
    """Read "if you were wrong about it" as that it does not do what is expected of it.

    One that breaks down stops; no plan shows what comes of a fault of our own.
    """
    if isinstance(of, Is) and of.state == "faulty" and not negated:
        if not isinstance(of.thing, Vehicle):
            raise Unanswered(CannotSay("unsupported-condition"))
        return Happens(Event("stop", of.thing, tense=of.tense)), negated
    if not isinstance(of, Is) or of.state != "wrong" or negated:
        return of, negated
    about = of.thing.number if isinstance(of.thing, Vehicle) else least_sure(scene, scene.moment)
    belief = None if about is None else scene.world.belief(about, scene.moment)
    if about is None or belief is None or not belief.expectations:
        return of, negated
    steps = belief.expectations[0].actions
    step = next((a for a in steps if a != "continue"), steps[0])
    return Happens(Event(step, Vehicle(about), tense=of.tense)), True


def _faster(event: Event | None, then: Question | None) -> Event | None:
    """Read "if you were faster, could you have gone before him?" as going before him."""
    asked = event_of(then.that) if isinstance(then, Whether) else None
    if event is None or asked is None or "fast" not in event.manner:
        return event
    if not is_own(asked.actor) or asked.object is None:
        return event
    return structs.replace(asked, modal="would", manner=(*asked.manner, "fast"))


def _asks_of_other(then: Question | None) -> bool:
    """Check whether the question is what another vehicle would have done; no plan shows that."""
    event = event_of(then.that) if isinstance(then, Whether) else None
    other = event is not None and isinstance(event.actor, Vehicle)
    return other and event is not None and event.action not in reacting.COLLIDING


def _is_free_road(of: Proposition | None, *, negated: bool) -> bool:
    """Check whether the supposition is that nobody, or no queue, had been in our way."""
    match of:
        case Exists(thing=Nobody(described=None)) | Related(thing=Nobody(described=None)):
            return not negated
        case Exists(thing=Feature(kind="queue" | "obstacle" | "light") | Everyone()):
            return negated
    return False


def _whom(scene: Asked, of: Proposition | None) -> int | None:
    match of:
        case Happens(event):
            return check_seen(scene, event.actor)
        case Exists(thing) | Related(thing=thing) | Is(thing=thing):
            return check_seen(scene, thing)
    return None


# --- of another -----------------------------------------------------------------------------------


def _of_other(
    question: WhatIf, scene: Asked, of: Proposition | None, vehicle: int, *, negated: bool
) -> Answer:
    event = event_of(of)
    if event is not None and event.then is not None and negated:  # "does not leave and goes round"
        event, negated = structs.replace(event.then, tense=event.tense), False
        of = Happens(event)
    if event is not None and event.then is not None and event.then.action in reacting.COLLIDING:
        event = structs.replace(event, action="cut-in", object=None, then=None)
        of = Happens(event)
    past = is_over(scene, of, question.then, _then(question.then), vehicle)
    if event is not None and event.action in reacting.COLLIDING:
        return closeness(scene, vehicle, Window(scene.now, scene.now), "hit", past=False)
    here = scene.moment if past else scene.now
    sudden = reacting.is_sudden
    if event is not None and sudden(event, question.then, scene, vehicle, here, negated=negated):
        return reacting.reaction(
            event, question.then, scene, vehicle, here, negated=negated, past=past
        )
    quick = manner_of(event, "fast", "slowly", "early", "late") is not None
    away = is_absence(of, negated=negated)
    if quick or (event is None and not negated and not away):  # nobody can be placed somewhere else
        topic = "imagined" if isinstance(of, Exists) else "unsupported-condition"
        raise Unanswered(CannotSay(topic))
    supposed = None if away else event
    if supposed is None and not past and asks_pace(question.then):
        return Measures((scene.world.measure("speed", Ego(), scene.now),))
    one = Joint((vehicle,), supposed, negated=negated)
    return _replanned(question, scene, one, past=past)


def _of_several(question: WhatIf, scene: Asked, several: Joint) -> Answer:
    """Return what we would have planned if several vehicles had acted otherwise, or were absent."""
    first, event = several.numbers[0], several.event
    content, _ = unwrapped(question.supposed)
    tense = content.tense if isinstance(content, Exists) else "present"  # "was gone" is about now
    gone = Exists(Vehicle(first), tense=tense)
    of = gone if event is None else Happens(event)
    past = is_over(scene, of, question.then, _then(question.then), first)
    return _replanned(question, scene, several, past=past)


def _replanned(question: WhatIf, scene: Asked, of: Joint, *, past: bool) -> SupposedOfOther:
    """Return what we would have planned if vehicles had acted otherwise, or were absent."""
    then, event = _then(question.then), of.event
    past = past and not is_turn_ahead(scene, then)
    drove = driven(scene, then)
    numbers, left = of.numbers, of.left_out
    later = None if event is not None or drove is None else since_seen(scene, drove, numbers)
    if later is not None and then is not None:  # it cannot have been for them before
        drove, then = later, structs.replace(then, action="slow-down")
    at = moment(scene, then, drove, past=past)
    if event is None:
        tried = None if drove is None else without_at(scene, drove, numbers)
        found = without(scene.ride, numbers, at) if tried is None else tried[0]
        still = _still(found, then, drove) if tried is None else tried[1]
        if drove is not None and tried is None and still:  # by another decision than explains it
            raise Unanswered(TooLittle("too-little-evidence"))
    else:
        at = open_until(scene, numbers[0], event, at) if past else at
        names, negated = conduct_names(event), of.negated
        both = together(scene.ride, numbers, names, at, negated=negated) if numbers[1:] else None
        if both is None:  # the record has no sample in which all of them do so
            numbers, left = numbers[:1], (*numbers[1:], *left)
        found = both or otherwise(scene.ride, numbers[0], names, at, negated=negated)
        if found.proxy is not None and not negated and event.action in ("brake", "slow-down"):
            event = structs.replace(event, action=found.proxy, manner=())
        still = _still(found, then, drove)
    new = then is not None and (not was_done(scene, then) if past else is_new(found, then))
    if past and new and then is not None and still:  # what the plan has not done yet stays in it
        still = not _comes_anyway(found, then)
    if still and "stop" in found.here.plan[:1] and "stop" not in found.there.plan[:1]:
        then, still = None, None  # we would stand, but not by choice: state the plan
    return SupposedOfOther(
        vehicle=numbers[0],
        supposed=event,
        negated=of.negated and event is not None,
        prior=found.prior,
        plan=found.here.plan,
        then=found.there.plan,
        same=found.same,
        contrast=found.contrast,
        within=within(scene.ride, found) if isinstance(question.then, Why) else None,
        past=past,
        asked=then,
        still=still,
        form=form_of(question.then),
        slows=_slows(found) if event is not None and not of.negated else None,
        faster=event is None and found.same and is_faster(found),
        arrival=arrival(scene, found.contrast),
        others=numbers[1:],
        left_out=left,
        everybody=of.everybody,
        undone=new,
    )


def _then(question: Question | None) -> Event | None:
    """Return the event of the question whether we would still have done something."""
    if isinstance(question, Whether):
        slow = question.that
        if isinstance(slow, Is) and slow.state == "slow" and is_own(slow.thing):
            return Event("slow-down", tense=slow.tense, modal="would")  # "would we still be slow"
        event = event_of(question.that)
        own = event is not None and is_own(event.actor)
        return event if own and not is_sooner(question) else None
    return None


def _still(found: Supposed, then: Event | None, driven: Episode | None) -> bool | None:
    """Check whether the event of the question would have come about."""
    if then is None:
        return None
    if then.action in GOING - DRIVING and then.side is None:
        standing = share_of(found.again, found.there, "stop")
        if standing is not None and standing >= LIKELY:
            return False
    names = names_of(then)
    if driven is not None or set(names) & DRIVING:
        name: ActionName = _mark(then.action, driven)
        share = share_of(found.again, found.there, name)
        return None if share is None else share >= LIKELY
    here, there = found.here.plan[:1], found.there.plan
    on = there[:1] == ("continue",) and not any(same(name, step) for name in names for step in here)
    return any(same(name, step) for name in names for step in there[: 2 if on else 1])


def _comes_anyway(found: Supposed, then: Event) -> bool:
    """Check whether the plan, as things were, leads to driving that way as well."""
    if not set(names_of(then)) & DRIVING:
        return False
    share = share_of(found.trace, found.here, _mark(then.action, None))
    return share is not None and share >= LIKELY


def _slows(found: Supposed) -> bool | None:
    """Check whether we would have to slow down for it, but do not as things are."""
    there = share_of(found.again, found.there, "slow-down")
    here = share_of(found.trace, found.here, "slow-down")
    if there is None or here is None:
        return None
    return there >= LIKELY > here


def _mark(action: ActionName, driven: Episode | None) -> ActionName:
    """Return the change of speed that shows a way of driving in a rollout."""
    if action in ("stop", "stand") or (driven is not None and driven.standing):
        return "stop"
    return "speed-up" if action == "speed-up" else "slow-down"
