"""What the manager keeps of a ride, and when it stops planning again, with a scripted mind."""

from collections.abc import Iterable
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event
from tests.dialogue.state.test_states import PIPELINE, PLANNED, RIDE
from tests.fakes import again
from xavi_dialogue.dialogue import manager
from xavi_dialogue.dialogue.manager import advance, fold
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    Cancelled,
    EventRecorded,
    Input,
    PlannedAhead,
    RecordMissing,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TraceRecorded,
    TurnedAway,
)
from xavi_dialogue.dialogue.state.state import Dialogue, Session, up_to
from xavi_dialogue.dialogue.state.states import IllegalEvent, Phase
from xavi_dialogue.domain.answers import NeedRollout

FIRST = RIDE.traces[0]


def drove(events: Iterable[Input] = ()) -> Dialogue:
    return fold(PIPELINE, [*map(TraceRecorded, RIDE.traces), *events])


def ask(text: str, name: str = "ada", request: str = "q") -> Asked:
    return Asked(request, name, text, 7.0)


@pytest.mark.parametrize(
    ("bound", "field", "make"),
    [
        ("MAX_EVENTS", "events", lambda k: EventRecorded(Event("gave-way", float(k)))),
        ("MAX_GAPS", "gaps", lambda k: RecordMissing(float(k), k + 0.5)),
        ("MAX_TRACES", "traces", lambda k: TraceRecorded(replace(FIRST, sim_time=float(k)))),
    ],
)
def test_no_more_than_the_latest_are_kept(
    monkeypatch: pytest.MonkeyPatch, bound: str, field: str, make: Any
) -> None:
    assert getattr(manager, bound) >= 100
    monkeypatch.setattr(manager, bound, 3)
    kept = getattr(fold(PIPELINE, map(make, range(5))), field)
    whole = getattr(fold(PIPELINE, map(make, range(2, 5))), field)
    assert kept == whole
    assert len(kept) == 3


def test_the_latest_turns_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    assert manager.MAX_TURNS == 400
    monkeypatch.setattr(manager, "MAX_TURNS", 2)
    state = fold(PIPELINE, map(ask, ("answer", "refuse", "huh")), drove())
    assert [turn.text for turn in state.session("ada").turns] == ["refuse", "huh"]


def test_bounds() -> None:
    bounds = ("MAX_ROUNDS", "MAX_TRACES", "MAX_EVENTS", "MAX_GAPS", "MAX_PLANNED")
    assert [getattr(manager, name) for name in bounds] == [12, 300, 2000, 100, 100]


def test_a_ride_is_named_by_its_first_trace() -> None:
    assert Dialogue().ride_id is None
    assert drove().ride_id == FIRST.trace_id
    named = fold(PIPELINE, [TraceRecorded(RIDE.traces[1], first="name"), TraceRecorded(FIRST)])
    assert named.ride_id == "name"
    state, (output,) = advance(PIPELINE, named, ask("answer"))
    assert isinstance(output, Answered)
    assert output.turn is not None
    assert output.turn.ride == "name"
    assert state.session("ada").turns == (output.turn,)


def test_after_the_ride_its_end_is_now() -> None:
    state = drove([RecordMissing(6.0, 9.0), RecordMissing(8.0, 9.0), RideEnded(7.0)])
    late, early = state.record(9.0), state.record(6.5)
    assert (late.now, late.ended, early.now, early.ended) == (7.0, True, 6.5, False)
    assert late.gaps == early.gaps == ((6.0, 9.0),)
    assert state.record(5.0).gaps == ()
    assert [t.sim_time for t in state.record(5.0).traces] == [2.0, 4.0, 5.0]
    assert [t.sim_time for t in state.record(4.9).traces] == [2.0, 4.0]
    assert state.record(7.0).ended
    running = drove()
    assert (running.record(9.0).now, running.record(9.0).ended) == (9.0, False)


def test_what_was_known_earlier_is_part_of_what_is_known_now() -> None:
    whole = drove([*map(EventRecorded, RIDE.events), RideEnded(7.0)]).record(7.0)
    before = up_to(whole, 4.05)
    assert (before.now, before.ended) == (4.05, False)
    assert [event.sim_time for event in before.events] == [0.0, 4.0, 4.0]
    assert up_to(whole, 7.0) == whole


def round_of(state: Dialogue, number: int) -> tuple[Dialogue, Any]:
    state, (output,) = advance(PIPELINE, state, RolloutsArrived("q", "ada", PLANNED[number]))
    return state, output


