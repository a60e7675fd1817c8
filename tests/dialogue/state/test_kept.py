"""What is found out about a turn is kept with it, and nowhere else."""

from msgspec.structs import replace

from tests.dialogue.state.test_chain import turn
from xavi_dialogue.dialogue.state.discourse import after, discourse_of
from xavi_dialogue.dialogue.state.turn import Turn, kept
from xavi_dialogue.domain.answers import Helpful
from xavi_dialogue.domain.discourse import Discourse


def test_it_is_found_out_once_for_each_turn() -> None:
    asked: list[Turn] = []

    @kept
    def noted(one: Turn) -> int:
        asked.append(one)
        return len(asked)

    one, other = turn(Helpful()), turn(Helpful())
    assert [noted(one), noted(one), noted(other)] == [1, 1, 2]
    assert noted(replace(one, text="other")) == 3


def test_a_turn_is_worth_the_same_wherever_it_stands() -> None:
    one = turn(Helpful())
    assert one == turn(Helpful())
    discourse_of([one, one])
    fresh = turn(Helpful())
    assert one == fresh
    assert after(Discourse(turn=7), one) == after(Discourse(turn=7), fresh)
