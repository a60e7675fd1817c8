"""How sure a plan and a choice are, and the options that were weighed."""

from collections.abc import Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace, TimedAction
from tests.explain.causes.decisions import decided, ride
from tests.explain.trust import ERROR, trusted
from tests.traces import Actions, Aim, End, Way
from xavi_dialogue.explain.causes.plans.certainty import at_least, of_choice, of_plan
from xavi_dialogue.explain.causes.plans.contrast import contrast
from xavi_dialogue.explain.causes.plans.natural import natural
from xavi_dialogue.explain.causes.plans.options import free, open_at, situations, weighed
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.history.ride import Ride

approx: Any = pytest.approx  # that compares within tuples, too

THREE: tuple[Actions, ...] = (("continue",), ("change-left", "continue"), ("stop", "continue"))


def plain(plan: Actions = (), **fields: object) -> PlanTrace:
    """Going on takes 12 s, moving left 10 s, stopping 15 s."""
    ends = {"continue": End(time=12.0), "change-left": End(time=10.0), "stop": End(time=15.0)}
    return decided(ends, plan=plan, **fields)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("share", "n", "low"), [(1.0, 12, 0.857), (1.0, 30, 0.938), (0.5, 20, 0.326), (0.0, 10, 0.0002)]
)
def test_a_bound_from_trials(share: float, n: int, low: float) -> None:
    """The 5 % point of Beta(k + 1/2, n - k + 1/2)."""
    assert at_least(share, n) == approx(low, abs=0.002)


def sure(bad: str, mass: float = 0.2) -> Ride:
    trace = decided(
        lambda _, chosen: End(bad) if chosen[1][1] == 1 else End(),  # type: ignore[arg-type]
        {1: (Aim("continue", 1.0, (Way(("continue",), 1.0 - mass), Way(("continue",), mass))),)},
        [("continue",)],
    )
    return ride(trace)


@pytest.mark.parametrize(
    ("bad", "good", "share"),
    [
        ("dead", 1, 0.8),
        ("collision", 1, 0.8),
        ("termination", 2, 1.0),  # who is late is still on the way
    ],
)
def test_how_sure_a_plan_goes_well(bad: str, good: int, share: float) -> None:
    whole = sure(bad)
    found = of_plan(whole, Premise(whole.latest, None))
    assert (found.about, found.good, found.situations) == ("plan", good, 2)
    told = trusted(share, "done") + trusted(0.0, "termination")
    assert found.share == approx(min(told, 0.99))  # there is always what nobody foresees
    assert found.low == approx((1.0 - ERROR) * min(share, 0.99))
    assert found.decided == 4.0


def beating(*gains: float, mass: Sequence[float] = (0.5, 0.3, 0.2)) -> PlanTrace:
    """Going on takes 10 s; moving left so much longer, by what the other vehicle does."""
    return decided(
        lambda plan, c: End(time=10.0 + (gains[c[1][1]] if plan[0] == "change-left" else 0.0)),
        {1: (Aim("continue", 1.0, tuple(Way(("continue",), p) for p in mass)),)},
        THREE[:2],
    )


@pytest.mark.parametrize(
    ("gains", "share", "good"),
    [
        ((1.0, 1.0, 1.0), 1.0, 3),
        ((1.0, -1.0, 1.0), 0.7, 2),
        ((1.0, 0.06, 0.04), 0.8, 2),  # what is hardly better is not
        ((-1.0, -1.0, -1.0), 0.0, 0),
    ],
)
def test_how_sure_a_choice_is_the_better_one(
    gains: tuple[float, ...], share: float, good: int
) -> None:
    trace = beating(*gains)
    found = of_choice(ride(trace), Premise(trace, None))
    assert found is not None
    assert (found.about, found.good, found.situations) == ("choice", good, 3)
    assert found.share == approx((1.0 - ERROR) * share + ERROR / 2.0)
    assert found.low == approx((1.0 - ERROR) * min(share, 0.99))
    assert found.contrast is not None
    assert found.contrast.foil == ("change-left",)


def test_choices_that_were_not_tried_alike_have_no_chance() -> None:
    trace = beating(1.0, 1.0, 1.0)
    left = tuple(r for r in trace.rollouts if r.actions[0].action != "change-left" or r.index == 3)
    part = replace(trace, rollouts=left)
    found = of_choice(ride(part), Premise(part, None))
    assert found is not None
    assert (found.situations, found.share, found.low) == (1, None, None)
    only = decided({"continue": End()}, plans=[("continue",)])
    assert of_choice(ride(only), Premise(only, None)) is None
    assert of_choice(ride(trace), Premise(trace, None, ("continue",))) is None


def test_one_situation_shows_no_chance() -> None:
    """Every guess came to the same one, however often it was drawn."""
    trace = decided({"continue": End(time=10.0), "change-left": End(time=12.0)}, plans=THREE[:2])
    trace = replace(trace, rollouts=trace.rollouts * 20)
    chosen = of_choice(ride(trace), Premise(trace, None))
    assert chosen is not None
    assert (chosen.good, chosen.situations, chosen.share, chosen.low) == (1, 1, None, None)
    assert chosen.evidence.distinct_samples == 1
    plan = of_plan(ride(trace), Premise(trace, None))
    assert (plan.good, plan.situations, plan.share, plan.low) == (1, 1, None, None)


