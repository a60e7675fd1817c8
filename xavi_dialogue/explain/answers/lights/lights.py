"""Lights: which function answers a question about a traffic light.

Questions about a traffic light are answered here, whatever their form. Only the question why we
stopped for one is answered with the other reasons.
"""

from collections.abc import Callable
from typing import Any, TypeAlias

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Doing,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import Believed, Both, Ego, Event, Feature, Has, Measured, Related
from xavi_dialogue.explain.answers.lights import (
    lights_ahead,
    lights_met,
    lights_seen,
    lights_supposed,
    lights_turn,
)
from xavi_dialogue.explain.answers.lights.lights_read import (
    may_pass,
    of_another,
    of_showing,
    passing,
    stated,
    things,
)
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.facts.traffic_lights import light_in

Explainer: TypeAlias = Callable[[Any, Asked], Answer]


def explainer(act: object, scene: Asked) -> Explainer | None:
    """Find the function that answers an act about a traffic light; None if it is about none."""
    if isinstance(act, Claim):
        if of_another(act.that):
            return lights_seen.unseen_claim
        return lights_seen.claimed if stated(act.that) is not None else None
    if not isinstance(act, Ask):
        return None
    if (hue := _which_colour(act.question)) is not None:
        return lambda _, scene: lights_seen.colour(hue, scene)
    match act.question:
        case Whether(that) if lights_met.wanted(that, scene) is not None:
            return _asked(lights_met.whether)
        case Whether(that) | HowKnow(that) | When(that) | HowLong(that) if isinstance(
            that, Believed
        ) and lights_ahead.concerns(that.content):
            return _asked(lights_ahead.expected)
        case Whether(that) if lights_ahead.is_to_come(that, scene):
            return _asked(lights_ahead.coming)
        case Whether(that) if stated(that) is not None:
            return _asked(lights_seen.whether)
        case Whether(that) if lights_turn.is_turn(that, scene):
            return _asked(lights_turn.whether)
        case Whether(that) if may_pass(that):
            return _asked(lights_seen.ours)
        case Whether(that) if lights_supposed.turns_on_red(unwrapped(that)[0]) is not None:
            return _asked(lights_supposed.whether_turn)
        case Whether(that) if of_another(that):
            return _asked(lights_seen.unseen)
        case HowSure(of) if lights_met.wanted(of, scene, lights_met.COMING) is not None:
            return _asked(lights_met.how_sure)
        case HowSure(of) if (
            isinstance(of, Has)
            and stated(of) is not None
            and (not lights_ahead.is_to_come(of, scene))
        ):
            return _asked(lights_seen.how_sure)
        case HowSure(of) if of is not None and lights_ahead.concerns(of):
            return _asked(lights_ahead.how_sure)
        case When(of) | HowLong(of) if lights_ahead.until_we_go(of, scene):
            return _asked(lights_ahead.going)
        case When(of) if lights_ahead.is_to_come(of, scene):
            return _asked(lights_ahead.when)
        case HowLong(of) if not isinstance(of, Event) and lights_ahead.is_to_come(of, scene):
            return _asked(lights_ahead.staying)
        case HowMuch(Measured("duration", Feature(kind="light"), tense=tense)):
            past = tense in ("past", "perfect")
            return _asked(lights_seen.how_long if past else lights_ahead.staying)
        case HowKnow(of) if of is not None and lights_ahead.is_change(of):
            return _asked(lights_ahead.how_known)
        case WhatIf(supposed) if lights_ahead.concerns(unwrapped(supposed)[0]):
            return _asked(lights_supposed.supposed)
    return _of_fact(act.question)


def _which_colour(question: object) -> HowMuch | None:
    """Return the question for its colour that "is the light red or green?" is."""
    match question:
        case Whether(Both((Has("colour", thing=Feature("light") as light) as first, *_), "or")):
            return HowMuch(Measured("colour", light, time=first.time, tense=first.tense))
    return None


def _asked(found: Explainer) -> Explainer:
    return lambda act, scene: found(act.question, scene)


def _of_fact(question: object) -> Explainer | None:
    """Return the function that answers what a light shows or showed, where it is, or why."""
    match question:
        case HowMuch(Measured(attribute="colour" | "kind", thing=Feature(kind="light"))):
            return _asked(lights_seen.colour)
        case HowMuch(Measured(attribute="distance" | "place", thing=thing, to=to)) if (
            light_in(thing, to) is not None
        ):
            return _asked(lights_seen.where)
        case Where(Feature(kind="light")) | Identify(Feature(kind="light")):
            return _asked(lights_seen.where)
        case Doing(actor=Feature(kind="light")):
            return _asked(lights_seen.colour)
        case Which(thing=Feature(kind="light")):
            return _asked(lights_seen.seen_any)
        case Which(such=Has(attribute="colour", thing=Feature(kind="light"))):
            return _asked(lights_seen.whose)
        case HowMany(of) if light_in(of, *things(of)) is not None:
            return _asked(lights_seen.count)
        case When(Related("can-see", Ego(), Feature(kind="light"))):
            return _asked(lights_seen.first_seen)
        case When(of) if of_showing(of) is not None:
            return _asked(lights_seen.when)
        case HowLong(of) if of_showing(of) is not None:
            return _asked(lights_seen.how_long)
        case HowKnow(of) if of_showing(of) is not None:
            return _asked(lights_seen.how_known)
        case Why(of) if of_showing(unwrapped(of)[0]) is not None:
            return _asked(lights_seen.why)
        case Why(of) if passing(of) is not None:
            return _asked(lights_seen.why_passed)
        case Why(of) if lights_supposed.turn_on_red(of) is not None:
            return _asked(lights_supposed.why_not_turn)
    return None
