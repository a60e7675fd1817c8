"""Lights seen: what a light showed, since when, where it is, and how we passed its line."""

from typing import Any

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Happenings, Verdict
from xavi_dialogue.domain.meaning import (
    Claim,
    Doing,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Proposition,
    Relative,
    WholeRide,
)
from xavi_dialogue.domain.traffic_lights import LightColour, LightPassed, LightTold
from xavi_dialogue.explain.answers.lights import lights_ahead
from xavi_dialogue.explain.answers.lights.lights_read import (
    alike,
    moment,
    of_showing,
    passing,
    place,
    things,
    within,
)
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import window
from xavi_dialogue.explain.answers.reference.occasions import did_not_happen
from xavi_dialogue.explain.answers.reference.reading import is_own, unwrapped
from xavi_dialogue.explain.facts.episodes.light_events import HELD, PASSING
from xavi_dialogue.explain.facts.traffic_lights import (
    colour_of,
    crossed,
    green_around,
    light_in,
    meant,
    shown_at,
    told,
)
from xavi_dialogue.explain.history.ride import ROUNDING
from xavi_dialogue.explain.history.traffic_lights import Passing, passings, stretches

GONE_BY = PASSING | {"overtake", "go", "move"}


def unseen(question: Whether, scene: Asked) -> Answer:
    """Return that it is not recorded how another vehicle passed a light."""
    del scene
    return Verdict(question.that, None, gap="not-recorded")


def unseen_claim(act: Claim, scene: Asked) -> Answer:
    """Return the same in reply to a claim."""
    del scene
    return Verdict(act.that, None, gap="not-recorded", claim=True)


def claimed(act: Claim, scene: Asked) -> Answer:
    """Check a claim about a light against what was seen of it."""
    return _judged(act.that, scene, claim=True)


def whether(question: Whether, scene: Asked) -> Answer:
    """Return whether a light shows or showed something, or was there."""
    return _judged(question.that, scene, claim=False)


def how_sure(question: HowSure, scene: Asked) -> Answer:
    """Return whether a light shows what we are asked to be sure of: it is in view or was."""
    assert question.of is not None
    return _judged(question.of, scene, claim=False)


def _judged(that: Proposition, scene: Asked, *, claim: bool) -> Answer:
    """Check what is said about a light against what was seen of it."""
    of, negated = unwrapped(that)
    event = passing(that)
    if event is not None:
        return _passed(event, scene, claim=claim)
    found = of_showing(of)
    if found is None:
        return _seen(of, scene, negated=negated)
    light, wanted = found
    before = light.rank == -1 or isinstance(getattr(of, "time", None), Relative)
    if before and not passings(scene.ride):
        return _passed(Event("pass", object=Feature("light", colour=wanted)), scene, claim=claim)
    turned = isinstance(of, Happens) and of.event.action == "turn-colour"
    time, past = moment(of, scene, light)
    one = shown_at(scene.ride, light, time)
    if one is None:
        return _others(scene, light, time, past=past)
    if turned:
        holds = _has_turned(scene, light, wanted)
        if not holds and not negated and not claim and wanted is not None and alike(one, wanted):
            return LightTold("when", one, wanted, past=past, time=time)  # it had turned before
    else:
        holds = wanted is None or alike(one, wanted)
    asked: Any = "claim" if claim else "whether"
    return LightTold(
        asked,
        one,
        wanted,
        holds != negated,
        past,
        time,
        **place(scene, light, time),  # type: ignore[arg-type]
    )


def _has_turned(scene: Asked, light: Feature, wanted: LightColour | None) -> bool:
    """Check whether the light was seen to turn to a colour in the time asked about."""
    past = scene.past
    begin, end = (0.0, scene.now) if past is None else (past.begin, past.end)
    event = Event("turn-colour", light, Feature("light", colour=wanted))
    return bool(scene.world.holds(event, begin, end))


def _seen(of: Proposition | None, scene: Asked, *, negated: bool) -> Answer:
    light = light_in(*(getattr(of, name, None) for name in ("thing", "to"))) or Feature("light")
    time, past = moment(of, scene, light)
    one = shown_at(scene.ride, light, time)
    spot = place(scene, light, time)
    there = one is not None and (past or spot["passed"] is None)
    if past and one is None and passings(scene.ride):
        last = passings(scene.ride)[-1]
        one, there, spot = crossed(scene.ride, last).shown, True, {"passed": last.time}
    shown = one if there else None
    return LightTold("seen", shown, holds=there != negated, past=past, time=time, **spot)  # type: ignore[arg-type]


