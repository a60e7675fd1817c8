"""Statements about the costs of a foil (time, effort, comfort), and that it was close."""

import re
from collections.abc import Iterator

from benchmarks.truth.context import Fault, Said, Told, claim
from benchmarks.truth.decision import Decision
from benchmarks.truth.naming import foil_of, seconds
from benchmarks.truth.phrases import SIZE, count, is_time
from benchmarks.truth.reckoning import Actions, Comfort

RIDES: dict[str, tuple[Comfort, bool]] = {
    "a rougher ride": ("jerk", True), "a smoother ride": ("jerk", False),
    "sharper steering": ("angular-acceleration", True),
    "gentler steering": ("angular-acceleration", False),
    "a more winding path": ("curvature", True), "a straighter path": ("curvature", False),
}  # fmt: skip
NEEDS = (
    r"(?:(?P<count>a|\w+) (?:more )?(?P<noun>lane change|change|stop)s?(?: of lanes)?(?: more)?"
    r"|the effort)"
)
CLOSE = 1.0  # [s] greatest difference that may be called little
ROUND = 5.0  # [s] greatest rounding error of the duration that is compared
NOTHING = 0.75  # [s] from which on a gain is not nothing


@claim(
    rf"would (?:only )?(?:have )?(?P<how>cost|saved?) us (?:about )?{SIZE}",
    rf"we would (?:have )?(?P<how>lose|lost|gain(?:ed)?) (?:about )?{SIZE}",
    rf"there,? (?:on average, |about )?{SIZE} (?P<how>later|sooner)",
)
def time_of_foil(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check a difference in time between foil and fact, and which of them is quicker."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("time", foil)
    later = match["how"] in ("cost", "lose", "lost", "later")
    known = [
        there - here
        for fact, side in decision.pairs(foil)
        if (here := fact.mean("time")) is not None and (there := side.mean("time")) is not None
    ]
    yield from _stretch(match, decision)
    signed = [value for value in known if (value > 0.0) == later]
    if not any(is_time(match["size"], value) for value in signed):
        yield Fault("time of a foil", f"{match[0]}: {seconds(known)} for {', '.join(foil)}")


def _stretch(match: re.Match[str], decision: Decision) -> Iterator[Fault]:
    """Check that the rollouts take about as long as the answer says, and aim for a waypoint."""
    if not match["stretch"]:
        return
    known = [time for side in decision.drives() if (time := side.mean("time")) is not None]
    if decision.trace.waypoint is None or not any(
        abs(time - float(match["stretch"])) <= ROUND for time in known
    ):
        yield Fault("time that is compared", f"{match[0]}: {seconds(known)}")


@claim(
    rf"(?P<how>nothing that is|too little to be|not enough (?:in all )?to be) worth {NEEDS}",
    rf"would (?:have )?take(?:n)? (?:{NEEDS}|more effort)(?P<how>)",
    rf"would (?:have )?(?P<how>spare(?:d)?) us {NEEDS}",
)
def effort_of_foil(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check how many more lane changes or stops a foil takes, and that it gains nothing if so."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("effort", foil)
    noun = match.groupdict().get("noun")
    if noun is not None:
        start = "stop" if noun == "stop" else "change"
        more = {
            sum(a.startswith(start) for a in there.plan) - sum(a.startswith(start) for a in f.plan)
            for f, there in decision.pairs(foil)
        }
        if (-1 if match["how"].startswith("spare") else 1) * count(match["count"]) not in more:
            yield Fault("effort of a foil", f"{match[0]}: {sorted(more)} more")
    saved = [-gain["time"] for gain in decision.gains(foil)]
    if match["how"].startswith("nothing") and saved and min(saved) > NOTHING:
        yield Fault("gain denied", f"{match[0]}: saves {seconds(saved)}")


@claim("|".join(RIDES))
def ride_of_foil(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that a foil is rougher, or smoother, than the plan."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    term, more = RIDES[match[0]]
    yield Told(term, foil)
    known = [gain[term] for gain in decision.gains(foil)]
    if not any(value > 0.0 if more else value < 0.0 for value in known):
        yield Fault("comfort of a foil", f"{match[0]}: {seconds(known)}")


@claim(
    r"ma(?:kes|de) little difference",
    r"(?:be|been) about as good",
    r"(?:come|came) to about the same",
    r"\b[Ii]t (?:is|was) (?:close|a close decision)\b",
    r"no real difference",
)
def close(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that plan and foil are worth about the same."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("close", foil)
    known = decision.values(foil)
    if known and min(map(abs, known)) > CLOSE + max(effort_between(decision, foil), 0.0):
        yield Fault("not close", f"{match[0]}: {seconds(known)} for {', '.join(foil)}")


def effort_between(decision: Decision, foil: Actions) -> float:
    """Return the greatest estimate of how much more effort [s] a foil takes."""
    return max((gain["effort"] for gain in decision.gains(foil)), default=0.0)


@claim(r"would (?:even )?(?:be|have been) (?:slightly |a little )?better\b")
def better(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that a foil is better than the plan by the record."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield Told("better", foil)
    known = decision.values(foil)
    if known and min(known) > 0.0:
        yield Fault("not better", f"{match[0]}: {seconds(known)} for {', '.join(foil)}")
