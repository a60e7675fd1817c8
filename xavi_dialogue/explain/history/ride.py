"""Ride: the record as it stood when the question was asked, indexed for explaining.

Errors:

    ExplainError
    └── Unanswered   a refusal or a request for rollouts; carries it, and never leaves `explain`
"""

from bisect import bisect_right
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import cached_property

from planner.motion.everybody import everybody_in
from planner.record.trace import Action, PlanTrace, VehiclePrediction, WhatIf
from sim.scene import EGO, Scene
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.domain.answers import NeedRollout, NotApplicable, NotRecorded, Refusal, TooLittle
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.errors import XaviError
from xavi_dialogue.explain.history.deeds import Deed, read_deeds
from xavi_dialogue.explain.history.joining import Joined, Seen, joined
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.thresholds import STANDING

#: Evidence is enough if the samples behind it cover this share of the prior mass, so that what all
#: agree on is likeliest, however few there are; all of them, where no more exist ...
MIN_COVERAGE = 0.5
#: ... or are this many: what happens with probability 1/4 goes unseen in 11 draws with less than
#: 5 % (0.75^11 = 0.042). docs/causal.md has the errors that go with both.
MIN_DISTINCT = 11
#: Rollouts that are asked for where the search's own do not suffice, and where those do not either:
#: they spread over what may follow the actions, of which only the best counts.
ROUNDS = (40, 160)
ROUNDING = 1e-6  # [s]
MODELS = 8  # causal models that are kept from one question to the next


class ExplainError(XaviError):
    """A question that has no answer."""


class Unanswered(ExplainError):
    """Ends the work on a question with a refusal or a request for rollouts."""

    def __init__(self, result: Refusal | NeedRollout) -> None:
        super().__init__(result)
        self.result = result


