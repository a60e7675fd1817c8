"""What question words demand is asked, of what is stated beside them."""

import pytest

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    HowDecide,
    HowMuch,
    Listing,
    Reading,
    WhatIf,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Ego, Event, Feature, Happens, Measured, Pronoun
from xavi_dialogue.nlu.demands import demanded, is_met
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.parse import Parser

BARE = (
    "Why?",
    "Whatever for?",
    "What for?",
    "How come?",
    "Explain that, please.",
    "Account for that.",
    "Justify that.",
    "What was that?",
    "What was that about?",
    "What's the reason?",
    "What's the idea?",
    "What's the rush?",
)
CONDUCT = (
    ("We braked again.", "brake"),
    ("You stopped again.", "stop"),
    ("We swerved to the right.", "swerve"),
    ("You nearly stopped there.", "slow-down"),
    ("There was a hard brake.", "brake"),
    ("That was a sudden stop.", "stop"),
    ("That was a proper stamp on the brakes.", "brake"),
)
AROUND = ("There's nobody in front of us.", "The road is clear.", "Nobody is coming.")


@pytest.mark.parametrize("demand", BARE)
@pytest.mark.parametrize(("stated", "action"), CONDUCT)
def test_a_bare_demand_asks_why_we_did_what_is_stated(
    stated: str, action: str, demand: str
) -> None:
    assert _asked(f"{stated} {demand}") == action


@pytest.mark.parametrize("demand", BARE[:7])
@pytest.mark.parametrize("around", AROUND)
def test_what_is_stated_of_the_road_is_not_what_a_reason_is_asked_of(
    around: str, demand: str
) -> None:
    assert _asked(f"We braked again. {around} {demand}") == "brake"
    assert _asked(f"We braked again. {demand} {around}") == "brake"


@pytest.mark.parametrize("around", AROUND)
def test_where_nothing_of_us_is_stated_it_is_asked_why_we_drive_as_we_do(around: str) -> None:
    question = _why(f"Why? {around}")
    assert question.of == Happens(Event("do", object=Pronoun("that"), tense="present"))
    assert first(_best(f"Why? {around}").acts, Claim) is not None


@pytest.mark.parametrize("text", ["You braked again, whatever for?", "You braked again, why?",
                                  "We are braking, explain that please."])  # fmt: skip
def test_a_demand_may_be_set_off_by_a_mark(text: str) -> None:
    assert _asked(text) == "brake"


def test_a_word_for_surprise_is_a_demand_before_what_is_stated() -> None:
    assert _asked("And now we're slowing down again. Why, there's nobody ahead.") == "slow-down"


def test_the_deed_of_another_is_asked_of_him() -> None:
    assert _why("He slowed down. Why?").of == Happens(Event("slow-down", Pronoun("he")))


@pytest.mark.parametrize("blame", [
    "All for that blue bus?", "And all for that blue bus, I take it.",
    "All because of that blue bus?", "Just for that blue bus?",
])  # fmt: skip
@pytest.mark.parametrize(("stated", "action"), CONDUCT)
def test_who_is_named_as_the_cause_is_suspected(stated: str, action: str, blame: str) -> None:
    question = _why(f"{stated} {blame}")
    assert question.suspect == Described(kind="bus", colour="blue")
    assert getattr(first(question.of, Event), "action", None) == action


@pytest.mark.parametrize(("text", "kind"), [
    ("why did you brake", "reason"), ("what did you do that for", "reason"),
    ("how long has it been red", "duration"), ("when did you see him", "moment"),
    ("how many times did we stop", "count"), ("how fast is he", "degree"),
    ("list whom you gave way to", "list"), ("how sure were you", "chance"),
    ("what number is the green one", "number"),
])  # fmt: skip
def test_question_words_tell_what_is_demanded(text: str, kind: str) -> None:
    assert kind in demanded(text.split())


@pytest.mark.parametrize("text", ["that is why we stopped", "what are you waiting for",
                                  "when we changed lanes was anyone beside us"])  # fmt: skip
def test_such_words_need_not_demand_anything(text: str) -> None:
    assert not demanded(text.split())


@pytest.mark.parametrize("text", [
    "Why did you brake?", "How long did we wait?", "When did you see him?",
    "How many times did we stop?", "How fast is the bus?", "Who has right of way?",
    "List the lane changes.", "How likely is it that he turns?",
])  # fmt: skip
def test_plain_questions_meet_what_they_demand(text: str) -> None:
    acts = Parser().read(text)[0].acts
    kinds = demanded(text.lower().rstrip("?.").split())
    assert kinds
    assert all(is_met(kind, acts) for kind in kinds)


def test_a_reading_that_leaves_a_demand_unmet_gives_way_to_a_plain_question() -> None:
    listed = _best("For the record, list whom you gave way to on this trip and where.").acts
    assert listed == (Ask(Listing("events", event=Event("give-way"))),)


@pytest.mark.parametrize("text", ["How many metres is behind us the blue car?",
                                  "How far is behind us the blue car?",
                                  "How far behind us is the blue car?"])  # fmt: skip
def test_a_place_belongs_to_who_is_said_to_be_there(text: str) -> None:
    asked = _best(text).acts[0]
    assert isinstance(asked, Ask)
    assert isinstance(asked.question, HowMuch)
    blue = Described(kind="car", colour="blue", bearing="behind")
    assert blue in (asked.question.of.thing, asked.question.of.to)
    assert isinstance(asked.question.of, Measured)


def _best(text: str) -> Reading:
    return interpret(text)[0]


def _why(text: str) -> Why:
    asked: list[Act] = [act for act in _best(text).acts if isinstance(act, Ask)]
    assert len(asked) == 1, asked
    assert isinstance(asked[0], Ask)
    assert isinstance(asked[0].question, Why), asked
    return asked[0].question


def _asked(text: str) -> str | None:
    event = first(_why(text).of, Event)
    return None if event is None else event.action


@pytest.mark.parametrize(
    "text",
    [
        "If it's green, why are we waiting?",
        "ok so if its green now why are we standing here",
        "If nobody is coming, why are you braking?",
    ],
)
def test_what_is_so_is_the_ground_of_a_why_and_supposes_nothing(text: str) -> None:
    acts = interpret(text)[0].acts
    assert any(isinstance(act, Ask) and isinstance(act.question, Why) for act in acts)
    assert first(acts, WhatIf) is None
    otherwise = interpret("If it was red, why would you wait?")[0].acts
    assert first(otherwise, WhatIf) is not None


@pytest.mark.parametrize(
    "text",
    [
        "Why are we going this way?",
        "why this way",
        "Is this the fastest way?",
        "Isn't there a quicker way to go?",
        "Would it have been quicker to take another road?",
        "Is there another way there?",
        "Are we taking a detour?",
        "Why did you choose this route?",
        "Wouldn't the other road have been faster?",
        "How do you choose the way?",
        "How do you know which way to go?",
    ],
)
def test_why_we_go_the_way_that_we_go_is_asked_in_many_ways(text: str) -> None:
    own = Happens(Event("go", Ego(), Feature("way")))
    assert interpret(text)[0].acts == (Ask(HowDecide(own)),)


@pytest.mark.parametrize(
    "text",
    ["Which way are we going?", "Is there a faster way around him?", "Why did he go this way?",
     "What other options did you have?"],
)  # fmt: skip
def test_other_ways_are_not_ours(text: str) -> None:
    assert all(first(one.acts, HowDecide) is None for one in interpret(text)[:1])
