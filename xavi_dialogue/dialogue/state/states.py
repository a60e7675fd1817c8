"""States: the transition tables of sessions and of the ride.

A session listens, thinks about one question at a time, and may have to wait for new rollouts
before it can continue. It may end a turn with a question of its own: a clarification, or on
request a quiz question, which shows whether the passenger has understood. A ride is under way until
it is over. An input that the table does not contain is an error and changes nothing.
"""

from collections.abc import Mapping
from enum import Enum
from typing import TypeVar

from xavi_dialogue.errors import XaviError


class Phase(Enum):
    """State of a session. THINKING ends within the input that begins it."""

    LISTENING = "listening"
    THINKING = "thinking"
    PLANNING = "planning"
    CHOOSING = "choosing"  # the passenger may pick one of the readings offered
    QUIZZING = "quizzing"  # the passenger may answer a question of ours


class Move(Enum):
    """Transition of a session."""

    ASKED = "asked"
    TURNED_AWAY = "turned away"  # the shell could not have the question answered
    ANSWERED = "answered"
    ASKED_BACK = "asked back"
    QUIZZED = "quizzed"
    LACKED = "lacked evidence"
    PLANNED = "rollouts arrived"
    PLANNING_FAILED = "rollouts failed"
    CANCELLED = "cancelled"
    FORGOTTEN = "forgotten"


class RidePhase(Enum):
    """State of the ride."""

    UNDER_WAY = "under way"
    OVER = "over"


class RideMove(Enum):
    """Transition of the ride."""

    RECORDED = "recorded"
    ENDED = "ended"


PHASES: Mapping[tuple[Phase, Move], Phase] = {
    (Phase.LISTENING, Move.ASKED): Phase.THINKING,
    (Phase.LISTENING, Move.TURNED_AWAY): Phase.LISTENING,
    (Phase.LISTENING, Move.FORGOTTEN): Phase.LISTENING,
    (Phase.CHOOSING, Move.ASKED): Phase.THINKING,
    (Phase.CHOOSING, Move.TURNED_AWAY): Phase.CHOOSING,
    (Phase.CHOOSING, Move.FORGOTTEN): Phase.LISTENING,
    (Phase.QUIZZING, Move.ASKED): Phase.THINKING,
    (Phase.QUIZZING, Move.TURNED_AWAY): Phase.QUIZZING,
    (Phase.QUIZZING, Move.FORGOTTEN): Phase.LISTENING,
    (Phase.THINKING, Move.ANSWERED): Phase.LISTENING,
    (Phase.THINKING, Move.ASKED_BACK): Phase.CHOOSING,
    (Phase.THINKING, Move.QUIZZED): Phase.QUIZZING,
    (Phase.THINKING, Move.LACKED): Phase.PLANNING,
    (Phase.PLANNING, Move.PLANNED): Phase.THINKING,
    (Phase.PLANNING, Move.PLANNING_FAILED): Phase.THINKING,
    (Phase.PLANNING, Move.CANCELLED): Phase.LISTENING,
    (Phase.PLANNING, Move.ASKED): Phase.PLANNING,  # turned away as busy
    (Phase.PLANNING, Move.TURNED_AWAY): Phase.PLANNING,
    (Phase.PLANNING, Move.FORGOTTEN): Phase.LISTENING,
}

RIDE_PHASES: Mapping[tuple[RidePhase, RideMove], RidePhase] = {
    (RidePhase.UNDER_WAY, RideMove.RECORDED): RidePhase.UNDER_WAY,
    (RidePhase.UNDER_WAY, RideMove.ENDED): RidePhase.OVER,
}

State = TypeVar("State", bound=Enum)
Input = TypeVar("Input", bound=Enum)


class IllegalEvent(XaviError):
    """An input that the present state does not permit."""


def after(table: Mapping[tuple[State, Input], State], state: State, move: Input) -> State:
    """Return the next state.

    Raises:
        IllegalEvent: the table has no such transition.
    """
    try:
        return table[state, move]
    except KeyError:
        raise IllegalEvent(f"{move.value!r} cannot happen while {state.value!r}") from None


def diagram() -> str:
    """Return both tables as Mermaid state diagrams, in Markdown."""
    lines = ["```mermaid", "stateDiagram-v2", "    [*] --> listening"]
    lines += [f"    {a.value} --> {b.value}: {move.value}" for (a, move), b in PHASES.items()]
    lines += ["```", "", "```mermaid", "stateDiagram-v2"]
    lines += ['    state "under way" as under_way', "    [*] --> under_way"]
    for (before, happened), then in RIDE_PHASES.items():
        names = [phase.value.replace(" ", "_") for phase in (before, then)]
        lines.append(f"    {names[0]} --> {names[1]}: {happened.value}")
    return "\n".join([*lines, "```"]) + "\n"
