"""Grounder: grounds the parts of one act, and notes what it finds out."""

from dataclasses import dataclass, field

from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.terms import Event, Proposition, Tense, Thing, Time
from xavi_dialogue.nlu.grounding.acts import propositions
from xavi_dialogue.nlu.grounding.context import Context, Fits, Mode, Notes, Window
from xavi_dialogue.nlu.grounding.events import events, windows
from xavi_dialogue.nlu.grounding.things.resolve import resolve


@dataclass(slots=True)
class TermGrounder:
    """Grounds terms in a context."""

    context: Context
    notes: Notes = field(default_factory=Notes)

    def beside(self, discourse: Discourse) -> "TermGrounder":
        """Give a grounder with another discourse that notes what it finds in the same place."""
        return TermGrounder(self.context.within(discourse), self.notes)

    def thing(self, thing: Thing, window: Window, fits: Fits | None = None) -> Thing:
        """Ground a thing as it was in a window of the ride."""
        return resolve(thing, self, window, fits)

    def event(self, event: Event, mode: Mode, outer: Window | None = None) -> Event:
        """Ground an event."""
        return events.event(event, mode, self, outer)

    def proposition(
        self, proposition: Proposition, mode: Mode, outer: Window | None = None
    ) -> Proposition:
        """Ground a proposition."""
        return propositions.proposition(proposition, mode, self, outer)

    def window(self, time: Time, tense: Tense) -> Window:
        """Find the part of the ride that a time names."""
        return windows.window(time, tense, self)
