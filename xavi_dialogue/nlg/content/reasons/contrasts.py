"""Contrasts: the consequences of the foil, which of them is the reason, and who causes it.

The terms that decided by the planner's reward are stated, and those that speak against them; see
`terms`. If the record shows no difference, the answer says that it was close.
"""

from typing import Any, Literal, TypeAlias

from xavi_dialogue.domain.answers import Cause, Contrast, Effect
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import CHANGES, other_verbs, plain
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.reasons import terms
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import table
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Quantity, Range, Who

RISK = 0.01  # minimum probability of a collision that is stated
SURE = 0.995  # minimum probability of what is stated as certain
EVEN, LIKELY = 0.45, 0.55  # bounds of what may or may not happen
STANDING = 0.5  # [m/s]
SLOWING = 0.6  # [m/s] minimum loss of speed that is stated as slowing
ASIDE = 2.0  # [m] minimum sideways distance of somebody in another lane
LANES = (("change-left",), ("change-right",))
RARE = 0.1  # share of the simulations below which a hold-up is no reason for a mean delay
OFTEN = 0.5  # share of the simulations that are too late in which it must occur
OTHERWISE = 2.0  # [m/s] by which a speed foreseen for later differs from the one that is seen

#: How the foil turns out: by its likeliest outcome, else by the term that is stated first; or the
#: record shows no difference (close), or speaks for the foil (worse).
Kind: TypeAlias = Literal[
    "collision", "dead", "late", "unsure", "risk", "time", "ride", "effort", "close", "worse",
    "alone",
]  # fmt: skip
_BY_OUTCOME: dict[str, Kind] = {"collision": "collision", "dead": "dead", "termination": "late"}
_BY_TERM: dict[str, Kind] = {
    "collision": "risk", "dead": "unsure", "late": "unsure", "effort": "effort", "time": "time",
}  # fmt: skip


def kind_of(contrast: Contrast) -> Kind:
    """Return how the foil turns out, and which consequence is the reason for the fact."""
    if not contrast.foil or contrast.outcome is None or contrast.verdict == "alone":
        return "alone"
    if contrast.outcome.name in _BY_OUTCOME:
        return _BY_OUTCOME[contrast.outcome.name]
    if contrast.verdict != "better":
        return contrast.verdict
    return _BY_TERM.get(contrast.told[0].term, "ride")


def main_effect(contrast: Contrast) -> Effect | None:
    """Find the effect that decided, if one did."""
    return next((e for e in contrast.effects if e.component == contrast.decisive), None)


def worth_telling(contrast: Contrast) -> list[Effect]:
    """List the effects that are not negligible, largest first."""
    least = table("causes")["negligible"]
    return [e for e in contrast.effects if abs(e.delta) > least[e.component]]


def time_effect(contrast: Contrast) -> Effect | None:
    """Find the difference in time, if it is not negligible."""
    return next((e for e in worth_telling(contrast) if e.component == "time"), None)


def _astray(contrast: Contrast) -> Chance | None:
    """Return the probability that the foil leads off the way, if that counts against it."""
    found = (s for s in contrast.told if s.term == "dead" and s.cost > 0.0)
    share = next(found, None)
    return None if share is None or not share.chance else Chance(share.chance)


def consequence_slots(
    contrast: Contrast, context: SpeechContext, *, past: bool, that: bool = False
) -> dict[str, Any]:
    """Make the slots for how the foil would have turned out.

    Args:
        contrast: fact and foil.
        context: the situation.
        past: the decision is past.
        that: the foil was named already, and is called "that".
    """
    outcome = contrast.outcome
    chance = 1.0 if outcome is None else outcome.probability
    struck = outcome.collided_with if outcome is not None else None
    struck = struck if struck is not None else contrast.collided_with
    time, main = time_effect(contrast), main_effect(contrast)
    later = time is not None and time.delta > 0.0
    parts, though = terms.sides(contrast, context, past=past)
    risk = terms.chance_of(contrast)
    counts = any(s.term == "collision" and s.cost > 0.0 for s in contrast.told)
    kind = kind_of(contrast)
    return {
        "kind": kind,
        "verdict": contrast.verdict,
        "past": past,
        "that": that and not contrast.further and contrast.verdict == "better",
        "simple": context.detail == "simpler",
        "foil": terms.foil_verbs(contrast),
        "parts": parts,
        "though": though,
        "chance": Chance(chance),
        "sure": chance >= SURE,
        "struck": None if struck is None else Who(Vehicle(struck), contrast.decided),
        "waypoint": contrast.waypoint,
        "way": contrast.way,
        "ride": main.component if main is not None and kind == "ride" else None,
        "risk_too": (counts or _adds_risk(contrast)) and kind not in ("risk", "collision", "alone"),
        "risk": Chance(risk) if counts or risk >= RISK else None,
        "tiny": risk < terms.TINY,
        "later": later,
        "unlike": contrast.spares_delay,
        "astray": _astray(contrast) if kind == "late" else None,
        **terms.timed(contrast, context, more=later),
        **terms.looked_ahead(contrast),
        **terms.not_worth_it(contrast),
        **terms.effort(contrast),
    }


