"""What is known of the time of a plan that does not arrive while it is simulated."""

import pytest

from tests.explain.causes.decisions import decided, ride
from tests.traces import End
from xavi_dialogue.domain.answers import Contrast
from xavi_dialogue.explain.answers.suppositions.deciding import _better
from xavi_dialogue.explain.causes.plans.contrast import contrast


def against(going: End, stopping: End) -> Contrast:
    """Going on, as planned, against stopping."""
    trace = decided({"continue": going, "stop": stopping}, plans=(("continue",), ("stop",)))
    return contrast(ride(trace), trace, ("stop",))


LATE = End("termination")
IN_TIME = End(time=18.0)


@pytest.mark.parametrize(
    ("fact", "foil", "late", "spares", "exceeds", "timed"),
    [
        (IN_TIME, LATE, True, False, 12.0, False),
        (LATE, IN_TIME, False, True, 12.0, False),
        (LATE, LATE, True, False, None, False),
        (IN_TIME, End(time=20.0), False, False, None, True),
        (IN_TIME, End("dead"), False, False, None, False),
    ],
)
def test_of_what_is_late_only_a_bound_of_its_time_is_told(
    fact: End, foil: End, late: bool, spares: bool, exceeds: float | None, timed: bool
) -> None:
    found = against(fact, foil)
    assert found.horizon == 30.0
    assert (found.late, found.spares_delay) == (late, spares)
    assert found.exceeds == (None if exceeds is None else pytest.approx(exceeds))
    assert any(effect.component == "time" for effect in found.effects) is timed


@pytest.mark.parametrize(
    ("fact", "foil", "better"),
    [
        (IN_TIME, LATE, "first"),
        (LATE, IN_TIME, "second"),
        (LATE, LATE, "unknown"),
        (IN_TIME, End(time=20.0), "first"),
    ],
)
def test_who_arrives_is_the_quicker_and_of_two_that_do_not_none_is_known_to_be(
    fact: End, foil: End, better: str
) -> None:
    assert _better("time", against(fact, foil), swapped=False) == better
