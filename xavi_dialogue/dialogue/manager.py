"""Manager: the dialogue without I/O. It maps inputs to outputs; its state is a fold over inputs.

It has no sockets, clock or threads. If an answer lacks evidence, it puts out RolloutsWanted and
continues when RolloutsArrived or RolloutsFailed comes in. An input that the present state does
not permit raises IllegalEvent and changes nothing.
"""

from collections.abc import Iterable
from dataclasses import replace
from typing import TypeAlias

import msgspec

from planner.record.trace import PlanTrace, WhatIf
from xavi_dialogue.dialogue.pipeline import Pipeline, Said, Situation, turn_away
from xavi_dialogue.dialogue.quizzes.quizzing import reply_to
from xavi_dialogue.dialogue.standing import failed
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    Cancelled,
    EventRecorded,
    Forgotten,
    Input,
    Output,
    PlannedAhead,
    RecordMissing,
    Resumed,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    SceneSeen,
    TraceRecorded,
    TurnedAway,
)
from xavi_dialogue.dialogue.state.memory import remember
from xavi_dialogue.dialogue.state.state import Dialogue, Pending, Session
from xavi_dialogue.dialogue.state.states import (
    PHASES,
    RIDE_PHASES,
    IllegalEvent,
    Move,
    Phase,
    RideMove,
    after,
)
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.dialogue.understanding import understand
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.history.record import Record

MAX_ROUNDS = 12  # maximum of new plans for one act of a question
MAX_TRACES = 300  # maximum of decisions of a ride that are remembered; the oldest are forgotten
MAX_EVENTS = 2000
MAX_SCENES = 100  # needed for questions about a moment just before
MAX_GAPS = 100  # in the record
MAX_PLANNED = 100  # decisions planned again
MAX_TURNS = 400  # of a session

Step: TypeAlias = tuple[Dialogue, tuple[Output, ...]]


def advance(pipeline: Pipeline, dialogue: Dialogue, event: Input) -> Step:
    """Return the state and the outputs after one input.

    Raises:
        IllegalEvent: the present state does not permit the input.
    """
    match event:
        case TraceRecorded() | EventRecorded() | SceneSeen() | RecordMissing() | RideEnded():
            return _record(dialogue, event), ()
        case Asked():
            return _ask(pipeline, dialogue, event)
        case TurnedAway():
            return _turn_away(pipeline, dialogue, event)
        case RolloutsArrived():
            return _go_on(pipeline, dialogue, event)
        case RolloutsFailed():
            return _give_up(pipeline, dialogue, event)
        case PlannedAhead(need, trace):
            return _planned(dialogue, need, trace), ()
        case Cancelled(request, name):
            session, _ = _waiting(dialogue, request, name, Move.CANCELLED)
            return _with(dialogue, name, session), ()
        case Resumed(name, turns):
            return _with(dialogue, name, _resumed(dialogue, name, turns)), ()
        case Forgotten(name):
            phase = after(PHASES, dialogue.session(name).phase, Move.FORGOTTEN)
            return _with(dialogue, name, Session(phase)), ()


def fold(pipeline: Pipeline, events: Iterable[Input], dialogue: Dialogue | None = None) -> Dialogue:
    """Return the state after a series of inputs."""
    state = Dialogue() if dialogue is None else dialogue
    for event in events:
        state, _ = advance(pipeline, state, event)
    return state


def _record(
    dialogue: Dialogue,
    event: TraceRecorded | EventRecorded | SceneSeen | RecordMissing | RideEnded,
) -> Dialogue:
    move = RideMove.ENDED if isinstance(event, RideEnded) else RideMove.RECORDED
    phase = after(RIDE_PHASES, dialogue.ride, move)
    match event:
        case TraceRecorded(trace, first):
            name = dialogue.ride_id or first or trace.trace_id
            traces = (*dialogue.traces, trace)[-MAX_TRACES:]
            return replace(dialogue, ride=phase, ride_id=name, traces=traces)
        case EventRecorded(happened):
            events = (*dialogue.events, happened)[-MAX_EVENTS:]
            return replace(dialogue, ride=phase, events=events)
        case SceneSeen(scene):
            others = (one for one in dialogue.scenes if one.time != scene.time)
            return replace(dialogue, ride=phase, scenes=(*others, scene)[-MAX_SCENES:])
        case RecordMissing(since, until):
            return replace(dialogue, gaps=(*dialogue.gaps, (since, until))[-MAX_GAPS:])
        case RideEnded(at):
            return replace(dialogue, ride=phase, ended_at=at)


