import contextlib
import itertools
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.scene import Scene
from tests.dialogue.scripted import scripted_pipeline
from tests.fakes import again
from tests.traces import s1_ride
from xavi_dialogue.dialogue.manager import MAX_ROUNDS, MAX_SCENES, advance, fold
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    Cancelled,
    EventRecorded,
    Forgotten,
    Input,
    Resumed,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    SceneSeen,
    TraceRecorded,
    TurnedAway,
)
from xavi_dialogue.dialogue.state.state import Dialogue, Session, up_to
from xavi_dialogue.dialogue.state.states import (
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
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.transcripts.state_diagram import drawn

ROOT = Path(__file__).resolve().parents[3]
RIDE = s1_ride(draws=20)
PIPELINE = scripted_pipeline()


def turns_of(*texts: str) -> tuple[Turn, ...]:
    """The turns of a conversation in which these were asked."""
    state = fold(PIPELINE, map(TraceRecorded, RIDE.traces))
    state = fold(PIPELINE, (Asked("q", "ada", text, 7.0) for text in texts), state)
    return state.session("ada").turns


# What "lack", "lack more" and "lack forever" wait for, one after another.
PLANNED = [
    again(RIDE.traces[0], NeedRollout(trace_id=RIDE.traces[0].trace_id, rollouts=rollouts))
    for rollouts in range(1, MAX_ROUNDS + 1)
]
SCENES = [Scene(time, RIDE.traces[0].scene) for time in (3.9, 4.0, 6.5)]
TURNS = turns_of("answer", "refuse", "either")
requests = st.sampled_from(["q1", "q2"])
sessions = st.sampled_from(["ada", "bob"])
texts = st.sampled_from(
    [
        *("answer", "refuse", "huh", "either", "the second", "quiz me"),
        *("lack", "lack more", "lack forever"),
    ]
)
asked = st.builds(Asked, requests, sessions, texts, at=st.sampled_from([4.0, 7.0]))
inputs = st.one_of(
    asked,
    st.builds(TurnedAway, asked, st.sampled_from(["timed-out", "planner-unavailable"])),
    st.builds(RolloutsArrived, requests, sessions, st.sampled_from([*RIDE.traces, *PLANNED])),
    st.builds(RolloutsFailed, requests, sessions, st.just("planner-failed")),
    st.builds(Cancelled, requests, sessions),
    st.builds(Forgotten, sessions),
    st.builds(Resumed, sessions, st.sampled_from([(), TURNS, TURNS[:1]])),
    st.builds(TraceRecorded, st.sampled_from(RIDE.traces)),
    st.builds(EventRecorded, st.sampled_from(RIDE.events)),
    st.builds(SceneSeen, st.sampled_from(SCENES)),
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


def test_the_diagram_in_the_documents_is_that_of_the_table() -> None:
    document = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    assert drawn(document) == document, "make diagram writes it anew"


def test_the_diagram_shows_every_transition() -> None:
    drawn = diagram()
    assert drawn.count("-->") == len(PHASES) + len(RIDE_PHASES) + 2
    assert "listening --> thinking: asked" in drawn


@given(st.lists(inputs, max_size=25))
def test_any_row_of_inputs_ends_in_a_legal_state(row: list[Input]) -> None:
    state = fold(PIPELINE, map(TraceRecorded, RIDE.traces))
    legal: list[Input] = []
    for one in row:
        try:
            after_it, outputs = advance(PIPELINE, state, one)
        except IllegalEvent:
            continue
        legal.append(one)
        questions = isinstance(one, Asked | TurnedAway | RolloutsArrived | RolloutsFailed)
        assert len(outputs) == int(questions)
        assert all(isinstance(output, Answered | RolloutsWanted) for output in outputs)
        for session in after_it.sessions.values():
            assert session.phase is not Phase.THINKING
            assert (session.pending is not None) == (session.phase is Phase.PLANNING)
            kept = [turn for turn in session.turns if not turn.turned_away]
            assert session.phase is not Phase.CHOOSING or kept[-1].offer is not None
            assert session.phase is not Phase.QUIZZING or kept[-1].quiz is not None
        state = after_it
    assert fold(PIPELINE, [*map(TraceRecorded, RIDE.traces), *legal]) == state


@given(st.lists(inputs, max_size=12), inputs)
def test_the_state_before_an_input_is_left_as_it_was(row: list[Input], last: Input) -> None:
    state = Dialogue()
    for one in row:
        with contextlib.suppress(IllegalEvent):
            state, _ = advance(PIPELINE, state, one)
    before = (state.ride, state.traces, state.events, dict(state.sessions), dict(state.planned))
    with contextlib.suppress(IllegalEvent):
        advance(PIPELINE, state, last)
    after = (state.ride, state.traces, state.events, dict(state.sessions), dict(state.planned))
    assert after == before


@given(st.lists(texts, max_size=6), st.lists(texts, max_size=4))
def test_a_conversation_that_is_resumed_goes_on_as_it_would_have(
    before: list[str], later: list[str]
) -> None:
    began = fold(PIPELINE, map(TraceRecorded, RIDE.traces))
    asked = [Asked("q", "ada", text, 7.0) for text in before if not text.startswith("lack")]
    lived = fold(PIPELINE, asked, began)
    stored = [msgspec.json.encode(turn) for turn in lived.session("ada").turns]
    turns = tuple(msgspec.json.decode(line, type=Turn) for line in stored)
    resumed = fold(PIPELINE, [Resumed("ada", turns)], began)
    assert resumed.session("ada") == lived.session("ada")
    more = [Asked("q", "ada", text, 7.0) for text in later if not text.startswith("lack")]
    gone_on = [fold(PIPELINE, more, state).session("ada") for state in (resumed, lived)]
    assert gone_on[0] == gone_on[1]


def test_a_conversation_is_resumed_before_it_goes_on_and_not_after() -> None:
    state = fold(PIPELINE, [*map(TraceRecorded, RIDE.traces), Asked("q", "ada", "answer", 7.0)])
    with pytest.raises(IllegalEvent, match="resumed"):
        advance(PIPELINE, state, Resumed("ada", TURNS))


def test_what_was_offered_about_another_ride_is_void() -> None:
    state = fold(PIPELINE, [TraceRecorded(RIDE.traces[1]), Resumed("ada", TURNS)])
    assert state.session("ada").phase is Phase.LISTENING
    assert state.session("ada").turns == TURNS


def test_a_forgotten_conversation_begins_anew() -> None:
    state = fold(
        PIPELINE, [*map(TraceRecorded, RIDE.traces), Resumed("ada", TURNS), Forgotten("ada")]
    )
    assert state.session("ada") == Session()


def test_the_record_holds_what_was_seen_last_up_to_its_moment() -> None:
    state = fold(PIPELINE, map(SceneSeen, [*SCENES, SCENES[0]]))
    assert [scene.time for scene in state.scenes] == [4.0, 6.5, 3.9]
    assert [state.record(at).scene for at in (3.0, 4.2, 7.0)] == [None, SCENES[1], SCENES[2]]
    assert up_to(state.record(7.0), 5.0).scene is None


def test_no_more_than_the_latest_scenes_are_kept() -> None:
    seen = (Scene(k / 10.0, RIDE.traces[0].scene) for k in range(3 * MAX_SCENES))
    state = fold(PIPELINE, map(SceneSeen, seen))
    assert [state.scenes[0].time, len(state.scenes)] == [2 * MAX_SCENES / 10.0, MAX_SCENES]
