"""Statements about the decision without a vehicle, checked by plans made again without it."""

import re
from collections.abc import Iterator
from itertools import product

from benchmarks.truth.context import Fault, Said, claim
from benchmarks.truth.decision import Decision
from planner.record.trace import PlanTrace

OTHERS = (
    r"[Oo]thers play(?:ed)? a part, too: without any one of them alone, "
    r"it would (?:have )?come to the same"
)


def tried(decision: Decision, who: tuple[int, ...]) -> list[PlanTrace]:
    """Return the plans that were made again without exactly these vehicles."""
    return [
        trace
        for trace in decision.without
        if trace.what_if is not None and trace.what_if.gone == frozenset(who)
    ]


@claim(
    r"[Ww]ithout (?P<who>V\d+),? I would (?:have )?"
    r"(?P<how>decided? otherwise|do(?:ne)? the same)",
    r"(?P<who>V\d+) ma(?:kes|de) (?P<how>no difference)",
)
def decided_without(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the decision was planned again without a vehicle, with the stated result."""
    if said.decision is None:
        return
    known = tried(said.decision, said.who(match["who"]))
    if not known:
        yield Fault("not tried without", match[0])
        return
    differs = [trace.plan[:1] and trace.plan[0].action != _first(said.decision) for trace in known]
    if "otherwise" not in match["how"] and all(differs):
        plans = ", ".join(str([step.action for step in trace.plan]) for trace in known)
        yield Fault("differs without", f"{match[0]}: {plans}")


@claim(
    r"[Ww]ithout (?P<who>V\d+), (?P<other>V\d+) would (?:be|have been) in our way just as well",
)
def another_instead(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that another vehicle holds us up in the plan made again without the first."""
    if said.decision is None:
        return
    known = tried(said.decision, said.who(match["who"]))
    other = said.who(match["other"])
    if not known:
        yield Fault("not tried without", match[0])
    elif not any(h.vehicle in other for t in known for r in t.rollouts for h in r.held_up):
        yield Fault("holds nobody up", match[0])


@claim(r"[Nn]o other vehicle ma(?:kes|de) the difference to that, not even all of them together")
def nobody_at_all(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the decision was planned again without all others, with the same result."""
    if said.decision is None:
        return
    known = [t for t in said.decision.without if t.what_if and t.what_if.gone]
    every = [t for t in known if len(t.scene) == 1]
    if not every:
        yield Fault("not tried without", match[0])
    elif all(t.plan[:1] and t.plan[0].action != _first(said.decision) for t in every):
        yield Fault("differs without", match[0])


@claim(
    rf"{OTHERS}, and without "
    r"(?:all (?P<count>\d+) of them|(?P<who>(?:V\d+|it)(?:(?:,| and|, and) (?:V\d+|it))*)), "
    r"I would (?:have )?do(?:ne)? (?P<how>otherwise|the same, but with less reason)"
)
def several(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the decision was planned again without this many vehicles, as stated."""
    if said.decision is None:
        return
    named = re.findall(r"V\d+|it", match["who"] or "")
    count = int(match["count"] or len(named))
    sure = {v for one in named if one != "it" for v in said.who(one)}
    again = (t for t in said.decision.without if t.what_if is not None)
    known = [t for t in again if t.what_if and len(t.what_if.gone) == count >= len(sure)]
    known = [t for t in known if t.what_if and sure <= t.what_if.gone]
    if not known:
        yield Fault("not tried without", match[0])
    elif match["how"] != "otherwise" and all(
        t.plan[:1] and t.plan[0].action != _first(said.decision) for t in known
    ):
        yield Fault("differs without", match[0])


@claim(rf"{OTHERS}(?!, and)")
def several_unnamed(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the decision was planned again without three vehicles or more."""
    if said.decision is None:
        return
    if not any(t.what_if and len(t.what_if.gone) > 2 for t in said.decision.without):
        yield Fault("not tried without", match[0])


@claim(
    r"[Bb]oth (?P<who>V\d+|it) and (?P<other>V\d+|it) (?:ha(?:d|ve) to be there|count(?:ed)?)"
    r": without one of them, I would (?:have )?do(?:ne)? "
    r"(?:otherwise|the same, but with less reason)",
)
def both(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the decision was planned again without one of two vehicles alone."""
    if said.decision is None:
        return
    named = {*said.who(match["who"]), *said.who(match["other"])}
    if not any(tried(said.decision, (vehicle,)) for vehicle in named):
        yield Fault("not tried without", match[0])


@claim(r"[Ee]ither of them would have been enough, (?P<who>V\d+|it) or (?P<other>V\d+|it)")
def either(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the decision was planned again without both vehicles, with another result."""
    if said.decision is None:
        return
    pairs = product(said.who(match["who"]), said.who(match["other"]))
    if not any(tried(said.decision, pair) for pair in pairs):
        yield Fault("not tried without", match[0])


def _first(decision: Decision) -> str | None:
    return decision.plan[0] if decision.plan else None
