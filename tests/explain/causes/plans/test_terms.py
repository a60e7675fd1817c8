"""What the reward holds for and against a plan: taken apart by hand for small decisions."""

import math

import pytest
from msgspec.structs import replace

from planner.record.trace import Action, Component, Costs, Outcome, PlanTrace, RewardTerm
from tests.explain.causes.decisions import decided
from tests.explain.trust import trusted
from tests.traces import Actions, Aim, Chosen, End, Way
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.answers import Share, Term
from xavi_dialogue.explain.causes.plans.terms import Difference, costs_of, differences, told

CHEAP = Costs(
    {"time": 1.0, "jerk": 0.5, "angular-acceleration": 2.0, "curvature": 10.0},
    {"collision": 100.0, "dead": 50.0, "termination": 10.0},
    {"stop": 2.0, "change-left": 3.0},
)
SPLIT = {
    1: (
        Aim("exit-left", 0.25, (Way(("exit-left",)),)),
        Aim("continue", 0.75, (Way(("continue",)),)),
    )
}
BOTH: tuple[Actions, ...] = (("continue",), ("change-left",))


def end(
    outcome: Outcome = "done", time: float = 10.0, jerk: float = 0.0, reward: float | None = None
) -> tuple[Outcome, float, float, float | None]:
    return outcome, time, jerk, reward


def sides(
    *rows: tuple[tuple[Outcome, float, float, float | None], ...], chances: float = 0.25
) -> tuple[CausalModel, Intervention, Intervention]:
    """The model, and what comes of moving left (the foil) and of going on (the fact).

    Of each first what comes of it where the other vehicle turns left, and then where it goes on;
    rewards follow the costs.
    """
    aims = {1: (replace_chance(SPLIT[1][0], chances), replace_chance(SPLIT[1][1], 1.0 - chances))}
    trace = decided(lambda *_: End(), aims, BOTH, costs=CHEAP)
    fact, foil = rows
    found = []
    for row, (outcome, time, jerk, reward) in zip(trace.rollouts, (*fact, *foil), strict=True):
        known: dict[Component, float | None] = dict.fromkeys(row.components)
        if outcome == "done":
            known = {"time": time, "jerk": jerk, "angular-acceleration": 0.0, "curvature": 0.0}
        effort = 3.0 if row.actions[0].action == "change-left" else 0.0
        price = {"collision": 100.0, "dead": 50.0, "termination": 40.0 + effort}.get(
            outcome, time + 0.5 * jerk * time + effort
        )
        found.append(
            replace(
                row,
                outcome=outcome,
                components=known,
                collided_with=1 if outcome == "collision" else None,
                reward=-price if reward is None else reward,
            )
        )
    model = CausalModel(replace(trace, rollouts=tuple(found)))
    there, here = model.intervene(("change-left",)), model.intervene(("continue",))
    assert there is not None
    assert here is not None
    return model, there, here


def replace_chance(aim: Aim, chance: float) -> Aim:
    return Aim(aim.kind, chance, aim.ways, aim.place)


@pytest.mark.parametrize(
    ("fact", "foil", "terms"),
    [
        ((end(), end()), (end(time=12.0), end(time=14.0)), {"time": 3.5, "effort": 3.0}),
        ((end(), end()), (end(time=4.0), end(time=4.0)), {"effort": 3.0, "time": -6.0}),
        ((end(jerk=0.4), end()), (end(), end()), {"effort": 3.0, "jerk": -0.5}),
        ((end(), end()), (end("collision"), end()), {"collision": 22.5, "effort": 2.25}),
        ((end("collision"), end()), (end("collision"), end()), {"effort": 2.25}),
        (
            (end("dead"), end()),
            (end("collision"), end()),
            {"collision": 25.0, "effort": 2.25, "dead": -12.5},
        ),
        ((end(), end()), (end("termination"), end()), {"late": 7.5, "effort": 3.0}),
        ((end("dead"), end()), (end(), end()), {"effort": 2.25, "dead": -0.25 * (50.0 - 13.0)}),
    ],
)
def test_a_difference_is_taken_apart(
    fact: tuple[tuple[Outcome, float, float, float | None], ...],
    foil: tuple[tuple[Outcome, float, float, float | None], ...],
    terms: dict[Term, float],
) -> None:
    """In a quarter of the situations the one, in three quarters the other."""
    found = differences(*sides(fact, foil))
    assert found.terms == {name: pytest.approx(cost) for name, cost in terms.items()}
    assert list(found.terms) == list(terms)  # largest first
    assert found.value == pytest.approx(sum(terms.values()))
    assert found.error == 0.0  # all was tried


