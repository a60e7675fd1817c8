"""Pairs of texts that differ in little and mean different things."""

import pytest

from tests.language.annotated import query
from xavi_dialogue.explain.query import Query


def after(before: str | None, text: str) -> Query:
    """The query that a text means after an earlier one, if any."""
    return query(text, *([] if before is None else [before]))


@pytest.mark.parametrize(
    ("text", "actor", "time"),
    [
        ("What did the lorry do ten seconds ago?", "vehicle:truck", "10 seconds ago"),
        ("What did vehicle 10 do seconds ago?", "vehicle:10", "seconds ago"),
        ("What was vehicle 1 doing 5 s ago?", "vehicle:1", "5 s ago"),
        ("What have you done in the last ten seconds?", "ego", "in the last 10 seconds"),
        ("What will you do in 10 seconds?", "ego", "in 10 seconds"),
        ("What did you do between second 5 and 12?", "ego", "between second 5 and 12"),
        ("What happened between 5 and 12 seconds?", "ego", "between 5 and 12 seconds"),
        ("What were you doing at second 7?", "ego", "at second 7"),
    ],
)
def test_a_number_of_seconds_is_no_vehicle(text: str, actor: str, time: str) -> None:
    found = query(text)
    assert (found.type, found.actor, found.time) == ("what", actor, time)


@pytest.mark.parametrize("text", ["20 seconds ago", "And ten seconds ago?", "What about 5 s ago?"])
@pytest.mark.parametrize("before", ["What did you do?", "What was vehicle 2 doing?"])
def test_a_time_alone_is_put_into_the_question_before(before: str, text: str) -> None:
    found, spoken_of = after(before, text), query(before)
    assert (found.type, found.actor, found.tense) == ("what", spoken_of.actor, "past")
    assert found.time is not None


@pytest.mark.parametrize("text", ["And vehicle 20?", "What about 2?"])
def test_a_number_alone_is_a_vehicle(text: str) -> None:
    assert after("What did you do?", text).actor == f"vehicle:{text.strip('?').split()[-1]}"


@pytest.mark.parametrize(
    ("before", "text", "actor", "cause"),
    [
        ("Why did you stop?", "Because of the blue car?", "ego", "vehicle:blue"),
        ("Why did you stop?", "The blue car?", "vehicle:blue", None),
        ("Why did vehicle 1 stop?", "Because of vehicle 2?", "vehicle:1", "vehicle:2"),
        ("Why did vehicle 1 stop?", "And vehicle 2?", "vehicle:2", None),
        ("Why did you stop?", "Is it because of the other one?", "ego", "vehicle:other"),
    ],
)
def test_what_is_laid_to_a_vehicle_is_not_what_it_did(
    before: str, text: str, actor: str, cause: str | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.factual) == ("why", actor, ("stop",))
    assert found.hypothesised_cause == cause


@pytest.mark.parametrize("text", ["No, I meant 2", "I meant vehicle 2.", "no i mean number 2"])
def test_a_number_may_be_what_was_meant(text: str) -> None:
    found = after("What is vehicle 1 doing?", text)
    assert (found.type, found.actor, found.tense) == ("what", "vehicle:2", "present")


@pytest.mark.parametrize("text", ["Is it safe?", "Is this safe?"])
def test_it_is_what_we_do_where_nothing_is_compared(text: str) -> None:
    found = after("What is vehicle 1 doing?", text)
    assert (found.type, found.actor, found.event) == ("compare", "ego", "safer")


@pytest.mark.parametrize(
    ("text", "actor", "foil"),
    [
        ("what if hed stayed in the roundabout", "vehicle:it", "continue-next-exit"),
        ("what if hed turned left", "vehicle:it", "exit-left"),
        ("what if wed turned left", "ego", "exit-left"),
        ("what if youd turned left", "ego", "exit-left"),
    ],
)
def test_he_is_never_us(text: str, actor: str, foil: str) -> None:
    found = query(text)
    assert (found.type, found.actor, found.counterfactual) == ("what_if", actor, (foil,))


@pytest.mark.parametrize(
    ("text", "event"),
    [("thx bye", "farewell"), ("thanks, goodbye", "farewell"), ("thx hi", "thanks")],
)
def test_who_says_goodbye_wants_no_more(text: str, event: str) -> None:
    found = query(text)
    assert (found.type, found.event) == ("smalltalk", event)