def _adds_risk(contrast: Contrast) -> bool:
    """Check whether the foil has a risk of collision worth stating, above that of the fact."""
    return contrast.collision >= RISK and contrast.collision > contrast.fact_collision


def risks(
    contrast: Contrast,
    context: SpeechContext,
    *,
    past: bool,
    unsaid: bool = False,
    weighs: bool = False,
) -> Message | None:
    """Return a sentence on the risks, unless the sentence on the reason contains them.

    Args:
        contrast: fact and foil.
        context: the situation.
        past: the decision is past.
        unsaid: the sentence on the reason does not state what the foil would lead to.
        weighs: no other sentence states which of the two is better on the whole.
    """
    if max(contrast.collision, contrast.fact_collision) < RISK:
        return None
    slots = consequence_slots(contrast, context, past=past)
    when = Moment(contrast.decided) if context.now - contrast.decided > PRESENT else None
    if slots["kind"] == "alone":
        return message("RISK_ALONE", past=past, risk=Chance(contrast.fact_collision), when=when)
    if tells_risk(contrast) and not unsaid:
        return None
    more = contrast.collision > contrast.fact_collision
    return message(
        "BOTH_RISKS",
        past=past,
        when=when,
        foil=slots["foil"],
        risk=Chance(contrast.collision if contrast.collision >= RISK else 0.0),
        fact_risk=Chance(contrast.fact_collision if contrast.fact_collision >= RISK else 0.0),
        struck=slots["struck"] if more else None,
        simple=slots["simple"],
        more=more,
        close=weighs and contrast.verdict == "close" and not more,
    )


def tells_risk(contrast: Contrast) -> bool:
    """Check whether the sentence on the reason states the risk of a collision."""
    if kind_of(contrast) == "alone":
        return False
    return any(s.term == "collision" and s.cost > 0.0 for s in contrast.told)


def told_cause(contrast: Contrast) -> Cause | None:
    """Return the cause that belongs to the reason: who makes the foil worse, or decides a tie."""
    kind = kind_of(contrast)
    told = {s.term for s in contrast.told if s.cost > 0.0}
    decides = contrast.verdict == "close" and any(c.decision_changes for c in contrast.causes)
    due = (contrast.verdict == "better" or decides) and bool(told & {"collision", "late", "time"})
    if kind != "alone" and not due:
        return None
    if kind in ("collision", "risk"):
        struck = contrast.collided_with
        if contrast.outcome is not None and contrast.outcome.collided_with is not None:
            struck = contrast.outcome.collided_with
        named = [c for c in contrast.causes if c.vehicle == struck or struck is None]
        sure = [c for c in named if c.probability >= EVEN and telling(c.actions)]
        return sure[0] if sure else None
    slower = [c for c in contrast.causes if c.mechanism is None or c.mechanism.how != "collision"]
    slower = [c for c in slower if _carries(c, contrast)]
    return slower[0] if slower else None


def _carries(cause: Cause, contrast: Contrast) -> bool:
    """Check whether a hold-up comes often enough to be the reason for what the foil would cost.

    A delay that comes in nearly every simulation is not due to what happens in a few of them.
    """
    held = cause.mechanism
    if held is None or held.how == "collision":
        return True
    if contrast.outcome is not None and contrast.outcome.name == "termination":
        return held.share >= OFTEN * contrast.outcome.probability
    return held.share >= RARE


