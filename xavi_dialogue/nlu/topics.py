"""Topics: "this red lorry, he has to wait": what is named first is what the pronoun means."""

from typing import Any

from msgspec import structs

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Doing, Elliptic, HowDecide, WhatIf
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Pronoun,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
)

_FORMS = frozenset({"it", "he", "she"})
Owners = list[int | None]


def fold(acts: list[Act], owners: Owners) -> tuple[list[Act], Owners]:
    """Put a thing that is named by itself into the next act, where a pronoun stands for it."""
    for index in range(len(acts) - 1):
        later = acts[index + 1]
        under = _under(acts[index], later)
        if under is not None:
            rest = [*acts[:index], under, *acts[index + 2 :]]
            return fold(rest, [o - 1 if o is not None and o > index else o for o in owners])
        if isinstance(getattr(acts[index], "thing", None), Unknown) and _topic_only(acts[index]):
            moved: Owners = [
                None if o == index else o - 1 if o is not None and o > index else o for o in owners
            ]
            return fold([*acts[:index], *acts[index + 1 :]], moved)
        topic = _topic(acts[index])
        if topic is None or not isinstance(later, Ask | Claim):
            continue
        told: Any = _replaced(later, topic)
        if told is not later:
            rest = [*acts[:index], told, *acts[index + 2 :]]
            moved = [o - 1 if o is not None and o > index else o for o in owners]
            return fold(rest, moved)
    return acts, owners


def _under(supposed: Act, later: Act) -> Act | None:
    """Put "how would that have gone" under the supposition before it."""
    match supposed, later:
        case Ask(question=WhatIf(then=None) as question), Ask(
            question=HowDecide(of=Happens(event=Event(action="go", actor=Pronoun())))
            | Doing(actor=None)
        ):
            return Ask(structs.replace(question, then=Doing(None)))
        case Ask(question=WhatIf(then=None) as question), Ask(question=Doing(actor=Ego()) as doing):
            return Ask(structs.replace(question, then=doing))
    return None


def _topic_only(act: Act) -> bool:
    """Say whether a thing without a sense is named and nothing more."""
    return isinstance(act, Elliptic) and act.event is None and act.form == "same"


def _topic(act: Act) -> Thing | None:
    match act:
        case Elliptic(thing=Vehicle() | Described() as thing, event=None, time=Unsaid(),
                      negated=False, form="same", besides=False):  # fmt: skip
            if isinstance(thing, Described) and thing.plural:
                return None
            return structs.replace(thing, definite=True) if isinstance(thing, Described) else thing
    return None


def _replaced(value: Any, topic: Thing) -> Any:
    """Replace each pronoun in a term; the term itself where there is none."""
    if isinstance(value, Pronoun):
        return topic if value.form in _FORMS else value
    if isinstance(value, tuple):
        parts = tuple(_replaced(part, topic) for part in value)
        return parts if any(a is not b for a, b in zip(parts, value, strict=True)) else value
    changes = {
        name: new
        for name in getattr(value, "__struct_fields__", ())
        if (new := _replaced(old := getattr(value, name), topic)) is not old
    }
    return structs.replace(value, **changes) if changes else value
