"""Statements about the risk of a collision, of a foil and of the plan."""

import re
from collections.abc import Iterator

from benchmarks.truth.context import Fault, Said, Told, claim
from benchmarks.truth.decision import Decision
from benchmarks.truth.naming import PERCENT, foil_of, percents
from benchmarks.truth.phrases import ADVERB, is_chance, is_likely, trusted
from benchmarks.truth.reckoning import Actions

STRUCK = r"(?: with (?P<who>V\d+|it))?"


@claim(
    rf"(?:carries|carried|be|been) an? {PERCENT} risk of a collision"
    r"(?: with (?P<who>V\d+))?(?:, against (?P<other>(?:under |over )?\d+ %) for what I d(?:o|id))?"
)
def risk_of_foil(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check the risk of a collision of a foil, and of the plan if stated."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("collision", foil)
    yield from _risk(said, match, decision, foil)
    own = map(trusted, decision.risks(None))
    if match["other"] and not any(is_chance(match, value, "other") for value in own):
        yield Fault("risk of the plan", f"{match[0]}: {percents(decision.risks(None))}")


@claim(
    rf"I put the risk of a collision(?: with (?P<who>V\d+))? at (?P<other>(?:under |over )?\d+ %)"
    rf" for what I d(?:o|id), and at {PERCENT} for (?P<foil>[^.;]+)"
)
def both_risks(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check the risks of plan and foil that are stated together."""
    decision = said.decision
    foil = None if decision is None else decision.foil_of(match["foil"])
    if decision is None or foil is None:
        return
    yield Told("collision", foil)
    yield from _risk(said, match, decision, foil)
    if not any(is_chance(match, trusted(value), "other") for value in decision.risks(None)):
        yield Fault("risk of the plan", f"{match[0]}: {percents(decision.risks(None))}")


@claim(rf"I put the risk of a collision in what I d(?:o|id) at {PERCENT}")
def own_risk(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check the risk of a collision of the plan."""
    if said.decision is None:
        return
    values = said.decision.risks(None)
    if not any(is_chance(match, trusted(value)) for value in values):
        yield Fault("risk of the plan", f"{match[0]}: {percents(values)}")


@claim(
    rf"would {ADVERB}(?:have ended|end) in a collision{STRUCK}(?: \({PERCENT}\))?",
    rf"we would {ADVERB}(?:have collided|collide){STRUCK}(?: \({PERCENT}\))?",
)
def ends_in_a_collision(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that a foil ends in a collision with the stated probability."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("collision", foil)
    values = decision.risks(foil)
    if not any(is_likely(match["adverb"], trusted(value)) for value in values):
        yield Fault("outcome of a foil", f"{match[0]}: {percents(values)}")
    if match["chance"]:
        yield from _risk(said, match, decision, foil)
    elif match["who"] and not any(decision.risks(foil, said.who(match["who"]))):
        yield Fault("collision with another", match[0])


@claim(r"would (?:be|have been) less risky")
def less_risky(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that the plan has the higher risk of a collision."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("collision", foil)
    if not any(gain["collision"] < 0.0 for gain in decision.gains(foil)):
        yield Fault("risk of a foil", f"{match[0]}: {percents(decision.risks(foil))}")


def _risk(said: Said, match: re.Match[str], decision: Decision, foil: Actions) -> Iterator[Fault]:
    values = decision.risks(foil)
    struck = said.who(match["who"]) if match["who"] else ()
    with_it = decision.risks(foil, struck) + decision.risks(None, struck)
    known = (*values, *decision.risks(foil, struck))
    if not any(is_chance(match, trusted(value)) for value in known):
        yield Fault("risk of a foil", f"{match[0]}: {percents(values)} for {', '.join(foil)}")
    elif struck and not any(with_it):
        yield Fault("collision with another", match[0])
