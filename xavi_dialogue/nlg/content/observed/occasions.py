"""Occasions: when something that was counted happened, and with whom."""

from math import inf

from xavi_dialogue.domain.answers import Counted
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Event, Thing, Vehicle
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Moment, Who

BETWEEN = 0.5  # [s] minimum pause between two times that count as two
TOWARDS = {"give-way": "to", "wait": "for", "let-go": "for"}  # prepositions of their objects
MANY = 5  # maximum number of times that are listed, and of vehicles at each


def occasions_counted(answer: Counted) -> tuple[Message, ...] | None:
    """Return when it happened, each time once, with the vehicle if the question left that open."""
    assert isinstance(answer.of, Event)
    rows = _by_time(answer) if answer.times else _apart(answer)
    if not 0 < len(rows) <= MANY or len(rows) != answer.count:
        return None
    to = TOWARDS.get(answer.of.action)
    return tuple(
        message(
            "OCCASION", when=Moment(begin), to=to, whom=tuple(Who(v, begin) for v in who[:MANY])
        )
        if to is not None and who
        else message("OCCASION", when=Moment(begin))
        for begin, who in rows
    )


def _apart(answer: Counted) -> list[tuple[float, list[Thing]]]:
    """Return the times and the vehicles at each; episodes that overlap are one time."""
    rows: list[tuple[float, list[Thing]]] = []
    until = -inf
    for fact in answer.facts:
        if isinstance(fact, Episode):
            if fact.begin >= until + BETWEEN:
                rows.append((fact.begin, []))
            until = max(until, inf if fact.end is None else fact.end)
            _add(answer, fact, rows)
    return rows


def _by_time(answer: Counted) -> list[tuple[float, list[Thing]]]:
    """Return the times that were counted, and at each the vehicles whose part began in it."""
    rows: list[tuple[float, list[Thing]]] = [(begin, []) for begin in answer.times]
    for fact in answer.facts:
        if isinstance(fact, Episode):
            known = [row for row in rows if row[0] <= fact.begin]
            _add(answer, fact, known or rows[:1])
    return rows


def _add(answer: Counted, fact: Episode, rows: list[tuple[float, list[Thing]]]) -> None:
    """Add to the last time the vehicle of an episode, if the question left that open."""
    assert isinstance(answer.of, Event)
    whom = fact.object
    if isinstance(whom, Vehicle) and whom != answer.of.object and whom not in rows[-1][1]:
        rows[-1][1].append(whom)
