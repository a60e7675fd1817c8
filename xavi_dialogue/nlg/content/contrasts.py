"""Contrasts: how the foil would have turned out, what of that is the reason, and who causes it.

The reason that is told is the term that decided in the planner's own reckoning. What the effects
have to say against it is told beside it, and the risk of a collision before all else.
"""

from typing import Any, Literal, TypeAlias

from xavi_dialogue.domain.answers import Cause, Contrast, Effect
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.manoeuvres import CHANGES, other_verbs, own_verbs, plain
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import table
from xavi_dialogue.nlg.surface.values import (
    Chance,
    Clause,
    Number,
    Quantity,
    Range,
    Who,
)

RISK = 0.01  # probability of a collision from which it is told
SURE = 0.995  # probability from which none is told
EVEN, LIKELY = 0.45, 0.55  # bounds of what may or may not be
STANDING = 0.5  # [m/s]
SLOWING = 0.6  # [m/s] a loss of speed worth calling so
OTHERWISE = 2.0  # [m/s] by which a speed foreseen for later differs from the one that is seen
LITTLE = 2.0  # [s] a gain up to which it is called little
WORSE = 0.25  # [s] by which a plan is worse than its foil by its own record
LARGE = 8.0  # [s] a difference that is much in everyday words

#: What of the foil is the reason: its outcome, a risk, an effect, effort; or that it was close.
Kind: TypeAlias = Literal[
    "collision", "dead", "late", "unsure", "risk", "time", "ride", "effort", "close", "same",
    "alone",
]  # fmt: skip
_BY_OUTCOME: dict[str, Kind] = {"collision": "collision", "dead": "dead", "termination": "late"}


def kind_of(contrast: Contrast) -> Kind:
    """Tell what of a foil is the reason for the fact."""
    if not contrast.foil or contrast.outcome is None:
        return "alone"
    if contrast.outcome.name in _BY_OUTCOME:
        return _BY_OUTCOME[contrast.outcome.name]
    risky = contrast.collision - contrast.fact_collision >= RISK / 2
    if contrast.decisive == "collision" and risky:
        return "risk"
    if contrast.decisive == "effort":
        return "effort"
    if contrast.close:
        more = contrast.collision - contrast.fact_collision >= RISK
        return "risk" if more and contrast.collision >= RISK else "close"
    if contrast.decisive in ("dead", "late") and contrast.outcome.probability < SURE:
        return "unsure"
    reason = deciding(contrast)
    if reason is None:
        return "same"
    if reason.component == "time":
        return "time"
    return "effort" if _steers(contrast) else "ride"


def _steers(contrast: Contrast) -> bool:
    """Whether the foil is a change of lanes more, which is steering by itself."""
    changes = [sum(a in CHANGES for a in plain(p)) for p in (contrast.foil, contrast.fact)]
    return changes[0] > changes[1]


def deciding(contrast: Contrast) -> Effect | None:
    """The effect that speaks for the fact: the one that decided, else the first worth telling."""
    worse = [e for e in worth_telling(contrast) if e.delta > 0.0]
    decided = [e for e in worse if e.component == contrast.decisive]
    if decided or contrast.decisive is not None:
        return decided[0] if decided else None
    return min(worse, key=lambda e: e.component != "time", default=None)


def worth_telling(contrast: Contrast) -> list[Effect]:
    """The effects that are not negligible, largest first."""
    least = table("causes")["negligible"]
    return [e for e in contrast.effects if abs(e.delta) > least[e.component]]


def time_effect(contrast: Contrast) -> Effect | None:
    """The difference in time, where it is worth telling."""
    return next((e for e in worth_telling(contrast) if e.component == "time"), None)


