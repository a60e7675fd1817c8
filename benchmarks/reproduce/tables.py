"""The paper's rows and our sentences, matched by their claims, never by their words."""

from collections.abc import Sequence
from statistics import fmean

import msgspec

from benchmarks.reproduce.claims import Claim, Part, differing
from benchmarks.reproduce.rides import Told, Wording
from benchmarks.reproduce.rows import ROWS, Foil, Row
from benchmarks.reproduce.weighing import Bearing
from planner.record.trace import OUTCOMES

NOT_DRIVEN = "not driven"  # SUMO could not continue with the foil


class Sentence(msgspec.Struct, frozen=True):
    """One of our sentences, and the seeds in which it was the answer."""

    text: str
    seeds: tuple[int, ...]
    differs: tuple[Part, ...] = ()  # parts that differ from the most similar row


class Blame(msgspec.Struct, frozen=True):
    """The effect on the foil of a vehicle that a row names, over the seeds in which it exists."""

    vehicle: int
    seeds: int
    does: float  # mean probability that it does what the row says
    influential: int  # seeds in which the choice depends on it by more than chance
    held_up: float  # [s] mean of the expected time that it holds the ego up under the foil
    done_if: float | None  # mean p(done | do(foil)) if it does so ...
    done_else: float | None  # ... and if it does not
    time_if: float | None  # [s] mean E[time | do(foil)] if it does so ...
    time_else: float | None  # [s] ... and if it does not
    decides: int  # seeds in which another action is chosen without it


class Grounds(msgspec.Struct, frozen=True):
    """The evidence on a foil, over the seeds in which it was explained."""

    seeds: int
    outcomes: dict[str, float]  # mean p(O | do(foil))
    collision: float  # the largest p(collision | do(foil)) at the decision, in any seed
    collision_before: float  # the largest at any decision up to then
    decisions: int  # number of decisions searched for this
    paper_done: float  # mean p(done | foil) as the paper factorises it, from the same rollouts
    later: float | None  # [s] mean by which the foil arrives later
    printed: float | None  # [s] mean difference of Equation 8 as it is printed
    driven: dict[str, int]  # counts of what happened in SUMO, by outcome
    blamed: tuple[Blame, ...]


class RowFound(msgspec.Struct, frozen=True):
    """One row of the paper."""

    table: int
    scenario: str
    foil: str
    paper: str
    borne_out: int  # seeds whose sentence claims the same
    verbatim: int  # those of them whose sentence is the same word for word
    ours: tuple[Sentence, ...]  # those sentences, the most frequent first
    claim: Claim


class SizeFound(msgspec.Struct, frozen=True):
    """The sentences with the same limits on effects and causes."""

    effects: int
    causes: int
    rows: tuple[RowFound, ...]
    others: tuple[Sentence, ...]  # our sentences that are in no row of the paper


class FoilFound(msgspec.Struct, frozen=True):
    """One foil in a table."""

    table: int
    scenario: str
    foil: str
    seeds: int
    answered: int  # seeds with a complete sentence
    declined: int  # seeds with a refusal and its reason
    sizes: tuple[SizeFound, ...]
    refusals: tuple[Sentence, ...]
    grounds: Grounds | None
    errors: tuple[str, ...] = ()


def compare(told: Sequence[Told]) -> tuple[FoilFound, ...]:
    """Compare our answers with the rows of the paper, by table and foil."""
    tables = dict.fromkeys((row.table, row.foil.scenario, row.foil.action) for row in ROWS)
    found = []
    for table, scenario, action in tables:
        rows = [r for r in ROWS if (r.table, r.foil.action) == (table, action)]
        asked = [t for t in told if (t.foil.scenario, t.foil.action) == (scenario, action)]
        found.append(_foil(rows[0].foil, table, rows, asked))
    return tuple(found)


def _foil(foil: Foil, table: int, rows: Sequence[Row], told: Sequence[Told]) -> FoilFound:
    explained = [one for one in told if one.wordings]
    refused = [one for one in told if one.declined is not None]
    sizes = dict.fromkeys(_size_of(row) for row in rows)
    return FoilFound(
        table=table,
        scenario=foil.scenario,
        foil=foil.action,
        seeds=len(told),
        answered=sum(all(_complete(w.text) for w in one.wordings) for one in explained),
        declined=len(refused),
        sizes=tuple(_size([r for r in rows if _size_of(r) == size], explained) for size in sizes),
        refusals=_counted([(f"{one.declined}: {one.answer}", one.seed) for one in refused]),
        grounds=_grounds(explained),
        errors=tuple(f"seed {t.seed}: {t.error}" for t in told if t.error is not None),
    )


