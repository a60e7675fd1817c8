"""Mentions: the other vehicle and the time that a text speaks of."""

from collections.abc import Iterator, Sequence
from typing import Any, Final, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, Identify, Listing, Reading, Request, TokenShare
from xavi_dialogue.domain.rewriting import first, parts, rewrite
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Between,
    Described,
    Event,
    Everyone,
    Exists,
    Has,
    Is,
    Measured,
    Pronoun,
    Related,
    Thing,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.parse import Parser

Other: TypeAlias = Described | Vehicle | Pronoun | Everyone
_SORTS: Final = (Described, Vehicle, Pronoun, Everyone)
_TIMES: Final = (At, AtDecision, Ago, Between)
_AMOUNT: Final = frozenset(("num", "tunit"))
_TIMED: Final = (Event, Measured, Is, Related, Has, Exists)
_LISTED: Final = ("options", "rivals", "decisions", "beliefs", "vehicles")
_PERSONS: Final = frozenset(("he", "she", "they", "one", "it"))
_NOMINAL: Final = frozenset(("det", "size", "colour", "kind", "bearing", "num", "numbered"))
_HEADS: Final = frozenset(("kind", "colour", "numbered"))


def at_time_of(acts: tuple[Act, ...], reading: Reading) -> tuple[Act, ...]:
    """Put the time that a text names into acts that name none, be it one that was not read."""
    time = first(reading.acts, _TIMES) or _time(reading.shares)
    if time is None or first(acts, _TIMES) is not None:
        return acts

    def change(part: Any) -> Any:
        timed = isinstance(part, _TIMED) or (isinstance(part, Listing) and part.of in _LISTED)
        if timed and isinstance(part.time, Unsaid):
            return replace(part, time=time)
        return part

    return rewrite(acts, change)


def _time(shares: Sequence[TokenShare]) -> At | AtDecision | Ago | Between | None:
    """Read the time in the words that are said with "at": "at 10 s", "at 0:14"."""
    for at, share in enumerate(shares):
        said = [one.text for one in shares[at + 1 : at + 3]]
        parts_ = [one.part.partition(":")[0] for one in shares[at + 1 : at + 3]]
        if share.read != "at" or not parts_ or parts_[0] not in ("clock", "num", "tunit"):
            continue
        timed = said[:1] if parts_[0] == "clock" else said if set(parts_) == _AMOUNT else ()
        for act in Parser().read(f"What happened at {' '.join(timed)}?")[0].acts if timed else ():
            if isinstance(found := first(act, _TIMES), _TIMES):
                return found
    return None


def mentioned(reading: Reading) -> Thing | None:
    """Give the vehicle that a text is most likely about; None where it names none.

    One that is asked about goes before one that is only spoken of, a description before a pronoun.
    """
    asked = [t for act in reading.acts if isinstance(act, Ask | Request) for t in _things(act)]
    told = [t for act in reading.acts for t in _things(act)]
    found = _first([*asked, *told])
    if found is None or isinstance(found, Pronoun):
        return _first([*asked, *told, *_named(reading.shares)])
    return found


def _first(things: Sequence[Other]) -> Other | None:
    named = (thing for thing in things if not isinstance(thing, Pronoun))
    return next(named, next(iter(things), None))


def _things(value: object) -> Iterator[Other]:
    for thing in parts(value, _SORTS):
        if isinstance(thing, Described | Vehicle | Everyone) or (
            isinstance(thing, Pronoun) and thing.form in _PERSONS
        ):
            yield thing


def _named(shares: Sequence[TokenShare]) -> Iterator[Other]:
    """Read the noun phrases in stretches of which no act was made."""
    phrase: list[TokenShare] = []
    for share in (*shares, TokenShare("", "", "unknown")):
        sort = share.part.partition(":")[0]
        if sort in _NOMINAL:
            phrase.append(share)
            continue
        if any(one.part.partition(":")[0] in _HEADS for one in phrase):
            yield from _read(" ".join(one.text for one in phrase))
        phrase = []
        if sort == "pron" and share.part.partition(":")[2] in _PERSONS:
            yield Pronoun(share.part.partition(":")[2])  # type: ignore[arg-type]


def _read(phrase: str) -> Iterator[Other]:
    for act in Parser().read(f"Who is {phrase}?")[0].acts:
        if isinstance(act, Ask) and isinstance(act.question, Identify):
            yield from _things(act.question.thing)
