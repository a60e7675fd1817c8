"""Agreement of what is foreseen of foils with what happens, on cases made up for it."""

import math

import msgspec
import pytest

from benchmarks.fidelity.agreement import agreement, by_outcome, calibration
from benchmarks.fidelity.cases import Case, Compared, Task, compare
from benchmarks.fidelity.fidelity import measure, report, tasks
from benchmarks.fidelity.foresight import Foreseen
from benchmarks.fidelity.ranging import coverage, extension, learn
from benchmarks.fidelity.resimulate import Happened
from benchmarks.fidelity.rivals import Guess, by_name, key_of
from xavi_dialogue.domain.evidence import calibrated
from xavi_dialogue.explain.causes.plans.ranges import LEAST, Group, Ranges, Source

RANGES = Ranges(0.9, 3.0, (Group("exit", None, 30, 50, 1.0),), Source("", {}, 0, 0, 0))


def case(said: dict, happened: str, time: float | None = None, later: float | None = None) -> Case:
    low, high = (None, None) if time is None else (time - 1.0, time + 1.0)
    arrived = 10.0 if happened == "done" else None
    return Case(
        "s1",
        0,
        3.0,
        "change-left",
        "continue",
        Foreseen(said, time, low, high),
        Happened(happened, arrived),  # type: ignore[arg-type]
        later,
    )


CASES = [
    case({"done": 1.0}, "done", 4.0, 3.5),  # right, within the range
    case({"done": 0.8, "dead": 0.2}, "done", 2.0, -1.5),  # right outcome, wrong sign
    case({"done": 0.6, "collision": 0.4}, "collision", 1.0),
    case({"dead": 1.0}, "dead"),
    msgspec.structs.replace(
        case({}, "done"), foreseen=Foreseen({}, declined="too-little-evidence")
    ),
]


def test_agreement_counts_what_was_told() -> None:
    found = agreement("s1", CASES)
    assert (found.foils, found.declined) == (5, 1)
    assert found.agree == 0.75
    assert found.commonest == 0.5  # two of four arrived
    assert (found.timed, found.clear) == (2, 2)
    assert found.sign == 0.5
    assert found.within == 0.5
    assert found.error_p50 == pytest.approx(2.0)  # of 0.5 and 3.5
    assert found.error == pytest.approx(2.0)
    assert found.bias == pytest.approx(2.0)  # both were foreseen too late


def at(one: Case, **changed: object) -> Case:
    return msgspec.structs.replace(one, **changed)


def test_the_name_of_a_foil_is_a_rival_that_knows_other_rides_only() -> None:
    here = at(CASES[0], seed=1, foil="stop", later=2.0)
    others = [
        at(CASES[0], seed=2, foil="stop", later=4.0),
        at(CASES[0], seed=3, foil="stop", later=6.0),
        at(CASES[3], seed=4, foil="stop"),
        at(CASES[3], seed=1, foil="exit-left"),
    ]
    found = by_name([here, *others])
    assert found[key_of(here)] == Guess("done", 5.0)
    assert key_of(others[3]) not in found  # no other ride has a foil of that name
    row = agreement("s1", [here], found)
    assert row.agree_name == 1.0
    assert row.error_name == pytest.approx(3.0)  # 5.0 instead of 2.0
    assert row.error == pytest.approx(2.0)  # 4.0 instead of 2.0
    assert row.skill == pytest.approx(1.0 - 2.0 / 3.0, abs=1e-3)


def timed(later: float | None, **changed: object) -> Case:
    one = at(case({"done": 1.0}, "done", 4.0, later), foil="exit-left", fact_arrived=True)
    return at(one, **changed)


def test_coverage_is_that_of_cases_of_which_a_range_is_said() -> None:
    cases = [timed(3.5), timed(6.5), timed(None), timed(4.0, foil="stop")]
    found = coverage("s1", [*cases, timed(4.0, fact_arrived=False)], RANGES)
    assert (found.n, found.missed, found.refused) == (4, 1, 1)
    assert found.covered == pytest.approx(1 / 3, abs=1e-3)  # 3 to 5: the first alone
    assert found.width == pytest.approx(2.0)
    assert found.rollouts == pytest.approx(1 / 3, abs=1e-3)  # 3 to 5
    assert found.constant == pytest.approx(2 / 3, abs=1e-3)  # 1 to 7
    assert found.constant_width == pytest.approx(6.0)


def test_ranges_are_learnt_of_the_rides_that_were_driven() -> None:
    rides = [Compared("learning", 7 + k, (timed(4.0 + 0.1 * k, seed=k),)) for k in range(2 * LEAST)]
    found = learn([*rides, Compared("learning", 99, error="no")], "again")
    cases = 2 * LEAST
    worlds = {"learning": (7, 6 + cases)}
    assert found.source == Source("again", worlds, cases, cases, 0, cases, found.source.model_error)
    assert found.source.model_error == pytest.approx(0.0, abs=1e-3)  # all came as foreseen
    assert found.model_error == pytest.approx(1.0 - 0.05 ** (1.0 / cases), abs=1e-4)
    whole = found.group("exit", "road")
    assert whole is not None
    assert (whole.rides, whole.cases) == (cases, cases)
    assert whole.reach == pytest.approx(3.6)  # the 37th of 40, for ceil(41 * 0.9)
    assert found.constant == pytest.approx(3.6)
    with pytest.raises(ValueError, match="too few"):
        learn(rides[:5], "again")


