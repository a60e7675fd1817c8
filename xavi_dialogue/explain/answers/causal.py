"""Causal: which explainer answers about reasons, suppositions and decisions."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    MotionReason,
    NeedRollout,
    Verdict,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import (
    Compare,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowSure,
    Listing,
    Peak,
    Question,
    WhatIf,
    WhatWouldChange,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Caused,
    Compares,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Measured,
    Nobody,
    Proposition,
    Related,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.explain.answers import owing, waiting
from xavi_dialogue.explain.answers.abandoned_plans import wavered
from xavi_dialogue.explain.answers.measuring.durations import compared_costs, stands
from xavi_dialogue.explain.answers.propositions import reasons, standing_rules
from xavi_dialogue.explain.answers.reasons import choices, knowing, suspects
from xavi_dialogue.explain.answers.reasons.provoked import because_of_us, brakes_for
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import window
from xavi_dialogue.explain.answers.reference.reading import (
    is_own,
    numbers_in,
    unwrapped,
    vehicle_in,
)
from xavi_dialogue.explain.answers.ride.delays import held_up
from xavi_dialogue.explain.answers.suppositions import deciding, possible, risks
from xavi_dialogue.explain.answers.suppositions.listing import closest_choice, how_decide, listed
from xavi_dialogue.explain.answers.suppositions.undone import is_undone
from xavi_dialogue.explain.history.thresholds import HARD

Explainer: TypeAlias = Callable[[Any, Asked], Answer]

#: Explainers by type of question alone.
QUESTIONS: Mapping[type, Explainer] = {
    Why: reasons.why,
    WhatIf: risks.what_if,
    HowKnow: knowing.how_know,
    HowSure: knowing.how_sure,
    HowDecide: how_decide,
    WhatWouldChange: deciding.what_would_change,
    HowAvoid: deciding.how_avoid,
}
NEEDED = frozenset(("necessary", "worth-it", "better"))
LISTED = frozenset(("options", "rivals"))
#: Actions of ours that are for something or somebody.
HELD = frozenset(("wait", "slow-down", "brake", "stop", "stand", "give-way", "let-go"))
SLOWED = frozenset(("brake", "slow-down", "stop", "wait"))
RULED = frozenset(("give-way", "let-go", "wait"))
REASONS = frozenset(("causes", "reasons"))


def explainer(question: Question, scene: Asked) -> Explainer | None:
    """Find the explainer of a causal question; None if the question is about facts only."""
    match question:
        case Whether(Both(join="or")):
            return None
        case Whether(that):
            return _of_whether(that, scene)
        case Why(of=Happens(event=event) | Is(state="allowed", event=Event() as event)) if (
            "first" in event.manner
            and event.action == "go"
            and isinstance(event.actor, Vehicle | Vehicles | Everyone)
        ):
            return owing.before_us
        case Why(suspect=None) | HowKnow() if owing.asks_rule(question):
            return owing.why_rule
        case Why(of=of, suspect=None, instead=None) if owing.is_owed(of):
            return owing.why_owed
        case Why(of=Happens(event=event), suspect=Ego()) if event.action in HELD and isinstance(
            event.actor, Vehicle
        ):
            return because_of_us
        case Why(of=Happens(event=Event(action="change-plan", actor=Ego())), suspect=None):
            return wavered
        case Which(
            such=Happens(Event("collide", Ego(), Wanted(), tense="present"))
            | Is("dangerous", Wanted(), None, tense="present")
        ):
            return risks.who
        case Which(such=Compares(Measured("delay", Wanted()))) if _names_several(question):
            return compared_costs
        case Which(thing, such) if _holds_us_up(such) and _over_the_ride(thing, such):
            return _who_held_up
        case Which(Wanted() | Vehicles(), such) if _holds_us_up(such):
            return waiting.what_for
        case HowKnow(Is(state="safe" | "possible", event=Event() as event)) if is_own(event.actor):
            return _why_safe
        case HowKnow(Happens(Event(actor=Ego(), where=Related("with", to=Vehicle())))):
            return _why_safe
        case WhatIf() if standing_rules.supposes_walker(question):
            return standing_rules.supposed
        case Which(such=such) if such is not None and isinstance(unwrapped(such)[0], Caused):
            return _who_caused
        case Compare(options) if options and all(_is_option(option) for option in options):
            return deciding.compared
        case Peak("choice"):
            return closest_choice
        case Listing(of) if of in LISTED:
            return listed
        case Listing(of) if of in REASONS:
            return _reasons
    return QUESTIONS.get(type(question))


def _names_several(question: Which) -> bool:
    """Check whether a question names several vehicles."""
    return len({n for of in (question.thing, *question.among) for n in numbers_in(of)}) > 1


def _holds_us_up(such: Proposition | None) -> bool:
    """Check whether the question is for what or whom we wait, slow down, stop or give way."""
    of, negated = unwrapped(such)
    if isinstance(of, Is) and not negated:
        return of.state in ("stuck", "stationary") and is_own(of.thing)
    if isinstance(of, Compares) and isinstance(of.left.thing, Wanted):
        return of.left.attribute == "delay"
    if not isinstance(of, Happens) or negated:
        return False
    event = of.event
    if event.modal == "must" and event.tense == "present" and event.action in RULED:
        return False  # the rule of the road answers that
    if event.action == "block":
        return isinstance(event.actor, Wanted) and is_own(event.object)
    return is_own(event.actor) and event.action in HELD and isinstance(event.object, Wanted)


def _over_the_ride(thing: object, such: Proposition | None) -> bool:
    """Check whether the question is about all who held us up: "which vehicles", or "so far"."""
    of, _ = unwrapped(such)
    asked = of.left if isinstance(of, Compares) else of.event if isinstance(of, Happens) else None
    if asked is None or (isinstance(asked, Event) and asked.action != "block"):
        return False
    several = isinstance(thing, Vehicles) and asked.tense != "present"
    return isinstance(asked.time, WholeRide) or several


def _who_held_up(question: Which, scene: Asked) -> Answer:
    """Return who held us up, and when."""
    of, _ = unwrapped(question.such)
    time = of.left.time if isinstance(of, Compares) else getattr(of, "event", Event("block")).time
    time = WholeRide() if isinstance(time, Unsaid) else time
    return held_up(scene, window(scene, time, "past"))


def _why_safe(question: HowKnow, scene: Asked) -> Answer:
    """Return why we considered an action of ours safe: the reason for it at that time."""
    return reasons.why(Why(question.of or Is("safe")), scene)


def _of_whether(that: Proposition, scene: Asked) -> Explainer | None:
    of, negated = unwrapped(that)
    if isinstance(of, Caused):
        return _was_cause
    if isinstance(of, Happens) and not negated and _slowed_for_anybody(of.event):
        return _for_anybody
    if not negated and _slowed_for(of, scene):
        return _slowed_because
    braking = None if negated else brakes_for(of, scene)
    if braking is not None:
        return lambda *_: braking
    if not negated and standing_rules.at_crossing(of):
        return standing_rules.whether
    if possible.is_could(of):
        return possible.could
    if possible.is_must(of) and not _on_our_way(of):
        return possible.must
    if isinstance(of, Is) and of.state == "right" and not negated:
        return deciding.needed if of.event is not None and is_own(of.event.actor) else None
    if isinstance(of, Is) and of.state == "wrong" and of.event is not None:
        ours = is_own(of.event.actor) and choices.is_choice(of.event)
        return deciding.needed if ours else None
    if isinstance(of, Is) and of.state in NEEDED:
        if of.state == "worth-it" and of.event is not None and is_undone(of.event, scene):
            return _was_cause
        about_us = of.event is None or is_own(of.event.actor)
        if not about_us and of.state == "worth-it":
            return _worth
        return deciding.needed if about_us and is_own(of.thing) else None
    return None


def _on_our_way(of: Proposition | None) -> bool:
    """Check whether the question is which way we must go from here; our route answers that."""
    if not isinstance(of, Happens) or of.event.tense != "present" or not is_own(of.event.actor):
        return False
    turning = of.event.action in ("turn", "exit-left", "exit-right", "exit-straight")
    return turning and not isinstance(of.event.object, Vehicle)


def _worth(question: Whether, scene: Asked) -> Answer:
    """Return whether it was worth it; if another vehicle is named, our own action is meant."""
    of, _ = unwrapped(question.that)
    tense = of.tense if isinstance(of, Is) else "past"
    return deciding.needed(Whether(Is("worth-it", tense=tense)), scene)


def _slowed_for(of: Proposition | None, scene: Asked) -> bool:
    """Check whether the question is if we slowed for somebody, and we did slow for any reason."""
    if not isinstance(of, Happens) or not is_own(of.event.actor):
        return False
    event = of.event
    if event.action not in SLOWED or vehicle_in(event.object) is None:
        return False
    try:
        found = _because_of(event, scene)
    except Unanswered as unanswered:
        return isinstance(unanswered.result, NeedRollout)
    # What we do for another reason does not show what we will do for them.
    if getattr(found, "suspected", None) != "none":
        return True
    ruled = owing.must_let(event, scene)  # the rule of the road answers that
    return not ruled and (event.tense != "future" or stands(scene))


def _slowed_for_anybody(event: Event) -> bool:
    """Check whether the question is if we slowed for anybody at all."""
    done = event.tense in ("past", "perfect") and event.modal is None
    ours = is_own(event.actor) and event.action in SLOWED
    return done and ours and isinstance(event.object, Nobody)


def _for_anybody(question: Whether, scene: Asked) -> Answer:
    """Return why we slowed, which tells for whom.

    Raises:
        Unanswered: we did not slow; or the record lacks it; or rollouts are needed.
    """
    of, _ = unwrapped(question.that)
    assert isinstance(of, Happens)
    return reasons.why(Why(Happens(replace(of.event, object=None))), scene)


def _slowed_because(question: Whether, scene: Asked) -> Answer:
    """Return the reason why we slowed, with a verdict on those whom the question names."""
    of, _ = unwrapped(question.that)
    assert isinstance(of, Happens)
    found = _because_of(of.event, scene)
    if "hard" in of.event.manner and isinstance(found, MotionReason):
        deed = found.deed
        if deed.peak is not None and deed.peak < HARD:
            most = Measure("deceleration", Ego(), deed.begin, value=deed.peak, until=deed.end,
                           extreme="highest")  # fmt: skip
            return Verdict(that=Happens(replace(of.event, object=None)), holds=False, facts=(most,))
    if of.event.tense == "future" and getattr(found, "suspected", None) == "none":
        return replace(found, suspect=None, suspected=None)  # we stand already
    return found


def _because_of(event: Event, scene: Asked) -> Answer:
    """Return why we slow or stand, with a verdict on those that an event names.

    Raises:
        Unanswered: we do not; or the record lacks it; or rollouts are needed.
    """
    others = event.object.numbers if isinstance(event.object, Vehicles) else ()
    tense = "present" if event.tense == "future" else event.tense
    action = event.action
    if event.tense in ("future", "present") and action in ("stop", "wait"):
        action = "stand" if stands(scene) else "slow-down"
    plain = Happens(replace(event, action=action, object=None, tense=tense))
    first = Vehicle(others[0]) if others else event.object
    found = reasons.why(Why(plain, suspect=first), scene)
    if not isinstance(found, ChoiceReason | MotionReason) or found.suspected != "none":
        return found
    named = [vehicle for vehicle in suspects.blamed(found) if vehicle in others]
    if named:
        return suspects.with_suspect(found, named[0])
    return replace(found, besides=others[1:])


def _is_option(option: object) -> bool:
    return isinstance(option, Happens) and is_own(option.event.actor)


def _was_cause(question: Whether, scene: Asked) -> Answer:
    """Return the reason for what the question says: of an event, with a verdict on its cause."""
    return reasons.why(Why(question.that), scene)


def _who_caused(question: Which, scene: Asked) -> Answer:
    """Return the reason of an event, for a question about the vehicle that caused it."""
    of, _ = unwrapped(question.such)
    assert isinstance(of, Caused)
    found = reasons.why(Why(of), scene)
    among = tuple(number for thing in question.among for number in numbers_in(thing))
    return suspects.with_suspects(found, among, which=True) if len(among) > 1 else found


def _reasons(question: Listing, scene: Asked) -> Answer:
    """Return the reasons of the action discussed, or of the last manoeuvre."""
    del question
    return choices.why(None, scene)
