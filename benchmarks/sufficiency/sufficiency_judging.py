"""Judging of each answer against its decision, and of a rival with another decision's reason."""

import re
from collections.abc import Sequence
from random import Random

import msgspec

from benchmarks.sufficiency.sufficiency_asking import Answered, Asked, Kind, asked
from benchmarks.truth.checker import Sentence, checked
from benchmarks.truth.context import Fault
from benchmarks.truth.decision import Decision
from benchmarks.truth.ridden import Ridden, ridden
from benchmarks.truth.sufficient import Check, check_of, insufficient
from planner.record.trace import PlanTrace

VEHICLE = re.compile(r"V\d+")
FIGURE = re.compile(r"\d+(?:\.\d+)?")


class Wrong(msgspec.Struct, frozen=True):
    """Something that an answer states wrongly, or leaves out."""

    check: Check
    kind: str
    detail: str


class Judged(msgspec.Struct, frozen=True):
    """An answer, with its faults and the sentences that were not understood."""

    scenario: str
    seed: int
    time: float  # [s] of the question
    kind: Kind
    question: str
    text: str
    declined: bool
    wrong: tuple[Wrong, ...] = ()
    sentences: int = 0
    uncovered: tuple[str, ...] = ()  # sentences not understood, in full

    @property
    def passed(self) -> bool:
        """Check whether nothing is wrong with the answer."""
        return not self.wrong


class Read(msgspec.Struct, frozen=True):
    """The answers of one ride and those of the rival, or the reason why there are none."""

    scenario: str
    seed: int
    ours: tuple[Judged, ...] = ()
    rival: tuple[Judged, ...] = ()  # those whose text differs from ours
    same: int = 0  # answers for which the other decision has exactly the same text
    lone: int = 0  # answers for which no other decision offers one
    error: str | None = None


def read(task: tuple[str, int, int]) -> Read:
    """Judge the answers of one ride; errors are part of the result."""
    scenario, seed, every = task
    try:
        return judged(asked(scenario, seed, every))
    except Exception as error:
        return Read(scenario, seed, error=f"{type(error).__name__}: {error}")


def judged(ride: Asked) -> Read:
    """Judge the answers of a ride, and the rival's, with the reason of another decision."""
    seen = ridden(ride.moments)
    ours = tuple(_judge(ride, seen, one, one.text) for one in ride.answers)
    rng = Random(f"sufficiency/{ride.scenario}/{ride.seed}")
    rival: list[Judged] = []
    same = lone = 0
    for one in ride.answers:
        if one.kind != "answer":
            continue
        other = donor(one, ride.answers, rng)
        if other is None:
            lone += 1
        elif other.text == one.text:
            same += 1
        else:
            rival.append(_judge(ride, seen, one, other.text))
    return Read(ride.scenario, ride.seed, ours, tuple(rival), same, lone)


def donor(one: Answered, among: Sequence[Answered], rng: Random) -> Answered | None:
    """Draw an answer to the same words about another decision of the same ride.

    If there is none, draw one to the same kind of question.
    """
    others = [
        other for other in among
        if other.kind == "answer" and other.trace_id != one.trace_id
        and other.put.kind == one.put.kind
    ]  # fmt: skip
    alike = [other for other in others if other.put.text == one.put.text]
    return rng.choice(alike or others) if others else None


def decision_of(seen: Ridden, one: Answered) -> Decision | None:
    """Return the decision that an answer names, with the plans made again from it."""
    known = [trace for trace in seen.traces if trace.sim_time <= one.at + 1e-6]
    everything = (*known, *one.again)
    named = next((trace for trace in everything if trace.trace_id == one.trace_id), None)
    if named is None:
        return None
    trace = next((t for t in known if t.sim_time == named.sim_time), named)
    again = tuple(other for other in one.again if _further(other, trace))
    foil = () if one.put.foil is None else (one.put.foil,)
    before = known[-2] if len(known) > 1 else None
    gone = (t for t in one.again if t.what_if is not None and t.what_if.gone)
    without = tuple(other for other in gone if other.sim_time == trace.sim_time)
    return Decision(trace, again, before, known[-1], without, foil)


def _further(other: PlanTrace, trace: PlanTrace) -> bool:
    """Check whether a plan made again is the same decision with further rollouts only."""
    change = other.what_if
    if change is None or other.sim_time != trace.sim_time:
        return False
    return not change.gone and change.vehicle is None


def _judge(ride: Asked, seen: Ridden, one: Answered, text: str) -> Judged:
    declined = one.kind != "answer"
    decision = None if declined else decision_of(seen, one)
    faults, sentences, told = checked(seen, one.at, one.put.text, text, decision)
    if decision is not None:
        faults += insufficient(text, told, decision)
    elif not declined:
        faults.append(Fault("no decision named", f"{one.trace_id}"))
    return Judged(
        scenario=ride.scenario,
        seed=ride.seed,
        time=one.at,
        kind=one.put.kind,
        question=one.put.text,
        text=text,
        declined=declined,
        wrong=tuple(Wrong(check_of(f), f.kind, f.detail) for f in faults),
        sentences=0 if declined else len(sentences),
        uncovered=() if declined else tuple(_shown(s) for s in sentences if not s.understood),
    )


def _shown(sentence: Sentence) -> str:
    """Return a sentence and its parts not understood, with figures and vehicles left open."""
    text = FIGURE.sub("#", VEHICLE.sub("V", sentence.text))
    rest = "; ".join(FIGURE.sub("#", VEHICLE.sub("V", one)) for one in sentence.unread)
    return f"{text} [{rest or 'all of it'}]"
