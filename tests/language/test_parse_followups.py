"""What a text means after an earlier one: whose deed it is about, what of that is taken over."""

import pytest

from tests.language.annotated import query
from xavi_dialogue.explain.query import Query

SLOWED = "Why did you slow down?"
LAID = [  # (question before, text, actor, factual, hypothesised cause)
    (SLOWED, "Did vehicle 2 have anything to do with it?", "ego", ("slow-down",), "vehicle:2"),
    (SLOWED, "Was that because of vehicle 2?", "ego", ("slow-down",), "vehicle:2"),
    (SLOWED, "Was it because of vehicle 2?", "ego", ("slow-down",), "vehicle:2"),
    (SLOWED, "And why did vehicle 2 slow down?", "vehicle:2", ("slow-down",), None),
    (
        "Why did vehicle 1 stop?",
        "Did vehicle 2 have anything to do with it?",
        "vehicle:1",
        ("stop",),
        "vehicle:2",
    ),
]


def after(before: str | None, text: str) -> Query:
    """The query that a text means after an earlier one, if any."""
    return query(text, *([] if before is None else [before]))


@pytest.mark.parametrize(("before", "text", "actor", "factual", "cause"), LAID)
def test_what_a_vehicle_had_to_do_with_it(
    before: str, text: str, actor: str, factual: tuple[str, ...], cause: str | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.factual) == ("why", actor, factual)
    assert found.hypothesised_cause == cause


@pytest.mark.parametrize("spoken_of", ["Why did vehicle 1 slow down?", "Where is vehicle 1 going?"])
@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("Why did it stop?", "why"),
        ("Why didn't it stop?", "why_not"),
        ("What if it stops?", "what_if"),
    ],
)
def test_it_is_the_vehicle_that_was_spoken_of(spoken_of: str, text: str, kind: str) -> None:
    found = after(spoken_of, text)
    assert (found.type, found.actor) == (kind, "vehicle:1")
    assert "stop" in (found.factual or ()) + (found.counterfactual or ())


@pytest.mark.parametrize(
    ("text", "kind", "actor", "factual"),
    [
        ("What happened at 0:05?", "what", "ego", None),
        ("What did you do between 0:02 and 0:08?", "what", "ego", None),
        ("What was vehicle 1 doing at 0:05?", "what", "vehicle:1", None),
        ("Why did you brake at 0:05?", "why", "ego", ("stop",)),
        ("Why did vehicle 1 stop at 0:12", "why", "vehicle:1", ("stop",)),
    ],
)
@pytest.mark.parametrize("before", [None, "Why did vehicle 2 turn left?"])
def test_a_time_of_the_ride_is_no_vehicle(
    before: str | None, text: str, kind: str, actor: str, factual: tuple[str, ...] | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.factual) == (kind, actor, factual)
    assert found.tense == "past"
    assert found.time is not None


TAKEN_BACK = [  # (text, actor, type, what was done or supposed)
    ("Why did vehicle 1, sorry, vehicle 2 stop?", "vehicle:2", "why", ("stop",)),
    ("Why did vehicle 1, no wait, vehicle 2 stop?", "vehicle:2", "why", ("stop",)),
    ("Why did vehicle 1 stop? Sorry, vehicle 2 I mean", "vehicle:2", "why", ("stop",)),
    ("Why did you stop? No, vehicle 2", "vehicle:2", "why", ("stop",)),
    (
        "What if the car in front, no, the car behind had stopped",
        "vehicle:behind",
        "what_if",
        ("stop",),
    ),
    ("Why did you turn left, I mean, right?", "ego", "why", ("exit-right",)),
    ("Why did you stop, no, slow down?", "ego", "why", ("slow-down",)),
    ("Why did you, I mean, why did vehicle 1 stop?", "vehicle:1", "why", ("stop",)),
    ("Sorry, why did you stop?", "ego", "why", ("stop",)),
    ("Why did you stop, actually?", "ego", "why", ("stop",)),
    ("You turned left, right?", "ego", "what", ("exit-left",)),
]


@pytest.mark.parametrize(("text", "actor", "kind", "done"), TAKEN_BACK)
def test_what_is_taken_back_is_not_heard(
    text: str, actor: str, kind: str, done: tuple[str, ...]
) -> None:
    found = query(text)
    assert (found.actor, found.type) == (actor, kind)
    assert (found.factual or found.counterfactual) == done


def test_not_that_one_but_the_other() -> None:
    found = query("No, not that one, the other one", "Why did vehicle 1 stop?")
    assert (found.type, found.actor, found.factual) == ("why", "vehicle:other", ("stop",))


