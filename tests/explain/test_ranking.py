"""Safer, or smoother: answered by the measure that the question names."""

from dataclasses import replace

import pytest
from msgspec.structs import replace as changed

from planner.trace import PlanTrace
from tests.explain.asking import told
from tests.traces import Ride, s1_ride
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.parse import Parser
from xavi_dialogue.language.realise import realise

S1 = s1_ride()
SLOWS = tuple(12.0 - 1.0 * min(k, 10) for k in range(30))  # 5 m/s2 at 5 Hz


def asked(measure: str) -> Query:
    """Whether staying in lane would have been better, by a measure."""
    return Query(
        type="compare",
        factual=("change-left",),
        counterfactual=("continue",),
        tense="past",
        event=measure,
    )


def said(ride: Ride, measure: str) -> tuple[Explanation, str]:
    query = asked(measure)
    found = told(query, Record(ride.now, ride.traces, ride.events))
    assert isinstance(found, Explanation)
    return found, realise(query, found, SpeechContext()).text


def braking(trace: PlanTrace) -> PlanTrace:
    """The trace with drives that brake hard wherever the ego goes on in its lane."""
    drives = tuple(
        changed(
            one,
            path=tuple((float(k), 0.0) for k in range(30)),
            speed=SLOWS if one.actions[0].action == "continue" else (10.0,) * 30,
        )
        for one in trace.rollouts
    )
    return changed(trace, rollouts=drives)


def test_where_nothing_collides_both_are_as_safe() -> None:
    found, text = said(S1, "safer")
    assert found.ranking is not None
    assert (found.ranking.collision, found.ranking.foil_collision) == (0.0, 0.0)
    assert text == (
        "Staying in my lane would have been just as safe: I foresaw no collision either way."
    )


def test_the_chances_of_a_collision_are_compared() -> None:
    found, text = said(s1_ride(cut_in_collides=True), "safer")
    assert found.ranking is not None
    assert found.ranking.collision == 0.0
    assert found.ranking.foil_collision == pytest.approx(0.8)
    assert text == (
        "Staying in my lane would have been less safe: in my simulations, the chance of a "
        "collision is 80 % instead of under 5 %."
    )


def test_hard_braking_tells_where_nothing_collides() -> None:
    ride = replace(S1, traces=tuple(map(braking, S1.traces)))
    found, text = said(ride, "safer")
    assert found.ranking is not None
    assert (found.ranking.hard_brake, found.ranking.foil_hard_brake) == (0.0, pytest.approx(1.0))
    assert text == (
        "Staying in my lane would have been less safe: I foresaw no collision either way. The "
        "chance of having to brake hard is over 95 % instead of under 5 %."
    )


def test_a_smoother_ride_is_told_by_its_jerk_and_what_it_costs() -> None:
    found, text = said(S1, "smoother")
    jerk = next(effect for effect in found.effects if effect.component == "jerk")
    assert jerk.delta > 0.0
    assert text.startswith("Staying in my lane would have been rougher, and would have got us ")


def test_a_way_that_leads_elsewhere_is_told_as_such() -> None:
    query = changed(asked("smoother"), counterfactual=("exit-right",))
    found = told(query, Record(S1.now, S1.traces, S1.events))
    assert isinstance(found, Explanation)
    assert "not have taken us" in realise(query, found, SpeechContext()).text


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("Was changing left safer than staying in lane?", "safer"),
        ("Would stopping have been more dangerous?", "safer"),
        ("Would stopping have been smoother?", "smoother"),
        ("Would it have been more comfortable to stop?", "smoother"),
        ("Would stopping have been quicker?", "quicker"),
        ("Would it have been better to stop?", None),
    ],
)
def test_the_measure_is_heard(question: str, measure: str | None) -> None:
    query = Parser().parse(question, vehicles=frozenset(range(3)))
    assert isinstance(query, Query)
    assert (query.type, query.event) == ("compare", measure)


def test_a_measure_that_the_contrast_tells_anyway_changes_nothing() -> None:
    assert said(S1, "quicker")[1] == said(S1, "better")[1]
