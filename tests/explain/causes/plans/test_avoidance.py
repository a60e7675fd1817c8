"""Which option would have avoided a mishap, or that none would."""

from collections.abc import Mapping, Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Told
from planner.record.trace import PlanTrace
from tests.explain.causes.decisions import decided, ride, steady
from tests.explain.trust import trusted
from tests.traces import Actions, Aim, Chosen, End, Way
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.plans.avoidance import avoiding, crashed, impact_of
from xavi_dialogue.explain.history.ride import Ride, Unanswered

approx: Any = pytest.approx  # that compares within tuples, too

THREE: tuple[Actions, ...] = (("continue",), ("change-left", "continue"), ("stop", "continue"))


def chance(*parts: float) -> Mapping[int, tuple[Aim, ...]]:
    """What the first vehicle may do, so probable each."""
    return {
        1: tuple(Aim("continue", p, (Way(("continue",)),), str(k)) for k, p in enumerate(parts))
    }


def refusal(work: object) -> object:
    with pytest.raises(Unanswered) as refused:
        work()  # type: ignore[operator]
    return refused.value.result


def plain(plan: Actions = (), **fields: object) -> PlanTrace:
    """Going on takes 12 s, moving left 10 s, stopping 15 s."""
    ends = {"continue": End(time=12.0), "change-left": End(time=10.0), "stop": End(time=15.0)}
    return decided(ends, plan=plan, **fields)  # type: ignore[arg-type]


def risky(*chances: tuple[float, float], times: Sequence[float] = (4.0,)) -> Ride:
    """Decisions of which going on and moving left crash so often."""
    traces = []
    for time, (going, left) in zip(times, chances, strict=True):
        aims = chance(min(going, left), abs(going - left), 1.0 - max(going, left))

        def ends(plan: Actions, chosen: Chosen, going: float = going, left: float = left) -> End:
            return End()

        trace = decided(ends, aims, THREE[:2], time=time)
        rows = []
        for row in trace.rollouts:
            k = row.samples[0].goal
            mine, other = (going, left) if row.actions[0].action == "continue" else (left, going)
            crashes = k == 0 or (k == 1 and mine > other)
            rows.append(
                replace(row, outcome="collision", collided_with=1, reward=-200.0)
                if crashes
                else row
            )
        traces.append(replace(trace, rollouts=tuple(rows)))
    return ride(*traces, events=(Told("collided", 9.0, vehicle=1),), now=9.0)


@pytest.mark.parametrize(
    ("going", "left", "possible"),
    [
        (0.6, 0.05, True),
        (0.29, 0.05, False),  # hardly rarer
        (0.6, 0.3, False),  # not seldom
        (0.9, 0.5, False),
    ],
)
def test_an_option_that_seldom_has_it_avoids_it(going: float, left: float, possible: bool) -> None:
    found = avoiding(risky((going, left)), "collide", 9.0)
    assert found.mishap == "collide"
    assert found.happened
    assert (found.decisions, found.options) == (1, 1)
    assert (found.risk, found.other) == (approx(trusted(going)), approx(trusted(left)))
    assert found.contrast is not None
    assert found.contrast.foil == ("change-left",)
    assert found.possible is possible


def test_the_decisions_of_ten_seconds_count() -> None:
    late = avoiding(risky((0.6, 0.0), (0.7, 0.0), times=(4.0, 6.0)), "collide", 9.0)
    assert (late.decisions, late.options) == (2, 2)
    assert (late.risk, late.other) == (approx(trusted(0.7)), approx(trusted(0.0)))
    early = avoiding(risky((0.6, 0.0), (0.7, 0.0), times=(4.0, 6.0)), "collide", 14.5)
    assert early.decisions == 1
    missing = refusal(lambda: avoiding(risky((0.6, 0.0)), "collide", 14.5))
    assert missing == NotRecorded("gap-in-record", since=4.5, until=14.5)
    assert refusal(lambda: avoiding(risky((0.6, 0.0)), "collide", 4.0)) is not None


def test_without_options_nothing_could_be_done() -> None:
    trace = decided({"continue": End("collision", collided_with=1)}, plans=[("continue",)])
    found = avoiding(ride(trace, now=9.0), "collide", 9.0)
    assert (found.possible, found.options, found.decisions) == (False, 0, 1)
    assert found.happened
    assert (found.risk, found.other) == (approx(trusted(1.0)), approx(trusted(1.0)))
    assert found.contrast is not None
    assert found.contrast.foil == ()


def test_the_crash_itself() -> None:
    whole = risky((0.6, 0.0))
    crash = crashed(whole)
    assert crash is not None
    impact = impact_of(crash)
    assert (impact.actor, impact.action, impact.begin, impact.object) == (
        Ego(),
        "collide",
        9.0,
        Vehicle(1),
    )
    assert impact_of(Told("collided", 3.0)).object is None
    assert crashed(ride(plain())) is None


SLOW, FAST = steady(*([10.0] * 3 + [8.0, 6.0, 4.0, 2.0] + [0.0] * 12)), steady(*[10.0] * 20)


GENTLE = steady(*[10.0 - 0.3 * k for k in range(20)])


@pytest.mark.parametrize(
    ("mishap", "going", "left", "possible"),
    [
        ("stop", SLOW, FAST, True),
        ("stop", SLOW, SLOW, False),
        ("brake", SLOW, GENTLE, True),  # 10 m/s2 against 1.5
        ("brake", GENTLE, FAST, False),
        ("slow-down", GENTLE, FAST, True),
        ("stop", GENTLE, FAST, False),
    ],
)
def test_a_way_of_driving_may_be_avoided(
    mishap: ActionName, going: object, left: object, possible: bool
) -> None:
    ends = {"continue": End(time=12.0), "change-left": End(time=12.5), "stop": End(time=30.0)}
    lines = {"continue": going, "change-left": left, "stop": SLOW}
    trace = decided(ends, lines=lines)  # type: ignore[arg-type]
    found = avoiding(ride(trace, now=6.0), mishap, 6.0)
    assert found.possible is possible
    assert found.options == 2
