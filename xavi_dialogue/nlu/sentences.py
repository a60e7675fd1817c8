"""Sentences: a text cut at its marks, and the readings of its sentences put together."""

from collections.abc import Iterable, Sequence
from itertools import product
from typing import Final

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Elliptic, Reading, Repair
from xavi_dialogue.nlu.text.tokens import Token, Typed
from xavi_dialogue.nlu.topics import fold

MAX_READINGS: Final = 6
SPREAD: Final = 1.5  # readings that cost this much more than the best are not offered
_STOPS: Final = frozenset({".", "?"})


def sentences(typed: Typed) -> tuple[Typed, ...]:
    """Cut a text where a sentence ends."""
    found: list[Typed] = []
    here: list[Token] = []
    for token in typed.tokens:
        if here and token.mark in _STOPS:
            found.append(Typed(tuple(here), token.mark))
            token = Token(token.text)
            here = []
        here.append(token)
    return (*found, Typed(tuple(here), typed.end))


def appended(first: Typed, second: Typed) -> Typed:
    """Write two sentences as one."""
    begin, *rest = second.tokens
    return Typed((*first.tokens, Token(begin.text, ","), *rest), second.end)


def joined(rows: Sequence[Sequence[Reading]], ends: Sequence[str]) -> tuple[Reading, ...]:
    """Put the readings of sentences together, likeliest first; `ends` are the marks behind."""
    if len(rows) == 1:
        return tuple(rows[0])
    kept = [[r for r in row[:3] if r.cost <= row[0].cost + SPREAD] for row in rows]
    while len(kept) > 3 and len(max(kept, key=len)) > 1:
        del max(kept, key=len)[1:]
    return tuple(unlike(_one(row, ends) for row in product(*kept)))


def unlike(readings: Iterable[Reading]) -> list[Reading]:
    """Give the likeliest of some readings that mean different things, likeliest first."""
    kept: list[Reading] = []
    for reading in sorted(readings, key=lambda reading: reading.cost):
        if kept and (reading.cost > kept[0].cost + SPREAD or len(kept) == MAX_READINGS):
            break
        if all(reading.acts != other.acts for other in kept):
            kept.append(reading)
    return kept


def _one(row: tuple[Reading, ...], ends: Sequence[str]) -> Reading:
    """Put one reading of each sentence together; what is named first is what "he" means."""
    acts = [act for reading in row for act in reading.acts]
    named = {
        id(act)
        for reading, end in zip(row, ends, strict=True)
        for act in reading.acts
        if end != "?" and isinstance(act, Elliptic) and act == Elliptic(act.thing)
    }
    owners: list[int | None] = []
    before = 0
    for reading in row:
        owners += [None if s.act is None else s.act + before for s in reading.shares]
        before += len(reading.acts)
    folded, owners = fold(acts, owners)
    if any(isinstance(act, Ask) for act in folded):
        folded, owners = _without(folded, owners, named)
    folded = [_on_claim(act, folded[:index]) for index, act in enumerate(folded)]
    shares = (share for reading in row for share in reading.shares)
    return Reading(
        tuple(folded),
        tuple(structs.replace(s, act=o) for s, o in zip(shares, owners, strict=True)),
        round(sum(reading.cost for reading in row), 3),
        tuple(unread for reading in row for unread in reading.unread),
    )


def _without(
    acts: list[Act], owners: list[int | None], dropped: set[int]
) -> tuple[list[Act], list[int | None]]:
    """Leave out exclamations such as "a roundabout!"."""
    rank: dict[int, int] = {}
    for index, act in enumerate(acts):
        if id(act) not in dropped:
            rank[index] = len(rank)
    kept = [act for index, act in enumerate(acts) if index in rank]
    return kept, [None if owner is None else rank.get(owner) for owner in owners]


def _on_claim(act: Act, before: list[Act]) -> Act:
    """Read "but why?" behind a claim as the question why that is so."""
    claimed = act == Repair("why") and any(isinstance(other, Claim) for other in before)
    return Elliptic(form="why") if claimed else act
