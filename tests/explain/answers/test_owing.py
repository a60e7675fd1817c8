"""Why somebody has right of way: the rule and on what it rests, whatever way it is asked."""

from typing import Any

import pytest

from tests.explain.answers.stated import scene
from xavi_dialogue.domain.answers import Priority
from xavi_dialogue.domain.meaning import HowKnow, Why
from xavi_dialogue.domain.terms import At, Ego, Not, Related, Vehicle, Wanted
from xavi_dialogue.explain.answers import causal, owing
from xavi_dialogue.explain.answers.reference.moments import Window

US, IT = Ego(), Vehicle(1)


@pytest.mark.parametrize("kind", [HowKnow, Why])
@pytest.mark.parametrize("relation", ["has-priority-over", "must-yield-to"])
@pytest.mark.parametrize("thing", [US, Wanted("vehicle")])
@pytest.mark.parametrize("basis", ["road", None])
def test_the_basis_of_a_rule_is_told_else_that_it_is_the_rule(
    monkeypatch: pytest.MonkeyPatch, kind: Any, relation: Any, thing: Any, basis: Any
) -> None:
    rule = Priority(20.0, "give-way", 1)
    asked: list[Any] = []

    def right_of_way(_: Any, *args: Any) -> Priority:
        asked.extend(args)
        return rule

    monkeypatch.setattr(owing, "right_of_way", right_of_way)
    with_basis = Priority(20.0, "give-way", 1, why=basis)
    monkeypatch.setattr(owing, "reason", lambda _, told: with_basis if told is rule else None)
    question = kind(Related(relation, thing, IT, time=At(5.0)))
    explainer = causal.explainer(question, scene())
    assert explainer is not None
    told = explainer(question, scene())
    assert told == Priority(20.0, "give-way", 1, why=basis, grounds=basis is None)
    assert asked == [thing, IT, Window(5.0, 5.0, True)]


def test_only_right_of_way_is_such_a_rule() -> None:
    assert owing.is_rule(Not(Related("must-yield-to", US, IT)))
    assert not owing.is_rule(Related("behind", US, IT))
    assert not owing.is_rule(None)
