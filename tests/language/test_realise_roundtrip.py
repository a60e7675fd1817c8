"""What the car suggests can be asked: the parser reads it as the query it was made from."""

import pytest

from planner.trace import ACTIONS
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.language.parse import Parser
from xavi_dialogue.language.questions import question

DESCRIPTIONS: tuple[QueryAction, ...] = ("give-way", "slow-down", "speed-up", "overtake")
ACTORS = ("ego", "vehicle:1")
PARSER = Parser()


def essence(query: Query) -> tuple[object, ...]:
    """What must survive; "straight" is one word for going on and for crossing straight on."""

    def straight(actions: tuple[QueryAction, ...] | None) -> tuple[str, ...]:
        return tuple("continue" if a == "exit-straight" else a for a in actions or ())

    foil = straight(query.counterfactual)
    return (query.type, query.actor, straight(query.factual), foil, query.negated)


def asked() -> list[Query]:
    queries = [
        Query(type="where_goal", tense="present"),
        Query(type="what", tense="future"),
        Query(type="where_goal", actor="vehicle:1", tense="present"),
        Query(type="what", actor="vehicle:1", tense="present"),
        Query(type="what_if", actor="vehicle:1", negated=True, intervention="remove"),
        Query(type="why", factual=("change-left",), counterfactual=("continue",)),
        Query(type="why", factual=("exit-right",), counterfactual=("exit-left",)),
    ]
    for actor in ACTORS:
        for action in (*ACTIONS, *DESCRIPTIONS):
            queries += [
                Query(type="why", actor=actor, factual=(action,)),
                Query(type="why_not", actor=actor, counterfactual=(action,)),
                Query(type="what_if", actor=actor, counterfactual=(action,)),
                Query(type="what_if", actor=actor, counterfactual=(action,), negated=True),
            ]
    return queries


@pytest.mark.parametrize("query", asked(), ids=question)
def test_questions_are_understood(query: Query) -> None:
    understood = PARSER.parse(question(query))
    assert isinstance(understood, Query)
    assert essence(understood) == essence(query)
    assert understood.intervention == query.intervention
