"""Findings: what deserves a look, worst first within each kind."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Final, Literal, TypeAlias, get_args

import msgspec

from xavi_dialogue.audit.audit import Audit, Looked
from xavi_dialogue.audit.results.changes import Change
from xavi_dialogue.audit.values import Answered, Choice, Mistake

Kind: TypeAlias = Literal[
    "collision",
    "close-call",
    "hard-braking",
    "wrong-prediction",
    "close-decision",
    "refusal",
    "changed-answer",
]
KINDS: Final = get_args(Kind)
KMH: Final = 3.6


class Finding(msgspec.Struct, frozen=True):
    """Something that deserves a look."""

    kind: Kind
    rank: int  # within its kind, 1 the worst
    ride: str
    at: float | None  # [s]
    value: float  # in the unit; of refusals their number
    unit: str
    text: str
    vehicle: int | None = None
    trace_id: str | None = None
    question: str | None = None


def findings(audit: Audit, changes: Sequence[Change] = ()) -> tuple[Finding, ...]:
    """Return all findings, in the order of KINDS and then by rank."""
    found: list[Finding] = []
    for several in (
        _collisions(audit.rides), _close_calls(audit.rides), _braking(audit.rides),
        _mistakes(audit.rides), _close_decisions(audit.rides), _refusals(audit.rides),
        _changes(changes),
    ):  # fmt: skip
        found += _ranked(several)
    return tuple(found)


def _ranked(several: Iterable[tuple[float, Finding]]) -> Iterator[Finding]:
    """Yield findings in order of their sort keys, then of their rides, with ranks."""
    order = sorted(several, key=lambda pair: (pair[0], _natural(pair[1].ride), pair[1].at or 0.0))
    for rank, (_, one) in enumerate(order, 1):
        yield msgspec.structs.replace(one, rank=rank)


def _natural(ride: str) -> tuple[str, int]:
    name, _, seed = ride.rpartition("-")
    return (name, int(seed)) if seed.isdigit() else (ride, 0)


def _collisions(rides: Sequence[Looked]) -> Iterator[tuple[float, Finding]]:
    for one in rides:
        peak = one.facts.collision
        if peak is not None:
            text = f"hit {peak.who or 'something'} at {peak.value * KMH:.0f} km/h"
            yield (
                -peak.value,
                Finding("collision", 0, one.source.ride, peak.at, peak.value, "m/s", text,
                        vehicle=peak.vehicle),
            )  # fmt: skip


def _close_calls(rides: Sequence[Looked]) -> Iterator[tuple[float, Finding]]:
    for one in rides:
        peak = one.facts.time_to_collision
        if peak is not None and one.facts.collision is None:
            text = f"{peak.value:.1f} s from a collision with {peak.who}"
            yield (
                peak.value,
                Finding("close-call", 0, one.source.ride, peak.at, peak.value, "s", text,
                        vehicle=peak.vehicle),
            )  # fmt: skip


def _braking(rides: Sequence[Looked]) -> Iterator[tuple[float, Finding]]:
    for one in rides:
        peak = one.facts.braking
        if peak is not None:
            text = f"braked at {peak.value:.1f} m/s²"
            yield (
                -peak.value,
                Finding("hard-braking", 0, one.source.ride, peak.at, peak.value, "m/s2", text),
            )


def _mistakes(rides: Sequence[Looked]) -> Iterator[tuple[float, Finding]]:
    for one in rides:
        for wrong in one.facts.mistakes:
            if wrong.mattered:
                yield (
                    -(wrong.gain or 0.0),
                    Finding(
                        "wrong-prediction", 0, one.source.ride, wrong.at, wrong.gain or 0.0, "s",
                        told(wrong), vehicle=wrong.vehicle, trace_id=wrong.trace_id,
                    ),
                )  # fmt: skip


def told(wrong: Mistake) -> str:
    """Return a wrong prediction in words."""
    took = f"{wrong.who} took {wrong.came} ({_percent(wrong.given)})"
    text = f"{took}, not {wrong.expected} ({_percent(wrong.probability)})"
    if not wrong.mattered:
        return text
    better = "" if wrong.gain is None else f", better by {wrong.gain:.1f} s"
    return f"{text}; known before: {wrong.instead} instead of {wrong.chosen}{better}"


def _close_decisions(rides: Sequence[Looked]) -> Iterator[tuple[float, Finding]]:
    """Yield the closest of decisions in a row between the same two actions."""
    for one in rides:
        key = _contest
        for (close, _), group in groupby(one.facts.choices, key=key):
            row = list(group)
            if close:
                least = min(row, key=lambda choice: (abs(choice.margin), choice.at))
                text = (
                    f"{least.chosen} before {least.rival} by {least.margin:.2f} s"
                    f" ± {least.error:.2f} s"
                )
                more = f", {len(row)} decisions in a row" if len(row) > 1 else ""
                yield (
                    abs(least.margin),
                    Finding("close-decision", 0, one.source.ride, least.at, least.margin, "s",
                            text + more, trace_id=least.trace_id),
                )  # fmt: skip


def _contest(choice: Choice) -> tuple[bool, frozenset[str]]:
    return choice.close, frozenset((choice.chosen, choice.rival)) if choice.close else frozenset()


def _refusals(rides: Sequence[Looked]) -> Iterator[tuple[float, Finding]]:
    """Yield one finding for each question and reason, with the first ride as example."""
    groups: dict[tuple[str, str, str], list[tuple[Looked, Answered]]] = {}
    for one in rides:
        for answer in one.answers:
            if answer.kind in ("refusal", "clarification"):
                why = answer.reason or answer.kind
                groups.setdefault((answer.question, answer.when, why), []).append((one, answer))
    for (question, _, why), several in groups.items():
        ride, first = several[0]
        text = f"{why}, {_times(len(several))}: “{question}” “{first.text}”"
        yield (
            -len(several),
            Finding("refusal", 0, ride.source.ride, first.at, len(several), "", text,
                    question=question),
        )  # fmt: skip


def _changes(changes: Sequence[Change]) -> Iterator[tuple[float, Finding]]:
    """Yield changed answers, first those in rides that are the same."""
    for one in changes:
        differs = "the ride differs, too: " if one.ride_changed else ""
        text = f"{differs}“{one.question}” was “{one.before}”, now “{one.now}”"
        yield (
            float(one.ride_changed),
            Finding("changed-answer", 0, one.ride, one.at, 1.0, "", text, question=one.question),
        )


def _percent(chance: float) -> str:
    return f"{chance:.0%}"


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"
