"""Statements about the vehicles that we acted for, and what was expected of them then."""

import re
from collections.abc import Iterator

from benchmarks.truth.context import KMH, Fault, Said, Told, claim, rounded
from benchmarks.truth.decision import Decision
from benchmarks.truth.naming import percents
from benchmarks.truth.phrases import COUNTS, acts, count, is_chance
from benchmarks.truth.reckoning import Actions
from benchmarks.truth.statements.chances import chances
from planner.record.trace import Action, HeldUp, PlanTrace
from sim.scene import EGO

STALE = 0.10  # greatest change of probability of a belief that is stated as held now
SLOWS = 0.4  # [m/s] least loss of speed of a vehicle that slows down
NEAR = 1.5  # [s] around a stated time, within which something seen counts
WINDOW = 12.0  # [s] before a question about the past in which a reason may lie
PERCENT = r"\((?P<chance>(?:under |over )?\d+ %)\)"
NUMBER = rf"(?:{'|'.join(COUNTS[1:])}|\d+)"


def window(said: Said, past: bool) -> tuple[float, float]:
    """Return the interval [s] that a reason may be from: from the decision on, up to now."""
    start = said.now if said.decision is None else said.decision.trace.sim_time
    if past:
        return min(start, said.now - WINDOW), said.now
    return min(start, said.now - NEAR), said.now


def traces(said: Said, past: bool) -> list[PlanTrace]:
    """Return the decisions that a reason may be from."""
    return said.ride.decided(*window(said, past))


