"""Turn: one question and its reply, with all that later turns need of it. Plain data."""

from typing import Literal

import msgspec

from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.when import Focus

#: What kind of thing the passenger is asked for.
QuizKind = Literal["vehicle", "deed", "sooner"]
#: What a reply comes to; "passed": the passenger does not know, or does not commit to one answer.
Judgement = Literal["right", "wrong", "passed"]


class Quiz(msgspec.Struct, frozen=True, kw_only=True):
    """A question of ours to the passenger, and the answer that follows from the record."""

    kind: QuizKind
    about: Query  # the question whose explanation is the answer
    vehicle: int | None = None  # of kind vehicle: the one that is meant
    actions: tuple[QueryAction, ...] = ()  # of kind deed: what we would have done
    same: bool | None = None  # of kind deed: whether that is what we did anyway
    sooner: bool | None = None  # whether we would have been there sooner; None: not clear


class Turn(msgspec.Struct, frozen=True, kw_only=True):
    """One question and its reply."""

    text: str  # as asked; where a choice was picked, the question it stands for
    query: Query | None  # as understood, with vehicles by number
    reply: Reply
    ride: str | None = None  # id of the first trace of the ride that it is about
    leans: Query | None = None  # what a follow-up leans on, where that is not the query
    focus: Focus | None = None  # the part of the ride that it is about
    mentioned: tuple[int, ...] = ()  # vehicles that question and reply name, the latest last
    choices: tuple[Query, ...] = ()  # offered by the reply
    quiz: Quiz | None = None  # put by the reply
    answered: Quiz | None = None  # which the text answers ...
    right: bool | None = None  # ... and whether rightly; None: the passenger does not know
    turned_away: bool = False  # the question was not taken up