def test_two_that_are_out_of_time_differ_by_their_terms() -> None:
    model, _, _ = sides((end("termination"),) * 2, (end("termination"),) * 2)
    left: dict[RewardTerm, float] = {"time": 30.0, "late": 10.0, "left": 9.5}
    here = {**left, "angular-acceleration": 2.0, "effort": 2.0}
    there = {**left, "left": 9.75, "angular-acceleration": 5.5}
    told_apart = tuple(
        replace(row, terms=there if row.actions[0].action == "change-left" else here)
        for row in model.trace.rollouts
    )
    model = CausalModel(replace(model.trace, rollouts=told_apart))
    foil, fact = model.intervene(("change-left",)), model.intervene(("continue",))
    assert foil is not None
    assert fact is not None
    found = differences(model, foil, fact)
    expected = {"angular-acceleration": 3.5, "late": 0.25, "effort": -2.0}
    assert found.terms == {name: pytest.approx(cost) for name, cost in expected.items()}
    assert told(found)[0].term == "angular-acceleration"


def test_chances_of_bad_ends_stand_beside_their_terms() -> None:
    found = differences(*sides((end("dead"), end()), (end("collision"), end("termination"))))
    assert found.risks == pytest.approx((trusted(0.25), trusted(0.0)))
    assert found.chances["dead"] == pytest.approx((0.0, 0.25))
    late = trusted(0.75, "termination"), trusted(0.0, "termination")
    assert found.chances["late"] == pytest.approx(late)
    share = found.share("collision")
    assert (share.chance, share.fact_chance) == pytest.approx((trusted(0.25), trusted(0.0)))
    assert found.share("jerk") == Share("jerk", 0.0, None, None)
    assert Difference({}, 0.0).risks == (0.0, 0.0)
    shares = Difference({"time": 2.0, "jerk": -1.0}, 0.0).shares
    assert shares == (Share("time", 2.0), Share("jerk", -1.0))


def without(model: CausalModel, *rows: int) -> tuple[CausalModel, Intervention, Intervention]:
    """The same record without some of its rollouts."""
    kept = tuple(r for r in model.trace.rollouts if r.index not in rows)
    other = CausalModel(replace(model.trace, rollouts=kept))
    there, here = other.intervene(("change-left",)), other.intervene(("continue",))
    assert there is not None
    assert here is not None
    return other, there, here


def test_situations_that_were_tried_with_both_count_alone() -> None:
    """Of the foil the first situation was not tried: 10 against 14 s in the other one."""
    model, _, _ = sides((end(time=90.0), end()), (end(), end(time=14.0)))
    found = differences(*without(model, 2))
    assert found.terms == {"time": pytest.approx(4.0), "effort": pytest.approx(3.0)}
    assert found.error == 0.0


def test_where_few_were_tried_with_both_the_sides_vary_independently() -> None:
    """Each side was tried in one situation, and not in the same one."""
    model, _, _ = sides((end(time=20.0), end()), (end(), end(time=14.0)))
    found = differences(*without(model, 1, 2))
    assert found.terms == {"effort": pytest.approx(3.0), "time": pytest.approx(-6.0)}