@claim(
    r"(?P<how>I expect(?:ed)? |there (?:is|was) a chance that |it (?:is|was) possible that |"
    r"I (?:think|thought) that )(?P<who>V\d+|it) (?:to|will|would|may well|might well)"
    rf" (?P<act>[^(;.]*?)(?: {PERCENT}|(?=[;.,:])|$)",
    r"(?P<how>, which I expect(?:ed)? to|, which might(?: well)?|, and might(?: well)?)"
    rf" (?P<act>[^(;.]*?)(?: {PERCENT}|(?=[;.,:])|$)",
)
def belief(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check a belief against that at the stated time, and whether it holds now if so stated."""
    decision = said.decision
    kinds = acts(match["act"])
    if decision is None:
        return
    who = match.groupdict().get("who")
    named = said.who(who) if who and who != "it" else _nearest_named(said, match)
    yield from _slows(said, match, decision, named)
    if not kinds or not match["chance"]:
        return
    then = [x / 100.0 for v in named for x in chances(decision.trace, v, kinds[-1])]
    if not any(is_chance(match, value) for value in then):
        yield Fault("belief", f"{match[0]}: {percents(then)}")
        return
    present = not re.search(r"expected|was|thought|would", match["how"] + match[0])
    if present and _old(decision) and decision.latest is not None:
        now = [x / 100.0 for v in named for x in chances(decision.latest, v, kinds[-1])]
        if now and min(abs(a - b) for a in then if is_chance(match, a) for b in now) > STALE:
            yield Fault("stale belief", f"{match[0]}: now {percents(now)}")


def _old(decision: Decision) -> bool:
    """Check whether a decision is older than the one before the decision in force."""
    return decision.before is not None and decision.trace.sim_time < decision.before.sim_time


def _nearest_named(said: Said, match: re.Match[str]) -> tuple[int, ...]:
    named = re.findall(r"V\d+", said.text[: match.start()])
    return said.who(named[-1]) if named else said.last()


def _slows(
    said: Said, match: re.Match[str], decision: Decision, named: tuple[int, ...]
) -> Iterator[Fault]:
    """Check that a vehicle that is expected to be slow is so in the rollouts that it holds up."""
    told = re.search(r"(?:down to|at|to) about (\d+) km/h|from \d+ to (\d+) km/h", match["act"])
    stops = re.search(r"\bstop ahead of us", match["act"])
    joins = re.search(r"\bmove in ahead of us", match["act"])
    if not told and not stops and not joins:
        return
    found = [h for h in held_up(decision) if h.vehicle in named]
    if not found:
        yield Fault("holds nobody up", f"{match[0]}: {', '.join(map(str, named))}")
    elif joins and not any(h.how == "cut-in" for h in found):
        yield Fault("does not cut in", match[0])
    elif told:
        speed = float(told[1] or told[2])
        lowest = [KMH * h.speed_to for h in found]
        if not any(abs(value - speed) <= 0.5 + 1.0 for value in lowest):
            yield Fault("speed foreseen", f"{match[0]}: {rounded(lowest)} km/h")


def held_up(decision: Decision) -> list[HeldUp]:
    """Return the hold-ups in all rollouts of a decision, and of plans made again from it."""
    return [h for record in decision.records for r in record.trace.rollouts for h in r.held_up]


@claim(
    r"(?P<who>V\d+), which (?P<be>has|had) right of way, (?:is|was)(?: still)? "
    r"(?P<how>slowing down|standing still|about (?P<far>[\d.]+) metres? away)"
)
def yielded_to_none(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle with priority was far, slow or standing when we went."""
    who, span = said.who(match["who"]), window(said, True)
    yield from _priority(said, match[0], who, "vehicle")
    states = [s for v in who for t in said.ride.span(*span) if (s := said.ride.state(v, t))]
    if match["how"] == "standing still" and not any(s.speed < 0.7 for s in states):
        yield Fault("not standing", f"{match[0]}: {rounded([KMH * s.speed for s in states])} km/h")
    if match["how"] == "slowing down" and not any(s.acceleration < -0.1 for s in states):
        yield Fault("not slowing", match[0])
    if match["far"]:
        gaps = [g for v in who for t in said.ride.span(*span) if (g := said.ride.gap(EGO, v, t))]
        if not any(abs(g - float(match["far"])) <= 3.0 + 0.1 * float(match["far"]) for g in gaps):
            yield Fault("distance", f"{match[0]}: {rounded(gaps)} m")


@claim(
    r"(?P<who>V\d+) (?:has|had) to (?:let us go first|give way)",
    r"right of way over (?P<who>V\d+)",
)
def gives_way_to_us(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that we go first."""
    yield from _priority(said, match[0], said.who(match["who"]), "ego")


@claim(
    r"(?P<who>V\d+) (?:has|had) right of way\b",
    r"(?:have|had) to (?:let|be ready to give way to) (?P<who>V\d+)(?: go first)?",
    r"had let (?P<who>V\d+) go first",
)
def goes_first(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that another vehicle goes first, by the roads or in the rollouts."""
    yield from _priority(said, match[0], said.who(match["who"]), "vehicle")


def _priority(said: Said, told: str, who: tuple[int, ...], first: str) -> Iterator[Fault]:
    past = re.search(r"\b(had|was)\b", told) is not None
    known = traces(said, past or first == "vehicle")
    facts = {f.who for t in known if t.road for f in t.road.priority if f.vehicle in who}
    if facts & {first, "depends"}:
        return
    if first == "vehicle":
        found = [h for t in known for r in t.rollouts for h in r.held_up if h.vehicle in who]
        gave = [e for e in said.ride.events if e.kind == "gave-way" and e.vehicle in who]
        if any(h.how == "right-of-way" for h in found) or gave:
            return
    yield Fault("right of way", f"{told}: {', '.join(sorted(facts)) or 'nothing recorded'}")


@claim(r"(?:the way (?:is|was) free: )?nobody (?:has|had) right of way over us")
def nobody_first(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that nobody goes first in the decision in force."""
    known = traces(said, False)
    first = [{f.vehicle for f in t.road.priority if f.who == "vehicle"} for t in known if t.road]
    if first and all(first):
        yield Fault("right of way", f"{match[0]}: {sorted(set.union(*first))}")


@claim(
    r"(?P<who>V\d+) (?P<be>is|was) (?P<how>slowing down|stopping|moving in) "
    r"(?:ahead of us|in that lane)"
)
def slows_ahead(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle slows down ahead, as seen or in the rollouts that it holds up."""
    who = said.who(match["who"])
    held = [] if said.decision is None else [h for h in held_up(said.decision) if h.vehicle in who]
    if match["how"] == "moving in":
        if not any(h.how == "cut-in" for h in held):
            yield Fault("does not cut in", match[0])
        return
    seen = said.some(
        match["who"],
        window(said, match["be"] == "was"),
        lambda v, t: (s := said.ride.state(v, t)) is not None and s.acceleration < -0.2,
    )
    if not seen and not any(h.speed_from - h.speed_to >= SLOWS for h in held):
        yield Fault("not slowing", match[0])
    elif not held:
        yield Fault("holds nobody up", match[0])


@claim(r"(?P<who>V\d+) (?P<be>is|was) (?:standing )?in our way")
def in_the_way(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle in our way held us up in some rollout around the stated time."""
    who = said.who(match["who"])
    known = traces(said, match["be"] == "was")
    held = {h.vehicle for t in known for r in t.rollouts for h in r.held_up}
    if not held & set(who):
        yield Fault("holds nobody up", f"{match[0]}: {sorted(held)} do")


@claim(r"I know of nobody who (?:is|was) in our way")
def nobody_in_the_way(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the plan has a rollout in which nobody holds us up."""
    if said.decision is None:
        return
    drives = [drive for side in said.decision.drives() for drive, weight in side.drives]
    if drives and all(drive.held_up for drive in drives):
        held = sorted({h.vehicle for drive in drives for h in drive.held_up})
        yield Fault("somebody in the way", f"{match[0]}: {held}")


@claim(r"no real alternative (?:now|then)|I (?:have|had) no real alternative")
def no_alternative(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that nothing else could be done, except for stopping."""
    if said.decision is not None:
        others = [action for action in said.decision.rivals() if action != "stop"]
        if others:
            yield Fault("alternatives", f"{match[0]}: {', '.join(others)}")


@claim(
    rf"I simulated (?P<options>{NUMBER}) options? against what (?:(?P<others>{NUMBER}) road users?|"
    r"the others) around us might do, and chose the best: (?P<chosen>[^.]+)"
)
def method(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the numbers of options and of other vehicles, and which option was chosen."""
    decision = said.decision
    if decision is None:
        return
    options = decision.records[0].first_actions
    if count(match["options"]) != len(options):
        yield Fault("options", f"{match[0]}: {', '.join(options)}")
    if match["others"] and count(match["others"]) != len(decision.trace.predictions):
        yield Fault("vehicles", f"{match[0]}: {len(decision.trace.predictions)} predicted")
    kinds = acts(match["chosen"])
    if kinds and not any(decision.plan[: len(kinds)] == one for one in _meant(kinds, decision)):
        yield Fault("chosen", f"{match[0]}: {', '.join(decision.plan)}")
    for rival in decision.rivals():
        known = decision.values((rival,))
        if known and max(known) < 0.0:
            yield Fault("not the best", f"{match[0]}: {rival} by {-max(known):.2f} s")


def _meant(kinds: list[frozenset[Action]], decision: Decision) -> Iterator[Actions]:
    """Yield the plan's first actions if they are those that the phrase may mean."""
    plan = decision.plan
    if len(plan) >= len(kinds) and all(a in k for a, k in zip(plan, kinds, strict=False)):
        yield plan[: len(kinds)]
    later = [action for action in plan if action != "continue"]
    if later and later[0] in kinds[0]:
        yield plan[: len(kinds)]


@claim(rf"rests on (?P<count>{NUMBER}) situations?")
def rests_on(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the number of distinct situations that were simulated."""
    if said.decision is None:
        return
    known = {record.situations for record in said.decision.records}
    if count(match["count"]) > max(known):
        yield Fault("situations", f"{match[0]}: {sorted(known)}")


@claim(
    r"(?:[Tt]hat is just what I (?:did|plan to do)): (?P<did>[^.]+)",
    r"[Bb]ut that did happen: I (?P<did>[^.]+)",
)
def just_that(said: Said, match: re.Match[str]) -> Iterator[Fault | Told]:
    """Check that the plan, or what was carried out, is just that."""
    if said.decision is None:
        return
    kinds = acts(match["did"])
    done = [e.action for e in said.ride.events if e.sim_time <= said.now + NEAR]
    planned = [step.action for t in traces(said, True) for step in t.plan]
    if kinds and not any(action in kinds[0] for action in (*done, *planned)):
        yield Fault("not done", f"{match[0]}: {', '.join(dict.fromkeys(planned))}")