class Ride:
    """A record up to its `now`."""

    def __init__(self, record: Record) -> None:
        self.record = record
        self.now = record.now
        self.traces = tuple(t for t in record.traces if t.sim_time <= record.now + ROUNDING)
        self.events = tuple(e for e in record.events if e.sim_time <= record.now + ROUNDING)
        self.ended = record.ended
        self.gaps = record.gaps  # [s] from when to when some of it was lost
        self.arrived = any(event.kind == "arrived" for event in self.events)
        self.notes: dict[str, object] = {}  # what others worked out of it
        self._models: dict[int, CausalModel] = {}

    @cached_property
    def scene(self) -> Scene | None:
        """What was seen last, after the last decision; None where that one knows no less.

        As in traces, people on foot are among the vehicles.
        """
        scene = self.record.scene
        if scene is None or not self.traces or EGO not in scene.vehicles:
            return None
        since = self.traces[-1].sim_time
        if not since + ROUNDING < scene.time <= self.now + ROUNDING:
            return None
        return replace(scene, vehicles=everybody_in(scene))

    @property
    def latest(self) -> PlanTrace:
        """The last decision.

        Raises:
            Unanswered: there is none yet.
        """
        if not self.traces:
            raise Unanswered(NotRecorded(gap="gap-in-record", until=self.now))
        return self.traces[-1]

    @cached_property
    def deeds(self) -> tuple[Deed, ...]:
        """What the ego carried out, oldest first."""
        return tuple(deed for deed in self.begun if deed.carried_out and not self._given_up(deed))

    @cached_property
    def begun(self) -> list[Deed]:
        """What the ego set out to do, oldest first; also what it gave up."""
        return read_deeds(self.events)

    def stood(self, deed: Deed) -> float | None:
        """Return when [s] the ego came to stand in a deed; None where it did not."""
        motion, (_, end) = self.motion(EGO), deed.span
        inside = motion.within(deed.started, end)
        return next((motion.time[k] for k in inside if motion.speed[k] < STANDING), None)

    def _given_up(self, deed: Deed) -> bool:
        """Check whether it was a stop that came to no standstill."""
        over = deed.action == "stop" and deed.ended is not None
        known = len(self.motion(EGO).within(deed.started, deed.span[1])) > 0
        return over and known and self.stood(deed) is None

    @property
    def under_way(self) -> Deed | None:
        """What the ego is about, even where the turn itself is still to come."""
        begun = self.begun
        return begun[-1] if begun and begun[-1].ended is None else None

    def meant(self, deeds: Sequence[Deed], span: Span | None = None) -> Deed | None:
        """Of some deeds, oldest first, the last that meets a part of the ride."""
        found = [d for d in deeds if span is None or meets(d.span, span)]
        return found[-1] if found else None

    def manoeuvre(self, span: Span | None = None) -> Deed | None:
        """The last deed that was more than driving on, else the last one; at a time, if said."""
        moves = tuple(deed for deed in self.deeds if deed.action != "continue")
        return self.meant(moves, span) or self.meant(self.deeds, span)

    def back(self, time: float) -> "Ride":
        """Return the ride as it stood at an earlier time [s]."""
        return self if time >= self.now else Ride(replace(self.record, now=time, ended=False))

    @cached_property
    def vehicles(self) -> tuple[int, ...]:
        """All other vehicles seen so far."""
        return tuple(sorted(self._joined.seen.keys() - {EGO}))

    def model(self, trace: PlanTrace) -> CausalModel:
        """Return the causal model of a trace."""
        known = self._models.get(id(trace))
        if known is None:
            known = self._models[id(trace)] = _model(trace)
        return known

    @cached_property
    def _joined(self) -> Joined:
        known = joined(self.traces)
        return known if self.scene is None else known.reaching(self.scene)

    def seen(self, vehicle: int) -> Seen:
        """What was seen of a vehicle over all decisions: motion, lights, when it was hidden."""
        return self._joined.seen.get(vehicle) or Seen()

    def motion(self, vehicle: int) -> Motion:
        """Return the recorded motion of a vehicle, joined over all traces."""
        return self.seen(vehicle).motion

    @cached_property
    def times(self) -> list[float]:
        """When [s] each decision was taken."""
        return [trace.sim_time for trace in self.traces]

    def index(self, time: float) -> int | None:
        """Return which of `traces` is the last decision at or before a time [s]."""
        k = bisect_right(self.times, time + ROUNDING) - 1
        return k if k >= 0 else None

    def at(self, time: float, vehicle: int = EGO) -> PlanTrace | None:
        """Return the last decision at or before a time [s] that knows a vehicle."""
        last = self.index(time)
        while last is not None and last >= 0:
            if vehicle in self.traces[last].scene:
                return self.traces[last]
            last -= 1
        return None

    def choice_of(self, deed: Deed) -> PlanTrace:
        """Return the last decision for a deed that still had alternatives.

        Where that is not in the record, the first one that decided so again.

        Raises:
            Unanswered: it is not in the record.
        """
        chosen = [t for t in self.traces if chose(t, deed.action)]
        named = [t for t in chosen if t.decision == deed.decision]
        before = [t for t in chosen if t.sim_time <= deed.time + ROUNDING]
        end = self.now if deed.ended is None else deed.ended
        again = [t for t in chosen if deed.time <= t.sim_time <= end]
        found = named[-1:] or before[-1:] or again[:1]
        if not found:
            raise Unanswered(NotRecorded(gap="gap-in-record", since=deed.time))
        return found[0]

    def variants(self, trace: PlanTrace, removed: Collection[int] = ()) -> tuple[PlanTrace, ...]:
        """Return the plans made again from a decision, without some vehicles or with all of them.

        Those for which something was supposed of another vehicle, of lights, or of what is hidden
        are left out.
        """
        vehicles = set(trace.scene) - set(removed)
        return tuple(
            extra
            for extra in self.record.extra
            if (extra.sim_time, extra.decision) == (trace.sim_time, trace.decision)
            and set(extra.scene) == vehicles
            and (extra.what_if is None or extra.what_if.vehicle is None)
            and not getattr(extra.what_if, "lights", ())
            and not getattr(extra.what_if, "seen_past", ())
        )

    def without(self, trace: PlanTrace, *vehicles: int) -> PlanTrace | None:
        """The plan made again from a decision without vehicles; None where that is not available.

        Raises:
            Unanswered: rollouts are needed.
        """
        again = self.variants(trace, removed=vehicles)
        gone = vehicles[0] if len(vehicles) == 1 else tuple(sorted(vehicles))
        need = NeedRollout(trace_id=trace.trace_id, removed=gone)
        if not again and need not in self.record.refused:
            raise Unanswered(need)
        return again[-1] if again else None

    def supposed(self, trace: PlanTrace, need: NeedRollout) -> PlanTrace | None:
        """The plan made again from a decision with what was supposed of a vehicle, if any."""
        moment = (trace.sim_time, trace.decision)
        wanted = (need.vehicle, need.goal or None, need.vehicle_actions or (), need.faster)
        return next(
            (
                extra
                for extra in self.record.extra
                if extra.what_if is not None
                and (extra.sim_time, extra.decision) == moment
                and _of_other(extra.what_if) == wanted
            ),
            None,
        )

    def cannot_have(self, need: NeedRollout) -> bool:
        """Check whether the planner was asked for something and could not give it."""
        return need in self.record.refused

    def original(self, trace: PlanTrace) -> PlanTrace:
        """The decision of the ride from which a plan was made again, or the decision itself."""
        moment = (trace.sim_time, trace.decision)
        return next((t for t in self.traces if (t.sim_time, t.decision) == moment), trace)

    def _more(self, trace: PlanTrace, actions: Actions) -> NeedRollout | None:
        """The next request for rollouts of leading actions; None where there is none left."""
        if trace.under_way is not None:
            return None
        made = [e.what_if for e in self.variants(trace) if e.what_if is not None]
        done = {one.rollouts for one in made if one.actions == actions}
        needs = [
            NeedRollout(trace_id=trace.trace_id, actions=actions, rollouts=rollouts)
            for rollouts in ROUNDS
            if rollouts not in done
        ]
        more = [need for need in needs if need not in self.record.refused]
        return next(iter(more if done else needs), None)

    def _check_possible(self, trace: PlanTrace, actions: Actions) -> None:
        """Decline actions that turned out not to apply when they were to be tried.

        Raises:
            Unanswered: one of them does not, with the planner's reason.
        """
        steps = {(actions[:depth], action) for depth, action in enumerate(actions)}
        for again in self.variants(trace):
            for entry in again.not_applicable:
                if (entry.node, entry.action) in steps:
                    asked = (entry.action,)
                    raise Unanswered(NotApplicable(asked, entry.reason, trace.sim_time))

    def evidence(self, trace: PlanTrace, actions: Actions) -> tuple[CausalModel, Intervention]:
        """Enough rollouts of leading actions, from the search or from planning again.

        Raises:
            Unanswered: rollouts are needed; or they have been made and are still too few, or an
                action does not apply.
        """
        again = self.variants(trace)
        found = [(m, m.intervene(actions)) for m in map(self.model, (trace, *again))]
        for model, intervention in found:
            if intervention is not None and enough(intervention):
                return model, intervention
        self._check_possible(trace, actions)
        need = self._more(trace, actions)
        if need is not None:
            raise Unanswered(need)
        known = [intervention for _, intervention in found if intervention is not None]
        raise thin(actions, max(known, key=lambda i: i.draws, default=None))


