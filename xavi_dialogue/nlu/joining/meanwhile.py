"""Meanwhile: "when we moved left, how far behind was it and how fast was it going?".

What is said first of when holds for each question that "and" adds.
"""

from collections.abc import Sequence

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Ask, HowMuch, Whether, Which, Why
from xavi_dialogue.domain.rewriting import rewrite
from xavi_dialogue.domain.terms import Event, Happens, Is, Measured, Related, Time, Unsaid
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, leaves_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

Row = tuple[Act, ...] | None
_SUPPOSING = ("IF", "WHATIF", "WHETHER")
LEADING = ("lead_time", "lead_clause")


def at_same_time(units: Sequence[Node], rows: Sequence[Row]) -> list[Row]:
    """Give the questions of units behind "and" the time that the first unit begins with."""
    time: Time = Unsaid()
    found: list[Row] = []
    for unit, row in zip(units, rows, strict=True):
        lead = unit.parts[0] if unit.parts else None
        if isinstance(lead, Node) and lead.name in LEADING and row:
            said = _dated(row[0])
            time = Unsaid() if said is None else said.time
        elif not (isinstance(lead, Leaf) and lead.category == "AND"):
            time = Unsaid()
        elif row and not isinstance(time, Unsaid):
            row = tuple(_timed(act, time) for act in row)
        found.append(row)
    return found


def in_its_world(units: Sequence[Node], rows: Sequence[Row]) -> Sequence[Row]:
    """Leave out what would be done in a world that is supposed in words of which nothing is made.

    "What would you do if it blew up" is not asked of the world as it is.
    """
    if not any(row == () and _first(unit) in _SUPPOSING
               for unit, row in zip(units, rows, strict=True)):  # fmt: skip
        return rows
    return [() if _is_unreal(unit) else row for unit, row in zip(units, rows, strict=True)]


def _first(unit: Node) -> str:
    """Tell the word class of the first word of a unit."""
    return next((leaf.category for leaf in leaves_of(unit)), "")


def _is_unreal(unit: Node) -> bool:
    """Say whether it is asked of a unit what would be."""
    said = leaf_of(unit, "MODAL")
    return said is not None and said.key in ("would", "could", "might")


def _dated(act: Act) -> Measured | Event | Is | Related | None:
    """Find what of a question may have a time."""
    match act:
        case Ask(question=HowMuch(of=Measured() as said)):
            return said
        case Ask(
            question=Whether(that=Happens(event=said))
            | Why(of=Happens(event=said))
            | Which(such=Happens(event=said))
        ):
            return said
        case Ask(question=Whether(that=Is() | Related() as said)):
            return said
    return None


def _timed(act: Act, time: Time) -> Act:
    said = _dated(act)
    if said is None or said.tense not in ("past", "perfect") or not isinstance(said.time, Unsaid):
        return act
    timed = structs.replace(said, time=time)
    return rewrite(act, lambda part: timed if part is said else part)