def _ask(pipeline: Pipeline, dialogue: Dialogue, asked: Asked) -> Step:
    session = dialogue.session(asked.session)
    phase = after(PHASES, session.phase, Move.ASKED)
    now = _situation(pipeline, dialogue, session, Pending(asked))
    if phase is Phase.PLANNING:
        return _tell(dialogue, session, asked, turn_away(now, "busy"))
    understood = understand(now, _open_turn(session))
    session = replace(session, phase=phase)
    return _think(dialogue, session, now, Pending(asked, understood))


def _think(dialogue: Dialogue, session: Session, now: Situation, question: Pending) -> Step:
    """Answer act by act; plans that were made before are used again."""
    while True:
        assert question.understood is not None
        found = reply_to(now, question.understood, question.done)
        if isinstance(found, Said):
            return _speak(dialogue, session, question.asked, found)
        question = replace(question, done=found.done)
        step = _evidence(dialogue, question, found.need)
        if step is None:
            return _want(dialogue, session, replace(question, need=found.need))
        question = step
        now = replace(now, record=_record_for(dialogue, question))


def _evidence(dialogue: Dialogue, question: Pending, need: NeedRollout) -> Pending | None:
    """Return the question with the plan that it needs, or a failure; None: it must be planned."""
    understood, extra = question.understood, question.extra
    assert understood is not None
    known = dialogue.planned.get(need)
    rounds = MAX_ROUNDS * max(1, len(understood.acts))
    endless = len(extra) >= rounds or known in extra
    if endless and understood.aim == "quiz":  # there are other questions to ask
        return replace(question, refused=(*question.refused, need))
    if endless:
        return replace(question, done=(*question.done, (failed("too-little-evidence"),)))
    if need in question.refused:  # it cannot be answered without the plan
        why = failed(question.why, roadless=question.roadless)
        return replace(question, done=(*question.done, (why,)))
    return None if known is None else replace(question, extra=(*extra, known))


def _situation(
    pipeline: Pipeline, dialogue: Dialogue, session: Session, question: Pending
) -> Situation:
    memory = remember(session.turns, dialogue.ride_id)
    return Situation(pipeline, memory, question.asked, _record_for(dialogue, question))


def _record_for(dialogue: Dialogue, question: Pending) -> Record:
    return dialogue.record(question.asked.at, question.extra, question.refused)


def _want(dialogue: Dialogue, session: Session, pending: Pending) -> Step:
    phase = after(PHASES, session.phase, Move.LACKED)
    session = replace(session, phase=phase, pending=pending)
    asked = pending.asked
    assert pending.need is not None
    wanted = RolloutsWanted(asked.request, asked.session, pending.need)
    return _with(dialogue, asked.session, session), (wanted,)


def _waiting(dialogue: Dialogue, request: str, name: str, move: Move) -> tuple[Session, Pending]:
    """Return the session that waits for rollouts for this request, after the move.

    Raises:
        IllegalEvent: it waits for nothing, or for another request.
    """
    session = dialogue.session(name)
    phase = after(PHASES, session.phase, move)
    pending = session.pending
    if pending is None or pending.asked.request != request:
        raise IllegalEvent(f"{move.value!r} for {request!r}, which waits for nothing")
    return replace(session, phase=phase, pending=None), pending


def _go_on(pipeline: Pipeline, dialogue: Dialogue, event: RolloutsArrived) -> Step:
    session, pending = _waiting(dialogue, event.request, event.session, Move.PLANNED)
    assert pending.need is not None
    dialogue = _planned(dialogue, pending.need, event.trace)
    pending = replace(pending, extra=(*pending.extra, event.trace))
    return _think(dialogue, session, _situation(pipeline, dialogue, session, pending), pending)


