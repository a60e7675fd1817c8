"""`xavi bench causes`: whether the causes that are named are those that were planted.

In each world SUMO confirmed beforehand that one vehicle alone matters (see `worlds`). We drive
it, ask about the most marked deed (see `asking`), and compare the vehicles named with the
planted one. Named vehicles, and as many unnamed ones, are then taken away (see `necessity`).
"""

import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec

from sim.network import Network
from xavi_dialogue.app.bench.asking import (
    Deed,
    Ridden,
    ask,
    decision_of,
    nearest,
    question,
    ride,
)
from xavi_dialogue.app.bench.figures import in_columns
from xavi_dialogue.app.bench.necessity import (
    Removal,
    compared,
    delay,
    plan_changes,
    ride_changes,
)
from xavi_dialogue.app.bench.runs import in_processes
from xavi_dialogue.app.bench.worlds.folder import without
from xavi_dialogue.app.bench.worlds.generate import Planted, generate, kind_of
from xavi_dialogue.app.bench.worlds.values import KINDS, Kind
from xavi_dialogue.app.local import planner_for
from xavi_dialogue.app.ride import network_of
from xavi_dialogue.dialogue.explanation import contrastive
from xavi_dialogue.dialogue.standing import reason_of
from xavi_dialogue.domain.answers import Cause

ALL = "all"
EVERY = 5  # worlds after which progress is told


class Case(msgspec.Struct, frozen=True):
    """One world: what was planted, asked and named."""

    seed: int
    kind: Kind
    error: str | None = None  # of a world that failed
    rejected: int = 0  # worlds drawn before that SUMO did not confirm
    role: str = ""  # of the planted vehicle in its story
    planted: int = 0
    others: int = 0  # vehicles that do not matter
    asked: Deed = "continue"
    at: float = 0.0  # [s] when it was asked
    named: tuple[int, ...] = ()
    unsure: bool = False  # the answer says that a vehicle named may not be necessary
    refused: str | None = None  # the reason, where there was no answer
    matters: bool = True  # to our own ride, too
    seen: bool = True  # the planted vehicle is in the decision that is explained
    nearest: int | None = None  # of the vehicles in that decision
    removals: tuple[Removal, ...] = ()

    @property
    def answered(self) -> bool:
        """Whether there is an answer to judge."""
        return self.error is None and self.refused is None

    @property
    def right(self) -> bool:
        """Whether the planted vehicle, and no other, was named."""
        return self.answered and self.named == (self.planted,)

    @property
    def reproduce(self) -> str:
        """The command that does it again."""
        return f"xavi bench causes --worlds 1 --seed {self.seed}"


class Share(msgspec.Struct, frozen=True):
    """How many of how many."""

    name: str
    hits: int
    n: int

    @property
    def share(self) -> float | None:
        """None of none."""
        return self.hits / self.n if self.n else None


class Row(msgspec.Struct, frozen=True):
    """The worlds of one kind, or all of them, in numbers."""

    kind: str
    worlds: int
    failed: int
    refused: int
    precision: Share  # of the vehicles named: those planted
    recall: Share  # of the answers: those that name the planted vehicle
    recall_where_it_matters: Share  # of the answers where it matters to our own ride, too
    nearest: Share  # of the answers: those where the nearest in view is the planted one
    unsure: Share  # of the answers
    matters: Share  # worlds in which the planted vehicle matters to our own ride, too


class Wrong(msgspec.Struct, frozen=True):
    """A world whose answer was not right."""

    seed: int
    kind: str
    what: str
    reproduce: str


class CausesReport(msgspec.Struct, frozen=True):
    """What the benchmark found."""

    bench: str
    rejected: int  # worlds drawn that SUMO did not confirm
    rows: tuple[Row, ...]
    necessity: tuple[Share, ...]
    asked: dict[str, int]  # deeds asked about
    wrong: tuple[Wrong, ...]
    cases: tuple[Case, ...]

    def table(self) -> str:
        """The report for people."""
        shares = ("precision", "recall", "recall_where_it_matters", "nearest", "unsure", "matters")
        names = [name.replace("_", " ") for name in shares]
        rows = [["", "worlds", "failed", "refused", *names]]
        rows += [
            [row.kind, str(row.worlds), str(row.failed), str(row.refused)]
            + [_told(getattr(row, name)) for name in shares]
            for row in self.rows
        ]
        needed = [["without it, what differs", "share"]]
        needed += [[one.name, _told(one)] for one in self.necessity]
        asked = ", ".join(f"{deed} {n}" for deed, n in self.asked.items())
        wrong = [f"{one.what}\n    {one.reproduce}" for one in self.wrong] or ["none"]
        drawn = f"{self.rejected} worlds were drawn that SUMO did not confirm"
        parts = [in_columns(rows), "", in_columns(needed), "", f"asked about: {asked}", drawn]
        return "\n".join([*parts, "", "answers that were not right:", *wrong])


def measure(
    worlds: int, seed: int, jobs: int, keep: Path | None, note: Callable[[str], None]
) -> CausesReport:
    """Drive worlds and ask about them.

    Args:
        worlds: how many; the k-th has the seed `seed + k`.
        seed: of the first.
        jobs: processes side by side.
        keep: folder in which the scenario folders are left; None: they are not kept.
        note: is told the progress.
    """
    tasks = [(seed + k, None if keep is None else str(keep)) for k in range(worlds)]
    done: list[Case] = []
    for case in in_processes(examine, tasks, jobs, _died):
        done.append(case)
        if len(done) % EVERY == 0:
            note(f"{len(done)} of {worlds} worlds")
    return report(done)


