"""Scores of the causes that an answer and its rivals name: precision, recall and F1."""

from collections.abc import Sequence

import msgspec

from benchmarks.causes.deed_question import Deed
from benchmarks.figures import Aimed, aimed, at_least, in_columns, targets_table
from benchmarks.worlds.values import KINDS, Family, Kind

OURS, ALL = "ours", "all"
NOBODY = 0  # stands for naming nobody; only the ego has this name
F1, LEAD = 0.9, 0.15  # targets: F1 of our answers, and its lead over the better rival
#: How an action depends on vehicles, as answers state it, by kind of world.
TOLD: dict[Kind, tuple[str | None, ...]] = {
    "one": ("one",),
    "distractor": ("one",),
    "both": ("both",),
    "either": ("either",),
    "pre-empted": ("pre-empted",),
    "none": ("none", None),
    "interactive": ("both",),
}


class Case(msgspec.Struct, frozen=True):
    """One world, with its true causes, the question, and the causes named."""

    seed: int
    kind: Kind
    family: Family
    error: str | None = None  # of a world that failed
    rejected: int = 0  # worlds drawn before that were not of their kind
    causes: tuple[int, ...] = ()  # vehicles that the action depends on
    others: int = 0  # number of vehicles that do not matter
    asked: Deed = "continue"
    at: float = 0.0  # [s] time of the question
    claims: dict[str, tuple[int, ...]] = {}  # vehicles named, by us and by rivals
    holds: dict[str, bool] = {}  # whether the action vanishes without these, and stays with them
    told: str | None = None  # how the action depends on them, by our answer
    refused: str | None = None  # the reason, if there was no answer
    seen: bool = True  # whether the causes are in the decision that is explained
    replans: int = 0  # plans made again for the answer
    took: float = 0.0  # [ms] time for the answer, including these plans

    @property
    def right(self) -> bool:
        """Whether exactly the vehicles that matter are named."""
        return self.error is None and self.refused is None and self.claims[OURS] == self.causes

    @property
    def kind_right(self) -> bool:
        """Whether the answer states correctly how the action depends on the causes."""
        if self.refused is not None:
            return False
        return self.told in TOLD["one" if len(self.causes) == 1 else self.kind]

    @property
    def reproduce(self) -> str:
        """The command that repeats this world."""
        return f"xavi bench causes --worlds 1 --seed {self.seed} --roads {self.family}"


class Score(msgspec.Struct, frozen=True):
    """The scores of the vehicles that are named, with counts summed over worlds."""

    precision: float
    recall: float
    f1: float
    holds: float  # share of worlds in which the set that is named is a cause in SUMO


class Row(msgspec.Struct, frozen=True):
    """The worlds of one kind, or all of them, in numbers."""

    kind: str
    worlds: int
    failed: int
    refused: int
    scores: dict[str, Score]
    kind_right: float  # share of worlds in which the answer states the right kind of dependence


class CausesReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str
    rows: tuple[Row, ...]
    rejected: int  # worlds drawn that were not of their kind
    replans: tuple[int, int]  # for an answer: median, greatest
    latency: tuple[float, float]  # [ms] of an answer: median, greatest
    cases: tuple[Case, ...]

    def table(self) -> str:
        """Return the report for people."""
        names = list(self.rows[-1].scores) if self.rows else []
        head = ["", "worlds", "failed", "refused", "kind right"]
        head += [f"{name} {what}" for name in names for what in ("P", "R", "F1", "holds")]
        rows = [head]
        for row in self.rows:
            values = [str(row.worlds), str(row.failed), str(row.refused), f"{row.kind_right:.2f}"]
            for one in row.scores.values():
                values += [f"{v:.2f}" for v in (one.precision, one.recall, one.f1, one.holds)]
            rows.append([row.kind, *values])
        times = (
            f"plans made again for an answer: median {self.replans[0]}, most {self.replans[1]};"
            f" time [ms]: median {self.latency[0]:.0f}, most {self.latency[1]:.0f}"
        )
        drawn = f"{self.rejected} worlds were drawn that are not of their kind"
        wrong = [_what(case) for case in self.cases if not case.right] or ["none"]
        parts = [
            in_columns(rows),
            "",
            times,
            drawn,
            "",
            targets_table(self.targets),
            "",
            "answers that were not right:",
        ]
        return "\n".join([*parts, *wrong])


def report(cases: Sequence[Case]) -> CausesReport:
    """Return the scores of worlds."""
    names = list(dict.fromkeys(name for case in cases for name in case.claims))
    rows = [_row(k, [c for c in cases if c.kind == k], names) for k in KINDS]
    rows = [*(row for row in rows if row.worlds), _row(ALL, cases, names)]
    total = rows[-1].scores
    rivals = [score.f1 for name, score in total.items() if name != OURS]
    own = total[OURS].f1 if OURS in total else None
    lead = None if own is None else own - max(rivals, default=0.0)
    done = [case for case in cases if case.error is None]
    replans, times = sorted(c.replans for c in done), sorted(c.took for c in done)
    middle = len(done) // 2
    whole = CausesReport(
        bench="causes",
        rows=tuple(rows),
        rejected=sum(case.rejected for case in cases),
        replans=(replans[middle], replans[-1]) if done else (0, 0),
        latency=(times[middle], times[-1]) if done else (0.0, 0.0),
        cases=tuple(cases),
    )
    return aimed(
        whole,
        at_least("F1", "", own, F1),
        at_least("F1, above the better rival", "", lead, LEAD),
    )


def score(cases: Sequence[Case], name: str) -> Score:
    """Score the vehicles that we or a rival name; naming nobody counts as one claim.

    A refusal of ours is no claim, so it only lowers recall.
    """
    hits = claimed = due = held = 0
    for case in cases:
        wanted = set(case.causes) or {NOBODY}
        silent = name == OURS and case.refused is not None
        named = set() if silent else set(case.claims[name]) or {NOBODY}
        hits += len(named & wanted)
        claimed += len(named)
        due += len(wanted)
        held += case.holds[name] and not silent
    precision, recall = hits / max(claimed, 1), hits / max(due, 1)
    f1 = 2.0 * hits / max(claimed + due, 1)
    return Score(precision, recall, f1, held / max(len(cases), 1))


def _row(kind: str, cases: Sequence[Case], names: Sequence[str]) -> Row:
    done = [case for case in cases if case.error is None]
    kinds = sum(case.kind_right for case in done)
    return Row(
        kind=kind,
        worlds=len(cases),
        failed=len(cases) - len(done),
        refused=sum(case.refused is not None for case in done),
        scores={name: score(done, name) for name in names},
        kind_right=kinds / max(len(done), 1),
    )


def _what(case: Case) -> str:
    if case.error is not None:
        return f"{case.kind}: {case.error}\n    {case.reproduce}"
    asked = f"{case.kind}, {case.asked} at {case.at:.1f} s, hangs on {_names(case.causes)}"
    told = f"named {_names(case.claims[OURS])} ({case.told})"
    if case.refused is not None:
        told = f"refused, {case.refused}"
    unseen = "" if case.seen else "; not all in view at that decision"
    return f"{asked}: {told}{unseen}\n    {case.reproduce}"


def _names(vehicles: Sequence[int]) -> str:
    return " and ".join(map(str, vehicles)) or "nobody"
