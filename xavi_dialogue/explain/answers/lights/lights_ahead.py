"""Lights ahead: when a traffic light is, or was, expected to change.

What is to come is a belief. It is stated with its range, which comes from the courses that the
planner drew from.
"""

from typing import Any

from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import HowKnow, HowLong, HowMuch, HowSure, When, Whether
from xavi_dialogue.domain.terms import (
    Believed,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Measured,
    Proposition,
    Within,
)
from xavi_dialogue.domain.traffic_lights import COLOURS, LightColour, LightForeseen, LightTold
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.lights.lights_turn import ONWARD, held
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import is_us
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.facts.episodes.light_events import SHOWING, light_of
from xavi_dialogue.explain.facts.episodes.light_waits import holds
from xavi_dialogue.explain.facts.traffic_lights import SAID, foreseen, meant, odds_of, shown_at
from xavi_dialogue.explain.history.traffic_lights import stretches

STILL = 0.3  # [m/s] up to which we have stopped
STANDING = frozenset[ActionName](("wait", "stand", "stop"))
LATELY = 20.0  # [s] after a change of a light in which a question means that change


def concerns(of: Proposition | None) -> bool:
    """Check whether a proposition is about what a light shows or turns to."""
    of, _ = unwrapped(of)
    match of:
        case Has(attribute="colour", thing=Feature(kind="light")):
            return True
        case Happens(event) if event.action in SHOWING:
            return light_of(event) is not None
    return False


def wanted_of(of: Proposition | None) -> tuple[Feature, LightColour | None]:
    """Return the light of a proposition, and the colour that it is said to show."""
    of, _ = unwrapped(of)
    match of:
        case Has(value=value, thing=Feature() as light):
            return light, SAID.get(value)
        case Happens(event):
            colour = getattr(event.object, "colour", None) or ""
            return light_of(event) or Feature("light"), SAID.get(colour)
    return Feature("light"), None


def is_to_come(of: Proposition | None, scene: Asked) -> bool:
    """Check whether a proposition is about what a light will show, or its change to come."""
    if not concerns(of):
        return False
    inner, _ = unwrapped(of)
    event = inner.event if isinstance(inner, Happens) else None
    tense = event.tense if event is not None else getattr(inner, "tense", "present")
    ahead_of = scene.span is not None and scene.span.ahead
    modal = event is not None and event.modal in ("will", "might", "could", "can")
    turning = event is not None and event.action == "turn-colour" and tense == "present"
    return tense == "future" or ahead_of or modal or turning


def is_change(of: Proposition | None) -> bool:
    """Check whether a proposition is that a light changes."""
    inner, _ = unwrapped(of)
    return concerns(of) and isinstance(inner, Happens) and inner.event.action == "turn-colour"


def when(question: When, scene: Asked) -> Answer:
    """Return when a light is expected to change."""
    return _forecast(question.of, scene, "when")


def until_we_go(of: Proposition | Event | None, scene: Asked) -> bool:
    """Check whether the question is until when a red light holds us: "when do we go on?"."""
    event = of.event if isinstance(of, Happens) else of
    if not isinstance(event, Event) or not is_us(event.actor) or event.object is not None:
        return False
    goes = event.action in ONWARD and event.tense in ("present", "future")
    stands = event.action in STANDING and (event.tense == "future" or event.modal == "must")
    if isinstance(of, Happens) and event.action in ("stop", "stand"):  # when that begins
        speed = scene.world.measure("speed", Ego(), scene.now).value
        stands = stands and speed is not None and speed <= STILL
    return (goes or stands) and held(scene) is not None


def going(question: When | HowLong, scene: Asked) -> Answer:
    """Return when the light that holds us is expected to turn green."""
    return _forecast(Has("colour", "green", Feature("light")), scene, "going")


