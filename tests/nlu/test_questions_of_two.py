"""Questions of two: "ahead or behind", "he waits or we wait", "the limit, and are we over it"."""

import pytest

from xavi_dialogue.domain.meaning import (
    Ask,
    HowMany,
    HowMuch,
    Peak,
    Request,
    WhatIf,
    When,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Is,
    Measured,
    Not,
    Pronoun,
    Related,
    Vehicle,
)
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


@pytest.mark.parametrize(
    ("text", "bearings"),
    [
        ("Is there anybody behind us or beside us?", ("behind", "beside")),
        ("Is there a car ahead or behind?", ("ahead", "behind")),
        ("Are there any vans on the left or on the right?", ("left", "right")),
    ],
)
def test_a_second_place_is_of_the_same_description(
    parser: Parser, text: str, bearings: tuple[str, ...]
) -> None:
    act = parser.read(text)[0].acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, Whether)
    both = act.question.that
    assert isinstance(both, Both)
    assert both.join == "or"
    things = [part.thing for part in both.contents if isinstance(part, Exists)]
    assert tuple(t.bearing for t in things if isinstance(t, Described)) == bearings


@pytest.mark.parametrize(
    "text", ["He waits for us or we wait for him?", "It goes first or we go first?"]
)
def test_two_statements_with_or_are_one_question(parser: Parser, text: str) -> None:
    acts = parser.read(text)[0].acts
    assert len(acts) == 1
    act = acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, Whether)
    assert isinstance(act.question.that, Both)
    assert all(isinstance(part, Happens) for part in act.question.that.contents)


@pytest.mark.parametrize(
    ("text", "degree"),
    [
        ("What is the limit and are we over it?", "more"),
        ("How fast are we allowed to go here and are we above it?", "more"),
        ("What is the limit and is he under it?", "less"),
    ],
)
def test_over_it_is_over_the_limit(parser: Parser, text: str, degree: str) -> None:
    acts = parser.read(text)[0].acts
    assert len(acts) == 2
    last = acts[-1]
    assert isinstance(last, Ask)
    assert isinstance(last.question, Whether)
    that = last.question.that
    assert isinstance(that, Compares)
    assert that.comparator == degree
    assert isinstance(that.right, Measured)
    assert that.right.attribute == "limit"


def test_what_a_request_is_for_is_not_asked(parser: Parser) -> None:
    for reading in parser.read("Could you flash your lights so he moves on?"):
        kept = [act for act in reading.acts if not isinstance(act, Request)]
        assert not any(isinstance(act, Ask) for act in kept)


def supposed(parser: Parser, text: str) -> object:
    act = parser.read(text)[0].acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, WhatIf)
    return act.question.supposed


@pytest.mark.parametrize(
    "text",
    [
        "What if vehicles 1 and 5 were not there?",
        "What if vehicle 1 or vehicle 5 was not there?",
        "What would you do without 1 and 5?",
        "Without vehicle 1 and vehicle 5?",
    ],
)
def test_all_that_are_supposed_away_are_read(parser: Parser, text: str) -> None:
    away = Both(tuple(Not(Exists(Vehicle(number))) for number in (1, 5)))
    assert supposed(parser, text) == away


def test_the_conduct_of_each_is_supposed(parser: Parser) -> None:
    both = supposed(parser, "What if 1 and 5 had driven slower?")
    assert isinstance(both, Both)
    events = [part.event for part in both.contents if isinstance(part, Happens)]
    assert [event.actor for event in events] == [Vehicle(1), Vehicle(5)]
    assert {event.action for event in events} == {"slow-down"}
    either = supposed(parser, "What if 1 or 5 had braked?")
    assert isinstance(either, Both)
    assert either.join == "or"


@pytest.mark.parametrize("who", ["neither of the two", "neither of them", "none of them"])
def test_none_of_them_is_denied_of_all_of_them(parser: Parser, who: str) -> None:
    assert supposed(parser, f"And if {who} were there?") == Not(Exists(Pronoun("them-all")))


def test_a_plain_question_stands_in_for_no_supposition_of_several() -> None:
    reading = interpret("what if 1 and 3 had changed lanes")[0]
    act = reading.acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, WhatIf)
    assert isinstance(act.question.supposed, Both)


HE = Pronoun("he")


def asked(parser: Parser, text: str) -> object:
    acts = parser.read(text)[0].acts
    assert len(acts) == 1
    assert isinstance(acts[0], Ask)
    return acts[0].question


@pytest.mark.parametrize(
    ("text", "first", "other"),
    [
        (
            "Do we have right of way or does he?",
            Related("has-priority-over", Ego(), HE),
            Related("has-priority-over", HE, Ego()),
        ),
        ("Are you stuck or is he?", Is("stuck", Ego()), Is("stuck", HE)),
        (
            "Did he brake, or did you?",
            Happens(Event("brake", HE, tense="past")),
            Happens(Event("brake", Ego(), tense="past")),
        ),
        (
            "Did you wait for him or did he?",
            Happens(Event("wait", Ego(), HE, tense="past")),
            Happens(Event("wait", HE, Ego(), tense="past")),
        ),
    ],
)
def test_or_does_he_asks_the_same_of_another(
    parser: Parser, text: str, first: object, other: object
) -> None:
    assert asked(parser, text) == Whether(Both((first, other), "or"))  # type: ignore[arg-type]


def test_who_did_it_first_is_one_of_the_two(parser: Parser) -> None:
    question = asked(parser, "Did he go first or did we?")
    assert isinstance(question, Which)
    assert question.among == (HE, Ego())


def test_late_or_on_time_is_whether_we_are_late(parser: Parser) -> None:
    assert asked(parser, "Are we late or on time?") == Whether(Is("late", Ego()))