def _asked_of(question: HowMuch | Doing) -> tuple[object, ...]:
    return (question.actor,) if isinstance(question, Doing) else (question.of.thing,)


def colour(question: HowMuch | Doing, scene: Asked) -> Answer:
    """Return what a light shows or showed."""
    light = light_in(*_asked_of(question)) or Feature("light")
    time, past = moment(getattr(question, "of", question), scene, light)
    one = shown_at(scene.ride, light, time)
    passed = [p for p in passings(scene.ride) if p.time <= time]
    if one is None and light.of is None and past and passed:  # out of view by then
        time = passed[-1].time
        one = crossed(scene.ride, passed[-1]).shown
    if one is None:
        return _others(scene, light, time, past=past)
    behind = None if past or light.of is not None else place(scene, light, time)["passed"]
    return LightTold("colour", one, past=past, time=time, whose=light.of, passed=behind)


def _others(scene: Asked, light: Feature, time: float, *, past: bool) -> LightTold:
    """Return that it is not known what a light showed.

    If it is another's, with what ours showed, and whether any other of the junction was green.
    """
    if light.of is None:
        return LightTold("colour", past=past, time=time)
    own = shown_at(scene.ride, Feature("light"), time)
    around = green_around(scene.ride, time)
    return LightTold("colour", past=past, time=time, whose=light.of, own=own, around=around)


def seen_any(question: Which, scene: Asked) -> Answer:
    """Return the light that was seen: on our way; or those that held us, or that we passed."""
    such, _ = unwrapped(question.such)
    if isinstance(such, Happens) and is_own(such.event.actor):
        event = such.event
        if event.action in HELD:
            return _held_by(event, scene)
        if event.action in GONE_BY and event.tense in ("past", "perfect"):
            return count(HowMany(question.thing), scene)
    return _seen(Exists(Feature("light")), scene, negated=False)


def _held_by(event: Event, scene: Asked) -> Answer:
    """Return when lights held us in the way that is asked about; none that was not said: ever.

    Raises:
        Unanswered: none did.
    """
    said = scene.past is not None and scene.past.said
    event = replace(event, object=Feature("light"), time=event.time if said else WholeRide())
    about = window(scene, event.time, "past")
    about = about.widened() if about.instant else about
    found = scene.world.holds(event, about.begin, about.end)
    if not found:
        raise did_not_happen(scene, event)
    looked = tuple(replace(one, object=Feature("light")) for one in found)
    return Happenings("when", looked, actor=Ego())


def ours(question: Whether, scene: Asked) -> Answer:
    """Return what the light shows to us, for the question whether we may pass it."""
    return LightTold("colour", shown_at(scene.ride, Feature("light"), scene.now), time=scene.now)


def whose(question: Which, scene: Asked) -> Answer:
    """Return whether others have green, for the question who has: not which of them."""
    light = Feature("light", of=Everyone())
    time, past = moment(question.such, scene, light)
    return _others(scene, light, time, past=past)


def where(question: Any, scene: Asked) -> Answer:
    """Return how far ahead a light is, or when we passed it."""
    of = question.thing if isinstance(question, Identify) else question.of
    light = light_in(of, getattr(of, "thing", None), getattr(of, "to", None)) or Feature("light")
    one = shown_at(scene.ride, light, scene.now)
    found = LightTold("where", one, **place(scene, light, scene.now))  # type: ignore[arg-type]
    if one is None and found.passed is None and passings(scene.ride):
        return count(HowMany(Feature("light")), scene)
    return found


def count(question: HowMany, scene: Asked) -> Answer:
    """Return how many lights we have passed."""
    every = tuple(crossed(scene.ride, one) for one in passings(scene.ride))
    wanted = colour_of(light_in(question.of, *things(question.of)))
    found = every
    if wanted is not None:
        found = tuple(c for c in every if c.shown is not None and alike(c.shown, wanted))
    others = tuple(one for one in every if one not in found)
    return LightTold(
        "count", count=len(found), crossed=found, others=others, wanted=wanted, past=True
    )


