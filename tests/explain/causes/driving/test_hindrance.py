"""Who is in the way of another vehicle, by what was predicted of it, and whom a foil blames."""

from collections.abc import Sequence
from typing import Any, get_args

import pytest
from msgspec.structs import replace

from planner.record.trace import HeldUp, HoldUp, PlanTrace
from tests.explain.causes.decisions import decided, ride
from tests.traces import Actions, Aim, Chosen, End, Way, straight_track
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain.answers import Cause, Mechanism, MotionCause
from xavi_dialogue.explain.causes.driving.hindrance import at_present, slowed, stood
from xavi_dialogue.explain.causes.plans.decisive_factor import weight
from xavi_dialogue.explain.causes.vehicles.involved import (
    contrastive_causes,
    expected_actions,
    holding_up,
    slowing,
)

approx: Any = pytest.approx  # that compares within tuples, too


def held(by: int, since: float = 4.0, until: float = 7.0, how: HoldUp = "leader") -> HeldUp:
    return HeldUp(by, since, until, how, 5.0, 2.0)


def predicted(*ways: tuple[float, Sequence[HeldUp]], time: float = 4.0, aims: int = 2) -> PlanTrace:
    """A decision that holds such ways of the first vehicle possible; the second goes straight."""
    known = {
        1: tuple(
            Aim("continue", p, (Way(("continue",), held_up=tuple(by)),), str(k))
            for k, (p, by) in enumerate(ways)
        ),
        2: (
            Aim("exit-left", 0.7, (Way(("exit-left",)),)),
            Aim("continue", 0.3, (Way(("continue",)),)),
        ),
    }
    chosen = {v: a for v, a in known.items() if v <= aims}
    return decided({"continue": End()}, chosen, [("continue",)], time=time)


def blamed(found: tuple[MotionCause, ...]) -> list[tuple[object, ...]]:
    return [(c.kind, c.vehicle, c.actions, c.probability) for c in found]


@pytest.mark.parametrize(
    ("ways", "told"),
    [
        ([(0.6, [held(2)]), (0.4, [])], [("leader", 2, ("exit-left",), 0.6)]),
        ([(0.4, [held(2)]), (0.6, [])], []),
        ([(1.0, [held(0)])], [("leader", 0, ("continue",), 1.0)]),
        ([(1.0, [held(9)])], [("leader", 9, (), 1.0)]),
        ([(1.0, [held(2, 4.0, 4.5)])], [("leader", 2, ("exit-left",), 1.0)]),
        ([(1.0, [held(2, 4.0, 4.4)])], []),  # too short
        ([(1.0, [held(2, 6.9, 9.0)])], [("leader", 2, ("exit-left",), 1.0)]),
        ([(1.0, [held(2, 7.1, 9.0)])], []),  # after it slowed down
        ([(1.0, [held(2, 0.0, 3.1)])], [("leader", 2, ("exit-left",), 1.0)]),
        ([(1.0, [held(2, 0.0, 2.9)])], []),
        (
            [(1.0, [held(2, how="cut-in"), held(2, 4.0, 6.0)])],
            [("cut-in", 2, ("exit-left",), 1.0)],
        ),
        (  # by turns, of whom none is probable alone: the more probable
            [(0.3, [held(2)]), (0.4, [held(9)]), (0.3, [])],
            [("leader", 9, (), 0.4)],
        ),
        (
            [(0.5, [held(2, 4.0, 5.0), held(9)]), (0.5, [held(9), held(2, 4.0, 5.0)])],
            [("leader", 9, (), 1.0), ("leader", 2, ("exit-left",), 1.0)],  # longest first
        ),
    ],
)
def test_who_made_somebody_slow_down(
    ways: list[tuple[float, Sequence[HeldUp]]], told: list[tuple[object, ...]]
) -> None:
    """From 4 to 6 s; a second more on either side counts."""
    found = slowed(ride(predicted(*ways)), 1, 4.0, 6.0)
    assert blamed(found.causes) == [(*one[:3], approx(one[3])) for one in told]


def test_all_decisions_meanwhile_tell() -> None:
    before, first, then = (
        predicted((1.0, [held(9)]), time=3.0),
        predicted((1.0, [held(2)]), time=4.0),
        predicted((0.2, [held(2)]), (0.8, []), time=5.0),
    )
    whole = ride(before, first, then)
    found = slowed(whole, 1, 4.0, 5.0)
    assert blamed(found.causes) == [("leader", 2, ("exit-left",), approx(0.6))]
    assert found.evidence.traces == (first.trace_id, then.trace_id)
    assert slowed(whole, 1, 3.2, 3.6).traces == (before.trace_id,)  # the nearest
    assert slowed(whole, 7, 4.0, 5.0).causes == ()