def test_a_fatal_end_is_never_left_out() -> None:
    """The crash was met in a situation that was tried with the foil alone."""
    model, _, _ = sides((end(), end()), (end("collision"), end()))
    found = differences(*without(model, 0))
    assert found.terms["collision"] == pytest.approx(0.25 * (100.0 - 10.0))
    assert found.chances["collision"] == pytest.approx((trusted(0.25), trusted(0.0)))
    model, _, _ = sides((end("dead"), end()), (end(), end()))
    other = differences(*without(model, 2))
    assert other.terms["dead"] == pytest.approx(-0.25 * (50.0 - 13.0))


def test_the_error_grows_with_what_was_not_tried() -> None:
    """Two of three situations, with differences of 2 and 6 s, each half of what was tried."""
    aims = {
        1: tuple(
            Aim("continue", p, (Way(("continue",)),), str(k)) for k, p in enumerate((0.3, 0.3, 0.4))
        )
    }

    def ends(plan: Actions, chosen: Chosen) -> End:
        return End(jerk=0.0, angular=0.0, curvature=0.0)

    trace = decided(ends, aims, BOTH, costs=CHEAP)
    rows = []
    for row in trace.rollouts:
        more = {0: 2.0, 1: 6.0}.get(row.samples[0].goal)
        if more is None:
            continue
        time = 10.0 + (more if row.actions[0].action == "change-left" else 0.0)
        effort = 3.0 if row.actions[0].action == "change-left" else 0.0
        rows.append(
            replace(row, components={**row.components, "time": time}, reward=-time - effort)
        )
    model = CausalModel(replace(trace, rollouts=tuple(rows)))
    there, here = model.intervene(("change-left",)), model.intervene(("continue",))
    assert there is not None
    assert here is not None
    found = differences(model, there, here)
    assert found.terms == {"time": pytest.approx(4.0), "effort": pytest.approx(3.0)}
    # sum of squares of w (v - mean) = 2 * (0.5 * 2)^2 = 2; times 2 / 1 and 0.4
    assert found.error == pytest.approx(math.sqrt(2.0 * 2.0 * 0.4))


def recorded(**terms: float) -> PlanTrace:
    trace = decided({"continue": End()}, plans=[("continue",)], costs=CHEAP)
    known: dict[RewardTerm, float] = {n.replace("_", "-"): v for n, v in terms.items()}  # type: ignore[misc]
    return replace(trace, rollouts=(replace(trace.rollouts[0], terms=known),))


def expected(trace: PlanTrace, *plan: Action) -> dict[Term, float]:
    model = CausalModel(trace)
    found = model.intervene(plan)
    assert found is not None
    return costs_of(model, found)


def test_what_was_recorded_is_told() -> None:
    found = expected(recorded(time=9.0, left=3.0, late=4.0, effort=1.0), "continue")
    assert found == {"time": 9.0, "late": 7.0, "effort": 1.0}


@pytest.mark.parametrize(
    ("reward", "terms"),
    [
        (
            -18.0,
            {
                "time": 10.0,
                "effort": 2.0,
                "jerk": 2.5,
                "angular-acceleration": 3.0,
                "curvature": 0.5,
            },
        ),
        (
            -18.04,
            {
                "time": 10.0,
                "effort": 2.0,
                "jerk": 2.5,
                "angular-acceleration": 3.0,
                "curvature": 0.5,
            },
        ),
        (-18.06, {"time": 18.06}),  # by other costs than are known
    ],
)
def test_without_terms_the_costs_tell(reward: float, terms: dict[Term, float]) -> None:
    """Ten seconds; 0.5 * 0.5 * 10 of jerk, 2 * 0.15 * 10 of turning, 10 * 0.005 * 10 of bends."""
    ends = {"stop": End(time=10.0, jerk=0.5, angular=0.15, curvature=0.005)}
    trace = decided(ends, plans=[("stop",)], costs=CHEAP)
    rows = (replace(trace.rollouts[0], reward=reward),)
    found = expected(replace(trace, rollouts=rows), "stop")
    assert found == {name: pytest.approx(cost) for name, cost in terms.items()}