def when(question: When, scene: Asked) -> Answer:
    """Return when a light turned to a colour, last up to the moment asked about."""
    found = of_showing(question.of)
    tense = getattr(question.of, "tense", "past")
    one = shown_at(scene.ride, found[0], scene.now) if found is not None else None
    if tense == "present" and found is not None and one is not None and one.colour != found[1]:
        return lights_ahead.when(question, scene)  # "when do we get green?"
    return _stretch(question.of, scene, "when")


def first_seen(question: When, scene: Asked) -> Answer:
    """Return when a light came into our view, and what it showed then."""
    light = light_in(getattr(question.of, "to", None)) or Feature("light")
    signal = meant(scene.ride, light, scene.now)
    rows = () if signal is None else stretches(scene.ride, signal)
    if signal is None or not rows:
        return LightTold("seen", holds=False)
    first = told(scene.ride, signal, rows[0], light)
    return LightTold("when", first, first.colour, time=scene.now)


def how_long(question: HowLong, scene: Asked) -> Answer:
    """Return how long a light has shown something, or did."""
    return _stretch(question.of, scene, "how-long")


def _stretch(of: object, scene: Asked, asked: Any) -> Answer:
    found = of_showing(of)
    light, wanted = found if found is not None else (Feature("light"), None)
    time, past = moment(of, scene, light)
    time = max(time, scene.now) if asked == "when" and not scene.past else time
    signal = meant(scene.ride, light, time)
    done = passings(scene.ride)
    if signal is None and past and done and (scene.past is None or not scene.past.said):
        signal = done[-1].signal  # of no other it can be asked
    if signal is None:
        return LightTold(asked, wanted=wanted, past=past, time=time)
    rows = [s for s in stretches(scene.ride, signal) if s.begin <= time + ROUNDING]
    seen = [told(scene.ride, signal, one, light) for one in rows]
    such = [one for one in seen if wanted is None or one.colour == wanted]
    such = such or [one for one in seen if wanted is not None and alike(one, wanted)]
    one = next(iter(such[-1:] or seen[-1:]), None)
    return LightTold(asked, one, wanted or (one.colour if one else None), past=past, time=time)


def how_known(question: HowKnow, scene: Asked) -> Answer:
    """Return how we know what a light shows: we see it."""
    found = of_showing(question.of)
    light = found[0] if found is not None else Feature("light")
    time, past = moment(question.of, scene, light)
    return LightTold("how-known", shown_at(scene.ride, light, time), past=past, time=time)


def why(question: Why, scene: Asked) -> Answer:
    """Return that we see what a light shows, but not why."""
    of, _ = unwrapped(question.of)
    found = of_showing(of)
    light = found[0] if found is not None else Feature("light")
    time, past = moment(of, scene, light)
    one = shown_at(scene.ride, light, time)
    if one is None and light.of is not None:
        return replace(_others(scene, light, time, past=past), asked="why")
    return LightTold("why", one, past=past, time=time)


def why_passed(question: Why, scene: Asked) -> Answer:
    """Return how we passed a light, for the question why we did."""
    event = passing(question.of)
    assert event is not None
    found = _passed(event, scene, claim=False)
    return LightPassed(found.crossed, found.claimed, found.holds, "why", found.ahead)


def _showed(scene: Asked, passing: Passing, wanted: LightColour) -> bool:
    """Check whether a light that we passed showed a colour then."""
    shown = crossed(scene.ride, passing).shown
    return shown is not None and alike(shown, wanted)


def _passed(event: Event, scene: Asked, *, claim: bool) -> LightPassed:
    """Check what is said about our passing a light against how we passed it."""
    light = light_in(event.object, None if event.where is None else event.where.to)
    wanted = colour_of(light)
    past = scene.past
    done = passings(scene.ride)
    inside = None if past is None else within(scene, past.begin, past.end)
    one = inside or (done[-1] if done else None)
    if past is None and wanted is not None:  # any of the lights that we passed
        such = (each for each in reversed(done) if _showed(scene, each, wanted))
        one = next(such, one)
    asked: Any = "claim" if claim else "whether"
    if one is None:
        now = shown_at(scene.ride, Feature("light"), scene.now)
        return LightPassed(None, wanted, False, asked, now)
    found = crossed(scene.ride, one)
    holds = None if found.shown is None else wanted is None or alike(found.shown, wanted)
    return LightPassed(found, wanted, holds, asked)
