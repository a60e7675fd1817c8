"""Memory: what later turns depend on, derived from the turns of a conversation.

Vehicles and offers belong to the ride in which they came up. The level of detail that the passenger
wants is kept from ride to ride.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from xavi_dialogue.dialogue.state.discourse import causes_in, discourse_of
from xavi_dialogue.dialogue.state.turn import Quiz, Turn
from xavi_dialogue.domain.answers import Answer, Refusal
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Feel, Repair, Request
from xavi_dialogue.nlg.context import Detail, Told

_FRESH = 3  # replies before a suggestion may be repeated
_STANDING = 2  # successive requests for more, or less, that make it permanent
_WISHES: dict[str, Detail] = {"longer": "more", "shorter": "less", "simpler": "simpler"}


@dataclass(frozen=True, slots=True)
class Memory:
    """The parts of a conversation that later turns depend on."""

    turns: tuple[Turn, ...]  # about this ride, oldest first
    discourse: Discourse
    named: frozenset[int]  # vehicles that were mentioned
    last: Turn | None  # the last turn that was about the drive
    detail: Detail  # how much the passenger wants to hear
    missed: frozenset[int]  # vehicles whose role the passenger got wrong
    quizzed: tuple[Quiz, ...]  # questions put to the passenger so far
    suggested: frozenset[str]  # questions that the last replies suggested

    @property
    def is_quizzing(self) -> bool:
        """Check whether the last turn asked the passenger a question, or judged the reply."""
        last = self.turns[-1] if self.turns else None
        return last is not None and (last.quiz is not None or last.answered is not None)

    @property
    def told(self) -> Told:
        """Return the causes that were stated to the passenger, except those that they got wrong."""
        causes = {cause for turn in self.turns for cause in causes_in(turn)}
        return frozenset(cause for cause in causes if cause[0] not in self.missed)

    def answered(self, act: GroundedAct, result: Answer | Refusal) -> bool:
        """Check whether the same result answered a question of the same kind before."""
        return any(
            part.act is not None and _kind(part.act.act) == _kind(act.act) and part.result == result
            for turn in self.turns
            for part in turn.parts
        )


def remember(turns: Sequence[Turn], ride: str | None) -> Memory:
    """Return the memory of the turns of a conversation, oldest first, during a ride."""
    here = tuple(turn for turn in turns if turn.ride == ride)
    about = [turn for turn in here if is_about_drive(turn)]
    return Memory(
        turns=here,
        discourse=discourse_of(here),
        named=frozenset(name for turn in here for name in turn.mentioned),
        last=about[-1] if about else None,
        detail=_detail(turns),
        missed=_missed(here),
        quizzed=tuple(turn.quiz for turn in here if turn.quiz is not None),
        suggested=frozenset(
            offer
            for turn in here[-_FRESH:]
            for offer in turn.reply.suggestions
            if offer in turn.reply.text
        ),
    )


def is_about_drive(turn: Turn) -> bool:
    """Check whether a turn was about the drive, so that follow-ups can refer to it."""
    return any(isinstance(one.act, Ask | Claim | Request | Feel) for one in turn.acts)


def _kind(act: Act) -> type:
    """Return the type of an act, or of its question."""
    return type(act.question if isinstance(act, Ask) else act)


def _detail(turns: Sequence[Turn]) -> Detail:
    """Return the level of detail that was wanted twice in a row, until another one is wanted."""
    standing: Detail = "usual"
    run: list[Detail] = []
    for turn in turns:
        for act in turn.acts:
            if not isinstance(act.act, Repair) or act.act.kind not in _WISHES:
                continue
            wanted = _WISHES[act.act.kind]
            run = [*run, wanted] if run[-1:] == [wanted] else [wanted]
            if wanted != standing:
                standing = "usual"
            if len(run) >= _STANDING:
                standing = wanted
    return standing


def _missed(turns: Sequence[Turn]) -> frozenset[int]:
    missed: set[int] = set()
    for turn in turns:
        if turn.answered is None or turn.right is None:
            continue
        vehicles = {vehicle for vehicle, _ in causes_in(turn)}
        missed = missed - vehicles if turn.right else missed | vehicles
    return frozenset(missed)
