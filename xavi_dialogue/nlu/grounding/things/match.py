"""Match: how well one vehicle fits a description."""

from dataclasses import dataclass

from xavi_dialogue.domain.facts import Episode, Look

MISS = 0.45  # cost from which a word is wrong


@dataclass(frozen=True, slots=True)
class Match:
    """A vehicle with the cost of each constraint that it was held against."""

    vehicle: int
    look: Look  # at the time spoken of
    misses: dict[str, float]
    stage: float  # cost of what does not lie in the description
    done: Episode | None = None  # what the relative clause says
    deed: Episode | None = None  # what the sentence says

    @property
    def cost(self) -> float:
        """What the description costs."""
        return sum(self.misses.values())

    @property
    def total(self) -> float:
        """What speaks against this vehicle in all."""
        return self.cost + self.stage

    @property
    def wrong(self) -> tuple[str, ...]:
        """The parts of the description that are wrong."""
        return tuple(name for name, cost in self.misses.items() if cost >= MISS)
