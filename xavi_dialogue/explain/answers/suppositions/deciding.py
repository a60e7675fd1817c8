"""Deciding: options, comparisons, need, what would change a decision, how to avoid things."""

import dataclasses
from typing import Literal

from msgspec.structs import replace

from planner.record.trace import Action as MacroAction
from sim.scene import EGO
from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Compared,
    Contrast,
    DecisiveFactor,
    DidNotHappen,
    MotionCause,
    MotionReason,
)
from xavi_dialogue.domain.meaning import Compare, HowAvoid, Listing, WhatWouldChange, Whether
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import Ego, Event, Happens, Is, Proposition, Thing
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import choices, motions
from xavi_dialogue.explain.answers.reference import foils
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import (
    event_of,
    foil_subject,
    subject,
    unwrapped,
)
from xavi_dialogue.explain.answers.suppositions.listing import listed, margin
from xavi_dialogue.explain.answers.suppositions.own_suppositions import of_us
from xavi_dialogue.explain.answers.suppositions.undone import is_paced_turn
from xavi_dialogue.explain.causes.plans import avoidance, decisive_factor, options
from xavi_dialogue.explain.causes.plans.contrast import contrast
from xavi_dialogue.explain.causes.plans.premise import Premise, about_foil, premise
from xavi_dialogue.explain.causes.vehicles.actions import (
    DRIVING,
    STRAIGHT,
    is_macro,
    names_of,
    same,
    to_macros,
)
from xavi_dialogue.explain.causes.vehicles.course import hard_braking
from xavi_dialogue.explain.history.ride import planned

EQUAL = 0.25  # [s] maximum difference in value of two options that count as equal
#: Merits by which a single option is compared with the decision.
FORMS: dict[str, Asking] = {"safety": "safer", "best": "better"}
LEAST: dict[str, Asking] = {"safety": "riskier", "best": "worse"}
EVEN = 0.01  # maximum difference in the probability of a collision that counts as none


def needed(question: Whether, scene: Asked) -> Answer:
    """Answer whether what we did was necessary, worth it, or better than the alternative.

    Raises:
        Unanswered: we did not do it; or the record lacks it; or rollouts are needed.
    """
    of, _ = unwrapped(question.that)
    event = of.event if isinstance(of, Is) else event_of(of)
    state = of.state if isinstance(of, Is) else "necessary"
    if event is not None and isinstance(of, Is) and of.tense == "past":
        event = replace(event, tense="past")
    if event is not None and event.action in ("go", "move") and "fast" in event.manner:
        return motions.fast(scene)
    form: choices.Form = "necessary" if state == "necessary" else "worth-it"
    if state == "wrong":
        form = "mistaken"
    if event is not None and not choices.is_choice(event):
        found = _moved(event, scene)
        if isinstance(found, MotionReason):
            return replace(found, form="necessary")
        return found
    return choices.needed(event, scene, form)


def _moved(event: Event, scene: Asked) -> Answer:
    """Return why we drove in some way, at the time named; without one, whenever we did.

    Raises:
        Unanswered: we did not; or rollouts are needed.
    """
    try:
        return motions.motion(event, scene)
    except Unanswered as unanswered:
        said = scene.past is not None and scene.past.said
        if said or not isinstance(unanswered.result, DidNotHappen):
            raise
        return motions.motion(event, dataclasses.replace(scene, span=None))


def compared(question: Compare, scene: Asked) -> Answer:
    """Compare two options of ours by a measure, or what was done with what was not.

    Raises:
        Unanswered: an option was not possible; or the record lacks it; or rollouts are needed.
    """
    named = [option for option in question.options if _own_event(option) is not None]
    events = [event for option in named if (event := _own_event(option)) is not None]
    if not events:
        return listed(Listing("options"), scene)
    if len(events) == 1 and is_paced_turn(events[0]):
        return of_us(replace(events[0], tense="past"), scene, "quicker")
    kept = events[0].action == "keep-lane"  # going straight on is another action then
    plain = kept or events[0].action == "go" or not _was_done(scene, events[0])
    single = len(question.options) == 1 and plain
    if single and question.by in ("time", "speed", "best", "safety"):
        form: Asking = FORMS.get(question.by, "quicker")
        if question.least:
            form = LEAST.get(question.by, "slower")
        return of_us(replace(events[0], tense="past"), scene, form)
    if question.by == "margin" and (apart := margin(scene, events)) is not None:
        return apart
    found, fact, foil = _sides(scene, events)
    ride = scene.ride
    against = contrast(ride, found.trace, foil, found.node)
    first, second = _named(named, events, fact, foil)
    better = _better(question.by, against, swapped=not _is_fact(events[0], fact))
    return Compared(question.by, first, second, better, contrast=against)


