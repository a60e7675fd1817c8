"""An option of a decision has one chance of a collision, whatever answer tells it."""

import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace
from planner.record.trace_reading import fault_of
from tests.explain.answers.stated import scene
from tests.explain.causes.decisions import decided, ride
from tests.explain.trust import trusted
from tests.traces import Actions, Aim, Chosen, End, Way
from xavi_dialogue.explain.answers.expectations.foreseen import collision_chance
from xavi_dialogue.explain.causes.plans.certainty import of_plan
from xavi_dialogue.explain.causes.plans.contrast import alone, compare, sides
from xavi_dialogue.explain.causes.plans.contrast import decided as plan_of
from xavi_dialogue.explain.causes.plans.options import of_trace, weighed
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.causes.plans.terms import differences

BOTH: tuple[Actions, ...] = (("continue",), ("change-left",))
SHARES = (0.4, 0.3, 0.2, 0.1)


def uneven(plan: Actions = ()) -> PlanTrace:
    """Moving left was tried in three situations of four, and strikes vehicle 1 in one of them.

    By their priors, as both were tried in them, that is 0.2 / 0.9; by what the foil stands for
    in all, it is another number. Going on strikes nobody.
    """

    def ends(plan: Actions, chosen: Chosen) -> End:
        hit = plan[0] == "change-left" and chosen[1][1] == 2
        return End("collision", collided_with=1) if hit else End(time=12.0)

    aims = {1: (Aim("continue", 1.0, tuple(Way(("continue",), p) for p in SHARES)),)}
    trace = decided(ends, aims, (("continue",), ("change-left", "continue")), plan=plan)
    kept = [
        r
        for r in trace.rollouts
        if r.actions[0].action == "continue" or r.samples[0].trajectory != 3
    ]
    often = [r for r in kept if r.samples[0].trajectory == 0] * 3  # the search drew it again
    return replace(trace, rollouts=(*kept, *often))


def test_every_answer_tells_the_same_chance_of_an_option() -> None:
    trace = uneven()
    whole, premise = ride(trace), Premise(trace, None)
    model = whole.model(trace)
    here, there = plan_of(whole, model), model.intervene(("change-left",))
    assert there is not None
    chance = trusted(there.outcomes["collision"])
    assert there.outcomes["collision"] != pytest.approx(0.2 / 0.9, abs=1e-3)
    told = sides(whole, model, here, there, ("change-left",))
    share = differences(model, there, here).share("collision")
    listed = {o.action: o for o in of_trace(whole, trace)}
    valued = {o.action: o for o in weighed(whole, premise)}
    assert told.collision == pytest.approx(chance)
    assert share.chance == pytest.approx(chance)
    for options in (listed, valued):
        assert options["change-left"].collision == pytest.approx(chance)
        assert options["continue"].collision == pytest.approx(trusted(0.0))
    own = collision_chance(scene(traces=[trace]), trace.sim_time)
    assert told.fact_collision == pytest.approx(own)
    assert alone(whole, model, here).fact_collision == pytest.approx(own)
    well = 1.0 - own - here.outcomes["dead"] - trusted(0.0, "dead")
    assert of_plan(whole, premise).share == pytest.approx(min(well, 0.99))  # never quite certain


def test_how_sure_a_risky_plan_is_tells_the_same_chance() -> None:
    trace = uneven(("change-left", "continue"))
    whole = ride(trace)
    here = plan_of(whole, whole.model(trace))
    own = collision_chance(scene(traces=[trace]), trace.sim_time)
    assert own == pytest.approx(trusted(here.outcomes["collision"]))
    assert own > 0.1
    well = sum(trusted(here.outcomes[o], o) for o in ("done", "termination"))
    assert of_plan(whole, Premise(trace, None)).share == pytest.approx(well)
    rounded = 1e-4  # as the shares of outcomes are in the table
    rest = 1.0 - own - here.outcomes["dead"] - trusted(0.0, "dead")
    assert well == pytest.approx(rest, abs=rounded)


@pytest.mark.parametrize("wrong", [float("nan"), float("inf"), -float("inf"), 1e9])
@pytest.mark.parametrize("where", ["time", "term", "reward"])
def test_a_figure_that_is_none_is_no_record(wrong: float, where: str) -> None:
    """Else a difference of rewards is none either, and no verdict agrees with its terms."""
    trace = decided({"continue": End(), "change-left": End()}, plans=BOTH)
    first = trace.rollouts[0]
    changes = {
        "time": {"components": {**first.components, "time": wrong}},
        "term": {"terms": {"time": wrong}},
        "reward": {"reward": wrong},
    }
    bad = replace(trace, rollouts=(replace(first, **changes[where]), *trace.rollouts[1:]))
    assert fault_of(trace) is None
    assert fault_of(bad) is not None


def test_a_drive_with_no_time_is_compared_without_one() -> None:
    """What is absent is None: it arrives, and when is not known."""
    trace = decided(
        {"continue": End(), "change-left": End()}, plans=(("continue",), ("change-left",))
    )
    rows = [
        replace(r, components=dict.fromkeys(r.components, None))
        if r.actions[0].action == "change-left"
        else r
        for r in trace.rollouts
    ]
    bare = replace(trace, rollouts=tuple(rows))
    whole = ride(bare)
    model = whole.model(bare)
    here, there = plan_of(whole, model), model.intervene(("change-left",))
    assert there is not None
    found = compare(whole, model, here, there, ("change-left",))
    assert all(effect.component != "time" for effect in found.effects)
    assert found.likely is None
