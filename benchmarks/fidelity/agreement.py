"""Measures of how well the foreseen outcomes of foils agree with what happened."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence

import msgspec

from benchmarks.fidelity.cases import Case
from benchmarks.fidelity.rivals import Guess, Key, key_of
from benchmarks.figures import in_columns, mean, quantile
from planner.record.trace import OUTCOMES, Outcome

CLEAR = 1.0  # [s] least difference whose sign counts
ALL = "all"


class Agreement(msgspec.Struct, frozen=True):
    """The agreement for the foils of one scenario or kind, or for all of them."""

    scenario: str  # or family of networks, or kind of foil
    foils: int
    declined: int  # declined for lack of evidence; not counted below
    agree: float | None  # share of foils with the outcome that was foreseen
    agree_blind: float | None  # the same if the others of a rollout do not react to the ego
    agree_name: float | None  # the same for the usual outcome of foils of that name elsewhere
    commonest: float | None  # the same for always naming the commonest outcome
    brier: float | None  # of the outcome probabilities: 0 is perfect, 2 the worst
    brier_blind: float | None  # the same if the others do not react
    brier_commonest: float | None  # the same for always giving the shares of all outcomes
    timed: int  # foils foreseen to arrive that came to the destination, as the fact did
    error: float | None  # [s] mean absolute error of the difference of the arrival times
    error_blind: float | None  # [s] the same if the others do not react
    error_name: float | None  # [s] the same for the mean difference of that name elsewhere
    skill: float | None  # 1 - error / error_name: 0 is no better than the name, 1 is perfect
    bias: float | None  # [s] mean of foreseen minus happened
    error_p50: float | None  # [s]
    error_p90: float | None
    within: float | None  # share of the timed foils within the range that is given
    clear: int  # timed foils with a difference of more than a second
    sign: float | None  # share of these with the right sign
    sign_name: float | None  # the same for the mean difference of that name elsewhere


class OutcomeRow(msgspec.Struct, frozen=True):
    """One outcome."""

    outcome: Outcome
    foreseen: int
    happened: int
    both: int
    said: float | None  # mean probability that was given to it when it happened


class Bin(msgspec.Struct, frozen=True):
    """Outcomes with about the same foreseen probability."""

    low: float
    high: float
    n: int
    said: float | None  # mean probability
    happened: float | None  # share that happened


def agreement(
    scenario: str, cases: Sequence[Case], guesses: Mapping[Key, Guess] | None = None
) -> Agreement:
    """Return the agreement for some cases, with guesses by the foils' names for comparison."""
    told = [case for case in cases if case.foreseen.declined is None]
    shares = _shares(told)
    blind = [_as_blind(c) for c in cases if c.blind is not None and c.blind.declined is None]
    known = guesses or {}
    named = [c for c in told if key_of(c) in known]
    timed = [c for c in told if c.later is not None and c.foreseen.time is not None]
    clear = [c for c in timed if abs(_later(c)) > CLEAR]
    return Agreement(
        scenario=scenario,
        foils=len(cases),
        declined=len(cases) - len(told),
        agree=_share(told, right),
        agree_blind=_share(blind, right),
        agree_name=_share(named, lambda c: known[key_of(c)].outcome == c.happened.outcome),
        commonest=max(shares.values()) if told else None,
        brier=_brier_of(told),
        brier_blind=_brier_of(blind),
        brier_commonest=_rounded(mean([_brier(shares, c.happened.outcome) for c in told])),
        timed=len(timed),
        **_times(timed, blind, known),
        within=_share(timed, _within),
        clear=len(clear),
        sign=_share(clear, same_sign),
        sign_name=_share(
            [c for c in clear if (key_of(c) in known and known[key_of(c)].later is not None)],
            lambda c: ((known[key_of(c)].later or 0.0) > 0.0) == (_later(c) > 0.0),
        ),
    )


def _times(
    timed: Sequence[Case], blind: Sequence[Case], known: Mapping[Key, Guess]
) -> dict[str, float | None]:
    """Return the errors of the differences in time [s]; skill is over cases with a guess."""
    errors = [_foreseen_time(c) - _later(c) for c in timed]
    sizes = [abs(error) for error in errors]
    blindly = [
        abs(_foreseen_time(c) - _later(c))
        for c in blind
        if c.later is not None and c.foreseen.time is not None
    ]
    pairs = [
        (abs(_foreseen_time(c) - _later(c)), abs(later - _later(c)))
        for c in timed
        if key_of(c) in known and (later := known[key_of(c)].later) is not None
    ]
    ours, rival = (mean([pair[k] for pair in pairs]) for k in (0, 1))
    return {
        "error": _rounded(mean(sizes)),
        "error_blind": _rounded(mean(blindly)),
        "error_name": _rounded(rival),
        "skill": None if ours is None or not rival else round(1.0 - ours / rival, 3),
        "bias": _rounded(mean(errors)),
        "error_p50": _rounded(quantile(sizes, 50)) if sizes else None,
        "error_p90": _rounded(quantile(sizes, 90)) if sizes else None,
    }


