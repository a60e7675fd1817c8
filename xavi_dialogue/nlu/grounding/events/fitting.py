"""Fitting: which vehicles did, or had done to them, what an event says, and in which episode."""

import dataclasses
from collections.abc import Callable
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Between,
    Described,
    Ego,
    Event,
    Passenger,
    Pronoun,
    Thing,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Fits, Grounder, Mode, Window
from xavi_dialogue.nlu.grounding.kin import like

ONGOING: Final = frozenset(("speed-up", "slow-down", "brake", "cross"))
LASTING: Final = frozenset(("move", "stand", "wait"))
LATELY: Final = 12.0  # [s] within which what is over is still asked about in the present tense
HARD: Final = 3.0  # [m/s2] from which braking is called hard
NEAR: Final = 2.5  # [m/s] by which a speed that is said may be off
JUST: Final = 0.5  # [s] since when what ended still goes on
OVER: Final = 0.5  # [s] what ends so soon after something was not after it
JUST_OVER: Final = 5.0  # [s] within which what ended is still felt
FELT: Final = 0.2  # minimum share of our speed that slowing takes for it to be felt as braking


def acting(spoken: Event, g: Grounder, window: Window, open_: bool) -> Fits:
    """Fit the vehicles that may have done something, with the episode in which they did."""
    target = spoken.object
    if isinstance(target, Passenger):
        target = Ego()
    elif isinstance(target, Described | Pronoun):
        target = None
    exact = open_ or spoken.actor == Described(definite=False)  # "has anyone changed lanes?"
    anybody = isinstance(spoken.actor, Described) and not spoken.actor.definite
    fits = _fitting(g, window, lambda n: replace(spoken, actor=Vehicle(n), object=target), exact)
    if not (anybody and spoken.tense == "present" and spoken.action in ONGOING):
        return fits

    def still(vehicle: int) -> Episode | None:
        found = fits(vehicle)
        over = found is not None and (found.end or g.context.now) < g.context.now - JUST
        return None if over else found

    return still


def undergoing(spoken: Event, g: Grounder, window: Window, open_: bool) -> Fits:
    """Fit the vehicles to whom something may have been done, with the episode."""
    return _fitting(g, window, lambda n: replace(spoken, object=Vehicle(n)), open_)


def is_open(thing: Thing, mode: Mode, window: Window) -> bool:
    """Tell whether it is asked of somebody, known by more than that, whether he did it lately."""
    definite = isinstance(thing, Described) and thing.definite and not thing.plural
    return mode == "asked" and not window.said and (definite or isinstance(thing, Pronoun))


def done(fits: Fits, g: Grounder, lately: bool) -> Fits:
    """Let only what was done lately tell who is meant, where that is asked for."""
    if not lately:
        return fits

    def just(vehicle: int) -> Episode | None:
        found = fits(vehicle)
        over = found is not None and found.end is not None and found.end < g.context.now - LATELY
        return None if over else found

    return just


def _fitting(
    g: Grounder, window: Window, filled: Callable[[int], Event], exact: bool = False
) -> Fits:
    def fits(vehicle: int) -> Episode | None:
        found = g.context.holds(filled(vehicle), *searched(g, window))
        if not found and not exact:
            found = like(g.context, filled(vehicle), *searched(g, window))
            found = tuple(e for e in found if Vehicle(vehicle) in (e.actor, e.object))
        return found[-1] if found else None

    return fits


def searched(g: Grounder, window: Window) -> tuple[float, float]:
    """Give the stretch of the ride in which an event is looked for [s]."""
    begin, end = window.search
    if not window.said and window.end - window.begin < 0.1:  # the present
        return end - LATELY, end
    return begin, end


def of_speeds(held: tuple[Episode, ...], event: Event) -> tuple[Episode, ...]:
    """Keep those from and to about the speeds that are said, where there are any."""
    if event.speeds is None:
        return held
    first, last = (speed.value for speed in event.speeds)
    near = [max(abs((e.speed_from or 0.0) - first), abs((e.speed_to or 0.0) - last)) for e in held]
    return tuple(e for e, off in zip(held, near, strict=True) if off <= NEAR) or held


def hard_ones(held: tuple[Episode, ...], event: Event, window: Window) -> tuple[Episode, ...]:
    """Keep the hard braking where hard braking is spoken of, else the hardest."""
    held = of_speeds(held, event)
    peaks = [episode.peak or 0.0 for episode in held]
    if "hard" not in event.manner or window.said or not any(peaks):
        return held
    least = min(HARD, max(peaks))
    return tuple(e for e, peak in zip(held, peaks, strict=True) if peak >= least)


def gentle_too(
    held: tuple[Episode, ...], event: Event, window: Window, g: Grounder
) -> tuple[Episode, ...]:
    """Add our slowing of just now to our braking, where it took much of what we drove."""
    plain = event.action == "brake" and isinstance(event.actor, Ego) and "hard" not in event.manner
    if not plain or window.rank is not None or window.prefer != "last":
        return held
    now = g.context.now
    slowed = g.context.holds(replace(event, action="slow-down"), *window.search)
    slowed = tuple(e for e in slowed if e.action == "slow-down" and _is_felt(e, now))
    return tuple(sorted((*held, *slowed), key=lambda e: e.begin)) if slowed else held


def _is_felt(slowing: Episode, now: float) -> bool:
    """Tell whether slowing goes on or is just over, and took a good share of our speed."""
    first, last = slowing.speed_from, slowing.speed_to
    if first is None or last is None or (slowing.end or now) < now - JUST_OVER:
        return False
    return first - last >= FELT * first


def held_in(event: Event, window: Window, g: Grounder) -> tuple[tuple[Episode, ...], Window]:
    """Find the episodes that an event is, and the part of the ride that its time names.

    What ends at once, or has begun before, is not after something: a stop that ends as we set off.
    """
    if window.prefer != "first" or not window.said or not isinstance(window.term, Between):
        return g.context.holds(event, *window.search), window
    begin, end = window.begin, window.term.end
    then = min(begin + OVER, end)
    window = dataclasses.replace(
        window, begin=then, term=Between(then, end), search=(then, window.search[1])
    )
    held = g.context.holds(event, *window.search)
    lasts = event.action in LASTING
    return tuple(e for e in held if lasts or e.begin >= begin), window
