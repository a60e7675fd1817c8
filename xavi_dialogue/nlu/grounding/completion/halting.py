"""Halting: who is meant where it is supposed that somebody stops or brakes."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import WhatIf
from xavi_dialogue.domain.terms import Described, Event, Happens, Now, Proposition, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.completion.supposing import of_named, of_nobody
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.things.descriptions import is_such

HALTING: Final = frozenset[ActionName](("brake", "stop", "slow-down"))
_TENSES: Final = ("present", "future")


def of_whom(spoken: WhatIf, g: Grounder) -> Proposition:
    """Give what is supposed, with the vehicle that is meant put in for a word of who it is."""
    return of_nobody(_ahead_of_us(of_named(spoken).supposed, g))


def _ahead_of_us(supposed: Proposition, g: Grounder) -> Proposition:
    """Take "what if the lorry brakes?" for one ahead of us, where there is one: it matters to us.

    A vehicle that the passenger named alone is the one that is meant, wherever it is.
    """
    match supposed:
        case Happens(event=Event(actor=Described() as whom, object=None) as event) if (
            event.action in HALTING and event.tense in _TENSES and _is_plain(whom)
        ):
            found = _nearest_ahead(whom, g)
        case _:
            return supposed
    if found is None or _is_named(whom, g):
        return supposed
    return Happens(replace(event, actor=found))


def _is_plain(whom: Described) -> bool:
    """Tell whether only the kind, the colour or the size of a known vehicle is said."""
    return whom == Described(whom.kind, whom.colour, whom.size)


def _nearest_ahead(whom: Described, g: Grounder) -> Vehicle | None:
    now, window = g.context.now, g.window(Now(), "present")
    looks = (g.context.look(vehicle, now) for vehicle in g.context.in_view(now))
    ahead = sorted(
        (look.distance, look.vehicle)
        for look in looks
        if look is not None and look.bearing == "ahead" and not look.oncoming
    )
    those = (Vehicle(vehicle) for _, vehicle in ahead)
    return next((one for one in those if is_such(one, whom, g, window)), None)


def _is_named(whom: Described, g: Grounder) -> bool:
    """Tell whether the passenger spoke of one vehicle that fits."""
    now, window = g.context.now, g.window(Now(), "present")
    named = (m.thing for m in g.context.discourse.mentions if not m.by_car)
    seen = g.context.in_view(now)
    return any(
        isinstance(one, Vehicle) and one.number in seen and is_such(one, whom, g, window)
        for one in named
    )
