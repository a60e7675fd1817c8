"""Several courses are foreseen for one light only: the next on the way."""

import pytest

from planner.driving.monitoring import light_courses
from tests.planner import crossroads


@pytest.mark.parametrize(
    ("edges", "several"),
    [
        (("south_in", "north_out"), True),
        (("south_in",), True),  # the way ends before the light, whose queue may hold us up
        (("north_out",), False),
    ],
)
def test_the_next_light_has_several_courses(edges: tuple[str, ...], several: bool) -> None:
    seen = crossroads.watched((0.0, crossroads.NORTH_SOUTH))
    (known,) = light_courses(crossroads.crossroads(), (seen,), 2.0, 30.0, edges)
    assert (len(known.courses) > 1) == several