def what_would_change(question: WhatWouldChange, scene: Asked) -> Answer:
    """Return what would have made us decide otherwise, or what mattered most.

    Raises:
        Unanswered: we did not do it; or the record lacks it; or rollouts are needed.
    """
    of, negated = unwrapped(question.of)
    event = event_of(of)
    if question.most:
        return _factor(event, scene, negated=negated)
    ride = scene.ride
    if event is not None and not choices.is_choice(event) and not negated:
        found_motive = _motive(event, scene)
        if not isinstance(found_motive, ChoiceReason):  # it was a choice
            return found_motive
        event = None
    if event is not None and (negated or not _was_done(scene, event)):
        found, foil = foils.foil_at(event, scene)
        return decisive_factor.towards(ride, found, foil)
    if event is None:
        return decisive_factor.otherwise(ride, options.in_force(ride, scene.moment))
    return decisive_factor.otherwise(ride, options.free(ride, premise(ride, subject(scene, event))))


def how_avoid(question: HowAvoid, scene: Asked) -> Answer:
    """Return which option would have avoided what happened, or that none would.

    Raises:
        Unanswered: it did not happen; or the record lacks the decisions before it.
    """
    of, _ = unwrapped(question.of)
    event = event_of(of)
    if event is not None and choices.is_choice(event) and event.action not in ("collide", "avoid"):
        return choices.needed(event, scene)
    mishap, moment = _mishap(scene, event)
    found = avoidance.avoiding(scene.ride, mishap, moment)
    crash = avoidance.crashed(scene.ride)
    if mishap == "collide" and crash is not None:
        return replace(found, impact=avoidance.impact_of(crash))
    return found


def _mishap(scene: Asked, event: Event | None) -> tuple[ActionName, float]:
    """Return what happened and when [s]: the event of the question, else the worst one.

    Raises:
        Unanswered: it did not happen.
    """
    crash = avoidance.crashed(scene.ride)
    if crash is not None and (event is None or event.action in ("collide", "happen", "do")):
        return "collide", crash.sim_time
    if event is not None and event.action in ("collide", "nearly-collide"):
        raise Unanswered(DidNotHappen(event))
    hard = hard_braking(scene.ride.motion(EGO))
    kinds: tuple[ActionName, ...] = ("stop", "give-way", "slow-down", "brake")
    if event is not None and event.action in DRIVING:
        kinds = motions.KINDS.get(event.action, (kinds,))[0]
    elif hard is not None:
        return "brake", hard
    found = [e for e in scene.world.episodes(Ego(), kinds) if e.action in kinds]
    last = scene.pick(found, lambda e: (e.begin, e.end))
    if last is None:
        raise Unanswered(DidNotHappen(event or Event("happen")))
    name: ActionName = "slow-down" if last.action == "brake" else last.action
    return name, last.begin


def _factor(event: Event | None, scene: Asked, *, negated: bool) -> Answer:
    """Return the first cause of an action; if that is no vehicle, what decided the choice."""
    chosen = event is not None and (choices.is_choice(event) or event.action == "stop")
    undone = event is not None and chosen and not _was_done(scene, event)
    if event is not None and (negated or undone):
        found = choices.why_not(event, scene)
    elif event is not None and not choices.is_choice(event):
        return _motive(event, scene, most=True)
    else:
        found = choices.why(event, scene)
    assert isinstance(found, ChoiceReason)
    against = found.contrast
    ranked = sorted(against.causes, key=decisive_factor.weight)
    if not ranked:
        return DecisiveFactor("factor", against, most=True)
    first = ranked[0]
    return DecisiveFactor(
        "factor", against, first.vehicle, first.actions, first.probability, most=True
    )


