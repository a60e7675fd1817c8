"""Clauses that make no difference to what was understood are owned up to."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Elliptic, HowMuch, HowSure, Reading, Whether
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Both, Compares, Happens, Measured, Pronoun, Unknown
from xavi_dialogue.nlu.grounding.doubts import judge
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.parse import Parser


def _best(text: str) -> Reading:
    return Parser().read(text)[0]


@pytest.mark.parametrize(
    ("text", "passed"),
    [
        (
            "Could you take it a bit slower coming out of the next one?",
            "coming out of the next one",
        ),
        (
            "Is there any traffic in the roundabout that you have to take into account?",
            "that you have to take into account",
        ),
    ],
)
def test_a_clause_without_which_the_acts_are_the_same_is_listed(text: str, passed: str) -> None:
    assert passed in [" ".join(words) for words in _best(text).ignored]


@pytest.mark.parametrize(
    "text",
    [
        "Why did you brake when the bus pulled out?",
        "Will you brake if he pulls out?",
        "Is that the car that cut in?",
        "Did you slow down because of the bus that stopped?",
    ],
)
def test_a_clause_that_has_a_part_is_not_listed(text: str) -> None:
    assert _best(text).acts
    assert not _best(text).ignored


def test_an_alternative_is_not_given_up_for_a_plain_question() -> None:
    asked = interpret("Are you going to overtake it or stay behind?")[0].acts[0]
    assert isinstance(asked, Ask)
    assert isinstance(asked.question, Whether)
    assert isinstance(asked.question.that, Both)


@pytest.mark.parametrize(
    "text",
    ["Will you merge before him or behind?", "Are you going to get in front of him or behind?"],
)
def test_before_or_behind_asks_who_goes_first(text: str) -> None:
    asked = _best(text).acts[0]
    assert isinstance(asked, Ask)
    assert isinstance(asked.question, Whether)
    of = asked.question.that
    assert isinstance(of, Both)
    actions = [one.event.action for one in of.contents if isinstance(one, Happens)]
    assert actions == ["go", "let-go"]


def test_what_is_meant_is_the_clause() -> None:
    assert _best("Do you mean that the van is going to stop?").acts == (
        *_best("The van is going to stop, isn't it?").acts,
    )


def test_sureness_is_of_the_clause() -> None:
    asked = _best("Are you sure that there is enough room on the left?").acts[0]
    assert isinstance(asked, Ask)
    assert isinstance(asked.question, HowSure)
    assert asked.question.of is not None


def test_faster_is_than_whom_was_asked_about() -> None:
    asked = _best("How fast is that lorry, and are we faster?").acts[1]
    assert isinstance(asked, Ask)
    assert isinstance(asked.question, Whether)
    assert isinstance(asked.question.that, Compares)
    assert asked.question.that.right is not None


def test_staying_behind_is_behind_whom_is_overtaken() -> None:
    asked = _best("do you overtake this lorry or keep behind it").acts[0]
    assert isinstance(asked, Ask)
    assert isinstance(asked.question, Whether)
    of = asked.question.that
    assert isinstance(of, Both)
    assert all(isinstance(one, Happens) and one.event.object is not None for one in of.contents)


@pytest.mark.parametrize(
    ("text", "idle"),
    [
        ("How long till we are in the village?", "village"),
        ("Were you well over the limit along the school road?", "school"),
    ],
)
def test_a_named_place_that_makes_no_difference_is_owned_up_to(text: str, idle: str) -> None:
    reading = _best(text)
    assert [share.text for share in reading.shares if share.share == "idle"] == [idle]
    assert judge(reading).leaves(0) == (idle,)


@pytest.mark.parametrize(
    "text",
    [
        "Did you come to a complete stop before the roundabout?",
        "What is the reason for the current braking?",
        "Why do we keep creeping forward and stopping again?",
        "Why are they stopped behind the brown car?",
        "Why are you only creeping?",
        "Why are we braking when the blue car is the one with its indicator on?",
        "Do you expect him to turn left rather than going straight on?",
        "How much time did the people on the crossing cost us?",
    ],
)
def test_a_word_that_changes_nothing_of_what_is_asked_is_not_owned_up_to(text: str) -> None:
    reading = _best(text)
    assert reading.acts
    assert not judge(reading).open
    assert not reading.ignored


def test_one_of_several_names_without_a_part_is_unknown() -> None:
    assert "van" in _best("And was that down to the light or the van?").unknown


@pytest.mark.parametrize(
    "text",
    [
        "why did we swap sides",
        "did you bring the speed down?",
        "why did you bail out of the overtake?",
    ],
)
def test_a_word_that_chooses_the_sense_of_a_verb_has_a_part(text: str) -> None:
    assert not [s for s in _best(text).shares if s.share in ("idle", "unknown")]


def test_a_question_that_is_read_is_not_given_up_for_what_is_told_beside_it() -> None:
    asked = interpret("Told you. Now we're stuck behind it. How fast is it even going?")[0].acts[-1]
    assert asked == Ask(HowMuch(Measured("speed", Pronoun("it"))))


@pytest.mark.parametrize("text", ["when does the lorry get its gap?", "has the van got its gap?"])
def test_what_somebody_else_gets_is_no_view_of_us(text: str) -> None:
    assert first(_best(text).acts, Unknown) is not None


def test_a_text_is_not_read_as_an_act_that_names_nothing() -> None:
    assert Elliptic() not in _best("so whose allowed to go first him or us").acts
