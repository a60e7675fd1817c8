"""What the car would do if another did otherwise, and how probably it drives so."""

import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace
from tests.explain.causes.decisions import decided, ride, steady
from tests.traces import Actions, Aim, Chosen, End, Way
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain.answers import NeedRollout, NotRecorded
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.suppositions import otherwise, share_of
from xavi_dialogue.explain.history.ride import Ride, Unanswered

SPLIT = {
    1: (
        Aim("exit-left", 0.3, (Way(("exit-left",)),)),
        Aim("continue", 0.7, (Way(("continue",)),)),
    )
}


THREE: tuple[Actions, ...] = (("continue",), ("change-left", "continue"), ("stop", "continue"))


def refusal(work: object) -> object:
    with pytest.raises(Unanswered) as refused:
        work()  # type: ignore[operator]
    return refused.value.result


def left_if(wins: str) -> PlanTrace:
    """Moving left is quicker only if the other one does so (30 %) or else (70 %)."""

    def ends(plan: Actions, chosen: Chosen) -> End:
        quick = chosen[1][0] == wins
        return End(time=(8.0 if quick else 20.0) if plan[0] == "change-left" else 12.0)

    return decided(ends, SPLIT, THREE[:2], plan=("continue",))


def refusing(trace: PlanTrace, *extra: PlanTrace) -> Ride:
    """A ride in which nothing more can be planned."""
    need = NeedRollout(trace_id=trace.trace_id, removed=1)
    return ride(trace, extra=extra, refused=() if extra else (need,))


SLOW, FAST = steady(*([10.0] * 3 + [8.0, 6.0, 4.0, 2.0] + [0.0] * 12)), steady(*[10.0] * 20)


def test_what_it_would_do_if_another_did_otherwise() -> None:
    trace = left_if("exit-left")
    whole = refusing(trace)
    turned = otherwise(whole, 1, ("exit-left",), 4.0, negated=False)
    assert (turned.there.plan[0], turned.same) == ("change-left", False)
    assert turned.prior == pytest.approx(0.3)
    stayed = otherwise(whole, 1, ("exit-left",), 4.0, negated=True)
    assert (stayed.there.plan[0], stayed.same) == ("continue", True)
    assert stayed.prior == pytest.approx(0.7)
    assert otherwise(whole, 1, ("change-right",), 4.0, negated=True).prior == pytest.approx(1.0)
    need = refusal(lambda: otherwise(whole, 1, ("exit-right",), 4.0, negated=False))
    assert need == NeedRollout(trace_id=trace.trace_id, vehicle=1, goal="exit-right")
    need = refusal(lambda: otherwise(whole, 1, ("change-left",), 4.0, negated=False))
    assert need == NeedRollout(trace_id=trace.trace_id, vehicle=1, vehicle_actions=("change-left",))
    gone = refusal(lambda: otherwise(whole, 7, ("exit-left",), 4.0, negated=False))
    assert gone == NotRecorded("out-of-view", thing=Vehicle(7), since=4.0)


@pytest.mark.parametrize(
    ("name", "share"),
    [("slow-down", 0.3), ("stop", 0.3), ("change-lane", 0.0), ("continue", 1.0), ("speed-up", 0.0)],
)
def test_how_probably_the_car_drives_so(name: ActionName, share: float) -> None:
    trace = decided({"continue": End()}, SPLIT, [("continue",)])
    rows = tuple(
        replace(r, path=line[0], speed=line[1])
        for r, line in zip(trace.rollouts, (SLOW, FAST), strict=True)
    )
    plan = CausalModel(replace(trace, rollouts=rows)).intervene(("continue",))
    assert plan is not None
    found = share_of(replace(trace, rollouts=rows), plan, name)
    assert found == pytest.approx(share)
    bare = tuple(replace(r, path=None) for r in rows)
    lost = share_of(replace(trace, rollouts=bare), plan, name)
    assert lost == (pytest.approx(share) if name in ("change-lane", "continue") else None)