def cause_message(
    cause: Cause, contrast: Contrast, context: SpeechContext, *, past: bool
) -> Message:
    """Return a vehicle, and how it brought the consequences about, as a clause."""
    mechanism = cause.mechanism
    how = mechanism.how if mechanism is not None else None
    present = mechanism is not None and mechanism.present
    lowest = mechanism.speed_to if mechanism is not None else None
    start = mechanism.speed_from if mechanism is not None else None
    slows = start is not None and lowest is not None and start - lowest >= SLOWING
    later = _stops_later(cause, contrast.decided, context)
    look = context.look(cause.vehicle, contrast.decided)
    simple = context.detail == "simpler"
    ahead = present and how in ("leader", "blocked", "cut-in")
    return message(
        "CAUSE",
        who=Who(Vehicle(cause.vehicle), contrast.decided, placed=not ahead),
        how=how,
        present=present and not later,
        past=past,
        alone=not contrast.foil,
        there=contrast.foil[:1] in LANES and look is not None and abs(look.left) > ASIDE,
        stands=lowest is not None and lowest < STANDING and not slows,
        halts=lowest is not None and lowest < STANDING,
        slows=slows,
        speed=None if lowest is None or simple else Quantity(lowest, "m/s"),
        verbs=(Clause("it", "stop ahead of us", ("later",)), *_after(cause))
        if later
        else _expected(cause, None if look is None else look.speed, slows=slows, simple=simple),
        acts=other_verbs(cause.actions) if telling(cause.actions) else None,
        **chances(cause.probability, context),
    )


def telling(actions: tuple[str, ...]) -> bool:
    """Check whether actions are more than going on."""
    return bool(actions) and set(actions) - {"continue"} != set()


def chances(probability: float, context: SpeechContext) -> dict[str, object]:
    """Return how probable something was: in words, and in percent if that is wanted."""
    simple = context.detail == "simpler"
    return {
        "some": probability < EVEN,
        "maybe": EVEN <= probability < LIKELY,
        "share": Chance(probability),
        "shown": None if simple or probability >= SURE else Chance(probability),
    }


def _stops_later(cause: Cause, decided: float, context: SpeechContext) -> bool:
    """Check whether somebody ahead, who drives on now, stops only later in the rollouts.

    The lowest speed of a hold-up may be reached long after the decision.
    """
    how = cause.mechanism
    if how is None or how.how != "leader" or "stop" in cause.actions:
        return False
    here, before = (context.look(cause.vehicle, t) for t in (decided, decided - 1.0))
    if how.speed_to is None or how.speed_to >= STANDING or here is None or before is None:
        return False
    return here.speed >= STANDING and before.speed - here.speed < SLOWING


def _after(cause: Cause) -> tuple[Clause, ...]:
    """Return what a vehicle was expected to do after it was in the way."""
    return other_verbs(cause.actions)[-1:] if telling(cause.actions) else ()


def _expected(cause: Cause, seen: float | None, *, slows: bool, simple: bool) -> tuple[Clause, ...]:
    """Return what a vehicle was expected to do: how it gets in the way, and where it goes."""
    mechanism = cause.mechanism
    actions = other_verbs(cause.actions) if cause.actions else ()
    if mechanism is None or mechanism.how in ("right-of-way", "collision"):
        return actions or (Clause("it", "get in our way"),)
    after = _after(cause)
    if mechanism.how == "cut-in":
        moved = [a for a in plain(cause.actions) if a not in CHANGES and a != "continue"]
        return (Clause("it", "move in ahead of us"), *other_verbs(moved[-1:]))
    if mechanism.how == "blocked":
        return (Clause("it", "block our way"), *(a for a in after if a.verb != "stop"))
    lowest = mechanism.speed_to
    if lowest is not None and lowest < STANDING:
        return (Clause("it", "stop ahead of us"), *(a for a in after if a.verb != "stop"))
    start = mechanism.speed_from
    if slows and lowest is not None and start is not None and not simple:
        if seen is not None and abs(seen - start) > OTHERWISE:
            return (Clause("it", "slow down to about", (Quantity(lowest, "m/s"),)), *after)
        speeds = Range(Quantity(start, "m/s"), Quantity(lowest, "m/s"))
        return (Clause("it", "slow from", (speeds,)), *after)
    if slows:
        return (Clause("it", "slow down"), *after)
    at = ("at about", Quantity(lowest, "m/s")) if lowest is not None and not simple else ()
    return (Clause("it", "hold us up", at), *after)