def _size_of(one: Row | Wording) -> tuple[int, int]:
    return one.effects, one.causes


def _size(rows: Sequence[Row], told: Sequence[Told]) -> SizeFound:
    """Compare the rows of one size with our sentences of that size."""
    effects, causes = size = _size_of(rows[0])
    said = [(w, one.seed) for one in told for w in one.wordings if _size_of(w) == size]
    apart = {w.text: _apart(w.claim, rows) for w, _ in said}
    others = _counted([(w.text, seed) for w, seed in said if apart[w.text]])
    return SizeFound(
        effects=effects,
        causes=causes,
        rows=tuple(_row(row, said) for row in rows),
        others=tuple(msgspec.structs.replace(one, differs=apart[one.text]) for one in others),
    )


def _apart(ours: Claim, rows: Sequence[Row]) -> tuple[Part, ...]:
    """Return the parts in which a claim differs from the most similar row; () if it equals one."""
    return min((differing(ours, row.claim) for row in rows), key=len)


def _row(row: Row, said: Sequence[tuple[Wording, int]]) -> RowFound:
    same = [(w.text, seed) for w, seed in said if not differing(w.claim, row.claim)]
    return RowFound(
        table=row.table,
        scenario=row.foil.scenario,
        foil=row.foil.action,
        paper=row.text,
        borne_out=len(same),
        verbatim=sum(text == row.text for text, _ in same),
        ours=_counted(same),
        claim=row.claim,
    )


def _counted(said: Sequence[tuple[str, int]]) -> tuple[Sentence, ...]:
    """Return distinct sentences with their seeds, the most frequent first."""
    seeds: dict[str, list[int]] = {}
    for text, seed in said:
        seeds.setdefault(text, []).append(seed)
    found = [Sentence(text, tuple(sorted(where))) for text, where in seeds.items()]
    return tuple(sorted(found, key=lambda one: (-len(one.seeds), one.seeds, one.text)))


def _complete(text: str) -> bool:
    """Check whether a sentence is complete: it has an end, and a cause after "because"."""
    return text.startswith("If ego had ") and text.endswith(".") and "because ." not in text


def _grounds(told: Sequence[Told]) -> Grounds | None:
    weighed = [one.weighed for one in told if one.weighed is not None]
    if not weighed:
        return None
    happened = [one.happened.outcome if one.happened else NOT_DRIVEN for one in told]
    bearings = [bearing for one in weighed for bearing in one.bearings]
    vehicles = dict.fromkeys(bearing.vehicle for bearing in bearings)
    return Grounds(
        seeds=len(weighed),
        outcomes={name: fmean(one.outcomes[name] for one in weighed) for name in OUTCOMES},
        collision=max(one.outcomes["collision"] for one in weighed),
        collision_before=max(one.collision for one in weighed),
        decisions=sum(one.decisions for one in weighed),
        paper_done=fmean(one.paper_done for one in weighed),
        later=_mean([one.later for one in weighed]),
        printed=_mean([one.printed for one in weighed]),
        driven={name: happened.count(name) for name in dict.fromkeys(sorted(happened))},
        blamed=tuple(_blame([b for b in bearings if b.vehicle == v]) for v in vehicles),
    )


def _blame(bearings: Sequence[Bearing]) -> Blame:
    return Blame(
        vehicle=bearings[0].vehicle,
        seeds=len(bearings),
        does=fmean(one.does for one in bearings),
        influential=sum(one.significant for one in bearings),
        held_up=fmean(one.held_up for one in bearings),
        done_if=_mean([one.done_if for one in bearings]),
        done_else=_mean([one.done_else for one in bearings]),
        time_if=_mean([one.time_if for one in bearings]),
        time_else=_mean([one.time_else for one in bearings]),
        decides=sum(one.decides is True for one in bearings),
    )


def _mean(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return fmean(known) if known else None