def test_who_made_somebody_stand() -> None:
    first, then = (
        predicted((1.0, [held(9)]), time=4.0),
        predicted((0.4, [held(2)]), (0.6, []), time=7.0),
    )
    whole = ride(first, then, now=12.0)
    assert [c.vehicle for c in stood(whole, 1, 4.9).causes] == [9]
    assert stood(whole, 1, 6.9).causes == ()
    assert [c.vehicle for c in stood(whole, 1, 6.9, 0.3).causes] == [2]
    assert stood(whole, 1, 2.4).traces == ()  # nothing is that near
    assert stood(whole, 1, 2.6).traces == (first.trace_id,)
    assert stood(whole, 7, 4.0).traces == ()


@pytest.mark.parametrize(
    ("speeds", "time", "known"),
    [
        ((9.0, 8.0, 7.0, 6.0, 5.0, 4.0), 4.0, True),
        ((0.0,) * 6, 4.0, True),
        ((9.0,) * 6, 4.0, False),
        ((4.0, 5.0, 6.0, 7.0, 8.0, 9.0), 4.0, False),
        ((0.0,) * 6, 5.4, True),
        ((0.0,) * 6, 5.6, False),
        ((0.0,) * 6, 3.9, False),
    ],
)
def test_only_who_is_seen_to_brake_or_stand_is_hindered(
    speeds: tuple[float, ...], time: float, known: bool
) -> None:
    trace = predicted((0.6, [held(2)]), (0.4, []))
    seen = replace(trace, history={**trace.history, 1: straight_track(4.0, 1, speeds)})
    found = at_present(ride(seen, now=6.0), 1, time)
    assert [c.vehicle for c in found.causes] == ([2] if known else [])
    if known:
        assert at_present(ride(seen, now=6.0), 1, time, 0.7).causes == ()
    assert at_present(ride(seen, now=6.0), 7, time).causes == ()


# Whom a foil blames ------------------------------------------------------------------------


def test_what_somebody_is_expected_to_do() -> None:
    """Two goals are reached by the same actions; they count together."""
    aims = {
        1: (
            Aim("continue", 0.5, (Way(("continue",), 0.8), Way(("stop",), 0.2))),
            Aim("continue", 0.3, (Way(("continue",)),)),
            Aim("stop", 0.2, (Way(("stop",)),)),
        )
    }
    model = CausalModel(decided({"continue": End()}, aims, [("continue",)]))
    assert expected_actions(model, 1, (0, 0)) == (("continue",), approx(0.7))
    assert expected_actions(model, 1, (0, 1)) == (("stop",), approx(0.3))
    assert expected_actions(model, 7, (0, 0)) == ((), 1.0)  # what it does is taken as given


@pytest.mark.parametrize(
    ("chance", "seconds", "told"),
    [(0.6, 3.0, True), (0.5, 3.0, True), (0.4, 3.0, False), (0.6, 0.9, True), (0.6, 0.8, False)],
)
def test_who_probably_holds_us_up(chance: float, seconds: float, told: bool) -> None:
    """In half of the drives at least, and for half a second in the mean."""
    aims = {
        1: (
            Aim("continue", chance, (Way(("continue",)),)),
            Aim("stop", 1 - chance, (Way(("stop",)),)),
        )
    }

    def ends(plan: Actions, chosen: Chosen) -> End:
        by = (held(1, 4.4, 4.4 + seconds),) if chosen[1][0] == "continue" else ()
        return End(held_up=by)

    model = CausalModel(decided(ends, aims, [("continue",)]))
    plan = model.intervene(("continue",))
    assert plan is not None
    found = holding_up(model, plan)
    assert [c.vehicle for c in found] == ([1] if told else [])
    assert holding_up(model, plan, (8.0, 9.0)) == ()
    if told:
        how = found[0].mechanism
        assert how is not None
        assert (how.how, how.speed_from, how.speed_to) == ("leader", 5.0, 2.0)
        assert (how.delay, how.share) == (approx(seconds), approx(chance))
        assert how.present
        assert (found[0].actions, found[0].probability) == (("continue",), approx(chance))