def test_what_never_arrives_costs_an_end() -> None:
    ends = {"stop": End("termination"), "continue": End("dead"), "change-left": End("collision")}
    trace = decided(ends, costs=CHEAP)
    assert expected(trace, "stop") == {"late": pytest.approx(98.0), "effort": 2.0}
    assert expected(trace, "continue") == {"dead": 100.0}
    assert expected(trace, "change-left") == {"collision": 200.0}


# What is told ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("terms", "error", "verdict"),
    [
        ({"time": 0.25}, 0.0, "better"),
        ({"time": 0.24}, 0.0, "close"),
        ({"time": -0.25}, 0.0, "worse"),
        ({"time": 3.0, "jerk": -2.0}, 0.9, "better"),
        ({"time": 3.0, "jerk": -2.0}, 1.1, "close"),
        ({"time": -3.0, "jerk": 1.0}, 1.1, "close"),
        ({"time": -3.0, "jerk": 1.0}, 0.9, "worse"),
    ],
)
def test_the_verdict(terms: dict[Term, float], error: float, verdict: str) -> None:
    assert Difference(terms, error).verdict == verdict


@pytest.mark.parametrize(
    ("terms", "risk", "said"),
    [
        ({"time": 3.0, "jerk": 1.0}, 0.0, ["time"]),
        ({"time": 3.0, "late": 5.0}, 0.0, ["late"]),
        ({"time": 3.0, "jerk": -1.0}, 0.0, ["time", "jerk"]),
        ({"time": 3.0, "jerk": -0.2}, 0.0, ["time"]),
        ({"time": 3.0, "effort": -1.0}, 0.0, ["time"]),
        ({"jerk": 3.0, "time": 0.3}, 0.0, ["jerk", "time"]),
        ({"jerk": 3.0, "time": 0.2}, 0.0, ["jerk"]),
        ({"jerk": 3.0, "effort": 1.0}, 0.0, ["jerk"]),
        ({"effort": 3.0, "time": 1.0}, 0.0, ["effort"]),
        ({"time": 2.0, "late": 1.5, "jerk": -3.0}, 0.0, ["time", "late", "jerk"]),
        ({"time": 5.0, "collision": 1.0}, 0.02, ["time", "collision"]),
        ({"time": 5.0, "collision": -1.0}, 0.02, ["time", "collision"]),
        ({"time": 5.0, "collision": -0.1}, 0.02, ["time", "collision"]),
        ({"time": 5.0, "collision": 1.0}, 0.009, ["time"]),
        ({"time": 5.0, "collision": 1.0}, 0.011, ["time", "collision"]),
        ({"curvature": 2.0, "angular-acceleration": 3.0}, 0.0,
         ["angular-acceleration", "curvature"]),
        ({"curvature": 2.0, "angular-acceleration": 3.0, "time": 4.0}, 0.0,
         ["angular-acceleration", "curvature", "time"]),
        ({"time": -3.0, "jerk": 1.0}, 0.0, ["time", "jerk"]),  # the foil is better
        ({"time": 0.4, "jerk": -0.3}, 0.0, ["time", "jerk"]),  # close
        ({"time": 0.2}, 0.0, []),
        ({"time": 0.4, "jerk": -0.2, "effort": -0.1}, 0.0, ["time"]),
    ],
)  # fmt: skip
def test_which_terms_are_told(terms: dict[Term, float], risk: float, said: list[str]) -> None:
    found = Difference(terms, 0.0, {"collision": (risk, 0.0)})
    assert [share.term for share in told(found)] == said
    other_way = Difference(terms, 0.0, {"collision": (0.0, risk)})
    assert [share.term for share in told(other_way)] == said
