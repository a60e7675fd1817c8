"""What a number, colour, kind or superlative says is in the acts, or the word is unknown."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Compare, HowMuch
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import Described, Measured, Pronoun, Vehicle
from xavi_dialogue.nlu.parse import Parser

PAIRS = (("the red one", "the blue one"), ("vehicle 3", "vehicle 7"), ("the bus", "the lorry"))
FRAMES = (
    "is {} or {} faster", "is {} or {} the closest", "is {} or {} behind us",
    "which is bigger, {} or {}", "who is in front, {} or {}", "will {} or {} turn left",
    "did you brake for {} or {}", "are we following {} or {}", "{} or {}, which is slower",
    "how far apart are {} and {}", "how big is the gap between {} and {}",
    "what about without {} and {}", "how about with {} and not {}", "why {} and not {}",
    "what happened to {} beside {}", "how much for {} or {}",
    "is it {} or {} that we are waiting for", "{} surprised you more than {}",
)  # fmt: skip


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


def told(thing: str) -> str:
    """Give the word that tells who is meant."""
    words = thing.split()
    return words[1] if words[0] == "the" else words[-1]


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("frame", FRAMES)
def test_who_is_named_is_in_the_acts_or_unknown(
    parser: Parser, frame: str, pair: tuple[str, str]
) -> None:
    for reading in parser.read(frame.format(*pair)):
        named = {one.number for one in parts(reading.acts, Vehicle)}
        described = list(parts(reading.acts, Described))
        named |= {one.colour for one in described} | {one.kind for one in described}
        for thing in pair:
            word = told(thing)
            said = {"lorry": "truck"}.get(word, int(word) if word.isdecimal() else word)
            assert said in named or word in reading.unknown, (thing, reading)


@pytest.mark.parametrize(
    ("text", "by", "least"),
    [
        ("is the red or the blue one faster", "speed", False),
        ("is vehicle 1 or 5 slower?", "speed", True),
        ("which of the two is further away", "distance", True),
        ("which of the three trucks is the biggest", "size", False),
        ("who is in front, us or the bus", "place", False),
        ("is the bus ahead of the van or behind it", "place", False),
    ],
)
def test_which_of_several_is_asked_by_what_is_compared(
    parser: Parser, text: str, by: str, least: bool
) -> None:
    act = parser.read(text)[0].acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, Compare)
    assert (act.question.by, act.question.least) == (by, least)


@pytest.mark.parametrize(
    ("text", "one", "other"),
    [
        ("how far apart are they", Pronoun("them-all"), Pronoun("them-all")),
        ("how far apart are vehicle 2 and vehicle 4", None, None),
        ("what is the distance between 2 and 4", Vehicle(2), Vehicle(4)),
        ("how long is the gap between truck 1 and truck 3", Vehicle(1), Vehicle(3)),
    ],
)
def test_a_distance_of_others_has_two_sides(
    parser: Parser, text: str, one: object, other: object
) -> None:
    act = parser.read(text)[0].acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, HowMuch)
    of = act.question.of
    assert isinstance(of, Measured)
    assert of.attribute == "distance"
    assert (of.thing, of.to) == (one, other) if one is not None else of.thing == of.to
