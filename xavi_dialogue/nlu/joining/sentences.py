"""Sentences: a text cut at its marks, and the readings of its sentences put together."""

from collections.abc import Iterable, Sequence
from itertools import islice, product
from typing import Final

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Elliptic, Reading, Repair, Unread, WhatIf
from xavi_dialogue.nlu.demands import set_apart
from xavi_dialogue.nlu.joining.besides import settled
from xavi_dialogue.nlu.joining.demanding import attached
from xavi_dialogue.nlu.joining.topics import fold
from xavi_dialogue.nlu.text.tokens import Token, Typed

MAX_READINGS: Final = 6
SPREAD: Final = 1.5  # readings that cost this much more than the best are not offered
DOUBTFUL: Final = 1.0  # cost from which on a sentence is read as a question by its mark alone
TOLD: Final = 0.5  # what a question costs less that another one asks too
_SUPPOSING: Final = frozenset({"suppose", "supposing", "say", "imagine", "assume", "if"})
_STOPS: Final = frozenset({".", "?"})
LEAST: Final = 2  # [words] of a question, and of what it concedes


def sentences(typed: Typed) -> tuple[Typed, ...]:
    """Cut a text where a sentence ends, and where a mark sets a demand for a reason apart."""
    found: list[Typed] = []
    here: list[Token] = []
    for token in typed.tokens:
        if here and token.mark in _STOPS:
            found.append(Typed(tuple(here), token.mark))
            token = Token(token.text)
            here = []
        here.append(token)
    found.append(Typed(tuple(here), typed.end))
    whole = (part for sentence in found for part in set_apart(sentence))
    return tuple(part for sentence in whole for part in _conceding(sentence))


def _conceding(sentence: Typed) -> tuple[Typed, ...]:
    """Cut a question before what it concedes: "why do they go first, although it is green?"."""
    words = [token.text for token in sentence.tokens]
    for at in range(LEAST, len(words) - LEAST) if sentence.end == "?" else ():
        if words[at] == "although" or words[at : at + 2] == ["even", "though"]:
            begin, *rest = sentence.tokens[at:]
            conceded = Typed((Token(begin.text), *rest), ".")
            return Typed(sentence.tokens[:at], "?"), conceded
    return (sentence,)


def appended(first: Typed, second: Typed) -> Typed:
    """Write two sentences as one."""
    begin, *rest = second.tokens
    return Typed((*first.tokens, Token(begin.text, ","), *rest), second.end)


def joined(rows: Sequence[Sequence[Reading]], ends: Sequence[str]) -> tuple[Reading, ...]:
    """Put the readings of sentences together, likeliest first; `ends` are the marks behind."""
    most = MAX_READINGS if len(rows) == 1 else 3
    kept = [[r for r in row[:most] if r.cost <= row[0].cost + SPREAD] for row in rows]
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
    row = _without_world(row)
    row = _attached(row)
    acts = [act for reading in row for act in reading.acts]
    asked = {
        id(reading.acts[-1])
        for reading, end in zip(row, ends, strict=True)
        if end == "?" and reading.acts
    }
    owners: list[int | None] = []
    before = 0
    for reading in row:
        owners += [None if s.act is None else s.act + before for s in reading.shares]
        before += len(reading.acts)
    spoken = owners
    folded, owners = fold(acts, owners)
    owners = _without_setting(row, acts, spoken, folded, owners)
    stated = _stated(row, ends)
    found = settled(
        folded, [id(act) in asked for act in folded], [id(act) in stated for act in folded]
    )
    told = sum(isinstance(a, Ask) and b is None for a, b in zip(folded, found, strict=True))
    folded, owners = _without_none(found, owners)
    folded = [_on_claim(act, folded[:index]) for index, act in enumerate(folded)]
    shares = (share for reading in row for share in reading.shares)
    return Reading(
        tuple(folded),
        tuple(structs.replace(s, act=o) for s, o in zip(shares, owners, strict=True)),
        round(max(sum(reading.cost for reading in row) - TOLD * told, 0.0), 3),
        tuple(unread for reading in row for unread in reading.unread),
        ignored=tuple(clause for reading in row for clause in reading.ignored),
    )


def _without_world(row: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """Leave out a question about a world that is supposed in words that were not understood."""
    kept: list[Reading] = []
    for reading in row:
        before = kept[-1] if kept else None
        lost = before is not None and not before.acts and _supposes(before)
        if lost and reading.acts:
            shares = tuple(structs.replace(share, act=None) for share in reading.shares)
            words = tuple(share.text for share in shares)
            reading = Reading((), shares, reading.cost, (Unread(words, True),))
        kept.append(reading)
    return tuple(kept)


def _attached(row: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """Put what we did into the bare demand for its reason beside it."""
    lost = not all(reading.acts for reading in row)
    acts = iter(attached([act for reading in row for act in reading.acts], lost))
    return tuple(structs.replace(r, acts=tuple(islice(acts, len(r.acts)))) for r in row)


def _is_supposing(act: Act) -> bool:
    """Say whether an act supposes something for a question to come."""
    return isinstance(act, Ask) and isinstance(act.question, WhatIf)


def _supposes(reading: Reading) -> bool:
    """Say whether words suppose something."""
    return any(share.text.lower() in _SUPPOSING for share in reading.shares[:2])


def _stated(row: tuple[Reading, ...], ends: Sequence[str]) -> set[int]:
    """Find the doubtful acts of sentences with a full stop, where another has a question mark."""
    if "?" not in ends:
        return set()
    return {
        id(act)
        for reading, end in zip(row, ends, strict=True)
        for act in reading.acts
        if end == "." and reading.cost > DOUBTFUL and not _is_supposing(act)
    }


def _without_setting(
    row: tuple[Reading, ...],
    acts: list[Act],
    spoken: list[int | None],
    folded: list[Act],
    owners: list[int | None],
) -> list[int | None]:
    """Take the words of a claim that found no place out of the question that it went into."""
    shares = [share for reading in row for share in reading.shares]
    found: list[int | None] = []
    for share, before, now in zip(shares, spoken, owners, strict=True):
        told = before is not None and isinstance(acts[before], Claim)
        asked = now is not None and isinstance(folded[now], Ask)
        found.append(None if share.share == "unknown" and told and asked else now)
    return found


def _without_none(
    acts: Sequence[Act | None], owners: list[int | None]
) -> tuple[list[Act], list[int | None]]:
    """Leave out acts that say nothing of their own."""
    rank: dict[int, int] = {}
    for index, act in enumerate(acts):
        if act is not None:
            rank[index] = len(rank)
    kept = [act for act in acts if act is not None]
    return kept, [None if owner is None else rank.get(owner) for owner in owners]


def _on_claim(act: Act, before: list[Act]) -> Act:
    """Read "but why?" behind a claim as the question why that is so."""
    claimed = act == Repair("why") and any(isinstance(other, Claim) for other in before)
    return Elliptic(form="why") if claimed else act
