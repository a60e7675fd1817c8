"""The report, with Tables 1 to 3 for people and as one JSON object."""

from collections.abc import Callable, Iterator, Sequence

import msgspec

from benchmarks.drive.runs import in_processes
from benchmarks.reproduce.rides import Told, broken, tell
from benchmarks.reproduce.rows import FOILS
from benchmarks.reproduce.tables import Blame, FoilFound, Grounds, RowFound, Sentence, compare

TITLES = {
    1: "Table 1. S1, one cause and one effect",
    2: "Table 2. S2, one cause and one effect",
    3: "Table 3. S1, more causes and effects",
}


class Reproduction(msgspec.Struct, frozen=True):
    """The paper's tables, compared with ours."""

    seeds: int
    answered: int  # counterfactuals with a complete sentence, of Tables 1 and 2
    declined: int  # counterfactuals with a refusal and its reason
    asked: int
    foils: tuple[FoilFound, ...]

    def table(self) -> str:
        """Return the tables for people."""
        lines = [
            f"{self.asked} counterfactuals: {self.answered} complete sentences, "
            f"{self.declined} refusals with their reason."
        ]
        shown = 0
        for found in self.foils:
            if found.table != shown:
                lines += ["", "", f"{TITLES[found.table]}; {found.seeds} seeds"]
                shown = found.table
            lines += ["", *_foil(found)]
        return "\n".join(lines)


def measure(seeds: int, jobs: int, note: Callable[[str], None]) -> Reproduction:
    """Drive the stories, ask, and compare.

    Args:
        seeds: of each story, from 0 on.
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    scenarios = dict.fromkeys(foil.scenario for foil in FOILS)
    tasks = [(name, seed) for name in scenarios for seed in range(seeds)]
    told: list[Told] = []
    for done, found in enumerate(in_processes(tell, tasks, jobs, _died), start=1):
        told += found
        note(f"{done} of {len(tasks)}: {found[0].foil.scenario}, seed {found[0].seed}")
    return reproduction(told, seeds)


def reproduction(told: Sequence[Told], seeds: int) -> Reproduction:
    """Return our answers compared with the rows of the paper."""
    foils = compare(told)
    once = [found for found in foils if found.table < 3]
    return Reproduction(
        seeds=seeds,
        answered=sum(found.answered for found in once),
        declined=sum(found.declined for found in once),
        asked=sum(found.seeds for found in once),
        foils=foils,
    )


def _died(task: tuple[str, int]) -> tuple[Told, ...]:
    return broken(task, "its process died")


def _foil(found: FoilFound) -> Iterator[str]:
    yield f"{found.scenario}, had the ego done {found.foil}: {found.answered} of {found.seeds}"
    for size in found.sizes:
        if len(found.sizes) > 1:
            yield f" effects: {size.effects}, causes: {size.causes}"
        for row in size.rows:
            yield from _row(row, found)
        if size.others:
            yield "  in no row of the paper:"
            for one in size.others:
                yield f"{_said(one)} [differs: {', '.join(one.differs)}]"
    if found.refusals:
        yield "  declined:"
        yield from map(_said, found.refusals)
    if found.table < 3 and found.grounds is not None:
        yield from _grounds(found.grounds)
    yield from (f"  broke off: {error}" for error in found.errors)


def _row(row: RowFound, found: FoilFound) -> Iterator[str]:
    yield f"  paper: {row.paper}"
    if row.ours:
        yield f"    borne out in {row.borne_out} of {found.seeds}, word for word in {row.verbatim}"
        yield from map(_said, row.ours)
    else:
        yield "    not supported"
    if 2 * row.borne_out < found.seeds:
        yield from (f"      {figures}" for figures in _against(row, found.grounds))


def _against(row: RowFound, grounds: Grounds | None) -> Iterator[str]:
    """Yield the figures behind a row that no seed, or only few seeds, bear out."""
    if grounds is None:
        return
    if row.claim.outcome == "collision":
        yield (
            f"p(collision | do({row.foil})) at most {_chance(grounds.collision)} at the decision,"
            f" {_chance(grounds.collision_before)} in the {grounds.decisions} decisions up to it;"
            f" driven on in SUMO: {_driven(grounds)}"
        )
        return
    blamed = {cause.vehicle for cause in row.claim.causes}
    for one in grounds.blamed:
        if one.vehicle in blamed:
            yield _blame(one)


def _blame(one: Blame) -> str:
    if one.time_if is not None and one.time_else is not None:
        either = f"takes {one.time_if:.1f} s if it does so, {one.time_else:.1f} s else"
    else:
        either = f"p(done) {_chance(one.done_if)} if it does so, {_chance(one.done_else)} else"
    return (
        f"vehicle {one.vehicle} does so with p {one.does:.2f};"
        f" influence beyond chance in {one.influential} of {one.seeds};"
        f" holds the ego up for {one.held_up:.1f} s; {either};"
        f" without it the decision changes in {one.decides} of {one.seeds}"
    )


def _grounds(found: Grounds) -> Iterator[str]:
    chances = ", ".join(f"{name} {_chance(p)}" for name, p in found.outcomes.items() if p > 0.0)
    yield f"  rollouts, mean of {found.seeds} seeds: {chances}"
    yield f"  as the paper factorises it, from the same rollouts: done {_chance(found.paper_done)}"
    if found.later is not None and found.printed is not None:
        yield f"  later by {found.later:.1f} s; Equation 8 as printed: {found.printed:.1f} s"
    yield f"  driven on in SUMO: {_driven(found)}"


def _driven(found: Grounds) -> str:
    return ", ".join(f"{name} {count}" for name, count in found.driven.items())


def _said(one: Sentence) -> str:
    seeds = " ".join(str(seed) for seed in one.seeds)
    return f"    {len(one.seeds)} x (seeds {seeds}) {one.text}"


def _chance(p: float | None) -> str:
    """Return a probability as text; "0" only if it is exactly 0."""
    if p is None:
        return "unknown"
    return "0" if p == 0.0 else f"{p:.3f}"