def _planned(dialogue: Dialogue, need: NeedRollout, trace: PlanTrace) -> Dialogue:
    """Remember a decision that was planned again.

    Raises:
        IllegalEvent: it is not the decision that was needed.
    """
    if not _is_wanted(dialogue, need, trace):
        raise IllegalEvent("rollouts that are not those that were needed")
    planned = [*dialogue.planned.items(), (need, trace)][-MAX_PLANNED:]
    return replace(dialogue, planned=dict(planned))


def _is_wanted(dialogue: Dialogue, need: NeedRollout, trace: PlanTrace) -> bool:
    """Check whether a trace is the needed decision, planned again as wanted."""
    if trace.what_if != msgspec.convert(msgspec.to_builtins(need), WhatIf):
        return False
    moment = (trace.sim_time, trace.decision)
    known = (t for t in dialogue.traces if (t.sim_time, t.decision) == moment)
    return any(t.trace_id == need.trace_id for t in known)


def _give_up(pipeline: Pipeline, dialogue: Dialogue, event: RolloutsFailed) -> Step:
    """Answer without the rollouts if that is possible; else state why they failed."""
    session, pending = _waiting(dialogue, event.request, event.session, Move.PLANNING_FAILED)
    assert pending.need is not None
    refused = (*pending.refused, pending.need)
    why = replace(pending, refused=refused, why=event.reason, roadless=event.roadless)
    return _think(dialogue, session, _situation(pipeline, dialogue, session, why), why)


def _turn_away(pipeline: Pipeline, dialogue: Dialogue, event: TurnedAway) -> Step:
    asked = event.asked
    session = dialogue.session(asked.session)
    session = replace(session, phase=after(PHASES, session.phase, Move.TURNED_AWAY))
    said = turn_away(_situation(pipeline, dialogue, session, Pending(asked)), event.reason)
    return _tell(dialogue, session, asked, said)


def _speak(dialogue: Dialogue, session: Session, asked: Asked, said: Said) -> Step:
    """End the turn that was being answered."""
    session = replace(session, phase=after(PHASES, session.phase, _ending(said)))
    return _tell(dialogue, session, asked, said)


def _tell(dialogue: Dialogue, session: Session, asked: Asked, said: Said) -> Step:
    """Put out the reply, and keep the turn."""
    turn = said.turn(asked, dialogue.ride_id)
    session = replace(session, turns=(*session.turns, turn)[-MAX_TURNS:])
    answered = Answered(asked.request, asked.session, said.reply, turn)
    return _with(dialogue, asked.session, session), (answered,)


def _ending(said: Said | Turn) -> Move:
    if said.offer is not None:
        return Move.ASKED_BACK
    return Move.QUIZZED if said.quiz is not None else Move.ANSWERED


def _open_turn(session: Session) -> Turn | None:
    """Return the turn that ended with a question of ours, which the next text may answer."""
    if session.phase not in (Phase.CHOOSING, Phase.QUIZZING):
        return None
    return next(turn for turn in reversed(session.turns) if not turn.turned_away)


def _resumed(dialogue: Dialogue, name: str, turns: tuple[Turn, ...]) -> Session:
    """Return the session as its last turn left it; offers of another ride have expired.

    Raises:
        IllegalEvent: the session has turns already.
    """
    if dialogue.session(name) != Session():
        raise IllegalEvent(f"'resumed' for {name!r}, which has gone on already")
    thinking = after(PHASES, Phase.LISTENING, Move.ASKED)
    last = next((turn for turn in reversed(turns) if not turn.turned_away), None)
    if last is None or last.ride != dialogue.ride_id:
        return Session(turns=turns)
    return Session(after(PHASES, thinking, _ending(last)), turns)


def _with(dialogue: Dialogue, name: str, session: Session) -> Dialogue:
    sessions = {**dialogue.sessions, name: session}
    if session == Session():  # a session without turns is the same as none
        del sessions[name]
    return replace(dialogue, sessions=sessions)
