"""Quotations, soundness and doubts: worked out case by case."""

from typing import Any

import pytest

from xavi_dialogue.domain.answers import NotUnderstood
from xavi_dialogue.domain.meaning import (
    Ask,
    Reading,
    Request,
    TokenShare,
    Unread,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Happens,
    Nobody,
    Passenger,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.doubts import judge
from xavi_dialogue.nlu.grounding.quoting import missed, phrases, unread, words_of
from xavi_dialogue.nlu.grounding.soundness import is_sound

STOPS = Happens(Event("stop", Vehicle(3)))


def share(word: str, kind: Any = "meaning", act: int | None = 0, part: str = "") -> TokenShare:
    strange = kind == "strange"
    return TokenShare(word, word, "unknown" if strange else kind, part, act, strange)


def read(*shares: TokenShare, acts: int = 1, **more: Any) -> Reading:
    return Reading(tuple([Ask(Why(STOPS))] * acts), shares, **more)


def test_the_words_of_an_act_that_bear_content_are_quoted_where_there_are_others() -> None:
    shares = [share(w) for w in ("and", "but", "stop", "and", "go")] + [share("thanks", act=1)]
    two = read(*shares, acts=2)
    assert (words_of(two, 0), words_of(two, 1)) == ("stop go", "thanks")
    assert words_of(read(*shares[:5]), 0) == ""
    lead = read(share("please", "politeness"), share("x", act=1), acts=2)
    assert words_of(lead, 0) == ""
    asking = read(share("who"), share("to", "grammar"), share("x", act=1), acts=2)
    assert words_of(asking, 0) == "who to"


@pytest.mark.parametrize(
    ("word", "kind", "part"),
    [
        ("now", "meaning", "timeadv:now"),
        ("again", "meaning", "adv:again"),
        ("time", "unknown", "abs:time"),
        ("guess", "unknown", "abs:prediction"),
        ("likely", "hedge", "hedge:hedge"),
        ("kindly", "politeness", "please:please"),
    ],
)
def test_words_of_time_courtesy_and_hedging_are_not_quoted(word: str, kind: str, part: str) -> None:
    row = read(share(word, kind, 0, part), share("x", act=1), acts=2)
    assert words_of(row, 0) == ""
    assert phrases(row, 0, (word,)) == ()
    assert unread(row, Unread((word,))).quote == ""


@pytest.mark.parametrize(("count", "ends"), [(4, False), (5, True)])
def test_a_long_quotation_is_cut(count: int, ends: bool) -> None:
    words = [f"w{k}" for k in range(count)]
    two = read(*map(share, words), share("x", act=1), acts=2)
    assert words_of(two, 0) == " ".join(words[:4]) + (" ..." if ends else "")


def test_doubtful_words_that_stand_together_are_quoted_as_one() -> None:
    row = read(share("stop"), share("for", "grammar"), share("the", "grammar"),
               share("green", "unknown"), share("light", "unknown"), share("now"))  # fmt: skip
    assert phrases(row, 0, ("green", "light")) == ("green light",)
    assert phrases(row, 0, ("light",)) == ("light",)
    assert phrases(row, 1, ("green",)) == ()
    strange = read(share("the", "grammar"), share("flurb", "strange"), share("the", "grammar"),
                   share("green", "unknown"), share("flurb", "strange"))  # fmt: skip
    assert phrases(strange, 0, ("flurb",)) == ("flurb",)
    assert phrases(strange, 0, ("flurb", "green")) == ("flurb", "green flurb")


def test_what_was_missed_of_an_act_is_quoted_from_its_first_word_to_its_last() -> None:
    row = [
        share("why"),
        share("flurb", "strange"),
        share("the"),
        share("zig", "unknown"),
        share("x"),
    ]
    one = read(*row, share("thanks", act=1), acts=2)
    assert missed(one, 0, ("flurb", "zig")) == NotUnderstood(("flurb",), "flurb zig")
    assert missed(one, 0, ()) == NotUnderstood(("flurb",), "flurb zig x")
    assert missed(read(*row), 0, ()) == NotUnderstood(("flurb",), "")


def test_a_stretch_of_which_nothing_was_made_is_quoted() -> None:
    row = read(share("so", act=None), share("flurb", "strange", None), share("stop"))
    found = unread(row, Unread(("so", "flurb")))
    assert found == NotUnderstood(("flurb",), "flurb")
    whole = unread(read(share("flurb", "strange")), Unread(("flurb",)))
    assert whole == NotUnderstood(("flurb",), "")


@pytest.mark.parametrize(
    ("value", "sound"),
    [
        (Event("follow", Vehicle(1), object=Vehicle(1)), False),
        (Event("follow", Vehicle(1), object=Vehicle(2)), True),
        (Event("wait", Ego(), object=Ego()), False),
        (Event("drop-off", Ego(), object=Ego()), True),
        (Event("follow", Nobody(), object=Everyone()), False),
        (Event("follow", Nobody(), object=Vehicle(1)), True),
        (Event("follow", Ego(), object=Everyone()), True),
        (Event("stop", Vehicle(1)), True),
        (Event("arrive", Vehicle(1)), False),
        (Event("arrive", Ego()), True),
        (Event("arrive", Passenger()), True),
        (Event("arrive", Vehicle(1), object=Vehicle(2)), True),
        (Event("arrive", Vehicle(1), where=Related("near", Wanted(), Ego())), True),
        (Related("behind", Vehicle(1), Vehicle(1)), False),
        (Related("same-as", Vehicle(1), Vehicle(1)), True),
        (Related("behind", Vehicle(1), Ego()), True),
        (Related("on", Vehicle(1), Ego()), False),
        (Related("near", Nobody(), Nobody()), False),
        (Request(Event("stop", Ego())), True),
        (Request(Event("stop", Vehicle(1))), False),
        (Request(Event("follow", Ego(), object=Ego())), False),
        (Request(Event("drop-off", Ego(), object=Ego())), True),
        (Ask(Whether(Happens(Event("follow", Ego(), object=Ego())))), False),
        ((STOPS, Related("behind", Ego(), Ego())), False),
        ("behind", True),
        (None, True),
    ],
)
def test_nobody_has_to_do_with_himself(value: Any, sound: bool) -> None:
    assert is_sound(value) is sound


def judged(*shares: TokenShare, **more: Any) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The words that kill the act, and those that leave a doubt."""
    found = judge(read(*shares, **more))
    return found.kills(0), found.leaves(0)


UNKNOWN = share("flurb", "strange")
SUBJECT, WILL, THE = share("we", "grammar"), share("will", "grammar"), share("the", "grammar")
TURN, CAR = share("turn", part="event:turn"), share("bus", part="kind:bus")


@pytest.mark.parametrize(
    ("row", "fatal"),
    [
        ((SUBJECT, WILL, UNKNOWN), True),  # it is the verb
        ((SUBJECT, WILL, UNKNOWN, TURN), False),
        ((CAR, WILL, UNKNOWN), True),
        ((share("how", "grammar"), UNKNOWN), True),
        ((share("how", "grammar"), UNKNOWN, TURN), False),
        ((share("which", "grammar"), UNKNOWN, CAR), False),
        ((share("how", "grammar"), UNKNOWN, share("x")), True),
        ((THE, UNKNOWN), True),
        ((THE, UNKNOWN, CAR), False),
        ((share("near", "grammar"), THE, UNKNOWN), False),  # a place
        ((TURN, THE, UNKNOWN), True),
        ((TURN, share("flurbly", "strange")), False),
        ((TURN, UNKNOWN, share("zig", "unknown"), CAR), False),
        ((TURN, UNKNOWN, CAR), False),
        ((TURN, UNKNOWN, THE), True),
        ((UNKNOWN,), True),
    ],
)
def test_a_word_without_a_sense_kills_an_act_or_leaves_a_doubt(
    row: tuple[TokenShare, ...], fatal: bool
) -> None:
    kills, leaves = judged(*row)
    assert (bool(kills), bool(leaves) and not kills) == (fatal, not fatal)


def test_an_english_word_beside_the_core_leaves_no_doubt() -> None:
    assert judged(SUBJECT, WILL, share("zig", "unknown"), TURN) == ((), ())
    assert judged(SUBJECT, WILL, share("zig", "idle"), TURN) == ((), ("zig",))  # a named place


def test_small_words_and_asides_do_not_matter() -> None:
    assert judged(TURN, share("of", "unknown")) == ((), ())
    assert judged(TURN, share("of", "strange"))[0] == ("of",)
    assert judged(SUBJECT, share("kindly", "politeness"), WILL, UNKNOWN) == (("flurb",), ())
    assert judged(TURN, share("flurb", "strange", None)) == ((), ("flurb",))
    other = judge(read(TURN, share("flurb", "strange", 1), acts=2))
    assert (other.kills(0), other.kills(1)) == ((), ("flurb",))


def test_strange_words_of_a_longer_aside_leave_a_doubt() -> None:
    words = ("flurb", "of", "the", "zig")
    row = [share(w, "strange" if w in ("flurb", "zig") else "grammar", None) for w in words]
    aside = Unread(words)
    assert judged(TURN, *row, unread=(aside,)) == ((), ("flurb", "zig"))
    assert judged(TURN, *row, unread=(Unread(words[:3]),)) == ((), ("zig",))
