"""Terms: what is stated about a difference, each term as a verb phrase about the foil.

Terms that support the verdict come first, a risk of a collision before all others. Terms against
it follow after "though".
"""

import math
from collections.abc import Iterable
from typing import Any

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Contrast, Share
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import CHANGES, own_verbs
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Clause, Number, Quantity, Who

LIKELY = 0.5  # minimum probability of an outcome that is stated as what comes, not as a chance
SURE = 0.995  # minimum probability of what is stated as certain
LITTLE = 2.25  # [s] maximum gain that is called little
LARGE = 8.0  # [s] minimum difference that is called much
TINY = 0.01  # probability below which it is stated as under 1 %
ROUND = 5.0  # [s] precision of the time that is compared
STEERING = ("angular-acceleration", "curvature")
RIDES = ("jerk", "angular-acceleration", "curvature")
_OUTCOMES = {"collision": "collision", "dead": "dead", "late": "termination"}


def foil_verbs(contrast: Contrast) -> tuple[Clause, ...]:
    """Return what was not done as verb phrases, with further manoeuvres that it contains."""
    whole, contrast, further = contrast, parted(contrast), contrast.further
    if contrast.foil[-1:] == ("continue",) and further and further[0] in CHANGES:
        first = own_verbs(contrast.foil, contrast.fact)
        rest = own_verbs(further, contrast.fact)
        return (*first, *(Clause(one.subject, one.verb, (*one.rest, "later")) for one in rest))
    row = own_verbs((*contrast.foil, *further), contrast.fact)
    if row and further and further[:1] == contrast.foil[-1:]:
        side = further[0].removeprefix("change-")
        if row[-1].verb == f"move to the {side} lane":
            return (*row[:-1], Clause(row[0].subject, f"move two lanes to the {side}"))
        return (*row, Clause(row[0].subject, "move one lane further"))
    if row and contrast is not whole:  # the same action may be done now
        head = row[0]
        further_on = (*head.rest, "after going straight on")
        return (Clause(head.subject, head.verb, further_on), *row[1:])
    return row


def parted(contrast: Contrast) -> Contrast:
    """Return the contrast without going straight on where both plans begin with it."""
    same = contrast.foil[:1] == contrast.fact[:1] == ("continue",)
    if not same or len(contrast.foil) < 2:
        return contrast
    return replace(contrast, foil=contrast.foil[1:], fact=contrast.fact[1:])


def sides(
    contrast: Contrast, context: SpeechContext, *, past: bool
) -> tuple[tuple[Message, ...], tuple[Message, ...]]:
    """Return phrases for the stated terms: those that support the verdict, and those against it."""
    sign = -1.0 if contrast.verdict == "worse" else 1.0
    risky = sorted(_leading(contrast.told), key=lambda share: share.term != "collision")
    spoken = [s for s in risky if s.term != "collision" or s.cost > 0.0 or sign < 0.0]
    if any(s.term == "late" for s in spoken) and (contrast.late or contrast.spares_delay):
        spoken = [s for s in spoken if s.term != "time"]  # this is the time of the few that arrive
    told = [(s, _term(s, contrast, context, past=past)) for s in spoken]
    for_it = tuple(one for s, one in told if sign * s.cost > 0.0)
    fatal = any(s.term == "collision" and sign * s.cost > 0.0 for s in spoken)
    told = [(s, one) for s, one in told if not (fatal and s.term == "late")]  # a crash is not late
    against = tuple(one for s, one in told if sign * s.cost <= 0.0)
    return (for_it, against) if for_it else (against, ())


def _leading(told: Iterable[Share]) -> list[Share]:
    """Return the shares to state; of those about steering, only the first, which is the largest."""
    found: list[Share] = []
    for share in told:
        if share.term not in STEERING or all(other.term not in STEERING for other in found):
            found.append(share)
    return found


