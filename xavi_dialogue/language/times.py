"""Times: what the words of a question say about when, as a `When`.

Phrases of `grammars/times.toml` are found at each word, each of a kind; a few patterns of kinds
say when. What is told by what somebody did ("when vehicle 1 cut in") is read by the parser, as
if it were asked why that was done.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import cast

from msgspec.structs import replace

from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.when import Landmark, Relation, When
from xavi_dialogue.language.normalise import BREAK, MAX_INPUT
from xavi_dialogue.language.parse import explained
from xavi_dialogue.language.timewords import (
    Mark,
    Marks,
    Piece,
    in_a_row,
    lists,
    marks_in,
    pieces_of,
    stands_alone,
)

#: What the question leaves open where it names no side.
_SIDES: dict[QueryAction, QueryAction] = {
    "change-left": "change-right",
    "exit-left": "exit-right",
}
EDGES: tuple[Landmark, ...] = ("start", "end")
NEAR = 3.0  # [s] what "right after" is taken for

Found = tuple[When, int]  # and the position of the word behind it


def when_said(text: str) -> When | None:
    """What a text says about when; None where it does not, or says no more than "now".

    The vehicle of a deed is named or described as in a `Query`. Pure; never raises.
    """
    if len(text) > MAX_INPUT:
        return None
    return _when_said(text)


@lru_cache(maxsize=128)
def _when_said(text: str) -> When | None:
    pieces = pieces_of(text)
    marks = marks_in(pieces)
    found: list[When] = []
    position = 0
    while position < len(pieces):
        hit = next((hit for read in _READERS if (hit := read(pieces, marks, position))), None)
        if hit is None:
            position += 1
            continue
        found.append(hit[0])
        position = hit[1]
    return _together(found)


def _together(found: Sequence[When]) -> When | None:
    """One of what was found: what is precise before what is rough, with the count of another."""
    counts = [when.nth for when in found if when.nth is not None]
    rest = sorted((when for when in found if when.landmark is not None), key=lambda w: w.rough)
    if not rest:
        return When(nth=counts[0]) if counts else None
    return replace(rest[0], nth=counts[0]) if counts else rest[0]


# --- Patterns: each reads what begins at a word --------------------------------------------------


def _length(kind: str, mark: Mark) -> tuple[float, bool]:
    """How long [s], and whether that is said roughly."""
    return float(mark.key) * mark.value, kind == "ROUGHLY"


def _lengths(pieces: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "ten seconds ago", "in ten seconds", "in the last ten seconds"."""
    if row := in_a_row(marks, start, "AMOUNT|ROUGHLY", "AGO|AHEAD"):
        (length, (kind, _)), end = row
        seconds, rough = _length(*length)
        relation: Relation = "before" if kind == "AGO" else "after"
        when = When(relation=relation, landmark="now", seconds=seconds, rough=rough)
        return replace(when, ahead=kind == "AHEAD"), end
    if row := in_a_row(marks, start, "PAST|IN", "ABOUT?", "AMOUNT|ROUGHLY"):
        found, end = row
        (kind, first), length = found[0], found[-1]
        if kind == "IN" and not stands_alone(pieces, end):
            return None
        seconds, rough = _length(*length)
        relation = "after" if first.key == "in" else "within"
        when = When(relation=relation, landmark="now", seconds=seconds, rough=rough)
        return replace(when, ahead=kind == "IN"), end
    return None


