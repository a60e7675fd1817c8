"""Statements about what we do, plan, did and did not do."""

import re
from collections.abc import Iterator

from benchmarks.truth.context import KMH, Fault, Said, claim, rounded
from benchmarks.truth.phrases import acts
from planner.record.trace import Action
from sim.scene import EGO

ABOUT = 6.0  # [s] before a decision, from which on other plans count too
FALLEN = 0.3  # [m/s] least loss of speed by braking
WINDOW = 25.0  # [s] before a question, within which "I braked" may lie
SLOW = 3.0  # [m/s] greatest speed that counts as waiting
CLAUSE = r"(?P<what>[^;:.]*?)(?=, (?:because|but|though|as|and)|[;:.]| because| to | then|$)"


def plans(said: Said, before: float = ABOUT) -> list[Action]:
    """Return the actions planned around the decision and since, and those carried out so far."""
    start = said.now if said.decision is None else said.decision.trace.sim_time
    known = said.ride.decided(min(start, said.now) - before, said.now)
    done = [e.action for e in said.ride.events if e.sim_time <= said.now + 0.1]
    planned = [step.action for trace in known for step in trace.plan]
    return planned + [action for action in done if action is not None]


@claim(
    rf"^I (?:am|plan to) (?P<not>not )?{CLAUSE}",
    rf"^I (?:decided|had decided|had planned) (?P<not>not )?to {CLAUSE}",
)
def planned(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a stated action is planned, or that a denied one is not the plan's first."""
    kinds = acts(match["what"])
    if not kinds or said.decision is None:
        return
    if match["not"]:
        if said.decision.plan[:1] and said.decision.plan[0] in kinds[0] and len(kinds) == 1:
            yield Fault("is done", f"{match[0]}: {', '.join(said.decision.plan)}")
    elif not any(action in kinds[0] for action in plans(said)):
        yield Fault("not planned", f"{match[0]}: {', '.join(said.decision.plan)}")


@claim(
    r"^I (?P<what>turned (?:right|left)|moved to the \w+ lane|went straight on|left the roundabout|"
    r"continued to the next exit|stayed in (?:my lane|the roundabout))",
    r"^I (?P<what>went)(?= then)",
    r"^I am (?P<what>going)(?= because)",
)
def did(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a stated action was planned or carried out."""
    kinds = acts(match["what"])
    if kinds and not any(action in kinds[0] for action in plans(said)):
        yield Fault("not done", match[0])


@claim(rf"^I (?:did|could) not {CLAUSE}", rf"^[Ii]f I (?:had )?{CLAUSE}")
def not_done(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that an action that we did not take is not the one decided on."""
    kinds = acts(match["what"])
    decision = said.decision
    if decision is not None and len(kinds) == 1 and decision.plan[0] in kinds[0]:
        yield Fault("is done", f"{match[0]}: {', '.join(decision.plan)}")


@claim(r"^I (?P<how>braked|slowed down|waited|stopped)\b", r"^We (?P<how>stood)\b")
def slowed(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that our speed fell, or that we were slow, in the time before the question."""
    times = said.ride.span(said.now - WINDOW, said.now)
    speeds = [s.speed for t in times if (s := said.ride.state(EGO, t)) is not None]
    fallen = max((max(speeds[: k + 1]) - v for k, v in enumerate(speeds)), default=0.0)
    if match["how"] in ("waited", "stopped", "stood"):
        if speeds and min(speeds) > SLOW:
            yield Fault("not waited", f"{match[0]}: {rounded([KMH * v for v in speeds])} km/h")
    elif speeds and fallen < FALLEN:
        yield Fault("not braked", f"{match[0]}: {rounded([KMH * v for v in speeds])} km/h")


@claim(r"there was no (?:junction|lane to the \w+|roundabout)[^.;]*", r"my car does not [^.;]*")
def not_applicable(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that the planner recorded the stated reason why an action was impossible."""
    known = [n.reason for t in said.ride.decided(0.0, said.now) for n in t.not_applicable]
    told = match[0].replace("there was", "there is")
    if not any(told == reason or reason in told for reason in known):
        yield Fault("not applicable", f"{match[0]}: {sorted(set(known))}")


@claim(
    r"(?:at (?P<clock>\d+:\d\d)|[Aa]bout (?P<ago>half a|\d+(?:\.\d+)?) seconds? ago|[Jj]ust now|"
    r"\b[Nn]ow), I (?:simulated|decided|put the risk)",
    r"I decided that (?:at (?P<clock>\d+:\d\d)|about (?P<ago>half a|\d+(?:\.\d+)?) seconds? ago|"
    r"just now)",
    r"^At (?P<clock>\d+:\d\d)(?P<ago>), I (?:simulated|decided|put the risk)",
)
def decided_when(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the time of the decision."""
    if said.decision is None:
        return
    time = said.decision.trace.sim_time
    told = said.told(match[0]) or (said.now - 2.6, said.now)
    if not told[0] - 0.1 <= time <= told[1] + 0.1:
        yield Fault("time of the decision", f"{match[0]}: {said.now - time:.1f} s ago")