@pytest.mark.parametrize(
    ("how", "actions", "since", "told"),
    [
        ("leader", ("exit-left",), 4.4, ("leader", True)),
        ("leader", ("exit-left",), 4.6, ("leader", False)),
        ("cut-in", ("continue",), 4.0, ("leader", True)),  # who goes straight on does not cut in
        ("cut-in", ("exit-left",), 4.0, ("cut-in", True)),
        ("right-of-way", ("continue",), 4.0, ("right-of-way", True)),
    ],
)
def test_how_somebody_is_in_the_way(
    how: HoldUp, actions: Actions, since: float, told: tuple[str, bool]
) -> None:
    assert how in get_args(HoldUp)
    aims = {1: (Aim("continue", 1.0, (Way(actions),)),)}
    model = CausalModel(
        decided({"continue": End(held_up=(held(1, since, 9.0, how),))}, aims, [("continue",)])
    )
    plan = model.intervene(("continue",))
    assert plan is not None
    mechanism = holding_up(model, plan)[0].mechanism
    assert mechanism is not None
    assert (mechanism.how, mechanism.present) == told


def contrasted(foil: End, fact: End, also: tuple[Actions, ...] = ()) -> list[tuple[object, ...]]:
    """Whom moving left (the foil) blames, against going on."""
    trace = decided(
        {"change-left": foil, "continue": fact}, plans=[("continue",), ("change-left",), *also]
    )
    model = CausalModel(trace)
    there, here = model.intervene(("change-left",)), model.intervene(("continue",))
    assert there is not None
    assert here is not None
    found = contrastive_causes(model, there, here, effects(there, here))
    return [(c.vehicle, None if c.mechanism is None else c.mechanism.how) for c in found]


@pytest.mark.parametrize(
    ("foil", "fact", "told"),
    [
        (End("collision", collided_with=1), End(), [(1, "collision")]),
        (End("collision", collided_with=1), End("collision", collided_with=1), []),
        (End("collision", collided_with=0), End(), []),
        (End("dead", held_up=(held(1),)), End(), []),
        (End(time=10.6, held_up=(held(1),)), End(), [(1, "leader")]),
        (End(time=10.4, held_up=(held(1),)), End(), []),  # hardly slower
        (End(time=12.0, held_up=(held(1, 4.0, 4.4),)), End(), []),  # hardly held up
        (End(time=12.0, held_up=(held(1),)), End(held_up=(held(1),)), []),
        (End(time=12.0, held_up=(held(1, 4.0, 7.6),)), End(held_up=(held(1),)), [(1, "leader")]),
        (End("termination", held_up=(held(1),)), End(), [(1, "leader")]),
        (End("termination", held_up=(held(1),)), End("termination"), []),
    ],
)
def test_whom_a_foil_blames(foil: End, fact: End, told: list[tuple[object, ...]]) -> None:
    assert contrasted(foil, fact) == told


def test_who_is_at_work_under_a_foil() -> None:
    """The first is hit where it stops; both others hold us up, one of them longer."""
    aims = {
        1: (Aim("stop", 0.3, (Way(("stop",)),)), Aim("continue", 0.7, (Way(("continue",)),))),
        2: (Aim("continue", 1.0, (Way(("continue",)),)),),
        3: (Aim("continue", 1.0, (Way(("continue",)),)),),
    }

    def ends(plan: Actions, chosen: Chosen) -> End:
        if plan[0] == "continue":
            return End()
        by = (held(2, 4.0, 6.0), held(3))
        if chosen[1][0] == "stop":
            return End("collision", collided_with=1, held_up=by)
        return End(time=13.0, held_up=by)

    model = CausalModel(decided(ends, aims, [("continue",), ("change-left",)]))
    there, here = model.intervene(("change-left",)), model.intervene(("continue",))
    assert there is not None
    assert here is not None
    assert slowing(model, there, here) == (1, 3, 2)
    assert slowing(model, here, there) == ()
    found = contrastive_causes(model, there, here, effects(there, here))
    assert [c.vehicle for c in found] == [3, 2, 1]  # it probably arrives, late
    assert [c.mechanism.share for c in found if c.mechanism] == approx([1.0, 1.0, 0.3])
    assert found[2].actions == ("stop",)


def test_causes_are_ordered_by_collisions_delays_and_influence() -> None:
    struck, slow, other = contrast_causes()
    assert sorted([other, slow, struck], key=weight) == [struck, slow, other]
    assert weight(struck) == (0, -0.3)
    assert weight(slow) == (1, -1.0)
    assert weight(other) == (2, -0.25)
    assert weight(Cause(4, (), 1.0, None)) == (2, 0.0)


def contrast_causes() -> tuple[Cause, Cause, Cause]:
    return (
        Cause(1, (), 1.0, Mechanism("collision", None, None, None, 0.3)),
        Cause(2, (), 1.0, Mechanism("leader", 5.0, 2.0, 2.0, 0.5)),
        Cause(3, (), 1.0, None, 0.25),
    )