def not_worth_it(contrast: Contrast) -> dict[str, object]:
    """Return the slots for a foil that gains too little for its effort, if that is all.

    Such a foil has more lane changes or stops. Only these and their effect on comfort are stated
    against it, and only time for it.
    """
    needs = effort(contrast)
    spoken = _leading(contrast.told)
    told = [s for s in spoken if s.term == "time" or s.cost > 0.0]
    rides = [s.term for s in told if s.term in RIDES]
    pros = [s for s in told if s.cost > 0.0]
    alone = len(told) == len(spoken) and all(s.term in (*RIDES, "effort") for s in pros)
    more = needs["net"] > 0 and (needs["changes"] or needs["change"] or needs["stop"])
    due = contrast.verdict == "better" and alone and bool(more)
    return {
        "not_worth": due,
        "saves": due and len(told) > len(pros),
        "rides": tuple(message("RIDE_EFFECT", ride=r, more=True) for r in rides),
    }


def chance_of(contrast: Contrast) -> float:
    """Return the probability of a collision under the foil, according to the comparison."""
    share = next((s for s in contrast.told if s.term == "collision"), None)
    known = 0.0 if share is None or share.chance is None else share.chance
    return contrast.collision or known


def timed(contrast: Contrast, context: SpeechContext, *, more: bool) -> dict[str, object]:
    """Return the slots for a difference in time, if one of that sign is recorded."""
    effect = next((e for e in contrast.effects if e.component == "time"), None)
    if effect is None or (effect.delta > 0.0) != more:
        return {"delta": None, "mean": False, "much": False, "little": False}
    size = abs(effect.delta)
    return {
        "delta": Quantity(size, "s"),
        "mean": effect.low < -0.25 and effect.high > 0.25,
        "much": size >= LARGE,
        "little": size <= LITTLE,
        "stretch": stretch(contrast, context),
    }


def looked_ahead(contrast: Contrast) -> dict[str, object]:
    """Return the slots for the horizon, and how much longer the late plan takes."""
    known, more = contrast.horizon, contrast.exceeds
    return {
        "horizon": None if known is None else Quantity(known, "s"),
        "exceeds": None if more is None or more < 1.0 else Quantity(math.floor(more), "s"),
    }


def stretch(contrast: Contrast, context: SpeechContext) -> Quantity | None:
    """Return how long the compared drive is, if it does not lead to the destination."""
    aim = contrast.aim
    if aim is None or aim.destination or aim.time is None or context.detail == "simpler":
        return None
    return Quantity(max(ROUND * round(aim.time / ROUND), ROUND), "s")


def _term(share: Share, contrast: Contrast, context: SpeechContext, *, past: bool) -> Message:
    outcome = contrast.outcome
    name = _OUTCOMES.get(share.term)
    likely = outcome is not None and name == outcome.name and outcome.probability >= LIKELY
    chance = outcome.probability if likely and outcome is not None else share.chance or 0.0
    here = share.fact_chance or 0.0
    struck = contrast.collided_with
    if outcome is not None and outcome.collided_with is not None:
        struck = outcome.collided_with
    if share.term == "collision" and not likely:
        chance = chance_of(contrast)
        here = contrast.fact_collision or here
    both = name is not None and here >= LIKELY and (share.chance or 0.0) >= LIKELY
    return message(
        "TERM",
        term=share.term,
        more=share.cost > 0.0,
        later=share.cost > 0.0,
        past=past,
        simple=context.detail == "simpler",
        likely=likely,
        sure=chance >= SURE,
        chance=Chance(chance),
        tiny=chance < TINY,
        both=both,
        unlike=share.term == "late" and contrast.spares_delay,
        **looked_ahead(contrast),
        fact_risk=Chance(here) if 0.01 <= here < chance - 0.01 else None,
        struck=None if struck is None else Who(Vehicle(struck), contrast.decided),
        waypoint=contrast.waypoint,
        route=None if contrast.route is None else own_verbs((contrast.route,)),
        **timed(contrast, context, more=share.cost > 0.0),
        **effort(contrast),
    )


def effort(contrast: Contrast) -> dict[str, Any]:
    """Return by how many lane changes and stops the foil differs."""
    whole, fact = (*contrast.foil, *contrast.continued), contrast.fact
    changes = _count(whole, CHANGES) - _count(fact, CHANGES)
    stops = _count(whole, ("stop",)) - _count(fact, ("stop",))
    return {
        "changes": Number(abs(changes), "change") if abs(changes) > 1 else None,
        "change": abs(changes) == 1,
        "stop": stops != 0 and changes == 0,
        "net": changes or stops,
    }


def _count(row: Iterable[str], kinds: Iterable[str]) -> int:
    among = frozenset(kinds)
    return sum(action in among for action in row)
