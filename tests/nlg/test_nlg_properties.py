"""What holds of every text, whatever is said."""

import itertools
import re
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.nlg import answer_cases, measure_cases
from tests.nlg.scenery import BLUE, CONTEXT, LORRY, NOW
from xavi_dialogue.domain.answers import Activity, Closeness, Counted, Measures, Verdict
from xavi_dialogue.domain.facts import Episode, Gap, Measure
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Not,
    Quantity,
    Related,
    Tense,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import (
    ActionName,
    Attribute,
    Bearing,
    Comparator,
    Kind,
    Relation,
    Side,
    State,
)
from xavi_dialogue.nlg.say import say
from xavi_dialogue.nlg.surface import values
from xavi_dialogue.nlg.surface.quantities import number, plural, quantity

E, V, W = Ego(), Vehicle(1), Vehicle(2)
UNTIDY = re.compile(r"[,;:]\s*[,.;:]|\s[,.;:?]|  |\(\s|\s\)|[{}_<>|ε]|[a-z]\. [a-z]|\bNone\b")
DOUBLED = re.compile(r"\b(\w+) \1\b", re.IGNORECASE)
COUNTED = re.compile(r"\b(one|1) (\w+s)\b|\b(two|three|four|[2-9]|\d\d+) (metre|second|lane|car)\b")
WRONG = re.compile(r"\b(I are|I is|we is|we am|we was|it are|they is)\b", re.IGNORECASE)
STARTS = re.compile(r"(?:^|[.?!] )([^\s])")
THINGS = (E, V, Vehicle(3), Vehicle(99))


def check(text: str) -> None:
    assert not UNTIDY.search(text), text
    assert not DOUBLED.search(text), text
    assert not [m for m in COUNTED.finditer(text) if m[2] not in ("is", "was", "has", "bus")], text
    assert text.endswith((".", "?", "!", '"')), text
    assert all(not first.islower() for first in STARTS.findall(text)), text
    assert not WRONG.search(text), text


def measures(attribute):
    """Measures with values of all sorts, and without: what is not known is said of no value."""
    extremes = (None, "highest", "lowest", "mean", "total")
    known = itertools.product((None,), (0.0, 1.0, 7.3), extremes)
    unknown = itertools.product(get_args(Gap), (7.3,), extremes[:2])
    places = (None, E, W, Junction(rank=1))
    for gap, value, extreme in (*known, *unknown):
        for thing, time, to in itertools.product(THINGS, (NOW, 18.5, 3.0), places):
            if to != thing:
                yield Measure(
                    attribute, thing, time, value, to=to, extreme=extreme, gap=gap, count=2
                )


@pytest.mark.parametrize("attribute", get_args(Attribute))
def test_measures_are_tidy(attribute):
    for one in measures(attribute):
        check(say(Measures((one,)), CONTEXT).text)


@pytest.mark.parametrize("action", get_args(ActionName))
def test_events_are_tidy_affirmed_and_denied(action):
    for actor, target, side, tense in itertools.product(
        THINGS, (None, W, Junction("roundabout")), (None, *get_args(Side)), get_args(Tense)
    ):
        for holds in (True, False, None):
            event = Event(action, actor, target, side=side, tense=tense)
            check(say(Verdict(Happens(event), holds), CONTEXT).text)


@pytest.mark.parametrize("action", get_args(ActionName))
def test_episodes_are_tidy(action):
    for actor, end in itertools.product(THINGS, (None, 15.0)):
        episode = Episode(actor, action, 12.0, end)
        check(say(Activity(actor, NOW, (episode,), 5.0, "steady"), CONTEXT).text)
        verdict = Verdict(Not(Happens(Event(action, actor))), False, (episode,))
        check(say(verdict, CONTEXT).text)


def propositions():
    for relation, thing in itertools.product(get_args(Relation), THINGS):
        yield Related(relation, thing, W if thing == E else E)
        yield Related(relation, thing, W if thing == E else E, tense="past")
    for state, thing in itertools.product(get_args(State), (None, *THINGS)):
        yield Is(state, thing)
        yield Is(state, thing, event=Event("brake") if thing is None else None, too=True)
    for attribute, thing in itertools.product(get_args(Attribute), THINGS):
        yield Has(attribute, "left", thing)
        for comparator in get_args(Comparator):
            yield Compares(Measured(attribute, thing), comparator, Quantity(10.0, "m"))
            yield Compares(Measured(attribute, thing), comparator, Measured(attribute, W))
    for kind, bearing in itertools.product(get_args(Kind), get_args(Bearing)):
        yield Exists(Described(kind, bearing=bearing, definite=False))
        yield Exists(Described(kind, "orange", bearing=bearing, plural=True, definite=False))


def test_propositions_are_tidy_affirmed_and_denied():
    for that in propositions():
        for holds in (True, False, None):
            check(say(Verdict(that, holds), CONTEXT).text)
            check(say(Verdict(Not(that), holds, claim=True), CONTEXT).text)


def test_golden_texts_are_tidy():
    for measures in measure_cases.CASES:
        check(say(Measures(measures), CONTEXT).text)
    for answer in answer_cases.CASES:
        check(say(answer, CONTEXT).text)


@given(st.integers(0, 40))
def test_number_words_fit_their_nouns(count):
    said = number(values.Number(count, "lorry"))
    assert said.endswith("lorry") == (count == 1)
    check(say(Counted(Everyone("bus"), count), CONTEXT).text)


@given(st.floats(0, 5000), st.sampled_from(["s", "m", "m/s", "m/s2"]))
def test_quantities_are_in_the_number_of_their_noun(value, unit):
    said = quantity(values.Quantity(value, unit))
    if said.startswith("1 "):
        assert not said.endswith("s") or unit == "m/s"


@given(st.floats(0, 1))
def test_no_chance_is_certain_and_words_fit_the_number(probability):
    verdict = Verdict(Happens(Event("turn", V, tense="future")), None, probability=probability)
    text = say(verdict, CONTEXT).text
    check(text)
    assert "100 %" not in text
    assert " 0 %" not in text
    if probability < 0.65:
        assert not text.startswith(("Probably:", "Very likely", "Almost certainly:"))


@given(st.floats(0, 60), st.booleans(), st.sampled_from(["safe", "dangerous", "close", "hit"]))
def test_closeness_is_tidy(metres, past, asked):
    near = Measure("distance", V, 5.0 if past else NOW, metres, to=E)
    check(say(Closeness(1, near, asked=asked, past=past), CONTEXT).text)


def test_plurals():
    assert plural("red lorry") == "red lorries"
    assert plural("bus") == "buses"
    assert (LORRY.alone, BLUE.alone) == (True, False)