def _motive(event: Event, scene: Asked, *, most: bool = False) -> Answer:
    """Return what a way of driving depended on: whose absence would have changed it."""
    found = motions.motion(event, scene)
    if not isinstance(found, MotionReason):
        return found
    first = next(iter(found.causes), None)
    if first is None or first.vehicle is None or not _is_needed(first, found):
        return found
    kind: Literal["removal", "factor"] = "factor" if most else "removal"
    return DecisiveFactor(
        kind, None, first.vehicle, first.actions, first.probability, most, event.action
    )


def _is_needed(cause: MotionCause, reason: MotionReason) -> bool:
    """Check whether a cause was necessary, by planning without it or because there is no other."""
    return len(reason.causes) == 1 if cause.necessary is None else cause.necessary


def _own_event(option: Proposition | Thing) -> Event | None:
    of, _ = unwrapped(option) if isinstance(option, Happens) else (option, False)
    return of.event if isinstance(of, Happens) else None


def _was_done(scene: Asked, event: Event) -> bool:
    names = names_of(event)
    turn = foils.at_turn(scene, names, past=True) if names == ("exit-straight",) else None
    if turn is not None:
        return planned(turn.trace)[len(turn.node)] in STRAIGHT
    deeds = [d for d in scene.ride.deeds if any(same(name, d.action) for name in names)]
    plan = planned(scene.ride.latest)[:1]
    return bool(deeds) or any(same(name, step) for name in names for step in plan)


def _sides(
    scene: Asked, events: list[Event]
) -> tuple[Premise, tuple[MacroAction, ...], tuple[MacroAction, ...]]:
    """Return the decision, what was done, and the foil, for one or two options."""
    done = next((event for event in events if _was_done(scene, event)), None)
    others = [event for event in events if event is not done]
    if done is not None and others:
        onward = done.tense == "present" and planned(scene.ride.latest)[:1] == (done.action,)
        found, foil = foils.foil_at(others[0], scene, None if onward else done)
    else:
        about = foil_subject(scene, events[0])
        names = foils.settled(scene, events[-1])
        found = about_foil(scene.ride, about, names[:1])
        foil = to_macros(scene.ride.model(found.trace), names[:1], found.node)
    return found, planned(found.trace)[len(found.node) :][:1], foil


def _is_fact(event: Event, fact: tuple[MacroAction, ...]) -> bool:
    return any(same(name, step) for name in names_of(event) for step in fact)


def _named(
    named: list[Proposition | Thing],
    events: list[Event],
    fact: tuple[MacroAction, ...],
    foil: tuple[MacroAction, ...],
) -> tuple[Proposition | Thing, Proposition | Thing]:
    """Return the two options with their names, in the order of the question."""
    if len(named) > 1:
        return named[0], named[1]
    ours = fact[0] if fact and not _is_fact(events[0], fact) else None
    if ours is not None:
        return named[0], Happens(Event(ours))
    return named[0], Happens(Event(foil[0])) if foil and is_macro(foil[0]) else named[0]


def _better(
    by: str, against: Contrast, *, swapped: bool
) -> Literal["first", "second", "same", "unknown"]:
    """Return which is better by a measure: fact (first) or foil."""
    gain = _gain(by, against)
    if gain is None:
        return "unknown"
    if gain == 0.0:
        return "same"
    return "first" if (gain > 0.0) != swapped else "second"


def _gain(by: str, against: Contrast) -> float | None:
    """Return by how much the fact is better, in the unit of the measure; 0 if they are equal."""
    effects = {effect.component: effect.delta for effect in against.effects}
    if by == "safety":
        gain = against.collision - against.fact_collision
        return gain if abs(gain) >= EVEN else 0.0
    if by in ("time", "speed"):
        sides = (against.outcome, against.fact_outcome)
        arrives, arrived = (side is None or side.name == "done" for side in sides)
        if not (arrives and arrived):
            return None if arrives == arrived else -1.0 if arrives else 1.0
        delta = effects.get("time")
        return None if delta is None else delta if abs(delta) >= EQUAL else 0.0
    if by == "comfort":
        parts = [effects.get("jerk"), effects.get("angular-acceleration")]
        known = [part for part in parts if part is not None]
        return sum(known) if known else None
    value = against.value
    return None if value is None else value if abs(value) >= EQUAL else 0.0
