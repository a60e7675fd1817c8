import contextlib
import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.fakes import scripted_mind
from tests.traces import s1_ride
from xavi_dialogue.dialogue.events import (
    Answered,
    Asked,
    Cancelled,
    EventRecorded,
    Input,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TraceRecorded,
    TurnedAway,
)
from xavi_dialogue.dialogue.manager import advance, fold
from xavi_dialogue.dialogue.state import Dialogue
from xavi_dialogue.dialogue.states import (
    PHASES,
    RIDE_PHASES,
    IllegalEvent,
    Move,
    Phase,
    RideMove,
    RidePhase,
    after,
    diagram,
)

RIDE = s1_ride(draws=20)
MIND = scripted_mind()

requests = st.sampled_from(["q1", "q2"])
sessions = st.sampled_from(["ada", "bob"])
texts = st.sampled_from(["answer", "lack", "lack more", "lack forever", "refuse", "huh"])
asked = st.builds(Asked, requests, sessions, texts, at=st.sampled_from([4.0, 7.0]))
inputs = st.one_of(
    asked,
    st.builds(TurnedAway, asked, st.sampled_from(["timed-out", "planner-unavailable"])),
    st.builds(RolloutsArrived, requests, sessions, st.sampled_from(RIDE.traces)),
    st.builds(RolloutsFailed, requests, sessions, st.just("planner-failed")),
    st.builds(Cancelled, requests, sessions),
    st.builds(TraceRecorded, st.sampled_from(RIDE.traces)),
    st.builds(EventRecorded, st.sampled_from(RIDE.events)),
    st.builds(RideEnded, st.just(7.0)),
)


@pytest.mark.parametrize(("state", "move"), [*itertools.product(Phase, Move)])
def test_a_session_moves_as_the_table_says_or_refuses(state: Phase, move: Move) -> None:
    if (state, move) in PHASES:
        assert after(PHASES, state, move) is PHASES[state, move]
    else:
        with pytest.raises(IllegalEvent, match=move.value):
            after(PHASES, state, move)


@pytest.mark.parametrize(("state", "move"), [*itertools.product(RidePhase, RideMove)])
def test_a_ride_moves_as_the_table_says_or_refuses(state: RidePhase, move: RideMove) -> None:
    if (state, move) in RIDE_PHASES:
        assert after(RIDE_PHASES, state, move) is RIDE_PHASES[state, move]
    else:
        with pytest.raises(IllegalEvent, match=state.value):
            after(RIDE_PHASES, state, move)


def test_every_phase_can_be_reached_and_left() -> None:
    assert {after for (before, _), after in PHASES.items() if before is not after} == set(Phase)
    assert {before for (before, _), after in PHASES.items() if before is not after} == set(Phase)


def test_the_diagram_shows_every_transition() -> None:
    drawn = diagram()
    assert drawn.count("-->") == len(PHASES) + len(RIDE_PHASES) + 2
    assert "listening --> thinking: asked" in drawn


@given(st.lists(inputs, max_size=25))
def test_any_row_of_inputs_ends_in_a_legal_state(row: list[Input]) -> None:
    state = fold(MIND, map(TraceRecorded, RIDE.traces))
    legal: list[Input] = []
    for one in row:
        try:
            after_it, outputs = advance(MIND, state, one)
        except IllegalEvent:
            continue
        legal.append(one)
        questions = isinstance(one, Asked | TurnedAway | RolloutsArrived | RolloutsFailed)
        assert len(outputs) == int(questions)
        assert all(isinstance(output, Answered | RolloutsWanted) for output in outputs)
        for session in after_it.sessions.values():
            assert session.phase is not Phase.THINKING
            assert (session.pending is not None) == (session.phase is Phase.PLANNING)
        state = after_it
    assert fold(MIND, [*map(TraceRecorded, RIDE.traces), *legal]) == state


@given(st.lists(inputs, max_size=12), inputs)
def test_the_state_before_an_input_is_left_as_it_was(row: list[Input], last: Input) -> None:
    state = Dialogue()
    for one in row:
        with contextlib.suppress(IllegalEvent):
            state, _ = advance(MIND, state, one)
    before = (state.ride, state.traces, state.events, dict(state.sessions), dict(state.planned))
    with contextlib.suppress(IllegalEvent):
        advance(MIND, state, last)
    after = (state.ride, state.traces, state.events, dict(state.sessions), dict(state.planned))
    assert after == before