_models: list[CausalModel] = []  # of the decisions asked about last, latest first


def _model(trace: PlanTrace) -> CausalModel:
    """Return the causal model of a decision, which questions after one another share."""
    found = next((one for one in _models if one.trace is trace), None) or CausalModel(trace)
    _models[:] = [found, *(one for one in _models if one is not found)][:MODELS]
    return found


def _of_other(what_if: WhatIf) -> tuple[object, ...]:
    """Return what a request supposes of another vehicle."""
    return what_if.vehicle, what_if.goal, what_if.vehicle_actions, what_if.faster


def meets(done: tuple[float, float], span: Span) -> bool:
    """Whether what was done from when to when [s] lies in a part of the ride, at least partly."""
    begin, end = done
    if end <= begin + ROUNDING or span.end <= span.begin + ROUNDING:
        return span.begin - ROUNDING <= end and begin <= span.end + ROUNDING
    return span.begin + ROUNDING < end and begin < span.end - ROUNDING


def enough(intervention: Intervention) -> bool:
    """Check whether there is enough evidence to speak of an intervention."""
    return intervention.coverage >= MIN_COVERAGE or len(intervention.results) >= MIN_DISTINCT


def thin(actions: Sequence[Action], found: Intervention | None) -> Unanswered:
    """Return the refusal where there is not enough evidence."""
    distinct = len(found.results) if found else 0
    asked = tuple(actions)
    return Unanswered(
        TooLittle("too-little-evidence", asked=asked, distinct=distinct, needed=MIN_DISTINCT)
    )


def chose(trace: PlanTrace, action: Action) -> bool:
    """Check whether a decision chose an action and had alternatives to it."""
    return trace.under_way is None and bool(trace.plan) and trace.plan[0].action == action


def planned(trace: PlanTrace) -> Actions:
    """Return the actions of a decision's plan."""
    return tuple(step.action for step in trace.plan)


def prediction(trace: PlanTrace, vehicle: int) -> VehiclePrediction | None:
    """Return what a decision expects of a vehicle."""
    return next((p for p in trace.predictions if p.vehicle == vehicle), None)
