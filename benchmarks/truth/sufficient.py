"""Checks of whether an answer is sufficient: reasons that outweigh others, risks, waypoint."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, TypeAlias

from benchmarks.truth.context import Fault, Told
from benchmarks.truth.decision import Decision
from benchmarks.truth.naming import percents, seconds
from benchmarks.truth.reckoning import Actions, Term

Check: TypeAlias = Literal["sign", "number", "reason", "risk", "waypoint"]
CHECKS: tuple[Check, ...] = ("sign", "number", "reason", "risk", "waypoint")
#: The kinds of faults that mean a wrong figure.
NUMBERS = frozenset({
    "arrival", "belief", "change of speed", "chance now", "chance then", "closest", "count",
    "delay", "distance", "distance driven", "effort of a foil", "highest speed", "limit",
    "options", "outcome of a foil", "risk", "risk of a foil", "risk of another time",
    "risk of the plan", "risk of what I did", "situations", "speed foreseen", "speed now",
    "speed then", "time of a foil", "time of the decision", "time that is compared", "vehicles",
})  # fmt: skip
SIGN = frozenset({"terms told favour the foil", "plan worse than the foil", "another foil",
                  "not close", "not better", "gain denied"})  # fmt: skip
STEERING: frozenset[Term] = frozenset({"angular-acceleration", "curvature"})
RISK = 0.01  # least probability of a collision that an answer must state
EPSILON = 0.005  # [s] greatest difference that counts as none
RISKY = re.compile(r"\b(?:collision|collide\w*|crash\w*|hit)\b")
ARRIVES = re.compile(r"\b(?:get|got|be|been|take|taken|arrive) (?:us )?there\b|destination")
WAY = re.compile(r"way to (?:our|the) destination")
DONE = re.compile(r"just what I (?:did|plan|see)|that did happen")
GIVEN = re.compile(r"\bbecause\b|not strictly|the better choice|\b[Yy]es\b")


def check_of(fault: Fault) -> Check:
    """Return the check that a fault belongs to."""
    if fault.kind in SIGN:
        return "sign"
    if fault.kind.startswith("risk not said"):
        return "risk"
    if fault.kind == "destination":
        return "waypoint"
    return "number" if fault.kind in NUMBERS else "reason"


def insufficient(text: str, told: Sequence[Told], decision: Decision) -> Iterator[Fault]:
    """Yield what an answer to a question about reasons lacks.

    Args:
        text: of the answer.
        told: its statements about foils.
        decision: the decision that it is about, with the foil that was asked about.
    """
    did_that = DONE.search(text) is not None
    if decision.asked and not did_that and decision.plan[: len(decision.asked)] == decision.asked:
        did = f"the decision told of, at {decision.trace.sim_time:g} s, did that"
        yield Fault("another foil", f"asked {_named(decision.asked)}: {did}")
        return
    foils = list(dict.fromkeys(one.foil for one in told if not one.implied))
    for foil in foils:
        yield from _sign(text, [one.term for one in told if one.foil == foil], foil, decision)
    if decision.asked and not foils:
        yield from _no_term(decision)
    if (
        decision.asked
        and foils
        and not did_that
        and not any(_same(decision.asked, one) for one in foils)
    ):
        yield Fault("another foil", f"asked {_named(decision.asked)}, told {_named(foils[0])}")
    yield from _risks(text, foils, decision)
    if decision.trace.waypoint is not None and ARRIVES.search(WAY.sub("", text)):
        yield Fault("destination", f"aims for {decision.trace.waypoint.edge} on the way to it")


def _sign(
    text: str, terms: Sequence[Term | Literal["close", "better"]], foil: Actions, decision: Decision
) -> Iterator[Fault]:
    """Check that reasons for the plan outweigh those against it."""
    if "close" in terms or "better" in terms:
        return
    known = [sum(gain[t] for t in _meant(terms, gain)) for gain in decision.gains(foil)]
    whole = decision.values(foil)
    if known and max(known) <= EPSILON:
        yield Fault(
            "terms told favour the foil",
            f"{', '.join(sorted(set(map(str, terms))))}: {seconds(known)} of {seconds(whole)}"
            f" for {_named(decision.plan)} over {_named(foil)}",
        )
    elif whole and max(whole) < -EPSILON and GIVEN.search(text):
        yield Fault("plan worse than the foil", f"{seconds(whole)} over {_named(foil)}")


def _meant(
    terms: Sequence[Term | Literal["close", "better"]], gain: Mapping[Term, float]
) -> set[Term]:
    """Return the terms stated; steering stands for two if both have the same sign."""
    named = {term for term in gain if term in terms}
    if named & STEERING and gain["angular-acceleration"] * gain["curvature"] > 0.0:
        named |= STEERING
    return named


def _no_term(decision: Decision) -> Iterator[Fault]:
    """Check that the plan is better, if the answer names only what was in the way."""
    whole = decision.values(decision.asked)
    if whole and max(whole) < -EPSILON:
        yield Fault("plan worse than the foil", f"{seconds(whole)} over {_named(decision.asked)}")


def _risks(text: str, foils: Sequence[Actions], decision: Decision) -> Iterator[Fault]:
    if RISKY.search(text):
        return
    if (own := decision.risks(None)) and min(own) > RISK:
        yield Fault("risk not said of the plan", percents(own))
    for foil in dict.fromkeys((*foils, *([decision.asked] if decision.asked else []))):
        if (values := decision.risks(foil)) and min(values) > RISK:
            yield Fault("risk not said of the foil", f"{_named(foil)}: {percents(values)}")


def _same(asked: Actions, told: Actions) -> bool:
    """Check whether two foils are the same, with or without a junction for going straight on."""
    straight = {"continue", "exit-straight"}
    return asked[-1] in told or bool({asked[-1], told[-1]} <= straight)


def _named(plan: Actions) -> str:
    return ", then ".join(plan)
