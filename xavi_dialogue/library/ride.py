"""A ride that can be asked about, and conversations about it."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from planner.record.events import Event
from sim.roads.network import Network
from sim.scene import Scene
from xavi_dialogue.dialogue.manager import fold
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.events import Input
from xavi_dialogue.dialogue.state.state import EPSILON, Dialogue
from xavi_dialogue.library import html
from xavi_dialogue.library.answers import Answer, answer, told_so_far
from xavi_dialogue.library.arguments import check_style, path_of, question_of, whole
from xavi_dialogue.library.curves import Curves, curves
from xavi_dialogue.library.decisions import Decision
from xavi_dialogue.library.errors import LibraryError, translated
from xavi_dialogue.library.html import element
from xavi_dialogue.library.pictures import Picture, drawn
from xavi_dialogue.library.reports import Report, report_of
from xavi_dialogue.library.tables import TableName, table
from xavi_dialogue.library.trajectories import compared
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.process.clock_time import seconds_of
from xavi_dialogue.service import in_process
from xavi_dialogue.service.in_process import Replan, make_pipeline
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide
from xavi_dialogue.transcripts.replay import keeping

if TYPE_CHECKING:
    from xavi_dialogue.library.tables import DataFrame
    from xavi_dialogue.report.ridden import Ridden

T = TypeVar("T")

#: An input of the dialogue, and the time [s] from which on it is known.
Known: TypeAlias = tuple[float, Input]


@dataclass(frozen=True, eq=False)
class Ride:
    """One ride: its decisions, events and scenes, and answers about it."""

    record: RecordedRide
    scenes: tuple[Scene, ...]  # in order of time
    known: tuple[Known, ...]  # what answers rest on, in order of time
    again: Replan  # plans again what the record does not hold
    network: Network | None = None  # the roads, where they are known
    digest: str | None = None  # SHA-256 of the file that it was read from

    @property
    def scenario(self) -> str:
        """The name of the scenario, or its folder."""
        return self.record.scenario

    @property
    def seed(self) -> int:
        """The seed of the ride."""
        return self.record.seed

    @property
    def end(self) -> float:
        """The time [s] up to which it is recorded."""
        return max(self.known[-1][0], self.record.halt)

    @cached_property
    def decisions(self) -> tuple[Decision, ...]:
        """Every decision, oldest first."""
        return tuple(Decision(trace, self.network) for trace in self.record.traces)

    @property
    def events(self) -> tuple[Event, ...]:
        """What the car did, oldest first."""
        return tuple(self.record.events)

    def ask(
        self, question: str, at: float | str | None = None, style: Style = "passenger"
    ) -> Answer:
        """Return the answer to a question by itself; it knows of no question before.

        Args:
            question: in plain English.
            at: [s], also as "1:05": when it is asked. Default: the end of the first lane change or
                turn that was carried out, else the end of the ride.
            style: `passenger`, or `paper` for the wording of the paper.

        Raises:
            XaviError: there is no such time or style.
        """
        return self.conversation(style).ask(question, at)

    def conversation(self, style: Style = "passenger") -> "Conversation":
        """Begin a conversation, in which questions may follow up on those before.

        Raises:
            XaviError: there is no such style.
        """
        return Conversation(self, style)

    def map(self, at: float | str | None = None) -> Picture:
        """Return a map of a moment, with the plan in force and what was believed.

        Args:
            at: [s], also as "1:05". Default: as in `ask`.

        Raises:
            XaviError: there is no such time.
        """
        time = self.default_time if at is None else self.moment(at)
        if not self.decisions:
            raise LibraryError("the ride holds no decision, so that there is no map")
        scene = _latest(self.scenes, [one.time for one in self.scenes], time)
        decision = _latest(self.decisions, [one.time for one in self.decisions], time)
        return drawn(replace(decision.view, scene=scene))

    def curves(self, vehicle: int) -> Curves:
        """Return how the beliefs about a road user moved over the ride.

        Raises:
            XaviError: no decision considered it.
        """
        wanted = whole(vehicle, "vehicle", "its number, such as 1")
        found = curves(self.record.traces, wanted)
        if found is None:
            seen = {one.vehicle for trace in self.record.traces for one in trace.predictions}
            raise LibraryError(
                f"no decision expected anything of vehicle {vehicle}; there are {sorted(seen)}"
            )
        return found

    def table(self, name: TableName) -> "DataFrame":
        """Return a table of pandas: `decisions`, `options`, `beliefs` or `events`.

        Raises:
            XaviError: there is no such table, or pandas is not installed.
        """
        return table(name, self.decisions, self.events)

    def save(self, path: str | Path) -> Path:
        """Save decisions, events and what was planned again, as `xavi drive --save` does.

        Returns:
            The file; it gets the ending `.ride.jsonl.gz` where the path has none.

        Raises:
            XaviError: it cannot be written.
        """
        file = ride_file.named(path_of(path))
        ride_file.save(self.record, file)
        return file

    def report(self, at: float | str | None = None) -> Report:
        """Report what the record shows of an incident.

        Args:
            at: a time [s], also as "1:05", or "collision", "hardest braking", "closest approach"
                or "red light". Default: the most remarkable moment.

        Raises:
            XaviError: there is no such moment.
        """
        return report_of(_ridden(self), at)

    @cached_property
    def default_time(self) -> float:
        """When [s] a question is asked that names no time."""
        ends = carried_out(self.events)
        times = (time for time, _ in self.known if ends and time >= ends[0].sim_time - EPSILON)
        return next(times, self.end)

    def moment(self, at: object) -> float:
        """Return a time [s] that was asked for; of one after the end, the end.

        Raises:
            XaviError: it is none of the ride.
        """
        wanted = f"a time [s or m:ss] of the ride, 0 to {self.end:g}"
        time = seconds_of(at)
        if time is None or time < 0.0:
            raise LibraryError(f"at is {at!r}; give {wanted}")
        return min(time, self.end)

    def decision(self, trace_id: str | None) -> Decision | None:
        """Return the decision with an id; None if there is none."""
        return next((one for one in self.decisions if one.trace_id == trace_id), None)

    def __repr__(self) -> str:
        count = len(self.record.traces)
        return f"<Ride {self.scenario}, seed {self.seed}: {count} decisions, {self.end:g} s>"

    def _repr_html_(self) -> str:
        changes = [
            (f"{one.time:g}", ", ".join(one.plan) or "stop")
            for before, one in zip((None, *self.decisions), self.decisions, strict=False)
            if before is None or before.plan != one.plan
        ]
        return element("p", repr(self)[1:-1]) + html.table(("from [s]", "plan"), changes)


def check_moment(ride: Ride, at: float | str | None) -> None:
    """Check that a ride has a moment of which a report can be made, which takes longer.

    Raises:
        XaviError: there is no such moment.
    """
    from xavi_dialogue.report.build import moment_of

    with translated():
        moment_of(_ridden(ride), at)


def _ridden(ride: Ride) -> "Ridden":
    """Return a ride as reports are made of it."""
    from xavi_dialogue.report.ridden import Ridden

    again = keeping(ride.again, ride.record)
    inputs = [one for _, one in ride.known]
    gaps = fold(make_pipeline(), inputs, Dialogue()).gaps
    return Ridden(ride.record, ride.scenes, again, ride.network, ride.digest, gaps)


def _latest(of: Sequence[T], times: Sequence[float], time: float) -> T:
    """Return what was the latest at a time [s], else the first."""
    return of[max(bisect_right(times, time + EPSILON) - 1, 0)]


class Conversation:
    """A conversation about a ride."""

    def __init__(self, ride: Ride, style: Style = "passenger") -> None:
        """Begin one.

        Raises:
            LibraryError: there is no such style.
        """
        check_style(style)
        self.ride = ride
        self.style = style
        self.answers: tuple[Answer, ...] = ()
        self._inner = in_process.Conversation(make_pipeline(), keeping(ride.again, ride.record))
        self._told = 0  # inputs so far
        self._free = [None]  # taken while a question is answered; unlike a lock, it is pickled

    def __repr__(self) -> str:
        count = len(self.answers)
        return f"<Conversation about {self.ride.scenario}, seed {self.ride.seed}: {count} answers>"

    def _repr_html_(self) -> str:
        return told_so_far(self, self.answers)

    def ask(self, question: str, at: float | str | None = None) -> Answer:
        """Return the answer to a question, which may refer to those before.

        Args:
            question: in plain English.
            at: [s], also as "1:05": when it is asked. Default: when the question before was, of
                the first as `Ride.ask` says.

        Raises:
            XaviError: there is no such time.
        """
        text = question_of(question)
        reply = self.reply(text, at)
        record = self.ride.record
        lines = compared(reply, (*record.traces, *record.whatifs.values()))
        found = answer(text, reply, self.ride.decision(reply.trace_id), lines)
        self.answers = (*self.answers, found)
        return found

    def reply(self, question: str, at: float | str | None = None) -> Reply:
        """Return the reply to a question as it goes over the bus; see `ask`."""
        try:
            self._free.pop()
        except IndexError:
            raise LibraryError(
                "a conversation answers one question at a time; give each thread one of its own"
            ) from None
        try:
            time = self._time(at)
            with translated():
                self._know(time)
                return self._inner.ask(question_of(question), time, self.style)
        finally:
            self._free.append(None)

    def _time(self, at: float | str | None) -> float:
        if at is None:
            return self.answers[-1].at if self.answers else self.ride.default_time
        return self.ride.moment(at)

    def _know(self, time: float) -> None:
        """Record the ride up to a time [s]; what was known before stays known."""
        rest = self.ride.known[self._told :]
        news = [one for known, one in rest if known <= time + EPSILON]
        self._told += len(news)
        self._inner.dialogue = fold(self._inner.pipeline, news, self._inner.dialogue)
