"""Playing transcripts: what befalls the car reaches the conversation as it does on the road."""

import pytest

from planner.record.trace import PlanTrace
from tests.fakes import again as same_again
from tests.fakes import inputs_of
from tests.traces import s1_ride
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.service.in_process import Replan, make_pipeline
from xavi_dialogue.transcripts.runner import Played, latest, play
from xavi_dialogue.transcripts.transcript import TranscriptError, read, write

RIDE = s1_ride()
NEEDS_A_PLAN = "> What if vehicle 1 hadn't been there?\n"


def played(body: str, again: Replan = same_again, style: str = "passenger") -> Played:
    transcript = read(f"scenario: s1\nseed: 0\nstyle: {style}\n\n{body}")
    return play(transcript, make_pipeline(), tuple(inputs_of(RIDE)), 7.0, again)


@pytest.mark.parametrize(
    ("befallen", "reason"),
    [
        ("planner fails", "planner-failed"),
        ("planner late", "timed-out"),
        ("planner gone", "planner-unavailable"),
    ],
)
def test_a_planner_that_does_not_answer(befallen: str, reason: str) -> None:
    failing = played(f"! {befallen}\n{NEEDS_A_PLAN}")
    assert [reply.reason for reply in failing.replies] == [reason]
    mended = played(f"! {befallen}\n! planner answers\n{NEEDS_A_PLAN}")
    assert mended.replies == played(NEEDS_A_PLAN).replies != failing.replies


def test_a_question_meanwhile_is_turned_away() -> None:
    wanted = []

    def again(trace: PlanTrace, need: NeedRollout) -> PlanTrace:
        wanted.append(need)
        return same_again(trace, need)

    both = played(f"{NEEDS_A_PLAN}! meanwhile\n> Hello?\n> Hello?\n", again)
    assert len(wanted) >= 1
    first, second, third = both.replies
    assert (second.reason, third.reason) == ("busy", None)
    assert first == played(NEEDS_A_PLAN).replies[0]
    assert write(both.transcript).index("Hello?") > write(both.transcript).index(first.text)


def test_there_is_no_meanwhile_where_nothing_is_planned() -> None:
    with pytest.raises(TranscriptError, match="the planner is not needed for 'Hello!'"):
        played("> Hello!\n! meanwhile\n> Hello?\n")


def test_a_record_that_is_lost_and_found() -> None:
    question = "> Why did you change lanes?\n"
    lost, found = played(f"! no record\n{question}! record\n{question}").replies
    assert lost.reason == "trace-gap"
    assert found == played(question).replies[0]


def test_a_conversation_goes_on_after_a_restart() -> None:
    body = "! planner fails\n> What is vehicle 1 doing?\n{}> Where is it going?\n"
    before, after = played(body.format("! restart\n")).replies
    assert after == played(body.format("")).replies[1]
    assert before.query is not None
    assert after.query is not None
    assert after.query.actor == before.query.actor == "vehicle:1"


def test_questions_are_asked_when_the_transcript_says() -> None:
    body = "> Hello!\n@ 3.0s\n> Hello!\n@ 5s\n"
    assert [reply.sim_time for reply in played(body).replies] == [7.0, 3.0]
    assert latest(read(f"scenario: s1\n\n{body}")) == 5.0
    assert latest(read("scenario: s1\n\n> Hello!\n")) == 0.0


def test_there_are_no_other_styles() -> None:
    with pytest.raises(TranscriptError, match="no style 'rude'"):
        played("> Hello!\n", style="rude")