def test_times_beyond_a_waypoint_are_compared_with_the_arrival() -> None:
    foreseen = Foreseen({"done": 1.0}, 4.0, 3.0, 5.0, extended=4.5)
    cases = [timed(5.0, foreseen=foreseen, waypoint=True), timed(5.0, foreseen=foreseen)]
    found = extension("s1", cases)
    assert (found.n, found.error, found.bias) == (1, 1.0, -1.0)
    assert (found.error_extended, found.bias_extended) == (0.5, -0.5)


def test_random_networks_come_after_the_scenarios() -> None:
    assert tasks(["s1"], [0, 1], [5], 2) == [
        Task("s1", 0, 2),
        Task("s1", 1, 2),
        Task("random", 5, 2),
    ]


def test_brier_scores_are_sums_of_squares_over_outcomes() -> None:
    found = agreement("s1", CASES)
    ours = (0.0 + (0.04 + 0.04) + (0.36 + 0.36) + 0.0) / 4.0
    assert found.brier == pytest.approx(ours, abs=1e-3)
    shares = {"done": 0.5, "collision": 0.25, "dead": 0.25}
    scores = [
        sum((p - (name == happened)) ** 2 for name, p in shares.items())
        for happened in ("done", "done", "collision", "dead")
    ]
    assert found.brier_commonest == pytest.approx(math.fsum(scores) / 4.0, abs=1e-3)


def test_each_outcome_is_told_apart() -> None:
    rows = {row.outcome: row for row in by_outcome(CASES)}
    done, struck = rows["done"], rows["collision"]
    assert (done.foreseen, done.happened, done.both) == (3, 2, 2)
    assert done.said == pytest.approx(0.9)
    assert (struck.foreseen, struck.happened, struck.both) == (0, 1, 0)
    assert struck.said == pytest.approx(0.4)
    assert rows["termination"].said is None


def test_calibration_sorts_probabilities_into_bins() -> None:
    bins = calibration(CASES)
    assert sum(one.n for one in bins) == 16  # four cases, four outcomes each
    assert (bins[-1].n, bins[-1].happened) == (3, 1.0)  # 1.0, 0.8 and 1.0
    assert bins[0].happened == 0.0


def test_calibration_tells_the_probabilities_that_answers_tell() -> None:
    bins = calibration(CASES, lambda _, chance: calibrated(chance, 0.4))
    assert bins[-1].n == 0  # 1.0 is told as 0.7
    assert (bins[3].n, bins[3].said) == (2, pytest.approx(0.7))
    assert calibrated(0.0, 0.4) == pytest.approx(0.1)
    assert calibrated(0.5, 0.4, 0.9) == pytest.approx(0.3 + 0.36)


def test_what_is_wrong_is_listed_with_how_to_see_it_again() -> None:
    found = report(
        [Compared("s1", 0, tuple(CASES)), Compared("s2", 3, error="SumoFailed: no")], RANGES
    )
    assert len(found.wrong) == 2
    assert "said done 0.60, collision 0.40, +1.0 s; came to collision" in found.wrong[1].what
    assert found.wrong[0].reproduce == "xavi bench fidelity --networks 0 --scenario s1 --seed 0"
    assert found.failed[0].startswith("SumoFailed: no")
    assert found.all.agree == 0.75
    assert "s1, seed 0, 3 s: continue instead of change-left" in found.table()
    assert msgspec.json.decode(msgspec.json.encode(found))["bench"] == "fidelity"


def test_a_scenario_that_cannot_be_driven_is_told_in_the_report() -> None:
    found = compare(Task("no-such-scenario", 0))
    assert found.cases == ()
    assert found.error is not None
    assert found.error.startswith("ScenarioNotFound")
    whole = report([found], RANGES)
    assert whole.all.agree is None
    assert "no-such-scenario" in whole.table()


def test_foils_of_a_story_are_foreseen() -> None:
    notes: list[str] = []
    found = measure(tasks(["s1"], [0], [], 5), 1, notes.append)
    assert notes == ["1 of 1: s1, seed 0"]
    assert found.failed == ()
    assert found.all.foils > 5
    outcomes = {row.outcome: row.happened for row in found.outcomes}
    assert outcomes["dead"] > 0  # whoever turns right does not get there
    assert outcomes["done"] > 0
    assert found.all.agree is not None
    assert found.all.commonest is not None
    assert found.all.agree > found.all.commonest
    assert found.all.sign is not None
    assert found.all.sign > 0.9


def test_a_measurement_whose_rides_all_failed_meets_no_target() -> None:
    found = report([Compared("s1", 0, error="SumoFailed: no")], RANGES)
    assert not any(target.met for target in found.targets)
    assert not found.met
    assert "rides that failed" in found.table()


def test_fidelity_is_held_against_the_name_of_the_foil() -> None:
    other = tuple(msgspec.structs.replace(case, seed=1) for case in CASES)
    found = report([Compared("s1", 0, tuple(CASES)), Compared("s1", 1, other)], RANGES)
    ahead = found.targets[0]
    assert found.all.agree_name is not None
    assert ahead.value == pytest.approx(100.0 * (0.75 - found.all.agree_name))
    assert ahead.met