def consequence_slots(
    contrast: Contrast, context: SpeechContext, *, past: bool, that: bool = False
) -> dict[str, Any]:
    """The slots that tell how the foil would have turned out.

    Args:
        contrast: fact and foil.
        context: the situation.
        past: the decision is past.
        that: the foil was named, and is "that".
    """
    kind = kind_of(contrast)
    outcome = contrast.outcome
    chance = 1.0 if outcome is None else outcome.probability
    struck = outcome.collided_with if outcome is not None else None
    struck = struck if struck is not None else contrast.collided_with
    reason = deciding(contrast) if kind in ("time", "ride") else None
    simple = context.detail == "simpler"
    return {
        "kind": kind,
        "past": past,
        "that": that,
        "simple": simple,
        "foil": own_verbs(contrast.foil, contrast.fact),
        "chance": Chance(chance),
        "sure": chance >= SURE,
        "struck": None if struck is None else Who(Vehicle(struck), contrast.decided),
        "waypoint": contrast.waypoint,
        "way": contrast.way,
        "ride": None if reason is None or kind == "time" else reason.component,
        "worse": (contrast.value or 0.0) <= -WORSE,
        "risk_too": _folded(contrast, kind),
        "risk": Chance(contrast.collision) if contrast.collision >= RISK else None,
        "fact_risk": Chance(contrast.fact_collision) if _tells_apart(contrast) else None,
        **_time(contrast, context, kind),
        **_effort(contrast),
        **_opposed(contrast, kind),
    }


def _tells_apart(contrast: Contrast) -> bool:
    """Whether the risk of the fact is worth telling beside that of the foil."""
    return RISK <= contrast.fact_collision < contrast.collision - RISK


def _folded(contrast: Contrast, kind: Kind) -> bool:
    """Whether the risk of the foil goes into the sentence of the reason."""
    more = contrast.collision >= RISK and contrast.collision > contrast.fact_collision
    return more and kind in ("time", "ride", "late", "dead", "unsure")


def _time(contrast: Contrast, context: SpeechContext, kind: Kind) -> dict[str, object]:
    """How much later or sooner, as a rule or in the mean; in everyday words where wanted."""
    effect = time_effect(contrast)
    if effect is None:
        return {"delta": None, "later": False, "mean": False}
    least = table("causes")["negligible"]["time"]
    size = abs(effect.delta)
    return {
        "delta": Quantity(size, "s"),
        "later": effect.delta > 0.0,
        "mean": effect.low < -least and effect.high > least,
        "much": size >= LARGE,
        "little": size <= LITTLE,
    }


def _effort(contrast: Contrast) -> dict[str, object]:
    """What the foil takes more of: lane changes, else stops."""
    whole, fact = (*contrast.foil, *contrast.continued), contrast.fact
    changes = sum(a in CHANGES for a in plain(whole)) - sum(a in CHANGES for a in plain(fact))
    stops = sum(a == "stop" for a in plain(whole)) - sum(a == "stop" for a in plain(fact))
    return {
        "changes": Number(changes, "lane change") if changes > 1 else None,
        "change": changes == 1,
        "stop": stops > 0 and changes <= 0,
    }


def _opposed(contrast: Contrast, kind: Kind) -> dict[str, object]:
    """The comfort of the ride, where it speaks against the reason that is told."""
    rides = [e for e in worth_telling(contrast) if e.component != "time"]
    time = time_effect(contrast)
    later = time is not None and time.delta > 0.0
    if kind == "close":
        rides = [e for e in rides if (e.delta > 0.0) != later] if time is not None else []
    elif kind != "time" or contrast.decisive is not None:
        rides = []
    else:
        rides = [e for e in rides if e.delta < 0.0]
    first = rides[0] if rides else None
    return {
        "but": None if first is None else first.component,
        "but_more": first is not None and first.delta > 0.0,
    }