def examine(task: tuple[int, str | None]) -> Case:
    """One world, by its seed; what goes wrong is told in the result."""
    seed, keep = task
    scratch = Path(tempfile.mkdtemp(prefix="xavi-world-"))
    folder = scratch if keep is None else Path(keep) / f"{kind_of(seed)}-{seed}"
    try:
        planted = generate(seed, folder)
        return _examined(planted, network_of(planted.scenario))
    except Exception as error:
        return Case(seed, kind_of(seed), error=f"{type(error).__name__}: {error}")
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def report(cases: Sequence[Case]) -> CausesReport:
    """The worlds in numbers."""
    kinds = [kind for kind in KINDS if any(case.kind == kind for case in cases)]
    rows = [_row(kind, [case for case in cases if case.kind == kind]) for kind in kinds]
    asked: dict[str, int] = {}
    for case in cases:
        if case.error is None:
            asked[case.asked] = asked.get(case.asked, 0) + 1
    return CausesReport(
        bench="causes",
        rejected=sum(case.rejected for case in cases),
        rows=(*rows, _row(ALL, cases)),
        necessity=tuple(
            _needed(cases, named, what) for named in (True, False) for what in ("plan", "ride")
        ),
        asked=asked,
        wrong=tuple(
            Wrong(case.seed, case.kind, _what(case), case.reproduce)
            for case in cases
            if not case.right
        ),
        cases=tuple(cases),
    )


def _examined(planted: Planted, network: Network) -> Case:
    world, scenario = planted.world, planted.scenario
    ridden = ride(scenario, network)
    alone = ride(without(world, scenario, world.others), network)
    asked = question(ridden, alone)
    found, _ = ask(asked, ridden, planner_for(network))
    rides: dict[int, Ridden] = {}

    def less(vehicle: int) -> Ridden:
        if vehicle not in rides:
            rides[vehicle] = ride(without(world, scenario, {vehicle}), network)
        return rides[vehicle]

    case = Case(
        world.seed,
        world.kind,
        rejected=planted.rejected,
        role=world.others[world.planted].role,
        planted=world.planted,
        others=len(world.others) - 1,
        asked=asked.deed,
        at=round(asked.now, 3),
        matters=ride_changes(ridden, less(world.planted)),
    )
    told, refused = contrastive(found), reason_of(found)
    if told is None or refused is not None:
        return msgspec.structs.replace(case, refused=refused or "no-influence")
    named = tuple(cause.vehicle for cause in told.causes)
    trace = decision_of(ridden, found, asked.now)
    return msgspec.structs.replace(
        case,
        named=named,
        unsure=any(map(_unsure, told.causes)),
        seen=world.planted in trace.scene,
        nearest=nearest(trace),
        removals=tuple(
            Removal(
                vehicle,
                vehicle in named,
                plan_changes(trace, network, vehicle),
                ride_changes(ridden, less(vehicle)),
                delay(ridden, less(vehicle)),
            )
            for vehicle in (*named, *compared(trace, named, world.seed))
        ),
    )


def _row(kind: str, cases: Sequence[Case]) -> Row:
    done = [case for case in cases if case.error is None]
    answered = [case for case in cases if case.answered]
    hits = sum(case.planted in case.named for case in answered)
    moved = [case for case in answered if case.matters]
    return Row(
        kind=kind,
        worlds=len(cases),
        failed=len(cases) - len(done),
        refused=len(done) - len(answered),
        precision=Share("precision", hits, sum(len(case.named) for case in answered)),
        recall=Share("recall", hits, len(answered)),
        recall_where_it_matters=Share(
            "recall where it matters", sum(c.planted in c.named for c in moved), len(moved)
        ),
        nearest=Share("nearest", sum(c.nearest == c.planted for c in answered), len(answered)),
        unsure=Share("unsure", sum(case.unsure for case in answered), len(answered)),
        matters=Share("matters", sum(case.matters for case in done), len(done)),
    )


def _needed(cases: Sequence[Case], named: bool, what: str) -> Share:
    """How often taking a vehicle away changes the plan, or the ride; where that could be tried."""
    tried = [getattr(one, what) for case in cases for one in case.removals if one.named == named]
    known = [value for value in tried if value is not None]
    return Share(f"{'named' if named else 'not named'}: the {what}", sum(known), len(known))


def _unsure(cause: Cause) -> bool:
    """Whether an answer says that a vehicle which it names may not be necessary."""
    return cause.necessary is False


def _what(case: Case) -> str:
    if case.error is not None:
        return f"{case.kind}: {case.error}"
    asked = f"{case.kind} ({case.role}), {case.asked} at {case.at:.1f} s, planted {case.planted}"
    if not case.matters:
        asked += " (of no matter to our own ride)"
    if case.refused is not None:
        return f"{asked}: refused, {case.refused}"
    unseen = "" if case.seen else "; the planted one was not in view at that decision"
    return f"{asked}: named {', '.join(map(str, case.named)) or 'none'}{unseen}"


def _told(share: Share) -> str:
    return "-" if share.share is None else f"{share.share:.3f} of {share.n}"


def _died(task: tuple[int, str | None]) -> Case:
    return Case(task[0], kind_of(task[0]), error="its process died")
