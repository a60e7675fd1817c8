"""The paper's factorisation, compared with ours on recorded decisions."""

from collections.abc import Iterable, Iterator

import msgspec

from benchmarks.figures import in_columns
from planner.record.trace import Action, PlanTrace
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.influence import influence
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.causal.paper import PaperNetwork
from xavi_dialogue.storage.ride_file import RecordedRide

ROUNDING = 1e-9
BEGIN, END = "<!-- factorisations: begin -->", "<!-- factorisations: end -->"


class Beside(msgspec.Struct, frozen=True):
    """One foil of one recorded decision, by our factorisation and by the paper's."""

    ride: str
    time: float  # [s] of the decision
    fact: Action
    foil: Action
    done: float  # p(done | do(foil))
    paper_done: float
    paper_sum: float  # sum over outcomes of the paper's; ours sum to 1
    later: float | None  # [s] E[time | do(foil)] - E[time | do(fact)]; None: never done
    paper_later: float | None  # [s] with the sign of ours
    cause: int | None  # the vehicle with the largest influence on the choice, if any has one
    paper_cause: int | None  # the vehicle with the least divergence


class Summary(msgspec.Struct, frozen=True):
    """The differences between the two over the foils of some rides."""

    foils: int
    done_apart: float  # mean difference of p(done)
    done_most: float
    later_apart: float  # [s] mean difference of the times
    later_most: float  # [s] greatest difference of the times
    signs: int  # foils that are earlier by one and later by the other
    sums: int  # foils whose outcomes do not sum to 1 by the paper's (within 0.01)
    causes: int  # foils for which the two put different vehicles first


def beside(name: str, ride: RecordedRide) -> Iterator[Beside]:
    """Yield every foil that may reach the goal, of every free decision of a ride."""
    for trace in ride.traces:
        if trace.under_way is None and trace.plan:
            yield from _foils(name, trace)


def summary(rows: Iterable[Beside]) -> Summary:
    """Return the differences between the two."""
    rows = list(rows)
    done = [abs(row.done - row.paper_done) for row in rows]
    later = [
        (row.later, row.paper_later)
        for row in rows
        if row.later is not None and row.paper_later is not None
    ]
    gaps = [abs(ours - theirs) for ours, theirs in later]
    return Summary(
        foils=len(rows),
        done_apart=round(sum(done) / max(len(done), 1), 2),
        done_most=round(max(done, default=0.0), 2),
        later_apart=round(sum(gaps) / max(len(gaps), 1), 2),
        later_most=round(max(gaps, default=0.0), 2),
        signs=sum(ours * theirs < 0.0 for ours, theirs in later),
        sums=sum(abs(row.paper_sum - 1.0) > 0.01 for row in rows),
        causes=sum(row.cause != row.paper_cause for row in rows),
    )


def table(rows: Iterable[Beside]) -> str:
    """Return the rows and a summary of the differences, for people."""
    rows = list(rows)
    names = [name.replace("_", " ") for name in Beside.__struct_fields__]
    cells = [[_cell(value) for value in msgspec.structs.astuple(row)] for row in rows]
    found = msgspec.structs.asdict(summary(rows))
    last = ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in found.items())
    return f"{in_columns([names, *cells])}\n\n{last}"


def written(page: str, rows: Iterable[Beside]) -> str:
    """Return a page with the table between its markers.

    Raises:
        ValueError: the page has no markers.
    """
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the page needs {BEGIN} and {END}, each on a line")
    return f"{before}{begin}\n```text\n{table(rows)}\n```\n{end}{after}"


def _foils(name: str, trace: PlanTrace) -> Iterator[Beside]:
    model, paper = CausalModel(trace), PaperNetwork(trace)
    fact = trace.plan[0].action
    here = model.intervene((fact,))
    measured = influence(model)
    first = measured[0].vehicle if measured and measured[0].significant else None
    for foil in model.options():
        there = model.intervene((foil,))
        chances = paper.outcomes((foil,))
        done = there.outcomes["done"] if there is not None else 0.0
        if foil == fact or here is None or there is None or done + chances["done"] <= ROUNDING:
            continue
        found = {effect.component: effect.delta for effect in effects(there, here)}
        printed = paper.difference((fact,), (foil,), "time")
        yield Beside(
            ride=name,
            time=trace.sim_time,
            fact=fact,
            foil=foil,
            done=round(done, 2),
            paper_done=round(chances["done"], 2),
            paper_sum=round(sum(chances.values()), 2),
            later=round(found["time"], 1) if "time" in found else None,
            paper_later=None if printed is None else round(-printed, 1),
            cause=first,
            paper_cause=_least_divergent(model, paper),
        )


def _least_divergent(model: CausalModel, paper: PaperNetwork) -> int | None:
    """Return the vehicle that the paper's ordering puts first.

    Vehicles whose divergence does not vary are left out.
    """
    found = []
    for vehicle in model.vehicles:
        every = [paper.divergence(vehicle, choice) for choice in model.choices(vehicle)]
        if max(every) - min(every) > ROUNDING:
            found.append((min(every), vehicle))
    return min(found)[1] if found else None


def _cell(value: str | float | int | None) -> str:
    if isinstance(value, float):
        return f"{value:g}"
    return "-" if value is None else str(value)
