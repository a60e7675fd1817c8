"""What the words of a question say about when."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from xavi_dialogue.explain.when import When
from xavi_dialogue.language.times import when_said
from xavi_dialogue.language.wordlists import load

CHANGES = ("change-left", "change-right")
TURNS = ("exit-left", "exit-right")


def ago(seconds: float, *, rough: bool = False) -> When:
    return When(relation="before", landmark="now", seconds=seconds, rough=rough)


def ahead(seconds: float, *, rough: bool = False) -> When:
    return When(relation="after", landmark="now", seconds=seconds, rough=rough, ahead=True)


SAID = [
    ("what were you doing 20 seconds ago", ago(20.0)),
    ("wat were you doing twenty secs ago?", ago(20.0)),
    ("twenty-five seconds ago, why did you brake?", ago(25.0)),
    ("what did you do 2.5 seconds ago", ago(2.5)),
    ("What'd you do half a minute ago", ago(30.0)),
    ("why did you brake one second ago", ago(1.0)),
    ("why did you brake two minutes back", ago(120.0)),
    ("what were you doing a moment ago", ago(5.0, rough=True)),
    ("what were you doing a couple of seconds ago", ago(2.0, rough=True)),
    (
        "why did you do that just now",
        When(relation="within", landmark="now", seconds=8.0, rough=True),
    ),
    ("why did you brake earlier", When(relation="within", landmark="now", rough=True)),
    ("what happened in the last ten seconds", When(relation="within", landmark="now", seconds=10)),
    ("what will you do in ten seconds", ahead(10.0)),
    ("in about ten seconds, what will you be doing", ahead(10.0)),
    ("where will you be ten seconds from now", ahead(10.0)),
    (
        "what will you do within the next ten seconds",
        When(relation="within", landmark="now", seconds=10.0, ahead=True),
    ),
    ("what happened at 0:12", When(landmark="clock", clock=12.0)),
    ("what happened around 1:05?", When(landmark="clock", clock=65.0)),
    ("what were you doing at 12 seconds", When(landmark="clock", clock=12.0)),
    ("what were you doing 12s into the ride", When(landmark="clock", clock=12.0)),
    ("before 0:12 what did you do", When(relation="before", landmark="clock", clock=12.0)),
    (
        "between 0:10 and 0:05 what happened",
        When(relation="within", landmark="clock", clock=5.0, until=10.0),
    ),
    (
        "what did you do between second 5 and second 12",
        When(relation="within", landmark="clock", clock=5.0, until=12.0),
    ),
    (
        "what happened between 5 and 12 seconds",
        When(relation="within", landmark="clock", clock=5.0, until=12.0),
    ),
    ("why did you slow down the first time", When(nth=1)),
    ("why did you slow down the 2nd time", When(nth=2)),
    ("why did you slow down the last time", When(nth=-1)),
    ("why did you slow down the penultimate time", When(nth=-2)),
    ("why did you make the second lane change", When(nth=2)),
    (
        "why did you slow down the second time you changed lanes",
        When(landmark="deed", deeds=CHANGES, actor="ego", which=2),
    ),
    ("why did you slow down before the junction", When(relation="before", landmark="junction")),
    ("why did you brake at the second junction", When(landmark="junction", which=2)),
    ("why did you turn at the roundabout", When(landmark="roundabout")),
    ("what will you do after the crossroads", When(relation="after", landmark="junction")),
    ("what will you do at the next roundabout", When(landmark="roundabout", ahead=True)),
    ("why did you slow down approaching the lights", When(landmark="junction")),
    (
        "why did you stop after you changed lanes",
        When(relation="after", landmark="deed", deeds=CHANGES, actor="ego"),
    ),
    (
        "why did you stop before turning left",
        When(relation="before", landmark="deed", deeds=("exit-left",)),
    ),
    (
        "what did you do five seconds after the turn",
        When(relation="after", landmark="deed", deeds=TURNS, seconds=5.0),
    ),
    (
        "what did you do right after the lane change",
        When(relation="after", landmark="deed", deeds=CHANGES, seconds=3.0, rough=True),
    ),
    (
        "what were you doing when vehicle 1 cut in",
        When(landmark="deed", deeds=CHANGES, actor="vehicle:1"),
    ),
    (
        "when the truck cut in, why did you brake",
        When(landmark="deed", deeds=CHANGES, actor="vehicle:truck"),
    ),
    (
        "what did vehicle 2 do while you were waiting",
        When(landmark="deed", deeds=("stop",), actor="ego"),
    ),
    ("what did you do at the start", When(landmark="start")),
    ("what were you doing when we set off", When(landmark="start")),
    ("what did you do at the end", When(landmark="end")),
    (
        "why did you slow down the first time before the junction",
        When(relation="before", landmark="junction", nth=1),
    ),
]


@pytest.mark.parametrize(("text", "when"), SAID)
def test_what_is_said(text: str, when: When) -> None:
    assert when_said(text) == when


@pytest.mark.parametrize(
    "text",
    [
        "",
        "why did you turn left",
        "one second slower",
        "why was the other lane 2 seconds slower",
        "what if you had been ten seconds faster",
        "how many seconds would it save",
        "last car",
        "why not the second lane",
        "why did you take the second exit",
        "why did you go first",
        "first why",
        "what are you doing now",
        "what are you doing right now",
        "what is vehicle 2 doing at the moment",
        "when did vehicle 1 cut in",
        "when will you turn",
        "how long until we arrive",
        "at what time did you turn",
        "why didn't you brake earlier",
        "stop as soon as possible",
        "why are you following vehicle 1",
        "why did you stop when you could have gone",
        "why did you stop when vehicle 1 did not turn left",
        "why did you stop before vehicle 1",
        "why are you in the second lane",
        "12345678901234567890",
    ],
)
def test_what_only_looks_like_time(text: str) -> None:
    assert when_said(text) is None


@given(st.text(max_size=300))
def test_any_text_is_taken(text: str) -> None:
    assert isinstance(when_said(text), When | None)


_WORDS = sorted(
    {
        word
        for kind, values in load("times.toml").items()
        if kind.isupper()
        for phrases in values.values()
        for phrase in phrases
        for word in phrase.replace("(", " ").replace(")", " ").replace("|", " ").split()
    }
)
_OTHERS = ["7", "0:12", "you", "turned", "vehicle 1", "braked", "why", "did", ","]


@given(st.lists(st.sampled_from(_WORDS + _OTHERS), max_size=12).map(" ".join))
def test_words_of_time_in_any_order_are_taken_and_mean_something(text: str) -> None:
    when = when_said(text)
    assert when is None or when.landmark is not None or when.nth is not None
    assert when is None or (when.landmark == "deed") == bool(when.deeds)
    assert when is None or (when.landmark == "clock") == (when.clock is not None)


def test_a_number_changes_the_length_alone() -> None:
    for number in (1, 7, 33, 100):
        assert when_said(f"what were you doing {number} seconds ago") == ago(float(number))
