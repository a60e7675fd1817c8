"""Content of answers about a collision that happened."""

from dataclasses import dataclass

from xavi_dialogue.explain.details import Impact
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.doings import doing, plain
from xavi_dialogue.language.insight import EVEN, SELDOM
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.points import Budget
from xavi_dialogue.language.quantities import Quantity

WHY = ("why", "how", "confidence")  # types of questions to which it belongs what was expected
NEVER, ALWAYS = 0.01, 0.99  # what was simulated is neither impossible nor certain


@dataclass(frozen=True, slots=True)
class ImpactPoint:
    """When we collided and with whom, and, where it is asked why, what was expected before."""

    why: bool
    struck: Vehicle | None
    at: Quantity
    ago: Quantity | None
    deed: Doing | None  # what we did before, where the question is of all that happened
    decided: Quantity | None  # when the decision was taken of which all below is told
    chance: Quantity | None  # of a collision with that vehicle
    forecast: Doing | None  # what it was expected to do
    likely: Quantity | None  # and how surely
    unlikely: bool
    foil: Doing | None  # what would have avoided it, ...
    foil_at: Quantity | None  # ... when, and what the chance would have been
    then: bool  # at that same decision
    spared: Quantity | None
    alone: bool  # there was nothing else to do
    in_vain: bool  # nothing that could have been done would have avoided it


def impact_point(
    query: Query, found: Explanation, impact: Impact, budget: Budget, now: float
) -> ImpactPoint:
    """What to say at time `now` [s] of a collision; its time is in the explanation."""
    moment = found.sim_time if found.moment is None else found.moment
    why, avoidance = query.type in WHY, found.avoidance
    tells = why and impact.chance is not None
    known = tells and impact.probability > 0.0 and budget.purpose
    actions = plain(impact.actions)
    saved = avoidance is not None and avoidance.possible and bool(found.counterfactual)
    foil = plain(found.counterfactual)[:1] if saved else ()
    return ImpactPoint(
        why=why,
        struck=None if impact.vehicle is None else Vehicle(impact.vehicle),
        at=Quantity(moment, "clock"),
        ago=Quantity(now - moment, "s") if now - moment >= 1.0 and not why else None,
        deed=None if impact.deed is None else doing(EGO, (impact.deed,), "past"),
        decided=Quantity(impact.decided, "clock") if tells and impact.decided is not None else None,
        chance=_chance(impact.chance) if tells and impact.chance is not None else None,
        forecast=doing(impact.vehicle or EGO, actions, "past") if known else None,
        likely=_chance(impact.probability) if known else None,
        unlikely=impact.probability < EVEN,
        foil=Doing(EGO, foil, "past") if foil else None,
        foil_at=Quantity(found.sim_time, "clock") if foil else None,
        then=impact.decided == found.sim_time,
        spared=_chance(avoidance.other) if avoidance is not None and foil else None,
        alone=avoidance is not None and avoidance.options == 0,
        in_vain=avoidance is not None and avoidance.options > 0 and avoidance.other > SELDOM,
    )


def _chance(probability: float) -> Quantity:
    return Quantity(min(max(probability, NEVER), ALWAYS), "probability")