@pytest.mark.parametrize(
    ("before", "text", "kind", "actor", "event"),
    [
        (None, "how fast we goin", "out_of_scope", "ego", "speed"),
        (None, "how fast are we going", "out_of_scope", "ego", "speed"),
        (None, "how fast vehicle 1 going", "out_of_scope", "vehicle:1", "speed"),
        (None, "How far is it?", "when", "ego", "arrival"),
        ("Why did you change lanes?", "How far is it?", "when", "ego", "arrival"),
        ("What is vehicle 1 doing?", "How far is it?", "when", "vehicle:1", "distance"),
        (None, "how many cars round us", "out_of_scope", "ego", "count"),
        (None, "anyone coming", "out_of_scope", "ego", "count"),
        ("Why did you change lanes?", "anyone coming?", "out_of_scope", "ego", "count"),
        (None, "anyone coming from the right", "what", "vehicle:from-right", None),
        (
            "What is vehicle 1 doing?",
            "what about from the right",
            "what",
            "vehicle:from-right",
            None,
        ),
        (None, "What is the car coming from the right doing?", "what", "vehicle:right", None),
        (None, "which one is the closest", "where_goal", "vehicle:nearest", "place"),
        (None, "What is the nearest car doing?", "what", "vehicle:nearest", None),
        (None, "Which lane is this?", "what", "ego", "lane"),
        (None, "what else could we do here", "what", "ego", "options"),
        ("Why did you slow down?", "And what now?", "what", "ego", None),
        ("Why did you slow down?", "Tell me more about vehicle 1", "what", "vehicle:1", None),
        ("What is vehicle 1 doing?", "is it still in the roundabout", "what", "vehicle:1", None),
    ],
)
def test_what_is_seen_and_in_short(
    before: str | None, text: str, kind: str, actor: str, event: str | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.event) == (kind, actor, event)
    assert found.factual is None


@pytest.mark.parametrize("before", [None, "What is vehicle 1 doing?", "Why did you change lanes?"])
@pytest.mark.parametrize(
    ("text", "tense"),
    [
        ("hmm ok. will we crash", "future"),
        ("will it hit us", "future"),
        ("did it nearly hit us", "past"),
        ("did we crash", "past"),
    ],
)
def test_a_collision_is_no_deed(before: str | None, text: str, tense: str) -> None:
    found = after(before, text)
    assert (found.type, found.event, found.tense) == ("what", "crash", tense)


@pytest.mark.parametrize(
    ("before", "kind", "foil", "event"),
    [
        (None, "what", None, "crash"),
        ("Why did you stop?", "what_if", ("stop",), None),
        ("What if you had turned left?", "compare", ("exit-left",), "safer"),
    ],
)
@pytest.mark.parametrize("text", ["would we of crashed", "Would we have crashed?"])
def test_whether_we_would_have_crashed_goes_on_from_what_was_supposed(
    before: str | None, text: str, kind: str, foil: tuple[str, ...] | None, event: str | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.counterfactual) == (kind, "ego", foil)
    assert (found.event, found.tense) == (event, "past")


@pytest.mark.parametrize("before", [None, "Why did vehicle 1 stop?", "Why did you stop?"])
@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("did he see us", "perception"),
        ("did it see us?", "perception"),
        ("has vehicle 2 even noticed us?", "perception"),
        ("does it know we are here", "perception"),
        ("can i have ice cream", "off-topic"),
        ("I want a cookie", "off-topic"),
    ],
)
def test_what_no_record_tells_is_declined(before: str | None, text: str, reason: str) -> None:
    found = after(before, text)
    assert (found.type, found.reason, found.refers_to_previous) == ("out_of_scope", reason, False)


def test_what_is_read_in_other_words_is_not_read_again() -> None:
    assert query("what else can you do now").event == "options"


def test_who_let_whom_pass_is_no_order() -> None:
    found = query("So who let whom go first?")
    assert (found.type, found.actor, found.factual) == ("what", "ego", ("give-way",))


@pytest.mark.parametrize(
    ("text", "actor"),
    [
        ("What is the car behind vehicle 1 doing?", "vehicle:behind-1"),
        ("What is the truck right in front of vehicle 12 doing?", "vehicle:front-12"),
        ("What is the car behind us doing?", "vehicle:behind"),
        ("What is vehicle 1 doing behind us?", "vehicle:1"),
    ],
)
def test_a_vehicle_may_be_named_by_another(text: str, actor: str) -> None:
    found = query(text)
    assert (found.type, found.actor, found.tense) == ("what", actor, "present")


@pytest.mark.parametrize("text", ["Why are you waiting behind vehicle 1?", "Why did you stop?"])
def test_what_we_wait_behind_does_not_wait(text: str) -> None:
    assert (query(text).actor, query(text).factual) == ("ego", ("stop",))


@pytest.mark.parametrize(
    ("before", "actor"),
    [
        ("What is vehicle 1 doing?", "vehicle:behind-1"),
        ("What is vehicle 2 doing?", "vehicle:behind-2"),
    ],
)
def test_it_is_whom_another_is_behind(before: str, actor: str) -> None:
    assert after(before, "What is the car behind it doing?").actor == actor
