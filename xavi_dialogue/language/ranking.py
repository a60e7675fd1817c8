"""Content of answers to which of two ways to act is the safer, or the smoother."""

from dataclasses import dataclass

from xavi_dialogue.explain.details import Ranking
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.contrast import effect_points
from xavi_dialogue.language.doings import LANE_CHANGES, plain
from xavi_dialogue.language.morphology import EGO, Doing
from xavi_dialogue.language.points import EffectPoint
from xavi_dialogue.language.quantities import Quantity

NEVER, ALWAYS = 0.01, 0.99  # what was simulated is neither impossible nor certain
MARKED = 0.05  # difference of probabilities worth speaking of


@dataclass(frozen=True, slots=True)
class Comparison:
    """How a foil compares with what we did or plan, by the measure asked about."""

    foil: Doing
    past: bool
    safety: bool  # else smoothness
    risk: Quantity | None  # chance of a collision, of what we did; None where neither has one
    other: Quantity | None  # and of the foil
    more: bool  # the foil is the riskier, or the rougher
    same: bool  # no difference worth speaking of
    harder: bool  # the foil more often brakes hard
    brake: Quantity | None  # chance of braking hard, where the two differ
    other_brake: Quantity | None
    effects: tuple[EffectPoint, ...]  # the time that the foil takes


def comparison(query: Query, found: Explanation, ranking: Ranking) -> Comparison | None:
    """The foil by the measure asked about; None where its outcome says more."""
    foil = plain(found.counterfactual)
    ends = found.outcome.name if found.outcome else "done"
    jerk = next((e.delta for e in found.effects if e.component == "jerk"), None)
    if ends == "dead" or (ranking.by == "smoother" and (jerk is None or ends != "done")):
        return None
    one, two = ranking.collision or 0.0, ranking.foil_collision or 0.0
    hard, other_hard = ranking.hard_brake, ranking.foil_hard_brake
    braking = hard is not None and other_hard is not None and abs(hard - other_hard) >= MARKED
    crash = max(one, two) >= NEVER
    difference = (two - one) if ranking.by == "safer" else (jerk or 0.0)
    points = effect_points(found.effects, len(found.effects)) if ends == "done" else ()
    in_lane = any(a in LANE_CHANGES for a in (*found.factual[:1], *foil[:1]))
    rides = any(e.component == "jerk" for e in points)
    return Comparison(
        foil=Doing(EGO, foil, query.tense, in_lane),
        past=query.tense == "past",
        safety=ranking.by == "safer",
        risk=_chance(one) if crash else None,
        other=_chance(two) if crash else None,
        more=difference > 0.0,
        same=abs(difference) < NEVER if ranking.by == "safer" else not rides,
        harder=braking and (other_hard or 0.0) > (hard or 0.0),
        brake=_chance(hard or 0.0) if braking else None,
        other_brake=_chance(other_hard or 0.0) if braking else None,
        effects=tuple(e for e in points if e.component == "time"),
    )


def _chance(probability: float) -> Quantity:
    return Quantity(min(max(probability, NEVER), ALWAYS), "probability")
