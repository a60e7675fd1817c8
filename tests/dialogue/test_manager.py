import msgspec
import pytest

from planner.trace import WhatIf
from tests.fakes import again, inputs_of, scripted_mind
from tests.traces import s1_ride
from xavi_dialogue.dialogue.events import (
    Answered,
    Asked,
    Cancelled,
    Output,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TraceRecorded,
    TurnedAway,
)
from xavi_dialogue.dialogue.manager import MAX_ROUNDS, advance, fold
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state import Dialogue
from xavi_dialogue.dialogue.states import IllegalEvent
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.parse import NotUnderstood, Parser

RIDE = s1_ride()
SCRIPTED = scripted_mind()


class Talk:
    """A conversation in a test: say something, get what comes out."""

    def __init__(self, mind: Mind, dialogue: Dialogue | None = None) -> None:
        self.mind = mind
        self.dialogue = fold(mind, inputs_of(RIDE)) if dialogue is None else dialogue

    def put(self, event: object) -> Output:
        self.dialogue, outputs = advance(self.mind, self.dialogue, event)  # type: ignore[arg-type]
        [output] = outputs
        return output

    def ask(
        self, text: str, *, request: str = "q", session: str = "ada", at: float = 7.0
    ) -> Output:
        return self.put(Asked(request, session, text, at))

    def reply(self, text: str, **more: object) -> Reply:
        output = self.ask(text, **more)  # type: ignore[arg-type]
        while isinstance(output, RolloutsWanted):
            failed = RolloutsFailed(output.request, output.session, "planner-unavailable")
            output = self.put(failed)
        assert isinstance(output, Answered)
        return output.reply


def real_mind() -> Mind:
    parser = Parser()

    def parse(text: str, vehicles: frozenset[int], previous: Query | None) -> Query | NotUnderstood:
        return parser.follow(text, previous, vehicles)

    return Mind(parse, explain)


def test_an_answer_rests_on_a_recorded_decision() -> None:
    reply = Talk(real_mind()).reply("Why did you change left instead of going straight?")
    assert reply.kind == "answer"
    assert reply.reason is None
    assert reply.explanation is not None
    assert reply.trace_id in {trace.trace_id for trace in RIDE.traces}
    assert reply.query is not None
    assert reply.query.factual == ("change-left",)
    assert "vehicle 1" in reply.text
    assert reply.timing_ms is None


def test_a_vehicle_that_is_described_is_found_in_the_scene() -> None:
    reply = Talk(real_mind()).reply("What is the car in front of us doing?")
    assert reply.query is not None
    assert reply.query.actor.removeprefix("vehicle:").isdecimal()


def test_it_is_what_was_spoken_of_last() -> None:
    talk = Talk(real_mind())
    first = talk.reply("What is vehicle 1 doing?")
    assert first.kind == "answer"
    second = talk.reply("And where is it going?")
    assert second.query is not None
    assert second.query.actor == "vehicle:1"


def test_a_vehicle_that_is_not_there_is_unknown() -> None:
    reply = Talk(real_mind()).reply("Why did the truck stop?")
    assert (reply.kind, reply.reason) == ("refusal", "unknown-vehicle")


def test_a_suspect_that_is_described_is_found_in_the_scene() -> None:
    described = Talk(real_mind()).reply("Did you change left because of the car ahead of us?")
    numbered = Talk(real_mind()).reply("Did you change left because of vehicle 1?")
    assert described.query is not None
    assert described.query.hypothesised_cause == "vehicle:1"
    assert described.text == numbered.text
    assert described.text.startswith("Yes.")


def test_a_suspect_that_is_not_there_is_unknown() -> None:
    reply = Talk(real_mind()).reply("Did you change left because of the truck?")
    assert (reply.kind, reply.reason) == ("refusal", "unknown-vehicle")


def test_what_another_could_have_avoided_is_declined_as_such() -> None:
    reply = Talk(real_mind()).reply("How could vehicle 1 have avoided slowing down?")
    assert reply.reason == "out-of-scope"
    assert reply.query is not None
    assert reply.query.actor == "vehicle:1"


def test_what_lies_after_the_moment_asked_at_is_not_known() -> None:
    reply = Talk(real_mind()).reply("Why did you change lanes?", at=2.0)
    assert (reply.kind, reply.reason) == ("refusal", "did-not-happen")
    assert reply.sim_time == 2.0


def test_gibberish_is_not_understood() -> None:
    reply = Talk(SCRIPTED).reply("huh")
    assert (reply.kind, reply.reason, reply.query) == ("refusal", "not-understood", None)


def test_a_refusal_carries_its_reason_and_no_explanation() -> None:
    reply = Talk(SCRIPTED).reply("refuse")
    assert (reply.kind, reply.reason) == ("refusal", "too-little-evidence")
    assert reply.explanation is None


def test_missing_evidence_is_asked_for_and_then_used() -> None:
    talk = Talk(SCRIPTED)
    wanted = talk.ask("lack more")
    assert isinstance(wanted, RolloutsWanted)
    more = talk.put(arrived(wanted))
    assert isinstance(more, RolloutsWanted)
    assert more.need != wanted.need
    assert isinstance(talk.put(arrived(more)), Answered)