def by_outcome(cases: Sequence[Case]) -> tuple[OutcomeRow, ...]:
    """Return the agreement by outcome."""
    told = [case for case in cases if case.foreseen.declined is None]
    return tuple(
        OutcomeRow(
            outcome,
            sum(c.foreseen.likeliest == outcome for c in told),
            sum(c.happened.outcome == outcome for c in told),
            sum(c.foreseen.likeliest == outcome == c.happened.outcome for c in told),
            _rounded(
                mean(
                    [
                        c.foreseen.outcomes.get(outcome, 0.0)
                        for c in told
                        if c.happened.outcome == outcome
                    ]
                )
            ),
        )
        for outcome in OUTCOMES
    )


def calibration(
    cases: Sequence[Case],
    told: Callable[[Outcome, float], float] = lambda _, given: given,
    bins: int = 5,
) -> tuple[Bin, ...]:
    """Return how often outcomes happened, by their foreseen probability.

    Args:
        cases: foils with their outcomes.
        told: returns the probability that an answer states, given that among the rollouts.
        bins: number of bins of equal width.
    """
    pairs = [
        (
            told(outcome, case.foreseen.outcomes.get(outcome, 0.0)),
            float(case.happened.outcome == outcome),
        )
        for case in cases
        if case.foreseen.declined is None
        for outcome in OUTCOMES
    ]
    found = []
    for k in range(bins):
        low, high = k / bins, (k + 1) / bins
        inside = [p for p in pairs if low <= p[0] < high or (k == bins - 1 and p[0] >= high)]
        said, happened = mean([p for p, _ in inside]), mean([h for _, h in inside])
        found.append(Bin(low, high, len(inside), _rounded(said), _rounded(happened)))
    return tuple(found)


def right(case: Case) -> bool:
    """Check whether the likeliest foreseen outcome happened."""
    return case.foreseen.likeliest == case.happened.outcome


def same_sign(case: Case) -> bool:
    """Check whether the sign of the foreseen difference in time is right."""
    return (_foreseen_time(case) > 0.0) == (_later(case) > 0.0)


def tables(
    rows: Sequence[Agreement],
    outcomes: Sequence[OutcomeRow],
    bins: Mapping[str, Sequence[Bin]],
) -> str:
    """Return the numbers as tables for people."""
    names = [name for name in Agreement.__struct_fields__ if name != "scenario"]
    first = [["", *(row.scenario for row in rows)]]
    first += [[n.replace("_", " "), *(_cell(getattr(row, n)) for row in rows)] for n in names]
    second = [["outcome", "foreseen", "happened", "both", "said where it happened"]]
    second += [
        [o.outcome, str(o.foreseen), str(o.happened), str(o.both), _cell(o.said)] for o in outcomes
    ]
    third = [["probability", "", "n", "said", "happened"]]
    third += [
        [name, f"{b.low:.1f} to {b.high:.1f}", str(b.n), _cell(b.said), _cell(b.happened)]
        for name, group in bins.items()
        for b in group
        if b.n
    ]
    return "\n\n".join(in_columns(table) for table in (first, second, third))


def _as_blind(case: Case) -> Case:
    """Return a case with what would be foreseen if the others did not react."""
    assert case.blind is not None
    return msgspec.structs.replace(case, foreseen=case.blind)


def _within(case: Case) -> bool:
    low, high = case.foreseen.low, case.foreseen.high
    return low is not None and high is not None and low <= _later(case) <= high


def _foreseen_time(case: Case) -> float:
    assert case.foreseen.time is not None
    return case.foreseen.time


def _later(case: Case) -> float:
    assert case.later is not None
    return case.later


def _shares(cases: Sequence[Case]) -> dict[Outcome, float]:
    counts = Counter(case.happened.outcome for case in cases)
    return {outcome: counts[outcome] / max(len(cases), 1) for outcome in OUTCOMES}


def _brier_of(cases: Sequence[Case]) -> float | None:
    return _rounded(mean([_brier(c.foreseen.outcomes, c.happened.outcome) for c in cases]))


def _brier(said: dict[Outcome, float], happened: Outcome) -> float:
    """Return Brier's score (1950) of one forecast: the sum of squares over all outcomes."""
    return sum((said.get(outcome, 0.0) - (outcome == happened)) ** 2 for outcome in OUTCOMES)


def _share(cases: Sequence[Case], holds: Callable[[Case], bool]) -> float | None:
    return _rounded(mean([float(holds(case)) for case in cases]))


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 3)


def _cell(value: float | None) -> str:
    if value is None:
        return "-"
    return str(value) if isinstance(value, int) else f"{value:.3f}"