LANES = "Why did you move to the left lane?"
SUPPOSED = [  # (question before, text, counterfactual, negated, tense)
    (LANES, "What if you had decided otherwise?", ("change-left",), True, "past"),
    (LANES, "And if you had done something else?", ("change-left",), True, "past"),
    (None, "What if you had decided otherwise?", None, False, "past"),
    (LANES, "What if you had stopped?", ("stop",), False, "past"),
    (LANES, "What if you stopped now?", ("stop",), False, "future"),
    (LANES, "What about stopping?", ("stop",), False, "past"),
    ("Where are we going?", "What about stopping?", ("stop",), False, "present"),
    (None, "What about stopping?", ("stop",), False, "future"),
    ("What if you had turned left?", "What about stopping?", ("stop",), False, "past"),
]


@pytest.mark.parametrize(("before", "text", "foil", "negated", "tense"), SUPPOSED)
def test_what_is_supposed(
    before: str | None, text: str, foil: tuple[str, ...] | None, negated: bool, tense: str
) -> None:
    found = after(before, text)
    assert (found.type, found.actor) == ("what_if", "ego")
    assert (found.counterfactual, found.negated, found.tense) == (foil, negated, tense)


@pytest.mark.parametrize("before", [None, "Why did you stop?", "Why did vehicle 1 stop?"])
@pytest.mark.parametrize(
    ("text", "kind", "tense"),
    [
        ("Did we crash?", "what", "past"),
        ("Was it close?", "what", "past"),
        ("Did we nearly hit something?", "what", "past"),
        ("How likely is a collision?", "confidence", "present"),
    ],
)
def test_a_collision_is_another_matter(
    before: str | None, text: str, kind: str, tense: str
) -> None:
    found = after(before, text)
    assert (found.type, found.event, found.tense) == (kind, "crash", tense)
    assert (found.actor, found.factual, found.counterfactual) == ("ego", None, None)


@pytest.mark.parametrize(
    ("before", "text", "kind", "factual", "tense"),
    [
        ("Why did you stop?", "How long did it take?", "when", ("stop",), "past"),
        ("Why did you stop?", "How long will this take?", "when", None, "future"),
        (None, "How long will it take?", "when", None, "future"),
        ("What would have made you stop?", "What mattered most?", "sensitivity", None, "past"),
        ("Why did you stop?", "What mattered most?", "sensitivity", ("stop",), "past"),
        (None, "What changed your mind?", "sensitivity", None, "past"),
        (None, "How are you deciding?", "how", None, "present"),
        (None, "Do we have to turn right?", "what", ("exit-right",), "present"),
        (None, "Where were we going at the start?", "where_goal", None, "past"),
    ],
)
def test_what_is_asked_about_us(
    before: str | None, text: str, kind: str, factual: tuple[str, ...] | None, tense: str
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.factual) == (kind, "ego", factual)
    assert (found.counterfactual, found.tense) == (None, tense)


@pytest.mark.parametrize("before", [None, "Why did you change lanes?"])
@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("Did vehicle 1 do anything wrong?", "blame"),
        ("Did you make a mistake?", "blame"),
        ("Who has right of way?", "legality"),
        ("Who has priority here?", "legality"),
    ],
)
def test_what_is_no_matter_of_ours_is_declined(before: str | None, text: str, reason: str) -> None:
    assert after(before, text).reason == reason


@pytest.mark.parametrize("before", [None, "Why did you stop?"])
@pytest.mark.parametrize(
    ("text", "event"),
    [
        ("Which lane are we in?", "lane"),
        ("What else can you do now?", "options"),
        ("What else can you do here?", "options"),
    ],
)
def test_what_is_seen_and_could_be_done_now(before: str | None, text: str, event: str) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.event) == ("what", "ego", event)
    assert found.tense == "present"


def test_what_can_be_asked_is_help() -> None:
    assert query("What can you do?").type == "help"


@pytest.mark.parametrize("before", [None, "Why did you stop?"])
@pytest.mark.parametrize("text", ["No.", "nah", "dunno", "idk", "I don't know"])
def test_no_and_not_knowing_are_talk(before: str | None, text: str) -> None:
    found = after(before, text)
    assert (found.type, found.event) == ("smalltalk", "dissent")


@pytest.mark.parametrize("before", ["Why did you change left?", "What if you had stopped?"])
@pytest.mark.parametrize(
    "text",
    [
        "and if vehicle 1 had not been there?",
        "and if vehicle 1 hadnt been there",
        "And without vehicle 1?",
        "and with no vehicle 1",
        "and if there were no vehicle 1?",
        "and had vehicle 1 not been there?",
    ],
)
def test_who_is_thought_away_is_put_into_no_earlier_question(before: str, text: str) -> None:
    found = after(before, text)
    assert (found.type, found.actor) == ("what_if", "vehicle:1")
    assert (found.intervention, found.counterfactual, found.tense) == ("remove", None, "past")


def test_a_condition_goes_on_without_a_vehicle() -> None:
    found = after("Would you still have changed left if vehicle 2 had?", "and without vehicle 1?")
    assert (found.type, found.actor, found.condition) == ("sensitivity", "ego", "without vehicle 1")
