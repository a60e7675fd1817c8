"""Grounding: what comes of grounding the readings of one turn."""

from typing import TypeAlias

from xavi_dialogue.domain.answers import NoSuchVehicle, NotUnderstood, WhichOne
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Act, Reading
from xavi_dialogue.domain.terms import Thing, Vehicle

Failure: TypeAlias = NotUnderstood | NoSuchVehicle


class Grounding(Value, frozen=True):
    """The acts that can be answered, and what stands in the way of the others.

    `refusal` is of the first act that cannot be answered. Where it has `misdescribed`, the act is
    among `acts` none the less, about the vehicle that must have been meant.
    Where `clarify` is set, `offers`, `offered_things` and `pending` are what the discourse has to
    keep so that the next turn can pick one.
    """

    acts: tuple[GroundedAct, ...] = ()
    clarify: WhichOne | None = None
    reading: Reading | None = None  # the one chosen
    refusal: Failure | None = None
    offers: tuple[Act, ...] = ()  # grounded: one for each choice that `clarify` names
    offered_things: tuple[Thing, ...] = ()  # likewise, where it names vehicles
    pending: Act | None = None  # the act that is to be completed, as it was read
    quotes: tuple[str, ...] = ()  # the words of each of the acts; "" where they are all the words
    named: Vehicle | None = None  # who was named in an act that was not understood
