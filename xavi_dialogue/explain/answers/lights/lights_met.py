"""Lights met: whether a light ahead is going to let us through when we come to it."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import HowSure, Whether
from xavi_dialogue.domain.terms import Believed, Event, Feature, Happens, Proposition, Tense
from xavi_dialogue.domain.traffic_lights import LightForeseen
from xavi_dialogue.explain.answers.expectations.foreseen import EXPECTED
from xavi_dialogue.explain.answers.expectations.plans import current_plan, stopping_at_light
from xavi_dialogue.explain.answers.lights.lights_ahead import seconds_given
from xavi_dialogue.explain.answers.measuring.durations import stands
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import is_own, unwrapped
from xavi_dialogue.explain.facts.episodes.light_events import PASSING
from xavi_dialogue.explain.facts.traffic_lights import foreseen as to_change
from xavi_dialogue.explain.facts.traffic_lights import light_in, meant, shown_at
from xavi_dialogue.explain.history.traffic_lights import ahead

LIGHT: Final = Feature("light")
COMING: Final[tuple[Tense, ...]] = ("future", "present")  # "what are the odds that we make it?"
STOPPING: Final = frozenset(("stop", "wait", "stand"))


def wanted(
    that: Proposition | None, scene: Asked, tenses: tuple[Tense, ...] = ("future",)
) -> bool | None:
    """Return whether a proposition is that we get past the light ahead, or that we stop for it.

    None: it is neither, we stand, or no light is ahead.
    """
    of, negated = unwrapped(that)
    if isinstance(of, Believed):
        of, negated = unwrapped(of.content)
    if not isinstance(of, Happens) or not is_own(of.event.actor):
        if not _turns_green(of) or seconds_given(of) is not None:
            return None
        through = True
    elif (passes := _passes(of.event, tenses)) is not None:
        through = passes
    else:
        return None
    if stands(scene) or not ahead(scene.ride, scene.now) or current_plan(scene) is None:
        return None
    return through != negated


def whether(question: Whether, scene: Asked) -> LightForeseen:
    """Return the chance that we have to stop for the light, and when it is to change.

    Raises:
        AssertionError: the question is about something else; see `wanted`.
    """
    through = wanted(question.that, scene, COMING)
    assert through is not None
    stops = stopping_at_light(scene)
    signal, shown = meant(scene.ride, LIGHT, scene.now), shown_at(scene.ride, LIGHT, scene.now)
    found = None if signal is None else to_change(scene.ride, signal, scene.now)
    holds = (stops < EXPECTED) == through
    return LightForeseen(found, shown, asked="met", holds=holds, stops=stops)


def how_sure(question: HowSure, scene: Asked) -> Answer:
    """Return the chance that we have to stop for the light; see `whether`."""
    assert question.of is not None
    return replace(whether(Whether(question.of), scene), holds=None)


def _passes(event: Event, tenses: tuple[Tense, ...]) -> bool | None:
    """Check whether an event of ours to come is that we pass a light; False: we stop for it.

    None: it is neither, or it is that we pass it on red.
    """
    light = light_in(event.object)
    to_come = event.tense in tenses or (event.modal == "must" and event.tense == "present")
    if not to_come or light is None or event.modal not in (None, "must"):
        return None
    if event.action in PASSING and light.colour != "red":
        return True
    return False if event.action in STOPPING else None


def _turns_green(of: Proposition | None) -> bool:
    """Check whether a proposition is that the light turns green, or is green, in the future."""
    match of:
        case Happens(Event(action="turn-colour", tense="future") as event):
            light, to = light_in(event.actor), light_in(event.object)
            return light == LIGHT and to is not None and to.colour == "green"
    return False
