"""Memory: what later turns may draw on, read off the turns of a conversation.

Vehicles and offers belong to the ride in which they came up; what was explained, and how much
the passenger wants to hear, outlasts it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from xavi_dialogue.dialogue.turn import Quiz, Turn
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Detail, Query
from xavi_dialogue.language.context import Told, told

_TALK = frozenset({"smalltalk", "help", "out_of_scope", "ambiguous"})
_FRESH = 3  # replies after which the same may be suggested again
_STANDING = 2  # requests in a row for more, or less, that make it the rule


@dataclass(frozen=True, slots=True)
class Memory:
    """What a conversation has come to."""

    turns: tuple[Turn, ...]  # about this ride, oldest first
    before: int  # turns about other rides
    named: frozenset[int]  # vehicles that were spoken of
    topic: int | None  # the one that was spoken of last
    last: Turn | None  # the last turn that was about the drive
    detail: Detail | None  # how much the passenger wants to hear
    missed: frozenset[int]  # vehicles whose part in things the passenger got wrong
    quizzed: tuple[Quiz, ...]  # questions put to the passenger so far
    suggested: frozenset[str]  # what the last replies said could be asked

    @property
    def is_quizzing(self) -> bool:
        """Whether the last turn put a question to the passenger, or judged the answer to one."""
        last = self.turns[-1] if self.turns else None
        return last is not None and (last.quiz is not None or last.answered is not None)

    @property
    def previous(self) -> Query | None:
        """What a follow-up leans on; how much was to be told is said anew each time."""
        leans = None if self.last is None else self.last.leans or self.last.query
        return None if leans is None else msgspec.structs.replace(leans, detail=None)

    @property
    def asked(self) -> tuple[Query, ...]:
        """What was asked so far, oldest first."""
        return tuple(turn.query for turn in self.turns if turn.query is not None)

    @property
    def told(self) -> Told:
        """The causes that the passenger was told of, and did not get wrong since."""
        causes = {cause for found in self.explained for cause in told(found)}
        return frozenset(cause for cause in causes if cause[0] not in self.missed)

    def answered(self, query: Query, found: Explanation) -> bool:
        """Whether the same was answered before to the same question, however it was worded."""
        return any(
            turn.query is not None
            and turn.reply.explanation == found
            and _asks_for(turn.query) == _asks_for(query)
            for turn in self.turns
        )

    @property
    def explained(self) -> tuple[Explanation, ...]:
        """What was answered so far, oldest first."""
        found = (turn.reply.explanation for turn in self.turns)
        return tuple(one for one in found if one is not None)


def _asks_for(query: Query) -> tuple[object, ...]:
    return (query.type, query.actor, query.factual, query.counterfactual, query.detail)


def remember(turns: Sequence[Turn], ride: str | None) -> Memory:
    """What the turns of a conversation, oldest first, come to during a ride."""
    here = tuple(turn for turn in turns if turn.ride == ride)
    named = [name for turn in here for name in turn.mentioned]
    about = [turn for turn in here if turn.query is not None and turn.query.type not in _TALK]
    return Memory(
        turns=here,
        before=len(turns) - len(here),
        named=frozenset(named),
        topic=named[-1] if named else None,
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


def _detail(turns: Sequence[Turn]) -> Detail | None:
    """What was asked for twice in a row, until the opposite is asked for."""
    standing: Detail | None = None
    run: list[Detail] = []
    for turn in turns:
        wanted = None if turn.query is None else turn.query.detail
        if wanted is None:
            continue
        run = [*run, wanted] if run[-1:] == [wanted] else [wanted]
        if standing is not None and wanted != standing:
            standing = None
        if len(run) >= _STANDING:
            standing = wanted
    return standing


def _missed(turns: Sequence[Turn]) -> frozenset[int]:
    missed: set[int] = set()
    for turn in turns:
        if turn.answered is None or turn.right is None:
            continue
        known = turn.reply.explanation
        vehicles = set() if known is None else {cause.vehicle for cause in known.causes}
        missed = missed - vehicles if turn.right else missed | vehicles
    return frozenset(missed)
