"""Decisions of a ride: what was planned, weighed and believed."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

from planner.record.trace import Action, PlanTrace, encode
from planner.record.trace_reading import decode
from sim.roads.network import Network
from sim.scene import Scene
from xavi_dialogue.inspection.comparison import Option, comparison
from xavi_dialogue.library.errors import LibraryError, translated
from xavi_dialogue.library.html import element, table
from xavi_dialogue.library.pictures import Picture, View, drawn
from xavi_dialogue.library.trajectories import Trajectory, planned


@dataclass(frozen=True, slots=True)
class Belief:
    """A goal that another road user may have."""

    vehicle: int  # the number of the road user
    goal: Action  # the action that ends at it
    place: str  # in words
    probability: float  # by the decision, 0 to 1


@dataclass(frozen=True)
class Decision:
    """One decision."""

    trace: PlanTrace = field(repr=False)  # its whole record
    network: Network | None = field(default=None, repr=False, compare=False)  # if it is known

    @property
    def time(self) -> float:
        """When [s] it was taken."""
        return self.trace.sim_time

    @property
    def number(self) -> int:
        """Its running number in the ride."""
        return self.trace.decision

    @property
    def trace_id(self) -> str:
        """The id that answers name."""
        return self.trace.trace_id

    def json(self) -> str:
        """Return its whole record as JSON on one line: a plan trace, see docs/trace.md."""
        return encode(self.trace).decode()

    @classmethod
    def from_json(cls, text: str | bytes) -> Self:
        """Read a decision from the JSON of its plan trace.

        Raises:
            XaviError: it is none; the message names what is wrong.
        """
        if not isinstance(text, str | bytes):
            raise LibraryError(f"give JSON as a text, not {type(text).__name__}")
        try:
            data = text.encode() if isinstance(text, str) else text
        except UnicodeEncodeError as error:
            raise LibraryError(f"not a plan trace: {error}") from error
        with translated():
            return cls(decode(data))

    @property
    def plan(self) -> tuple[Action, ...]:
        """The actions that it came to, the present one first."""
        return tuple(step.action for step in self.trace.plan)

    @cached_property
    def options(self) -> tuple[Option, ...]:
        """The first actions that were compared, best first; none of older records."""
        return comparison(self.trace)

    @cached_property
    def planned(self) -> Trajectory | None:
        """The likeliest trajectory of the plan, as far as the record holds one."""
        return planned(self.trace)

    @property
    def view(self) -> View:
        """What a map of it shows."""
        scene = Scene(self.trace.sim_time, self.trace.scene)
        return View(scene, self.network, self.planned, beliefs=self.trace)

    @property
    def map(self) -> Picture:
        """A map of what was seen, planned and believed."""
        return drawn(self.view)

    @property
    def ruled_out(self) -> Mapping[Action, str]:
        """The first actions that could not be taken, and why."""
        barred = self.trace.not_applicable
        return {one.action: one.reason for one in barred if not one.node}

    @cached_property
    def beliefs(self) -> tuple[Belief, ...]:
        """The goals of the other road users; the likeliest of each first."""
        return tuple(
            Belief(known.vehicle, goal.kind, goal.place, goal.probability)
            for known in self.trace.predictions
            for goal in sorted(known.goals, key=lambda one: -one.probability)
        )

    def __hash__(self) -> int:
        return hash(self.trace_id)

    def __repr__(self) -> str:
        return f"<Decision {self.number} at {self.time:g} s: {', '.join(self.plan) or 'stop'}>"

    def _repr_html_(self) -> str:
        options = (
            (
                f"{one.action}{' (chosen)' if one.chosen else ''}",
                f"{one.value:.1f}",
                ", ".join(f"{name} {chance:.1%}" for name, chance in one.chances.items()),
            )
            for one in self.options
        )
        beliefs = (
            (str(one.vehicle), one.goal, one.place, f"{one.probability:.1%}")
            for one in self.beliefs
        )
        return (
            element("p", repr(self)[1:-1])
            + ("" if self.network is None else self.map._repr_html_())
            + table(("option", "value [s]", "chances"), options)
            + table(("vehicle", "goal", "place", "probability"), beliefs)
        )