@pytest.mark.parametrize(
    ("text", "rival"),
    [
        ("Did you slow down because of the bend or because he braked?", HE),
        ("Did he stop because of that green car, or because you were too close?", Ego()),
        (
            "Did you stop because of the light or because someone was crossing?",
            Described("pedestrian", plural=True),
        ),
    ],
)
def test_a_second_cause_may_be_a_clause(parser: Parser, text: str, rival: object) -> None:
    question = asked(parser, text)
    assert isinstance(question, Why)
    assert question.rival == rival


@pytest.mark.parametrize(
    "text",
    [
        "Is it the light or the truck that's holding us up?",
        "Is it the truck that's holding us up or the light?",
    ],
)
def test_what_holds_us_up_may_be_a_light_or_a_vehicle(parser: Parser, text: str) -> None:
    question = asked(parser, text)
    assert isinstance(question, Which)
    assert set(question.among) == {Feature("light"), Described("truck")}


def test_a_plain_question_stands_in_for_none_that_names_whom_it_may_be() -> None:
    act = interpret("Who are you slowing for, the cyclist or that red car?")[0].acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, Which)
    assert len(act.question.among) == 2


@pytest.mark.parametrize(
    "text",
    [
        "Had you seen them before you braked, or only just then?",
        "Had you seen them before you braked or only then?",
    ],
)
def test_another_time_of_the_same_is_no_other_question(parser: Parser, text: str) -> None:
    question = asked(parser, text)
    assert isinstance(question, Whether)
    assert isinstance(question.that, Related)
    assert question.that.relation == "can-see"


def test_or_luck_asks_nothing(parser: Parser) -> None:
    act = parser.read("Did you see him or was that luck?")[0].acts[0]
    assert act == Ask(Whether(Related("can-see", Ego(), HE, tense="past")))


@pytest.mark.parametrize(
    "text",
    [
        "When we arrive, and how many kilometres is it still?",
        "When, and how many km?",
        "When are we there, and how far is it still?",
        "Distance and time to destination.",
        "Time and distance to the destination?",
        "How far is it and how long will it take?",
        "How many metres and how many minutes to go?",
    ],
)
def test_both_are_asked_of_the_way_that_is_left(text: str) -> None:
    acts = interpret(text)[0].acts
    questions = [act.question for act in acts if isinstance(act, Ask)]
    asked = {one.of.attribute for one in questions if isinstance(one, HowMuch)}
    assert asked == {"time-to-go", "distance-to-go"}


_TURN = Event("turn", tense="future")
_UNTIL_TURN = Ask(When(Happens(_TURN)))
_TO_TURN = Ask(HowMuch(Measured("turn", event=_TURN)))


@pytest.mark.parametrize(
    "text",
    [
        "When do we turn, and how far is it?",
        "How long until the turn and in how many metres?",
        "How long till the turn, and how far is it?",
        "How long is it to the turn and how far?",
    ],
)
def test_how_far_it_is_is_asked_of_the_turn_before_it(parser: Parser, text: str) -> None:
    assert parser.read(text)[0].acts == (_UNTIL_TURN, _TO_TURN)


@pytest.mark.parametrize(
    "text",
    [
        "How far is the turn and how long does it take?",
        "How many metres until the turn, and how long?",
        "How many metres is it to the turn and when?",
    ],
)
def test_how_long_it_takes_is_asked_of_the_turn_before_it(text: str) -> None:
    assert interpret(text)[0].acts == (_TO_TURN, _UNTIL_TURN)


@pytest.mark.parametrize(
    "text",
    ["Where are we turning and in how many metres?", "Where are we going and how far is it?"],
)
def test_where_we_go_says_how_far_it_is(parser: Parser, text: str) -> None:
    assert parser.read(text)[0].acts == (Ask(Whither()),)


def test_when_behind_where_we_turn_is_of_the_turn(parser: Parser) -> None:
    assert parser.read("Where do we turn and when?")[0].acts == (Ask(Whither()), _UNTIL_TURN)


@pytest.mark.parametrize("unit", ["metres", "meters", "kilometres"])
def test_units_are_measured_and_not_counted(parser: Parser, unit: str) -> None:
    assert parser.read(f"How many {unit} until the turn?")[0].acts == (_TO_TURN,)


@pytest.mark.parametrize(
    ("text", "of"),
    [
        ("How many turns did we make all told, and which one was the slowest?", "slowness"),
        ("How many times did we turn and which of them was the slowest?", "slowness"),
        ("How many turns have we made and which was the fastest?", "speed"),
    ],
)
def test_which_one_it_was_is_asked_of_what_was_counted(parser: Parser, text: str, of: str) -> None:
    count, which = parser.read(text)[0].acts
    assert isinstance(count, Ask)
    assert isinstance(count.question, HowMany)
    assert isinstance(which, Ask)
    assert isinstance(which.question, Peak)
    assert which.question.of == of
    assert which.question.deed == count.question.of


@pytest.mark.parametrize(
    ("text", "of"),
    [
        ("Which turn was the slowest?", Peak("slowness", deed=Event("turn"))),
        ("Which of our turns was the fastest?", Peak("speed", deed=Event("turn"))),
        ("Which lane change was the fastest?", Peak("speed", deed=Event("change-lane"))),
        ("Which stop was the longest?", Peak("waiting")),
    ],
)
def test_which_of_our_deeds_stands_out_is_asked(parser: Parser, text: str, of: Peak) -> None:
    assert parser.read(text)[0].acts == (Ask(of),)


def test_which_of_the_vehicles_counted_stands_out_is_no_deed(parser: Parser) -> None:
    acts = parser.read("How many cars have you seen, and which one was the fastest?")[0].acts
    assert not any(isinstance(act, Ask) and isinstance(act.question, Peak) for act in acts)
