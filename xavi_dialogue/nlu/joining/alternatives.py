"""Alternatives: "are you going to stop, or just drive in?" is one question of two deeds."""

from collections.abc import Sequence

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Compare,
    Doing,
    Elliptic,
    Question,
    Request,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Is,
    Junction,
    Not,
    Pronoun,
    Proposition,
    That,
    Together,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.alternatives.choosing import compared_by, of_the_same
from xavi_dialogue.nlu.compose.alternatives.ways import way_asked
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.joining.blaming import HELD

_MOVING = frozenset({"go", "wait", "stop", "brake", "give-way", "turn", "enter", "leave"})
Rows = Sequence[tuple[tuple[Act, ...], float]]


def chosen_between(units: Sequence[Node], rows: Rows) -> list[tuple[Act, ...] | None]:
    """Give the acts of each unit; None where they went into the question before it."""
    found: list[tuple[Act, ...] | None] = _paired(units, [acts for acts, _ in rows])
    last = 0
    for index in range(1, len(found)):
        first, later = found[last] or (), found[index] or ()
        asked: Question | None = None
        if len(later) == 1 and first and _is_other(units[index]):
            asked = _either(first[-1], later[0])
        elif len(later) == 1 and first and isinstance(later[0], Elliptic):
            asked = _listed(first[-1], later[0])
        elif len(later) == 1 and first and units[index].name == "imperative":
            asked = _guessed(first[-1], later[0])
        if (
            len(later) == 1
            and first
            and _is_purpose(units[index - 1 : index + 1], first[-1], later[0])
        ):
            found[index] = None
            continue
        if asked is None:
            last = index
        else:
            found[last], found[index] = (*first[:-1], Ask(asked)), None
    return found


def one_of(first: Act, later: Act) -> Act | None:
    """Ask "the red one or the white one, which is closer?" of these; None for all else."""
    match first, later:
        case Elliptic(thing=Together(members=members), form="which"), Ask(question=question):
            match question:
                case Compare(options=(Pronoun(form="them-all"),)):
                    return Ask(structs.replace(question, options=members))
                case Which(such=such, among=()):
                    compare = compared_by(such, members)
                    return Ask(compare or structs.replace(question, among=members))
    return None


def _paired(units: Sequence[Node], rows: list[tuple[Act, ...]]) -> list[tuple[Act, ...] | None]:
    """List two causes behind a question for one: "why brake, for the bus or for the turn?"."""
    found: list[tuple[Act, ...] | None] = [*rows]
    for index in range(2, len(rows)):
        if not _is_other(units[index]):
            continue
        match rows[index - 2][-1:], rows[index - 1], rows[index]:
            case (
                (Ask(question=Why() | Which()),),
                (Elliptic(thing=one, event=None, form="same" | "why"),),
                (Elliptic(form="same" | "why") as later,),
            ):
                other = later.thing if later.event is None else _place_of(later.event)
                if one is not None and other is not None:
                    found[index - 1] = (Elliptic(Together((one, other)), form="which"),)
                    found[index] = None
    return found


def _place_of(event: Event) -> Junction | None:
    """Give the place of what we have to slow down for."""
    return Junction() if event.action in ("turn", "exit-left", "exit-right") else None


def _listed(first: Act, later: Elliptic) -> Question | None:
    """Ask "..., the bus or the light?" which of these it is that was asked for before."""
    match first, later:
        case Ask(question=asked), Elliptic(thing=Together(members=members), form="which"):
            match asked:
                case Why(suspect=None):
                    one, other, *more = members
                    if more:  # the reason tells which it is
                        return asked
                    return structs.replace(asked, suspect=one, rival=other)
                case Why(rival=None):  # "was that for him, the bus, or something else?"
                    return structs.replace(asked, rival=members[0])
                case Which(such=such, among=()) if such is not None:
                    return structs.replace(asked, among=members)
    return None


def _is_other(unit: Node) -> bool:
    """Say whether "or" leads into a unit."""
    lead = unit.parts[0] if unit.parts else None
    return isinstance(lead, Leaf) and lead.category == "OR"


def _is_purpose(pair: Sequence[Node], first: Act, later: Act) -> bool:
    """Say whether "so it moves" is what for something is requested: it asks nothing."""
    before, unit = pair
    lead = unit.parts[0] if unit.parts else None
    led = isinstance(lead, Leaf) and lead.category == "SO"
    if not (led or words_of(before).endswith(" so")) or not isinstance(first, Request):
        return False
    match later:
        case Ask(question=Whether(that=Happens(event=event))) | Claim(that=Happens(event=event)):
            return not isinstance(event.actor, Ego)
    return False