def staying(question: HowLong | HowMuch, scene: Asked) -> Answer:
    """Return how long a light is expected to show what it shows: when it changes next."""
    of = question.of
    that: Any = Has("colour", "", of.thing) if isinstance(of, Measured) else of
    light, wanted = wanted_of(that)
    one = shown_at(scene.ride, light, scene.now)
    stays = one is not None and wanted == one.colour
    if one is not None and wanted is not None and not stays:
        return LightTold("colour", one, time=scene.now)  # it does not show that any more
    return _forecast(Has("colour", "", light) if stays else that, scene, "when")


def coming(question: Whether, scene: Asked) -> Answer:
    """Return whether a light is expected to change soon."""
    return _forecast(question.that, scene, "whether")


def how_sure(question: HowSure, scene: Asked) -> Answer:
    """Return how sure we are that a light changes."""
    return _forecast(question.of, scene, "how-sure")


def _forecast(of: Proposition | None, scene: Asked, asked: Any) -> Answer:
    light, wanted = wanted_of(of)
    signal = meant(scene.ride, light, scene.now)
    one = shown_at(scene.ride, light, scene.now)
    found = None if signal is None else foreseen(scene.ride, signal, scene.now, wanted)
    within = seconds_given(of)
    to = wanted or (None if found is None else found.to)
    if within is not None and signal is not None and one is not None and to is not None:
        odds = odds_of(scene.ride, signal, scene.now + within, to)
        if odds is not None:
            holds = (odds.chance >= 0.5) != unwrapped(of)[1] if asked == "whether" else None
            return LightForeseen(found, one, asked=asked, holds=holds, odds=odds)
    whether = asked == "whether" and found is not None
    negated = unwrapped(of)[1]
    holds = (found.middle is not None) != negated if whether and found is not None else None
    if found is None and one is not None and wanted != one.colour:
        return LightTold("colour", one, time=scene.now)
    return LightForeseen(found, one, asked=asked, holds=holds)


def seconds_given(of: Proposition | None) -> float | None:
    """Return in how many seconds something is to be so; None: no time was said."""
    inner, _ = unwrapped(of)
    time = inner.event.time if isinstance(inner, Happens) else getattr(inner, "time", None)
    return time.seconds if isinstance(time, Within) else None


def how_known(question: HowKnow, scene: Asked) -> Answer:
    """Return the forecast by which a light is expected to change."""
    return _forecast(question.of, scene, "when")


def expected(question: Any, scene: Asked) -> Answer:
    """Return what was expected of a light before it changed last, else what is expected now."""
    believed = question.that if isinstance(question, Whether) else question.of
    assert isinstance(believed, Believed)
    light, wanted = wanted_of(believed.content)
    at = _when_expected(scene, light, wanted, past=believed.tense != "present")
    if at is None:
        return _forecast(believed.content, scene, "whether")
    signal = meant(scene.ride, light, at)
    found = None if signal is None else foreseen(scene.ride, signal, at, wanted)
    holds = None if found is None else found.middle is not None
    return LightForeseen(found, shown_at(scene.ride, light, at), True, "whether", holds)


def _when_expected(
    scene: Asked, light: Feature, wanted: LightColour | None, *, past: bool
) -> float | None:
    """Return the moment [s] whose expectation is asked about; None: now."""
    if not past:
        return None
    if scene.past is not None and scene.past.said:
        return scene.past.begin
    signal = meant(scene.ride, light, scene.now)
    known = () if signal is None else stretches(scene.ride, signal)
    changes = [
        one.begin
        for one in known
        if one.begun and (wanted is None or COLOURS.get(one.state) == wanted)
    ]
    late = [at for at in changes if scene.now - LATELY <= at]
    if late:
        held = [h.begin for h in holds(scene.ride, EGO) if h.begin < late[-1] <= h.end + 2.0]
        return max(held[-1], late[-1] - LATELY) if held else late[-1] - 1.0
    held = [h.begin for h in holds(scene.ride, EGO) if h.goes_on]
    return held[-1] if held else None
