"""Shared subjects: "is the lorry turning left or going straight on" is about one lorry."""

from collections.abc import Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.terms import Described, Event, Happens, Proposition, Vehicle


def of_the_same(
    one: Proposition, spoken: Sequence[Proposition], grounded: Sequence[Proposition]
) -> Proposition:
    """Give a part of a proposition the subject of its first part, if both describe it alike.

    Args:
        one: the part, as spoken.
        spoken: all parts, as spoken.
        grounded: the parts before it, grounded.
    """
    match one, spoken[0], grounded[:1]:
        case (
            Happens(event=Event(actor=Described() as actor) as event),
            Happens(event=Event(actor=also)),
            [Happens(event=Event(actor=Vehicle() as vehicle))],
        ) if actor == also:
            return Happens(replace(event, actor=vehicle))
    return one