def _either(first: Act, later: Act) -> Question | None:
    """Ask which of two is so; None where they are no alternatives."""
    match first:
        case Ask(question=Whether(that=Both(contents=contents, join="or"))):
            pass
        case Ask(question=Whether(that=that) as asked):
            if isinstance(later, Elliptic) and later == Elliptic(time=later.time):
                return asked  # "had you seen him before, or only just then?"
            if (cause := _held_by(that, later) or _held_for(that, later)) is not None:
                return cause
            contents = (that,)
        case Claim(that=Happens() as that) if _is_of_two(that, later):
            contents = (that,)  # "he waits for us, or we wait for him?"
        case Ask(question=Doing(actor=Ego(), tense="future")) if isinstance(later, Ask):
            return later.question if isinstance(later.question, Whether) else None
        case _:
            return None
    if isinstance(contents[0], Compares) and _is_own_choice(later):
        return Whether(contents[0])  # "is that the limit or just your taste?"
    other = _other(contents[-1], later)
    if other is None or isinstance(other, Not):
        return None
    if _is_contrary(contents[0], other):
        return Whether(contents[0])
    if len(contents) == 1 and (why := _for_what(contents[0], other)) is not None:
        return why
    of = of_the_same(Both((*contents, other), "or"))
    return way_asked(of) or Whether(of)


def _for_what(that: Proposition, other: Proposition) -> Why | None:
    """Read "did we brake for the corner, or was there somebody?" as why we braked."""
    match that, other:
        case Happens(event=Event(action=action, actor=Ego(), object=suspect) as event), Exists(
            thing=Described(definite=False)
        ) if action in HELD and suspect is not None:
            return Why(Happens(structs.replace(event, object=None)), suspect=suspect)
    return None


def _held_by(that: Proposition, later: Act) -> Which | None:
    """Read "is it the bus that is holding us up, or the light?" as which of them it is."""
    match that, later:
        case Happens(event=Event(action="block", object=Ego()) as event), Elliptic(
            thing=Feature() | Described() | Vehicle() as other, event=None, form="same"
        ):
            such = Happens(structs.replace(event, actor=Wanted()))
            return Which(Wanted(), such, (event.actor, other))
    return None


def _held_for(that: Proposition, later: Act) -> Why | None:
    """Read "is it those people you are waiting for, or the light?" as for which of them."""
    match that, later:
        case Happens(event=Event(action=action, actor=Ego(), object=suspect) as event), (
            Elliptic(
                thing=Feature() | Described() | Vehicle() | Junction() as other,
                event=None,
                form="same",
            )
            | Ask(question=Why(of=That(), suspect=other, rival=None))
        ) if action in HELD and suspect is not None and other is not None:
            return Why(Happens(structs.replace(event, object=None)), suspect=suspect, rival=other)
    return None


def _is_of_two(first: Happens, later: Act) -> bool:
    """Say whether a deed that is stated and one that is asked after are alternatives."""
    match later:
        case Ask(question=Whether(that=Happens(event=event))):
            told = first.event
            ahead = {told.tense, event.tense} <= {"present", "future"}  # "or will you pass him?"
            return (ahead or told.tense == event.tense) and told != event
    return False


def _is_own_choice(later: Act) -> bool:
    """Say whether no more is named than that it is our choice."""
    event = later.event if isinstance(later, Elliptic) else None
    return event is not None and event.action == "do" and isinstance(event.actor, Ego)


def _guessed(first: Act, later: Act) -> Question | None:
    """Read "what's the plan, sit behind him all day?" as the question whether that is to come."""
    match first, later:
        case Ask(question=Doing(actor=Ego()) | Why(of=That())), (
            Ask(question=Whether(that=Happens(event=event))) | Request(event=event, negated=False)
        ):
            return Whether(Happens(structs.replace(event, tense="future")))
    return None


def _other(first: Proposition, later: Act) -> Proposition | None:
    """Tell what a later question or order says of the vehicle spoken of."""
    match later:
        case Ask(question=Whether(that=that)):
            return that
        case Request(event=event, negated=False) if isinstance(first, Happens):
            return Happens(_as(event, first.event))
        case Elliptic(thing=other, event=None, form="same", negated=False) if (
            other is not None and isinstance(first, Happens) and first.event.action in _MOVING
        ):  # "do they go first, or us?"
            return Happens(structs.replace(first.event, actor=other))
    return None


def _as(event: Event, first: Event) -> Event:
    """Take a deed for one of the same actor, at the same time, as one before it."""
    return structs.replace(event, actor=first.actor, tense=first.tense, modal=first.modal)


def _is_contrary(first: Proposition, other: Proposition) -> bool:
    """Say whether the second is so just where the first is not: "there, or still far?"."""
    arrives = isinstance(first, Happens) and first.event.action == "arrive"
    far = isinstance(other, Is) and other.state in ("far", "late")
    thing = getattr(other, "thing", None)
    return arrives and far and isinstance(thing, Pronoun | Destination | None)
