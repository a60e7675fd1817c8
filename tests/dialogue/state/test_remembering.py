"""What later turns draw on: who was named, what was asked for, told and got wrong."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.dialogue.state.test_chain import BRAKED, CONTRAST, LEADER, turn
from xavi_dialogue.dialogue.state.memory import remember
from xavi_dialogue.dialogue.state.turn import Quiz, Turn
from xavi_dialogue.domain.answers import Helpful, Measures, MotionReason, Posed, SupposedOfUs
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Ask, Claim, Feel, HowMuch, Repair, Social, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Measured

STOPPED = Happens(Event("stop"))
WHY = Ask(Why(STOPPED))
QUIZ = Quiz(posed=Posed("vehicle", Why(STOPPED)), at=5.0, vehicle=3)
REASON = MotionReason(BRAKED, (LEADER,))


def wish(*kinds: Any) -> Turn:
    one = turn(Helpful(), act=Repair(kind=kinds[0]))
    parts = tuple(replace(one.parts[0], act=GroundedAct(Repair(kind=kind))) for kind in kinds)
    return replace(one, parts=parts)


def detail(*turns: Turn) -> str:
    return remember(turns, None).detail


ASKED = turn(Helpful(), act=WHY)


@pytest.mark.parametrize(
    ("wishes", "found"),
    [
        ([], "usual"),
        (["longer"], "usual"),
        (["longer", "longer"], "more"),
        (["shorter", "shorter"], "less"),
        (["simpler", "simpler"], "simpler"),
        (["longer", "shorter"], "usual"),
        (["longer", "shorter", "longer"], "usual"),
        (["longer", "longer", "longer"], "more"),
        (["longer", "longer", "shorter"], "usual"),
        (["longer", "longer", "shorter", "shorter"], "less"),
        (["longer", "repeat", "longer"], "more"),  # that was no wish
    ],
)
def test_what_is_asked_for_twice_in_a_row_becomes_the_rule(wishes: list[Any], found: str) -> None:
    assert detail(*map(wish, wishes)) == found
    between = [one for each in wishes for one in (wish(each), ASKED)]
    assert detail(*between) == found


def test_a_wish_counts_once_in_a_turn_and_outlasts_a_ride() -> None:
    assert detail(wish("longer", "longer")) == "usual"
    assert detail(wish("shorter", "longer"), wish("longer")) == "more"
    earlier = replace(wish("longer"), ride="another")
    assert remember((earlier, earlier), "this").detail == "more"


def test_only_the_turns_of_the_ride_count() -> None:
    before = replace(turn(REASON, act=WHY), ride="old", mentioned=(3,), quiz=QUIZ)
    now = replace(turn(Helpful(), act=Social("thanks")), ride="new", mentioned=(4, 5))
    found = remember((before, now), "new")
    assert found.turns == (now,)
    assert found.named == {4, 5}
    assert (found.last, found.quizzed, found.discourse.turn) == (None, (), 1)
    old = remember((before, now), "old")
    assert (set(old.named), old.last, old.quizzed) == ({3}, before, (QUIZ,))
    assert remember((before, now), None).turns == ()


def test_the_last_turn_about_the_drive_is_kept_past_talk() -> None:
    thanks = turn(Helpful(), act=Social("thanks"))
    for act in (WHY, Claim(STOPPED), Feel("afraid")):
        about = turn(REASON, act=act)
        assert remember((ASKED, about, thanks), None).last == about
    assert remember((thanks,), None).last is None


@pytest.mark.parametrize(
    ("last", "quizzing"),
    [
        (ASKED, False),
        (replace(ASKED, quiz=QUIZ), True),
        (replace(ASKED, answered=QUIZ), True),
    ],
)
def test_a_quiz_is_under_way_until_something_else_is_asked(last: Turn, quizzing: bool) -> None:
    assert remember((ASKED, last), None).is_quizzing is quizzing
    assert not remember((last, ASKED), None).is_quizzing
    assert not remember((), None).is_quizzing


def judged(right: bool | None, *, answered: bool = True) -> Turn:
    return replace(turn(REASON, act=WHY), answered=QUIZ if answered else None, right=right)


@pytest.mark.parametrize(
    ("turns", "missed"),
    [
        ([judged(False)], True),
        ([judged(True)], False),
        ([judged(None)], False),
        ([judged(False, answered=False)], False),
        ([judged(False), judged(True)], False),
        ([judged(True), judged(False)], True),
        ([judged(False), judged(None)], True),
    ],
)
def test_what_was_got_wrong_counts_as_not_told(turns: list[Turn], missed: bool) -> None:
    found = remember(turns, None)
    assert found.missed == ({3} if missed else set())
    assert found.told == (frozenset() if missed else {(3, ("exit-right",))})


def test_causes_that_were_told_are_known_by_what_was_expected() -> None:
    found = remember((turn(SupposedOfUs(CONTRAST)), judged(True)), None)
    assert found.told == {
        (0, ("stop",)), (3, ("continue", "exit-right")), (3, ("exit-right",))
    }  # fmt: skip
    assert remember((turn(SupposedOfUs(CONTRAST)), judged(False)), None).told == {(0, ("stop",))}


def test_the_same_answer_to_a_question_of_the_same_kind_was_given_before() -> None:
    speed = Measures((Measure("speed", Ego(), 7.0, 12.0),))
    found = remember((turn(speed, act=Ask(HowMuch(Measured("speed")))), ASKED), None)
    same = GroundedAct(Ask(HowMuch(Measured("limit"))))
    assert found.answered(same, speed)
    assert not found.answered(same, Helpful())
    assert not found.answered(GroundedAct(WHY), speed)
    assert not found.answered(GroundedAct(Claim(STOPPED)), speed)
    assert found.answered(GroundedAct(WHY), Helpful())


def test_suggestions_that_were_said_lately_are_known() -> None:
    def suggesting(name: str) -> Turn:
        reply = replace(ASKED.reply, text=f"Ask {name}.", suggestions=(name, f"{name} too"))
        return replace(ASKED, reply=reply)

    turns = [suggesting(name) for name in ("who", "when", "how", "why")]
    assert remember(turns, None).suggested == {"when", "how", "why"}
    assert remember(turns[:1], None).suggested == {"who"}
