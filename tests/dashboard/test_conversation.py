"""What a dashboard learns of a conversation that others take part in."""

from hypothesis import given
from hypothesis import strategies as st

from xavi_dialogue.bus.messages import HistoryReply, PastTurn
from xavi_dialogue.dashboard.conversation import GLANCE, MAX_TURNS, Conversation
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.storage.turn_log import MAX_PAST


def turn(text: str) -> PastTurn:
    return PastTurn(text, Reply(text=f"About {text}.", kind="refusal", sim_time=float(len(text))))


def history(said: list[PastTurn], turns: int) -> HistoryReply:
    """What the service replies, which remembers the latest 200."""
    known = said[-MAX_PAST:]
    fields = {"session": "ada", "seq": 0, "sim_time": 0.0, "wall_time": 0.0}
    return HistoryReply(**fields, total=len(known), turns=tuple(known[-turns:]))  # type: ignore[arg-type]


def look(conversation: Conversation, said: list[PastTurn]) -> list[tuple[int, str]]:
    """What is new to a dashboard that looks at the latest turns, and at all if it has to."""
    news = conversation.learn(history(said, GLANCE), whole=False)
    if news is None:
        news = conversation.learn(history(said, 100), whole=True)
    assert news is not None
    return [(one.n, one.text) for one in news.turns]


def test_what_is_new_is_told_once() -> None:
    conversation, said = Conversation(), [turn("a"), turn("b")]
    assert look(conversation, said) == [(0, "a"), (1, "b")]
    assert look(conversation, said) == []
    said.append(turn("c"))
    assert look(conversation, said) == [(2, "c")]


def test_more_than_one_looks_at_is_found_too() -> None:
    conversation, said = Conversation(), [turn(f"q{k}") for k in range(3)]
    look(conversation, said)
    said += [turn(f"q{k}") for k in range(3, 20)]
    assert look(conversation, said) == [(k, f"q{k}") for k in range(3, 20)]


def test_a_conversation_that_was_forgotten_begins_anew() -> None:
    conversation = Conversation()
    look(conversation, [turn("a"), turn("b")])
    news = conversation.learn(history([], 100), whole=True)
    assert news is not None
    assert news.reset
    assert conversation.all().turns == ()
    assert look(conversation, [turn("c")]) == [(2, "c")]


def test_a_conversation_that_is_joined_late_is_known_whole() -> None:
    said = [turn(f"q{k}") for k in range(12)]
    assert look(Conversation(), said) == [(k, f"q{k}") for k in range(12)]


def test_one_that_is_forgotten_and_begun_anew_at_the_same_length_is_another() -> None:
    conversation = Conversation()
    look(conversation, [turn("a"), turn("b")])
    assert look(conversation, [turn("c"), turn("d")]) == [(2, "c"), (3, "d")]
    assert [one.text for one in conversation.all().turns] == ["c", "d"]


def test_the_same_question_again_and_again_is_a_turn_each_time() -> None:
    conversation, said = Conversation(), []
    for k in range(12):
        said.append(turn("are you sure?"))
        assert look(conversation, said) == [(k, "are you sure?")]


def test_a_turn_is_found_by_what_was_said() -> None:
    conversation, said = Conversation(), [turn("a"), turn("b"), turn("a")]
    look(conversation, said)
    assert conversation.find("a", said[0].reply) == 2
    assert conversation.find("b", said[1].reply) == 1
    assert conversation.find("c", turn("c").reply) is None
    assert conversation.turn(1) == said[1]
    assert conversation.turn(3) is None
    assert conversation.turn(-1) is None


def test_a_long_conversation_is_not_known_for_ever() -> None:
    conversation, said = Conversation(), []
    for k in range(MAX_TURNS + 10):
        said.append(turn(f"q{k}"))
        look(conversation, said)
    told = conversation.all().turns
    assert [told[0].n, told[-1].n] == [10, MAX_TURNS + 9]
    assert conversation.turn(9) is None
    assert conversation.turn(10) == said[10]


def test_what_the_latest_answer_says_could_be_asked_is_known() -> None:
    conversation, said = Conversation(), [turn("a")]
    look(conversation, said)
    assert conversation.suggestions == ()
    offers = ("What is it?", "Why?")
    answer = Reply(text="So.", kind="answer", suggestions=offers, sim_time=1.0)
    said.append(PastTurn("b", answer))
    look(conversation, said)
    assert conversation.suggestions == offers
    said.append(PastTurn("c", Reply(text="No.", kind="refusal", suggestions=offers, sim_time=1.0)))
    look(conversation, said)
    assert conversation.suggestions == ()  # the page shows those of a refusal beside it


@given(st.lists(st.integers(0, 3).flatmap(lambda n: st.lists(st.text(max_size=3), max_size=n))))
def test_whatever_is_said_when_all_of_it_is_known_in_order(batches: list[list[str]]) -> None:
    conversation, said = Conversation(), []
    for batch in batches:
        said += [turn(text) for text in batch]
        look(conversation, said)
        assert conversation.turns == said