def risks(contrast: Contrast, context: SpeechContext, *, past: bool) -> Message | None:
    """Make a sentence of the risks, where they are not part of that of the reason."""
    slots = consequence_slots(contrast, context, past=past)
    told = slots["kind"] in ("risk", "collision") or slots["risk_too"]
    if max(contrast.collision, contrast.fact_collision) < RISK or told:
        return None
    if slots["kind"] == "alone":
        return message("RISK_ALONE", past=past, risk=Chance(contrast.fact_collision))
    struck = slots["struck"] if contrast.collision >= contrast.fact_collision else None
    low = Chance(contrast.collision if contrast.collision >= RISK else 0.0)
    fact = Chance(contrast.fact_collision if contrast.fact_collision >= RISK else 0.0)
    return message(
        "BOTH_RISKS",
        past=past,
        foil=slots["foil"],
        risk=low,
        fact_risk=fact,
        struck=struck,
        simple=slots["simple"],
        more=contrast.collision > contrast.fact_collision,
    )


def told_cause(contrast: Contrast) -> Cause | None:
    """The cause that goes with the reason: who makes the foil worse, or has us drive so."""
    kind = kind_of(contrast)
    if kind not in ("collision", "late", "risk", "time", "unsure", "alone"):
        return None
    if kind in ("collision", "risk"):
        struck = contrast.collided_with
        if contrast.outcome is not None and contrast.outcome.collided_with is not None:
            struck = contrast.outcome.collided_with
        named = [c for c in contrast.causes if c.vehicle == struck or struck is None]
        sure = [c for c in named if c.probability >= EVEN and telling(c.actions)]
        return sure[0] if sure else None
    slower = [c for c in contrast.causes if c.mechanism is None or c.mechanism.how != "collision"]
    return slower[0] if slower else None


def cause_message(
    cause: Cause, contrast: Contrast, context: SpeechContext, *, past: bool
) -> Message:
    """Make a clause of a vehicle and how it made things turn out so."""
    mechanism = cause.mechanism
    how = mechanism.how if mechanism is not None else None
    present = mechanism is not None and mechanism.present
    lowest = mechanism.speed_to if mechanism is not None else None
    start = mechanism.speed_from if mechanism is not None else None
    slows = start is not None and lowest is not None and start - lowest >= SLOWING
    look = context.look(cause.vehicle, contrast.decided)
    simple = context.detail == "simpler"
    ahead = present and how in ("leader", "blocked", "cut-in")
    return message(
        "CAUSE",
        who=Who(Vehicle(cause.vehicle), contrast.decided, placed=not ahead),
        how=how,
        present=present,
        past=past,
        alone=not contrast.foil,
        stands=lowest is not None and lowest < STANDING and not slows,
        halts=lowest is not None and lowest < STANDING,
        slows=slows,
        speed=None if lowest is None or simple else Quantity(lowest, "m/s"),
        verbs=_expected(cause, None if look is None else look.speed, slows=slows, simple=simple),
        acts=other_verbs(cause.actions) if telling(cause.actions) else None,
        **chances(cause.probability, context),
    )


def telling(actions: tuple[str, ...]) -> bool:
    """Whether actions say more than going on."""
    return bool(actions) and set(actions) - {"continue"} != set()


def chances(probability: float, context: SpeechContext) -> dict[str, object]:
    """How surely something was expected, in words and in percent where that is wanted."""
    simple = context.detail == "simpler"
    return {
        "some": probability < EVEN,
        "maybe": EVEN <= probability < LIKELY,
        "share": Chance(probability),
        "shown": None if simple or probability >= SURE else Chance(probability),
    }


def _expected(cause: Cause, seen: float | None, *, slows: bool, simple: bool) -> tuple[Clause, ...]:
    """What the vehicle was expected to do: how it gets in the way, and where it goes."""
    mechanism = cause.mechanism
    actions = other_verbs(cause.actions) if cause.actions else ()
    if mechanism is None or mechanism.how in ("right-of-way", "collision"):
        return actions or (Clause("it", "get in our way"),)
    after = actions[-1:] if telling(cause.actions) else ()
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