@pytest.mark.parametrize(
    ("gains", "verdict"),
    [
        ((1.0, 1.0, 1.0), "better"),
        ((0.06, 0.06, 0.06), "close"),  # better in all situations, and hardly so
        ((-1.0, -1.0, -1.0), "worse"),
        ((-9.0, 1.0, 1.0), "worse"),
    ],
)
def test_how_sure_a_choice_is_agrees_with_its_reason(
    gains: tuple[float, ...], verdict: str
) -> None:
    trace = beating(*gains)
    whole, premise = ride(trace), Premise(trace, None)
    found = of_choice(whole, premise)
    assert found is not None
    assert found.contrast == natural(whole, trace)
    assert found.contrast.verdict == verdict
    named = of_choice(whole, premise, ("change-left",))
    assert named is not None
    assert named.contrast == contrast(whole, trace, ("change-left",))


def test_never_more_than_the_model_and_the_situations_bear() -> None:
    """Two of three situations, of 0.8, were tried both ways; both came out better."""
    trace = beating(1.0, 1.0, 1.0)
    part = replace(trace, rollouts=tuple(r for r in trace.rollouts if r.samples[0].trajectory < 2))
    found = of_choice(ride(part), Premise(part, None))
    assert found is not None
    assert (found.good, found.situations) == (2, 2)
    rest = 2.5 / 3.0  # of what was not tried, by Jeffreys' prior
    assert found.share == approx((1.0 - ERROR) * (0.8 + 0.2 * rest) + ERROR / 2.0)
    assert found.low == approx((1.0 - ERROR) * 0.8)


def test_options_are_weighed_as_the_planner_does() -> None:
    trace = plain()
    chosen = replace(trace, plan=(replace(trace.plan[0], value=-11.0),))
    rows = weighed(ride(chosen), Premise(chosen, None))
    assert [(r.action, r.chosen) for r in rows] == [
        ("change-left", False),
        ("continue", True),
        ("stop", False),
    ]
    left, going, stop = rows
    assert going.value == -11.0
    assert left.value == approx(-9.0)  # two seconds less
    assert (left.time, left.delta) == (approx(10.0), approx(-2.0))
    assert (going.time, going.delta) == (approx(12.0), None)
    assert (stop.outcome, stop.collision, stop.collided_with) == ("done", trusted(0.0), None)
    assert weighed(ride(chosen), Premise(chosen, None, ("continue",))) == ()
    assert (left.close, stop.close) == (False, False)
    ends = {"continue": End(time=12.0), "change-left": End(time=12.1), "stop": End(time=15.0)}
    even = decided(ends)
    rows = weighed(ride(even), Premise(even, None))
    assert [(r.action, r.close) for r in rows] == [
        ("continue", False),
        ("change-left", True),  # a tenth of a second tells nothing apart
        ("stop", False),
    ]
    deep = weighed(ride(trace), Premise(plain(("change-left", "continue")), None, ("change-left",)))
    assert [r.action for r in deep] == ["continue"]
    assert deep[0].value == approx(-10.5)


def test_an_option_that_crashes() -> None:
    ends = {
        "continue": End(),
        "change-left": End("collision", collided_with=1),
        "stop": End("dead"),
    }
    trace = decided(ends)
    rows = {r.action: r for r in weighed(ride(trace), Premise(trace, None))}
    left = rows["change-left"]
    assert (left.collision, left.collided_with) == (approx(trusted(1.0)), 1)
    assert (rows["change-left"].time, rows["change-left"].delta) == (None, None)
    assert (rows["stop"].outcome, rows["stop"].probability) == ("dead", 1.0)


def test_within_a_manoeuvre_the_decision_before_counts() -> None:
    first, second = plain(), replace(plain(), sim_time=5.0)
    busy = replace(plain(), sim_time=6.0, under_way=TimedAction("change-left", 5.5))
    whole = ride(first, second, busy)
    assert free(whole, Premise(busy, None)).trace is second
    assert free(whole, Premise(first, None)).trace is first
    alone = Premise(busy, None)
    assert free(ride(busy), alone) is alone
    doubled = replace(first, rollouts=first.rollouts * 2)
    found = situations(Premise(doubled, None))
    assert (found.rollouts, found.distinct_samples, found.traces) == (3, 1, (doubled.trace_id,))


def test_what_leads_off_the_way_is_no_rival() -> None:
    """Turning left is a dead end; the choice was between turning right and stopping."""
    ends = {"exit-right": End(time=12.0), "exit-left": End("dead"), "stop": End(time=15.0)}
    plans: tuple[Actions, ...] = (("exit-right",), ("exit-left",), ("stop", "exit-right"))
    several = {1: (Aim("continue", 1.0, tuple(Way(("continue",), p) for p in (0.5, 0.3, 0.2))),)}
    trace = decided(ends, several, plans, plan=("exit-right",))
    found = of_choice(ride(trace), Premise(trace, None))
    assert found is not None
    assert found.contrast is not None
    assert found.contrast.foil == ("stop",)
    lost = decided(ends, several, plans[:2], plan=("exit-right",))
    assert of_choice(ride(lost), Premise(lost, None)) is None
    named = of_choice(ride(trace), Premise(trace, None), ("exit-left",))
    assert named is not None
    assert named.contrast is not None
    assert named.contrast.foil == ("exit-left",)


def test_the_last_decision_with_more_than_one_option_counts() -> None:
    first, second = plain(), replace(plain(), sim_time=5.0)
    only = replace(decided({"continue": End()}, plans=[("continue",)]), sim_time=6.0)
    whole = ride(first, second, only)
    assert open_at(whole, Premise(only, None)).trace is second
    assert open_at(whole, Premise(first, None)).trace is first
    assert open_at(ride(only), Premise(only, None)).trace is only
