"""How vehicles are spoken of: truly, telling them apart, with the number at the first mention."""

from dataclasses import replace

import pytest

from tests.nlg.scenery import CONTEXT, LORRY, NOW, look
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Destination, Ego, Everyone, Lane, Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.clauses import episode_clause
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.morphology import clause
from xavi_dialogue.nlg.surface.referring import ReferringContext
from xavi_dialogue.nlg.surface.values import Clause, Who

V, W, X = Vehicle(1), Vehicle(2), Vehicle(3)


def said(*whos: Who, context: SpeechContext = CONTEXT, form: str = "plain") -> list[str]:
    speaker = ReferringContext(context)
    return [speaker.refer(who, form) for who in whos]


def test_the_first_mention_has_colour_kind_place_and_number():
    assert said(Who(V)) == ["the red lorry ahead of us on the left (vehicle 1)"]


def test_the_only_one_in_a_reply_is_it():
    assert said(Who(V), Who(V))[1] == "it"
    assert said(Who(V), Who(V), form="possessive")[1] == "its"


def test_with_two_in_a_reply_neither_is_it():
    assert said(Who(V), Who(W), Who(V), Who(W))[2:] == ["the red lorry", "vehicle 2"]


def test_later_mentions_are_short():
    named = replace(CONTEXT, named=frozenset({1, 3}))
    assert said(Who(V), context=named) == ["the red lorry"]
    assert said(Who(X), context=named) == ["the blue car (vehicle 3)"]


def test_what_was_elsewhere_is_described_by_where_it_was():
    assert said(Who(V, 5.0)) == ["the red lorry that was behind us (vehicle 1)"]


def test_what_is_out_of_sight_is_described_by_where_it_was_seen():
    assert said(Who(Vehicle(4))) == ["the bus that I saw last behind us (vehicle 4)"]


def test_what_was_never_seen_has_only_its_number():
    assert said(Who(Vehicle(77))) == ["vehicle 77"]


def test_a_place_that_the_sentence_tells_is_no_part_of_the_description():
    assert said(Who(V, placed=False)) == ["the red lorry (vehicle 1)"]


def test_several_are_listed_in_full():
    assert said(Who(Vehicles((1, 3)))) == [
        "the red lorry ahead of us on the left (vehicle 1) and the blue car behind us (vehicle 3)"
    ]


def test_we_are_spoken_of_by_what_we_do():
    assert said(Who(Ego()), Who(Ego(), ride=True)) == ["I", "we"]
    assert said(Who(Ego()), form="object") == ["us"]
    assert said(Who(Lane()), Who(Destination())) == ["our lane", "our destination"]


def test_an_article_fits_its_noun():
    orange = look(5, NOW, "emergency", None, "behind")
    context = SpeechContext(now=NOW, looks={(5, NOW): orange})
    assert said(Who(Vehicle(5), indefinite=True), context=context) == [
        "an emergency vehicle behind us (vehicle 5)"
    ]


def test_looks_may_come_from_a_function():
    context = SpeechContext(now=NOW, looks=lambda vehicle, time: LORRY)
    assert said(Who(V), context=context) == ["the red lorry ahead of us on the left (vehicle 1)"]


def test_a_clause_names_its_object_once():
    told = episode_clause(Episode(V, "cut-in", 19.5, 20.0, object=Ego()), NOW)
    words = clause(told, "plain", ReferringContext(CONTEXT))
    assert words == "the red lorry ahead of us on the left (vehicle 1) is cutting in ahead of us"


def test_somebody_on_foot_is_no_it():
    walks = look(5, NOW, "pedestrian", None, "ahead")
    context = SpeechContext(now=NOW, looks={(5, NOW): walks, (1, NOW): LORRY})
    speaker = ReferringContext(context)
    assert speaker.refer(Who(Vehicle(5)), "plain") == "the pedestrian ahead of us (vehicle 5)"
    assert speaker.refer(Who(Vehicle(5)), "object") == "them"
    assert speaker.refer(Who(Vehicle(5)), "possessive") == "their"
    assert speaker.refer(Who(Vehicle(5)), "plain") == "the pedestrian"


@pytest.mark.parametrize(
    ("thing", "words"),
    [
        (Everyone("bicycle"), "all bicycles are waiting"),
        (Everyone(), "everybody is waiting"),
        (Vehicle(4), "the bus that I saw last behind us (vehicle 4) is waiting"),
    ],
)
def test_a_verb_agrees_with_its_subject(thing, words):
    waiting = Clause(Who(thing), "wait", tense="present", progressive=True)
    assert clause(waiting, "plain", ReferringContext(CONTEXT)) == words
