"""Relative clauses: vehicles told by what they did: "that cut in", "the one we waited for"."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Back, Described, Ego, Event, Pronoun, Thing, Vehicle, Wanted
from xavi_dialogue.nlu.grounding.context import Context, Grounder, Window
from xavi_dialogue.nlu.grounding.kin import like

JUST_NOW: Final = 1.5  # [s] for which what is under way counts as still going on
KIN_COST: Final = 0.3
_GAP: Final = -1  # number that stands for the vehicle looked for


@dataclass(frozen=True, slots=True)
class Clause:
    """A relative clause, its gap not filled."""

    context: Context
    events: tuple[Event, ...]  # one after the other, with Vehicle(_GAP) where the vehicle belongs
    begin: float  # [s]
    end: float  # [s]
    nearly: bool = True  # what is like that counts as well
    found: dict[int, tuple[Episode | None, float]] = field(default_factory=dict)

    def episode(self, vehicle: int) -> Episode | None:
        """Find the last time that a vehicle did so."""
        return self._search(vehicle)[0]

    def cost(self, vehicle: int) -> float:
        """Weigh how well what it did is what was said."""
        return self._search(vehicle)[1]

    def _search(self, vehicle: int) -> tuple[Episode | None, float]:
        if vehicle not in self.found:
            found = [self._one(fill(event, vehicle), vehicle) for event in self.events]
            last = next((episode for episode, _ in reversed(found) if episode is not None), None)
            self.found[vehicle] = last, sum(cost for _, cost in found) / len(found)
        return self.found[vehicle]

    def _one(self, event: Event, vehicle: int) -> tuple[Episode | None, float]:
        exact = self.context.holds(event, self.begin, self.end)
        known = exact or not self.nearly
        near = exact if known else like(self.context, event, self.begin, self.end)
        near = tuple(e for e in near if _concerns(e, vehicle))
        return near[-1] if near else None, 0.0 if exact else KIN_COST if near else 1.0


def _concerns(episode: Episode, vehicle: int) -> bool:
    return Vehicle(vehicle) in (episode.actor, episode.object)


def fill(event: Event, vehicle: int) -> Event:
    """Put a vehicle where the clause has its gap."""
    gap, filler = Vehicle(_GAP), Vehicle(vehicle)
    return replace(
        event,
        actor=filler if event.actor == gap else event.actor,
        object=filler if event.object == gap else event.object,
    )


def clause_of(event: Event, g: Grounder, window: Window, *, nearly: bool = True) -> Clause:
    """Ground a relative clause but for its gap; of those who are counted, only what is said."""
    begin, end = _when(event, g, window)
    return Clause(g.context, tuple(_parts(event, g, window)), begin, end, nearly)


def _parts(event: Event, g: Grounder, window: Window) -> Iterator[Event]:
    """Ground what is done one after the other: "that came out and went past us"."""
    gap: Thing = Vehicle(_GAP)
    actor, target = event.actor, event.object
    if _is_gap(actor):
        actor = gap
    elif _is_gap(target) or (isinstance(actor, Ego) and target is None and event.action in _OF_US):
        target = gap
    else:
        actor = gap
    actor = actor if actor == gap else g.thing(actor, window)
    target = target if target is None or target == gap else g.thing(target, window)
    placed = None if first(event.where, Wanted) is not None else event.where
    yield replace(event, actor=actor, object=target, where=placed, then=None)
    if event.then is not None:
        yield from _parts(event.then, g, window)


#: What "we" do to the vehicle meant where the clause names no actor but us: "the one we passed".
_OF_US: Final = frozenset(("wait", "give-way", "let-go", "follow", "overtake", "avoid", "see"))


def _is_gap(thing: Thing | None) -> bool:
    match thing:
        case Wanted() | Pronoun(form="who"):
            return True
        case Described(definite=False, doing=None, colour=None, kind="vehicle"):
            return True
    return False


def _when(event: Event, g: Grounder, window: Window) -> tuple[float, float]:
    inner = g.window(event.time, event.tense)
    before = isinstance(event.time, Back) and event.time.relation in ("before", "earlier")
    if inner.said and not before:
        return inner.search
    moment = min(window.end, g.context.now)
    if event.tense == "present":
        return moment - JUST_NOW, moment
    if event.tense == "future":
        return moment, g.context.now
    return g.context.begin, g.context.now
