"""The judge: what it learns, and that the shipped one is learnt from the questions here."""

import math
from pathlib import Path

import pytest

from tests.language.annotated import HERE, LEARN, lines, names
from xavi_dialogue.app.learn import Example, digest_of, examples, learn
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.features import features
from xavi_dialogue.language.judge import Judge, Weights, judge
from xavi_dialogue.language.kinds import LEAN, WHICH, kind_of, reason_in
from xavi_dialogue.language.lattice import build
from xavi_dialogue.language.normalise import normalise
from xavi_dialogue.language.words import hear


def seen(text: str, *, follows: bool = False) -> frozenset[str]:
    heard = hear(normalise(text), frozenset(range(6)))
    return features(build(heard.words), heard, follows=follows)


def files() -> list[Path]:
    return [HERE / name for name in names(LEARN)]


def test_the_shipped_judge_is_learnt_from_these_questions() -> None:
    assert judge().weights.learnt_from == digest_of(files()), "run `make judge`"


def test_probabilities_add_up_to_one() -> None:
    found = judge().log_probabilities(seen("Why did you stop?"))
    assert sum(map(math.exp, found.values())) == pytest.approx(1.0)
    assert max(found, key=lambda kind: found[kind]) == "why"


def test_nothing_known_is_judged_by_no_weight() -> None:
    found = judge().log_probabilities(frozenset({"nothing like it"}))
    assert len(set(found.values())) == 1


def test_what_is_taught_is_learnt_and_the_rest_left_open() -> None:
    taught = [Example(frozenset({"a", "x"}), "why"), Example(frozenset({"b", "x"}), "what")] * 3
    learnt = Judge(learn(taught))
    one = learnt.log_probabilities(frozenset({"a"}))
    other = learnt.log_probabilities(frozenset({"x"}))
    assert math.exp(one["why"]) > 0.9
    assert math.exp(other["why"]) == pytest.approx(0.5, abs=0.05)
    assert learnt.telling(frozenset({"a", "x"}), "why")[0] == "a"


def test_learning_twice_is_learning_the_same() -> None:
    taught = examples(lines("learn/own.jsonl"))
    first, again = learn(taught), learn(list(taught))
    assert first == again
    assert isinstance(first, Weights)


def test_actions_and_directions_look_alike_to_the_judge() -> None:
    one, other = seen("why did you turn left"), seen("why did you overtake")
    assert {f for f in one if f.startswith("asks")} == {f for f in other if f.startswith("asks")}
    assert "t EGO ACT" in one
    assert "t EGO ACT" in other


def test_tags_are_taken_off_and_noted() -> None:
    heard = hear(normalise("You are slowing down, aren't you?"), frozenset())
    assert heard.tagged
    assert heard.words[-1] == "down"
    assert not hear(normalise("Why aren't you?"), frozenset()).tagged


BEFORE = Query(type="why", actor="vehicle:1", factual=("stop",))


@pytest.mark.parametrize(
    ("query", "previous", "kind"),
    [
        (Query(type="why"), None, "why"),
        (Query(type="out_of_scope", reason="blame"), None, "out_of_scope:blame"),
        (Query(type="why", detail="more"), BEFORE, "more"),
        (Query(type="what", actor="vehicle:unknown"), BEFORE, WHICH),
        (
            Query(type="why", actor="vehicle:2", factual=("stop",), refers_to_previous=True),
            BEFORE,
            LEAN,
        ),
        (Query(type="when", actor="vehicle:1", refers_to_previous=True), BEFORE, "when"),
    ],
)
def test_kinds(query: Query, previous: Query | None, kind: str) -> None:
    assert kind_of(query, previous) == kind
    assert reason_in(kind) == query.reason
