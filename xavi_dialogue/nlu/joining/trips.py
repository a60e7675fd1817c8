"""Trips: "when do we arrive, and how far is it?": both are asked of the way that is left.

So are "when do we turn, and in how many metres?" of the way to the turn.
"""

from collections.abc import Sequence
from typing import Final

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, HowLong, HowMuch, When, Whither
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Happens,
    Measured,
    Pronoun,
    Relative,
    That,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.compose.wh_questions.towards import WAYS
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.joining.meanwhile import LEADING, Row

TIME_LEFT: Final = HowMuch(Measured("time-to-go"))
WAY_LEFT: Final = HowMuch(Measured("distance-to-go"))
_NEXT: Final = Event("turn", Ego(), tense="future")
NEXT_TURN: Final = Ask(When(Happens(_NEXT)))
_WHEN: Final = Elliptic(form="when")
_IT: Final = (Pronoun("it"), Pronoun("that"), Ego())


def of_the_way(units: Sequence[Node], rows: Sequence[Row]) -> list[Row]:
    """Let questions in one sentence be of the way that is left, where one of them is."""
    found = [_twice(unit, row) for unit, row in zip(units, rows, strict=True)]
    acts = [act for row in found for act in row or ()]
    if len(acts) > 1 and (turn := next(filter(None, map(_turn, acts)), None)) is not None:
        return [row and tuple(_to_turn(act, turn) for act in row) for row in found]
    if any(isinstance(act, Ask) and act.question == Whither() for act in acts):
        return [row and tuple(NEXT_TURN if act == _WHEN else act for act in row) for row in found]
    timed, far = any(map(_is_time_left, acts)), any(map(_is_way_left, acts))
    far = far or (len(acts) > 1 and any(map(_takes, acts)) and any(map(_is_far, acts)))
    timed = timed or (far and any(map(_takes, acts)))
    return [None if row is None else tuple(_left(act, timed, far) for act in row) for row in found]


def _left(act: Act, timed: bool, far: bool) -> Act:
    if timed and _is_far(act):
        return Ask(WAY_LEFT)
    if far and (_takes(act) or act == _WHEN):
        return Ask(TIME_LEFT)
    return act


def _turn(act: Act) -> Event | None:
    """Find the turn of ours that is asked about, when it is or how far ahead."""
    match act:
        case Ask(question=HowMuch(of=Measured(attribute="turn", event=None))):
            return _NEXT
        case Ask(
            question=When(of=Happens(event=Event(actor=Ego(), tense="present" | "future") as turn))
            | HowMuch(of=Measured(attribute="turn", event=Event(actor=Ego()) as turn))
        ):
            return turn if turn.action in WAYS else None
    return None


def _to_turn(act: Act, turn: Event) -> Act:
    """Ask how far and how long "it" is, or nothing, of the way to a turn."""
    if _is_far(act):
        return Ask(HowMuch(Measured("turn", event=turn)))
    if _takes(act) or _lasts(act) or act == _WHEN:
        return Ask(When(Happens(structs.replace(turn, tense="future"))))
    return act


def _lasts(act: Act) -> bool:
    """Tell whether it is asked how long "it" takes now."""
    match act:
        case Ask(question=HowMuch(of=Measured(attribute="duration", thing=thing, tense="present"))):
            return thing in _IT
    return False


def _twice(unit: Node, row: Row) -> Row:
    """Ask "when we arrive, and how many kilometres is it still?" as the two questions it is."""
    if row is None or len(row) != 1 or not isinstance(row[0], Ask):
        return row
    asked = row[0].question
    left = isinstance(asked, HowMuch) and asked.of.attribute in ("distance-to-go", "time-to-go")
    if not left or not isinstance(asked, HowMuch):
        return row
    of = asked.of
    lead = unit.parts[0] if unit.parts else None
    led = isinstance(lead, Node) and lead.name in LEADING and _is_when(lead)
    match of.time:
        case Relative(relation="during", anchor=Event(action="arrive", actor=Ego())):
            led, of = True, structs.replace(of, time=Unsaid())
    if not led or of.attribute != "distance-to-go":
        return row
    return (Ask(TIME_LEFT), Ask(structs.replace(asked, of=of)))


def _is_when(lead: Node) -> bool:
    return any(leaf.words[:1] == ("when",) for leaf in leaves_of(lead))


def _is_time_left(act: Act) -> bool:
    match act:
        case Ask(question=When(of=Happens(event=Event(action="arrive", actor=Ego())))):
            return True
        case Ask(question=HowMuch(of=Measured(attribute="time-to-go" | "arrival-time"))):
            return True
    return False


def _is_way_left(act: Act) -> bool:
    return isinstance(act, Ask) and act.question == WAY_LEFT


def _is_far(act: Act) -> bool:
    """Tell whether it is asked how far "it" is."""
    match act:
        case Ask(question=HowMuch(of=Measured("distance", thing, to, tense="present"))):
            return thing in _IT and (to is None or to in _IT)
    return False


def _takes(act: Act) -> bool:
    """Tell whether it is asked how long "it" takes, or for "time"."""
    match act:
        case Ask(question=HowMuch(of=Measured("time", Ego(), None, tense="present"))):
            return True
        case Ask(question=HowMuch(of=Measured("duration", thing, tense="future"))):
            return thing in _IT
        case Ask(question=HowLong(of=That())):
            return True
    return False
