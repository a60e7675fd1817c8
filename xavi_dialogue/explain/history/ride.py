"""Ride: the record as it stood when the question was asked, indexed for explaining.

Errors:

    ExplainError
    └── Unanswered   a refusal or a request for rollouts; carries it, and never leaves `explain`
"""

from bisect import bisect_right
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import cached_property

from planner.motion.road_users import road_users_in
from planner.record.trace import Action, PlanTrace, VehiclePrediction, WhatIf
from sim.scene import EGO, Scene
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.domain.answers import NeedRollout, NotApplicable, NotRecorded, Refusal, TooLittle
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.errors import XaviError
from xavi_dialogue.explain.history.between import seen_last
from xavi_dialogue.explain.history.deeds import Deed, read_deeds
from xavi_dialogue.explain.history.joining import Joined, Seen, joined
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.thresholds import STANDING
from xavi_dialogue.explain.history.turning import by_turns

#: Evidence is enough if the samples behind it cover this share of the prior mass: then what they
#: all agree on is the likeliest result, however few they are ...
MIN_COVERAGE = 0.5
#: ... or if they are this many: what happens with probability 1/4 is missed in 11 draws with less
#: than 5 % (0.75^11 = 0.042). docs/causal.md has the errors that go with both.
MIN_DISTINCT = 11
#: Rollouts to request if those of the search do not suffice, and if these do not, either. They
#: spread over what may follow the actions, of which only the best counts.
ROUNDS = (40, 160)
ROUNDING = 1e-6  # [s]
MODELS = 8  # causal models that are kept from one question to the next


class ExplainError(XaviError):
    """A question that has no answer."""


class Unanswered(ExplainError):
    """A refusal or a request for rollouts that ends the work on a question."""

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
        self.gaps = record.gaps  # [s] begin and end of what was lost
        self.arrived = any(event.kind == "arrived" for event in self.events)
        self.notes: dict[str, object] = {}  # results that other modules keep here
        self._models: dict[int, CausalModel] = {}

    @cached_property
    def scene(self) -> Scene | None:
        """What was seen last, if it is later than the last decision; else None.

        As in traces, people on foot are among the vehicles.
        """
        if not self.traces:
            return None
        scene = seen_last(self.record.scene, self.record.traces, self.now)
        if scene is None or EGO not in scene.vehicles:
            return None
        return replace(scene, vehicles=road_users_in(scene))

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
        """The actions that the ego carried out, oldest first."""
        return tuple(deed for deed in self.begun if deed.carried_out and not self._given_up(deed))

    @cached_property
    def begun(self) -> list[Deed]:
        """The actions that the ego began, oldest first, including those that it gave up."""
        return read_deeds(self.events)

    def stood(self, deed: Deed) -> float | None:
        """Return when [s] the ego came to a standstill in an action; None if it did not."""
        motion, (_, end) = self.motion(EGO), deed.span
        inside = motion.within(deed.started, end)
        return next((motion.time[k] for k in inside if motion.speed[k] < STANDING), None)

    def _given_up(self, deed: Deed) -> bool:
        """Check whether an action was a stop that led to no standstill."""
        over = deed.action == "stop" and deed.ended is not None
        known = len(self.motion(EGO).within(deed.started, deed.span[1])) > 0
        return over and known and self.stood(deed) is None

    @property
    def under_way(self) -> Deed | None:
        """The action that has begun and not ended, even if the turn itself is still to come."""
        begun = self.begun
        return begun[-1] if begun and begun[-1].ended is None else None

    def meant(self, deeds: Sequence[Deed], span: Span | None = None) -> Deed | None:
        """Return the last of some actions, oldest first, that overlaps a part of the ride."""
        found = [d for d in deeds if span is None or meets(d.span, span)]
        return found[-1] if found else None

    def manoeuvre(self, span: Span | None = None) -> Deed | None:
        """Return the last action that was more than driving on, else the last, within a span."""
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
        """Return what was seen of a vehicle: its motion, its lights, and when it was hidden."""
        return self._joined.seen.get(vehicle) or Seen()

    def motion(self, vehicle: int) -> Motion:
        """Return the recorded motion of a vehicle, joined over all traces."""
        return self.seen(vehicle).motion

    @cached_property
    def times(self) -> list[float]:
        """The time [s] of each decision."""
        return [trace.sim_time for trace in self.traces]

    def index(self, time: float) -> int | None:
        """Return the index of the last decision at or before a time [s]."""
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
        """Return the last decision for an action that still had alternatives.

        If that is not in the record, it is the first one that decided so again.

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

        Plans under a supposition about another vehicle, lights, or what is hidden are left out.
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
        """Return the plan made again from a decision without vehicles; None if not available.

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
        """Return the plan made again from a decision with a supposition about a vehicle, if any."""
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
        """Return the decision of the ride from which a plan was made again, or the plan itself."""
        moment = (trace.sim_time, trace.decision)
        return next((t for t in self.traces if (t.sim_time, t.decision) == moment), trace)

    def _more(self, trace: PlanTrace, actions: Actions) -> NeedRollout | None:
        """Return the next request for rollouts that begin with actions; None if none is left."""
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
        """Refuse actions that proved not to apply when the planner tried them.

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
        """Return enough rollouts that begin with actions, from the search or planned again.

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


_models: list[CausalModel] = []  # of the decisions that were asked about last, latest first


def _model(trace: PlanTrace) -> CausalModel:
    """Return the causal model of a decision; successive questions share it."""
    found = next((one for one in _models if one.trace is trace), None) or CausalModel(trace)
    _models[:] = [found, *(one for one in _models if one is not found)][:MODELS]
    return found


def _of_other(what_if: WhatIf) -> tuple[object, ...]:
    """Return what a request supposes of another vehicle."""
    return what_if.vehicle, what_if.goal, what_if.vehicle_actions, what_if.faster


def meets(done: tuple[float, float], span: Span) -> bool:
    """Check whether a begin and end [s] overlap a part of the ride."""
    begin, end = done
    if end <= begin + ROUNDING or span.end <= span.begin + ROUNDING:
        return span.begin - ROUNDING <= end and begin <= span.end + ROUNDING
    return span.begin + ROUNDING < end and begin < span.end - ROUNDING


def enough(intervention: Intervention) -> bool:
    """Check whether there is enough evidence for statements about an intervention."""
    return intervention.coverage >= MIN_COVERAGE or len(intervention.results) >= MIN_DISTINCT


def thin(actions: Sequence[Action], found: Intervention | None) -> Unanswered:
    """Return the refusal for too little evidence."""
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
    found = next((p for p in trace.predictions if p.vehicle == vehicle), None)
    return None if found is None else by_turns(found)