def _bare(pieces: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "just now", "soon", "at the start"."""
    here = marks[start]
    if edge := here.get("START") or here.get("END"):
        landmark: Landmark = "start" if edge.key == "start" else "end"
        return When(landmark=landmark), edge.end
    known = {piece.word for piece in pieces}
    if known & lists()["uncounted"]:  # "why not earlier", "as soon as"
        return None
    for kind in ("RECENT", "SOON"):
        if mark := here.get(kind):
            seconds = float(mark.key) or None
            when = When(relation="within", landmark="now", seconds=seconds, rough=True)
            return replace(when, ahead=kind == "SOON"), mark.end
    return None


def _clocks(pieces: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "at 0:12", "before 0:12", "between 0:05 and 0:10", "12 seconds in"."""
    row = in_a_row(marks, start, "BETWEEN", "EXACT|NUMERAL", "AND", "EXACT|AMOUNT|NUMERAL")
    if row and any(kind in ("EXACT", "AMOUNT") for kind, _ in row[0]):
        (_, (_, low), _, (kind, high)), end = row
        until = _length(kind, high)[0] if kind == "AMOUNT" else high.value
        first, last = sorted((low.value, until))
        return When(relation="within", landmark="clock", clock=first, until=last), end
    if row := in_a_row(marks, start, "ABOUT?", "BEFORE|AFTER|AT|BY?", "ABOUT?", "EXACT"):
        found, end = row
        said = [_relation(mark) for kind, mark in found if kind in ("BEFORE", "AFTER")]
        return When(
            relation=said[0] if said else "at", landmark="clock", clock=found[-1][1].value
        ), end
    if (mark := marks[start].get("CLOCK")) and stands_alone(pieces, mark.end):
        return When(landmark="clock", clock=mark.value), mark.end
    return None


def _counts(pieces: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "the second time", "the second time you braked", "the second lane change"."""
    row = in_a_row(marks, start, "ORDINAL", "TIMES|COUNTED")
    if row is None:
        return None
    ((_, ordinal), (kind, _)), end = row
    which = _nth(ordinal)
    if kind == "COUNTED":
        known = start > 0 and pieces[start - 1].word in lists()["articles"]
        return (When(nth=which), end) if known else None
    clause = _clause(pieces, marks, end, bare=False)
    if clause is None or clause[0].landmark != "deed":
        return When(nth=which), end
    return replace(clause[0], which=which), clause[1]


def _landmarks(pieces: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "before the junction", "five seconds after you changed lanes", "when it cut in"."""
    row = in_a_row(marks, start, "AMOUNT|ROUGHLY|ABOUT?", "BEFORE|AFTER|AT|BY")
    if row is None:
        return None
    found, begin = row
    kind, said = found[-1]
    bare = pieces[begin - 1].word != "as" or kind == "AFTER"
    clause = _clause(pieces, marks, begin, bare=bare) or _that(kind, pieces, marks, begin)
    if clause is None or (kind == "BY" and clause[0].landmark == "deed"):
        return None
    when, end = replace(clause[0], relation=_relation(said)), clause[1]
    if len(found) > 1:
        near = found[0][0] == "ABOUT" and when.relation != "at"
        seconds, rough = (NEAR, True) if near else _length_of(found[0])
        when = replace(when, seconds=seconds, rough=rough)
    return when, end


def _that(kind: str, pieces: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "before that", where no more is said of it."""
    mark = marks[start].get("THAT") if start < len(marks) else None
    if mark is None or kind not in ("BEFORE", "AFTER") or not stands_alone(pieces, mark.end):
        return None
    return When(landmark="that"), mark.end


def _then(_: Sequence[Piece], marks: Marks, start: int) -> Found | None:
    """As in "at that time"."""
    mark = marks[start].get("THEN")
    return None if mark is None else (When(landmark="that"), mark.end)


def _length_of(found: tuple[str, Mark]) -> tuple[float | None, bool]:
    return (None, False) if found[0] == "ABOUT" else _length(*found)


_READERS: tuple[Callable[[Sequence[Piece], Marks, int], Found | None], ...] = (
    *(_clocks, _lengths, _counts, _then, _landmarks, _bare),
)


def _relation(mark: Mark) -> Relation:
    return cast(Relation, mark.key)


def _nth(mark: Mark) -> int:
    return int(mark.key) or max(int(mark.value), 1)


# --- What was done at the time -------------------------------------------------------------------


def _clause(pieces: Sequence[Piece], marks: Marks, start: int, *, bare: bool) -> Found | None:
    """The landmark that begins at a word: a place, the start or end, or what somebody did.

    Args:
        pieces: all words.
        marks: the phrases in them.
        start: where it begins.
        bare: whether it may go without a word on who did it, as in "turning left".
    """
    words = lists()
    while start < len(pieces) and pieces[start].word in words["articles"]:
        start += 1
    if start >= len(pieces) or pieces[start].word in words["auxiliaries"] | words["questions"]:
        return None
    ordinal, following = marks[start].get("ORDINAL"), marks[start].get("NEXT")
    begin = max((mark.end for mark in (ordinal, following) if mark), default=start)
    told = When(which=_nth(ordinal) if ordinal else None, ahead=following is not None)
    if begin >= len(pieces):
        return None
    if place := marks[begin].get("PLACE"):
        return replace(told, landmark=cast(Landmark, place.key)), place.end
    for edge in EDGES:
        if pieces[begin].word in words[edge]:
            return replace(told, landmark=edge), begin + 1
    end = begin
    while end < len(pieces) and pieces[end].word not in words["stops"] | {BREAK}:
        end += 1
    deed = _deed(" ".join(piece.typed for piece in pieces[begin:end]))
    subject = any(piece.word in words["subjects"] for piece in pieces[begin:end])
    if deed is not None and (bare or subject or deed.actor != "ego"):
        actor = deed.actor if subject or deed.actor != "ego" else None
        return replace(told, landmark="deed", deeds=_sides(deed), actor=actor), end
    places = [mark for k in range(begin, end) if (mark := marks[k].get("PLACE"))]
    if places and subject:
        return replace(told, landmark=cast(Landmark, places[0].key)), end
    return None


@lru_cache(maxsize=128)
def _deed(clause: str) -> Query | None:
    """Who did what in a clause; None where it says no more than that somebody drove on."""
    query = explained(f"why {clause}").result
    if not isinstance(query, Query) or query.type != "why" or query.counterfactual:
        return None
    return query if _sides(query) else None


def _sides(query: Query) -> tuple[QueryAction, ...]:
    """What was done; where its side was left open, on either."""
    deeds = tuple(action for action in query.factual or () if action != "continue")
    if query.underspecified is None:
        return deeds
    return tuple(side for action in deeds for side in (action, _SIDES.get(action, action)))