def arrived(wanted: Output) -> RolloutsArrived:
    """What was wanted, planned."""
    assert isinstance(wanted, RolloutsWanted)
    [trace] = [trace for trace in RIDE.traces if trace.trace_id == wanted.need.trace_id]
    return RolloutsArrived(wanted.request, wanted.session, again(trace, wanted.need))


def test_rollouts_that_are_not_those_waited_for_change_nothing() -> None:
    """Late ones, for a question that was cancelled, may come under the name of another."""
    talk = Talk(SCRIPTED)
    late = arrived(talk.ask("suppose"))
    talk.dialogue, _ = advance(SCRIPTED, talk.dialogue, Cancelled("q", "ada"))
    wanted = talk.ask("lack")
    right = arrived(wanted)
    for wrong in (
        late.trace,
        RIDE.traces[0],
        again(RIDE.traces[1], wanted.need),  # of another decision
        msgspec.structs.replace(right.trace, what_if=WhatIf(rollouts=2)),
    ):
        before = talk.dialogue
        with pytest.raises(IllegalEvent, match="not those that were needed"):
            talk.put(RolloutsArrived("q", "ada", wrong))
        assert talk.dialogue == before
    assert talk.dialogue.planned == {}
    assert isinstance(talk.put(right), Answered)


def test_what_was_planned_once_is_not_asked_for_again() -> None:
    talk = Talk(SCRIPTED)
    talk.put(arrived(talk.ask("lack")))
    assert isinstance(talk.ask("lack", session="bob"), Answered)


def test_planning_again_has_an_end() -> None:
    talk = Talk(SCRIPTED)
    output = talk.ask("lack forever")
    rounds = 0
    while isinstance(output, RolloutsWanted):
        rounds += 1
        output = talk.put(arrived(output))
    assert rounds == MAX_ROUNDS
    assert output.reply.reason == "too-little-evidence"


def test_a_failed_plan_is_told() -> None:
    talk = Talk(SCRIPTED)
    talk.ask("lack")
    output = talk.put(RolloutsFailed("q", "ada", "planner-unavailable"))
    assert isinstance(output, Answered)
    assert output.reply.reason == "planner-unavailable"
    assert talk.reply("answer").kind == "answer"


def test_a_second_question_finds_the_session_busy() -> None:
    talk = Talk(SCRIPTED)
    wanted = talk.ask("lack")
    assert talk.reply("answer", request="q2").reason == "busy"
    assert talk.reply("answer", request="q3", session="bob").kind == "answer"
    assert isinstance(talk.put(arrived(wanted)), Answered)


def test_a_cancelled_question_is_forgotten() -> None:
    talk = Talk(SCRIPTED)
    wanted = talk.ask("lack")
    talk.dialogue, outputs = advance(SCRIPTED, talk.dialogue, Cancelled("q", "ada"))
    assert outputs == ()
    assert talk.dialogue.session("ada").turns == ()
    with pytest.raises(IllegalEvent, match="rollouts arrived"):
        talk.put(arrived(wanted))


def test_who_is_turned_away_is_told_why() -> None:
    talk = Talk(SCRIPTED)
    output = talk.put(TurnedAway(Asked("q", "ada", "answer", 7.0), "timed-out"))
    assert isinstance(output, Answered)
    assert (output.reply.kind, output.reply.reason) == ("refusal", "timed-out")


def test_after_the_ride_nothing_is_recorded_and_questions_are_answered() -> None:
    talk = Talk(SCRIPTED, fold(SCRIPTED, inputs_of(RIDE, ended=7.0)))
    with pytest.raises(IllegalEvent, match="over"):
        advance(SCRIPTED, talk.dialogue, TraceRecorded(RIDE.traces[0]))
    with pytest.raises(IllegalEvent, match="over"):
        advance(SCRIPTED, talk.dialogue, RideEnded(8.0))
    reply = talk.reply("answer", at=30.0)
    assert (reply.kind, reply.sim_time) == ("answer", 7.0)


def test_passengers_do_not_hear_one_another() -> None:
    talk = Talk(SCRIPTED)
    talk.reply("answer", session="ada")
    assert len(talk.dialogue.session("ada").turns) == 1
    assert talk.dialogue.session("bob").turns == ()


def test_a_choice_can_be_picked_by_its_number() -> None:
    first, second = Query(type="why", time="first"), Query(type="what", time="second")

    def parse(text: str, _: frozenset[int], __: Query | None) -> Query | NotUnderstood:
        return NotUnderstood("ambiguous", readings=(first, second))

    talk = Talk(Mind(parse, SCRIPTED.explain))
    asked_back = talk.reply("either")
    assert (asked_back.kind, asked_back.reason) == ("clarification", "ambiguous")
    assert len(asked_back.choices) == 2
    assert talk.reply("the second one").query == second
    assert talk.reply("2").reason == "not-understood"  # the choices were there for one turn


def test_an_answer_that_only_could_not_be_made_sure_of_is_given_all_the_same() -> None:
    talk = Talk(real_mind())
    wanted = talk.ask("Why did you change left?")
    assert isinstance(wanted, RolloutsWanted)
    assert wanted.need.removed == 1
    answered = talk.put(RolloutsFailed("q", "ada", "planner-unavailable"))
    assert isinstance(answered, Answered)
    assert answered.reply.kind == "answer"
    assert "vehicle 1" in answered.reply.text
    assert answered.reply.explanation is not None
    assert answered.reply.explanation.causes[0].necessary is None
