"""Forecast: what several others are going to do, by what is believed of each."""

from collections.abc import Iterable

from xavi_dialogue.domain.answers import Forecast
from xavi_dialogue.domain.facts import Belief, Look
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked


def forecast(asked: Asked, who: Iterable[object]) -> Forecast | None:
    """Return what those in view are expected to do; None if nothing is believed of any."""
    numbers = dict.fromkeys(one.number for one in who if isinstance(one, Vehicle))
    found: list[tuple[Look, Belief]] = []
    for vehicle in numbers:
        look, belief = asked.world.look(vehicle, asked.now), asked.world.belief(vehicle, asked.now)
        if look is not None and look.in_view and belief is not None and belief.expectations:
            found.append((look, belief))
    found.sort(key=lambda one: (one[0].distance, one[0].vehicle))
    return Forecast(tuple(belief for _, belief in found)) if found else None
