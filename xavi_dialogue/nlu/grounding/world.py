"""World: what grounding asks of the fact layer. `explain.facts.world.World` has this form."""

from collections.abc import Collection
from typing import Protocol

from planner.record.places import RoadFacts
from xavi_dialogue.domain.facts import Episode, Look, Somebody
from xavi_dialogue.domain.terms import Event, Thing
from xavi_dialogue.domain.vocabulary import ActionName, Relation


class World(Protocol):
    """The ride so far, as facts; all times in simulation seconds."""

    @property
    def now(self) -> float: ...

    @property
    def begin(self) -> float: ...

    @property
    def vehicles(self) -> tuple[int, ...]: ...

    def in_view(self, t: float) -> tuple[int, ...]:
        """List the vehicles that are seen at a time."""

    def crossing(self, t: float) -> tuple[int, ...]:
        """List who crosses our way at a time, crossed it lately or is about to."""

    def look(self, vehicle: int, t: float) -> Look | None:
        """Describe a vehicle as it is seen at a time, or was seen last; None: never until then."""

    def episodes(
        self,
        actor: Somebody | None = None,
        actions: Collection[ActionName] | None = None,
        begin: float | None = None,
        end: float | None = None,
        object: Thing | None = None,  # noqa: A002
    ) -> tuple[Episode, ...]:
        """List what was done, by begin."""

    def relation(self, relation: Relation, thing: Thing, to: Thing, at: float) -> bool | None:
        """Tell whether a relation holds at a time; None: it cannot be known."""

    def holds(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        """List the episodes that are such an event."""

    def decided(self, number: int) -> float | None:
        """Tell when the decision of a number was taken; None: not recorded."""

    def road(self, t: float) -> RoadFacts | None:
        """Give the facts of the road at a time; None: not recorded."""
