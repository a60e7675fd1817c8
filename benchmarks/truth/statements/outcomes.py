"""Statements about outcomes of a foil (off the way, too late), and about the way."""

import re
from collections.abc import Iterator

from benchmarks.truth.context import Fault, Said, Told, claim
from benchmarks.truth.decision import Decision
from benchmarks.truth.naming import PERCENT, foil_of, percents, seconds
from benchmarks.truth.phrases import ADVERB, acts, is_chance, is_likely, trusted
from benchmarks.truth.reckoning import OUTCOMES, Term
from planner.record.trace import Action, Outcome

ROADS: tuple[Action, ...] = ("exit-left", "exit-right", "exit-straight", "continue-next-exit")
LONGER = 1.0  # [s] least difference by which another way is longer


#: Words for taking longer than the planning horizon.
BEYOND = (
    r"(?:more than (?P<horizon>\d+) seconds (?:to our destination|for the next stretch of our way)"
    r"|longer than the time that I look(?:ed)? ahead)"
)


@claim(rf"would {ADVERB}(?:have taken|take) us {BEYOND}, and so would")
def both_late(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that neither foil nor plan arrives within the planning horizon."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    sides = [[side.chance("termination") for side in pair] for pair in decision.pairs(foil)]
    if not any(is_likely(match["adverb"], trusted(min(pair), "termination")) for pair in sides):
        yield Fault("outcome of both", f"{match[0]}: {percents([x for p in sides for x in p])}")
    yield from _looked(decision, match)


@claim(
    rf"would {ADVERB}(?:have taken|take) us {BEYOND}(?!, and so would)",
    rf"might (?:have taken|take) us {BEYOND} \({PERCENT}\)(?P<adverb>)",
    rf"(?P<both>less likely) to take us {BEYOND}",
    rf"would not (?:have taken|take) us {BEYOND}(?P<both>)",
    r"would (?:have left|leave) (?:more|less) of the way to go(?P<both>) after "
    r"(?:(?P<horizon>\d+) seconds|the time that I look(?:ed)? ahead)",
)
def late(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that a foil does not arrive within the planning horizon."""
    yield from _outcome(said, match, ("termination",))
    if said.decision is not None:
        yield from _looked(said.decision, match)


@claim(
    rf"would {ADVERB}(?:have taken|take) us "
    r"more than (?P<seconds>\d+) seconds? (?P<how>longer) than my choice",
    r"more than (?P<seconds>\d+) seconds? (?P<how>quicker)(?P<both>) than my choice",
)
def beyond(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check which side is late, and how long before the horizon's end the other one arrives."""
    yield from _outcome(said, match, ("termination",))
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    horizon = decision.trace.settings.horizon
    pairs = decision.pairs(foil)
    known = [
        horizon - time
        for fact, side in pairs
        if (time := (fact if match["how"] == "longer" else side).mean("time")) is not None
    ]
    if not any(int(match["seconds"]) <= left < int(match["seconds"]) + 1.0 for left in known):
        yield Fault("time of a foil", f"{match[0]}: {seconds(known)}")


def _looked(decision: Decision, match: re.Match[str]) -> Iterator[Fault]:
    """Check the stated planning horizon."""
    known = decision.trace.settings.horizon
    if match["horizon"] and abs(float(match["horizon"]) - known) > 0.5:
        yield Fault("time looked ahead", f"{match[0]}: {known:g} s")


@claim(
    rf"might not (?:have )?take(?:n)? us to our destination \({PERCENT}\)(?P<adverb>)",
    rf"might (?:have )?take(?:n)? us off our route \({PERCENT}\)(?P<adverb>)",
    rf"would {ADVERB}(?:have )?take(?:n)? us (?P<both>off our way)(?=, as we ha)",
    r"(?P<both>more certain) to keep us on our way",
    rf"would {ADVERB}(?:not )(?:have )?take(?:n)? us to our destination",
    rf"would {ADVERB}(?:have )?take(?:n)? us off our route",
    rf"we would {ADVERB}(?:have left|leave) our (?:route|way to the destination)",
    r"that (?:is|was) not the way to our destination(?P<adverb>)",
)
def off_the_way(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that a foil leads off the way to the decision's waypoint."""
    way = "way to" in match[0] or "off our way" in match[0]
    yield from _outcome(said, match, ("dead", "termination") if way else ("dead",))


def _outcome(
    said: Said, match: re.Match[str], outcomes: tuple[Outcome, ...]
) -> Iterator[Fault | Told]:
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield from (Told(OUTCOMES[outcome], foil) for outcome in outcomes)
    known = [decision.chances(outcome, foil) for outcome in outcomes]
    values = [sum(one) for one in zip(*known, strict=True)] + [v for one in known for v in one]
    part = match.groupdict()
    if part.get("both") is not None:
        return  # the sentence states the side with more of it, or is checked by `way_ahead`
    if outcomes == ("termination",):
        values = [trusted(value, "termination") for value in values]
    if part.get("chance"):
        right = any(is_chance(match, value) for value in values)
    else:
        right = any(is_likely(match["adverb"], value) for value in values)
    if not right:
        yield Fault("outcome of a foil", f"{match[0]}: {percents(values)} for {', '.join(foil)}")


@claim(r"as we ha(?:ve|d) to (?P<next>[^,;.]*) next")
def way_ahead(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the way continues as stated at the next junction, or as the plan does."""
    kinds = acts(match["next"])
    if said.decision is None or not kinds:
        return
    road = said.decision.trace.road
    ahead = [] if road is None else [step.turn for step in road.route[:2]]
    found = foil_of(said, match)
    if not kinds[0] & {*ahead, *said.decision.plan}:
        yield Fault("way ahead", f"{match[0]}: {', '.join(ahead)}")
    elif found is not None and found[1][-1] in kinds[0]:
        yield Fault("way ahead", f"{match[0]}: the foil does that")


@claim(r"might not (?:get|have got) (?:there|through the next stretch of our way)")
def unsure(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that a foil arrives in some situations and not in others."""
    found = foil_of(said, match)
    if found is None:
        return
    decision, foil = found
    yield from (Told(term, foil) for term in OUTCOMES.values())
    known = decision.chances("done", foil)
    if not any(value < 0.995 for value in known):
        yield Fault("outcome of a foil", f"{match[0]}: {percents(known)} arrive")


@claim(r"that (?:is|was) the way to our destination")
def the_way(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that every other road that was tried leads off the way, or takes longer."""
    decision = said.decision
    if decision is None:
        return
    if decision.asked:
        yield Told("time", decision.asked)
        yield from (Told(OUTCOMES[o], decision.asked) for o in ("dead", "termination"))
    depth = next((k for k, a in enumerate(decision.plan) if a in ROADS), None)
    if depth is None:
        yield Fault("no road taken", f"{match[0]}: {', '.join(decision.plan)}")
        return
    for road in ROADS:
        other = (*decision.plan[:depth], road)
        if other == decision.plan[: depth + 1]:
            continue
        known = decision.gains(other)
        if known and max(g["dead"] + g["late"] + g["time"] for g in known) <= LONGER:
            arrive = percents(decision.chances("done", other))
            yield Fault("another way", f"{match[0]}: {road} arrives as soon, {arrive}")
        elif known:
            terms: tuple[Term, ...] = ("time", "dead", "late")
            yield from (Told(term, other, implied=True) for term in terms)
