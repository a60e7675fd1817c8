"""Answers about who goes first: all who matter, on what it rests, and who has to move first."""

from tests.nlg.scenery import NOW
from xavi_dialogue.domain.answers import Answer, Priority, Unblocking

CASES: tuple[Answer, ...] = (
    Priority(NOW, "give-way", 1, others=(2,), after=(3,), why="across"),
    Priority(NOW, "give-way", 1, after=(2, 3), why="across"),
    Priority(NOW, "give-way", 1, why="right", apart=(2,)),
    Priority(NOW, "priority", 1, apart=(2,)),
    Priority(NOW, "give-way", 1, others=(2,), number=True),
    Priority(NOW, "none", number=True),
    Unblocking(NOW, 1),
    Unblocking(NOW, 1, going=True),
    Unblocking(NOW, 1, waits=(2, 3)),
    *(Priority(NOW, "give-way", 1, why=why) for why in ("beside", "on-foot", "road")),
    *(Priority(NOW, "give-way", 1, others=(2,), why=why) for why in ("beside", "road")),
)
