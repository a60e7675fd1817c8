"""Whom we owe way to, and who is in our way before others, stay reasons after planning again."""

from msgspec.structs import replace

from planner.record.places import PriorityFact
from tests.explain.causes.rides import recorded
from xavi_dialogue.domain.answers import Cause, Mechanism
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.explain.causes.driving.yielding import kept
from xavi_dialogue.explain.causes.vehicles.necessity import Proven

NOBODY = Causation("none", (), (1, 2))
TRACE = next(t for t in recorded("s1-0").traces if t.road is not None)


def suspect(vehicle: int, how: str, *, present: bool = True) -> Cause:
    mechanism = Mechanism(how, None, None, 2.0, 1.0, present)  # type: ignore[arg-type]
    return Cause(vehicle, (), 1.0, mechanism)


def vehicles(found: Proven) -> list[int]:
    return [cause.vehicle for cause in found.causes]


def test_who_was_given_way_to_is_the_reason_though_another_would_take_its_place() -> None:
    suspects = [suspect(1, "leader"), suspect(2, "right-of-way")]
    found = kept(Proven((), NOBODY), suspects, TRACE, 2)
    assert vehicles(found) == [2]
    assert found.causation == Causation("open", (), (1,))


def test_it_goes_before_one_that_is_necessary() -> None:
    tried = Proven((suspect(1, "leader"),), Causation("one", (1,), (2,)))
    found = kept(tried, [suspect(1, "leader"), suspect(2, "right-of-way")], TRACE, 2)
    assert vehicles(found) == [2, 1]
    assert found.causation == Causation("one", (1,), ())


def test_a_duty_that_the_rules_have_is_kept_and_another_is_not() -> None:
    assert TRACE.road is not None
    suspects = [suspect(1, "right-of-way"), suspect(2, "right-of-way")]
    rule = PriorityFact(2, "vehicle")
    trace = replace(TRACE, road=replace(TRACE.road, priority=(rule,)))
    assert vehicles(kept(Proven((), NOBODY), suspects, trace)) == [2]


def test_who_is_in_our_way_before_others_is_kept_and_who_makes_no_difference_is_not() -> None:
    suspects = [suspect(1, "leader"), suspect(2, "leader")]
    assert vehicles(kept(Proven((), NOBODY), suspects, TRACE)) == []
    assert vehicles(kept(Proven((), NOBODY, (2,)), suspects, TRACE)) == [2]


def test_who_is_yet_to_be_in_our_way_counts_only_where_the_road_tells_nothing() -> None:
    suspects = [suspect(1, "leader", present=False)]
    tried = Proven((), NOBODY, (1,))
    assert vehicles(kept(tried, suspects, TRACE)) == []
    assert vehicles(kept(tried, suspects, TRACE, alone=True)) == [1]