def test_planning_again_ends_after_some_rounds() -> None:
    state, (output,) = advance(PIPELINE, drove(), ask("lack forever"))
    for number in range(manager.MAX_ROUNDS):
        assert isinstance(output, RolloutsWanted)
        assert output.need.rollouts == number + 1
        assert (output.request, output.session) == ("q", "ada")
        assert state.session("ada").phase is Phase.PLANNING
        state, output = round_of(state, number)
    assert isinstance(output, Answered)
    assert (output.reply.kind, output.reply.reason) == ("refusal", "too-little-evidence")
    assert state.session("ada").phase is Phase.LISTENING


def test_what_was_planned_again_is_used_at_once() -> None:
    need = NeedRollout(FIRST.trace_id, rollouts=1)
    state = drove([PlannedAhead(need, PLANNED[0])])
    assert state.planned == {need: PLANNED[0]}
    state, (output,) = advance(PIPELINE, state, ask("lack"))
    assert isinstance(output, Answered)
    assert output.reply.kind == "answer"
    # Two were needed: the second one has to be planned.
    _, (output,) = advance(PIPELINE, state, ask("lack more"))
    assert isinstance(output, RolloutsWanted)
    assert output.need.rollouts == 2


def test_no_more_than_the_latest_plans_are_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(manager, "MAX_PLANNED", 2)
    needs = [NeedRollout(FIRST.trace_id, rollouts=k) for k in (1, 2, 3)]
    state = drove(PlannedAhead(need, again(FIRST, need)) for need in needs)
    assert list(state.planned) == needs[1:]


@pytest.mark.parametrize(
    "trace",
    [
        FIRST,  # it was not planned again at all
        PLANNED[1],  # ... as it was wanted
        replace(PLANNED[0], sim_time=2.5),
        replace(PLANNED[0], decision=77),
    ],
)
def test_only_what_was_wanted_is_taken(trace: Any) -> None:
    state, _ = advance(PIPELINE, drove(), ask("lack"))
    with pytest.raises(IllegalEvent, match="not those that were needed"):
        advance(PIPELINE, state, RolloutsArrived("q", "ada", trace))


def test_another_decision_than_the_one_needed_is_not_taken() -> None:
    need = NeedRollout(RIDE.traces[1].trace_id, rollouts=1)
    with pytest.raises(IllegalEvent):
        advance(PIPELINE, drove(), PlannedAhead(need, PLANNED[0]))


def test_plans_that_cannot_be_had_are_refused_with_the_reason() -> None:
    state, _ = advance(PIPELINE, drove(), ask("lack more"))
    state, _ = round_of(state, 0)
    state, (output,) = advance(PIPELINE, state, RolloutsFailed("q", "ada", "timed-out"))
    assert isinstance(output, Answered)
    assert (output.reply.kind, output.reply.reason) == ("refusal", "timed-out")
    assert state.session("ada").pending is None


@pytest.mark.parametrize("make", [Cancelled, lambda q, name: RolloutsFailed(q, name, "timed-out")])
def test_only_the_request_that_waits_can_be_ended(make: Any) -> None:
    state, _ = advance(PIPELINE, drove(), ask("lack"))
    with pytest.raises(IllegalEvent, match="waits for nothing"):
        advance(PIPELINE, state, make("another", "ada"))
    state, _ = advance(PIPELINE, state, make("q", "ada"))
    assert state.session("ada").phase is Phase.LISTENING


def test_a_question_that_was_cancelled_leaves_nothing() -> None:
    state, _ = advance(PIPELINE, drove(), ask("lack"))
    state, outputs = advance(PIPELINE, state, Cancelled("q", "ada"))
    assert outputs == ()
    assert state.sessions == {}
    assert state.session("ada") == Session()


def test_who_asks_meanwhile_is_turned_away() -> None:
    state, _ = advance(PIPELINE, drove(), ask("lack"))
    state, (output,) = advance(PIPELINE, state, ask("answer", request="other"))
    assert isinstance(output, Answered)
    assert (output.request, output.reply.reason) == ("other", "busy")
    assert output.turn is not None
    assert output.turn.turned_away
    assert state.session("ada").phase is Phase.PLANNING
    state, other = round_of(state, 0)
    assert isinstance(other, Answered)
    assert other.reply.kind == "answer"


def test_conversations_do_not_meet() -> None:
    state = fold(PIPELINE, [ask("either"), ask("answer", "bob")], drove())
    assert state.session("ada").phase is Phase.CHOOSING
    assert state.session("bob").phase is Phase.LISTENING
    state = fold(PIPELINE, [TurnedAway(ask("answer"), "planner-unavailable")], state)
    assert state.session("ada").phase is Phase.CHOOSING
    assert [turn.turned_away for turn in state.session("ada").turns] == [False, True]
    _, (output,) = advance(PIPELINE, state, ask("the second"))
    assert isinstance(output, Answered)
    assert output.reply.reason == "too-little-evidence"
