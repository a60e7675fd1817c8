"""Parts of terms: what is found by the declared types is what is found by looking everywhere."""

from collections.abc import Iterator

import msgspec
import pytest

from tests.nlg.test_nlg_reach import CASES
from xavi_dialogue.domain import answers, facts, terms, traffic_lights
from xavi_dialogue.domain.rewriting import first, parts

SORTS = (
    (terms.Event,),
    (terms.Vehicle,),
    (terms.Vehicle, terms.Vehicles),
    (terms.At,),
    (facts.Episode,),
    (facts.Measure,),
    (answers.Evidence,),
    (answers.Contrast,),
    (answers.Cause,),
    (answers.MotionCause,),
    (traffic_lights.Shown,),
    (str,),
    (float, int),
)


def everywhere(value: object, sorts: tuple[type, ...]) -> Iterator[object]:
    """Yield the parts of some sorts, whatever the types of fields declare."""
    if isinstance(value, sorts):
        yield value
    if isinstance(value, tuple):
        for part in value:
            yield from everywhere(part, sorts)
    elif isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from everywhere(getattr(value, name), sorts)


@pytest.mark.parametrize("sorts", SORTS, ids=lambda sorts: sorts[0].__name__)
def test_no_part_is_missed(sorts: tuple[type, ...]) -> None:
    wanted = sorts if len(sorts) > 1 else sorts[0]
    found = [list(parts(case, wanted)) for case in CASES]
    assert found == [list(everywhere(case, sorts)) for case in CASES]
    assert any(found)


def test_the_first_part_is_the_outermost_and_leftmost() -> None:
    inner = terms.Event("brake", actor=terms.Vehicle(2))
    outer = terms.Event("turn", actor=terms.Vehicle(1), object=inner.actor)
    assert first((outer, inner), terms.Event) is outer
    assert first(outer, terms.Vehicle) == terms.Vehicle(1)
    assert first(outer, answers.Evidence) is None
