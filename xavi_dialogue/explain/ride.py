"""Ride: the record as it stood when the question was asked, indexed for explaining.

Errors:

    ExplainError
    └── Unanswered   an answer other than an Explanation; carries it, and never leaves this room
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from planner.events import Event
from planner.trace import Action, PlanTrace, VehiclePrediction
from sim.scene import EGO
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.explain.explanation import Facts, NeedRollout, NoExplanation, Reason
from xavi_dialogue.explain.motion import STANDING, Motion, join
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.when import Focus, pick

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


class ExplainError(Exception):
    """A query that has no explanation."""


class Unanswered(ExplainError):
    """Ends the work on a query with a refusal or a request for rollouts."""

    def __init__(self, result: NoExplanation | NeedRollout) -> None:
        super().__init__(result)
        self.result = result


def decline(
    reason: Reason, /, **facts: str | float | int | bool | tuple[str, ...] | None
) -> Unanswered:
    """A refusal, to be raised."""
    known: Facts = {name: value for name, value in facts.items() if value is not None}
    return Unanswered(NoExplanation(reason=reason, facts=known))


@dataclass(frozen=True, slots=True)
class Deed:
    """One macro action of the ego, from its events."""

    action: Action
    decision: int | None  # that chose it
    started: float  # [s]
    committed: float | None = None  # [s] when it could no longer be taken back
    ended: float | None = None  # [s] None while it is under way

    @property
    def time(self) -> float:
        """When it was decided for good [s]."""
        return self.started if self.committed is None else self.committed

    @property
    def span(self) -> tuple[float, float]:
        """From when to when it was done [s]; it has no end as long as it is under way."""
        return self.time, math.inf if self.ended is None else self.ended

    @property
    def carried_out(self) -> bool:
        """Whether it was done or is being done; a turn still to come is neither."""
        if self.committed is not None or self.action in ("continue", "stop"):
            return True
        return self.ended is None and not self.action.startswith("exit")


class Ride:
    """A record up to its `now`."""

    def __init__(self, record: Record) -> None:
        self._record = record
        self.now = record.now
        self.traces = tuple(t for t in record.traces if t.sim_time <= record.now + ROUNDING)
        self.events = tuple(e for e in record.events if e.sim_time <= record.now + ROUNDING)
        self.ended = record.ended
        self.gaps = record.gaps  # [s] from when to when some of it was lost
        self.arrived = any(event.kind == "arrived" for event in self.events)
        self._extra, self._refused = record.extra, record.refused
        self._models: dict[int, CausalModel] = {}

    @property
    def latest(self) -> PlanTrace:
        """The last decision.

        Raises:
            Unanswered: there is none yet.
        """
        if not self.traces:
            raise decline("trace-gap", time=self.now)
        return self.traces[-1]

    @cached_property
    def deeds(self) -> tuple[Deed, ...]:
        """What the ego carried out, oldest first."""
        return tuple(
            deed for deed in _deeds(self.events) if deed.carried_out and not self._given_up(deed)
        )

    def stood(self, deed: Deed) -> float | None:
        """When [s] the ego came to stand in a deed; None where it did not."""
        motion, (_, end) = self.motion(EGO), deed.span
        pairs = zip(motion.time, motion.speed, strict=True)
        return next((t for t, v in pairs if deed.started <= t <= end and v < STANDING), None)

    def _given_up(self, deed: Deed) -> bool:
        """Whether it was a stop that came to no standstill."""
        known = any(deed.started <= t <= deed.span[1] for t in self.motion(EGO).time)
        over = deed.action == "stop" and deed.ended is not None
        return over and known and self.stood(deed) is None

    @property
    def under_way(self) -> Deed | None:
        """What the ego is about, even where the turn itself is still to come."""
        begun = _deeds(self.events)
        return begun[-1] if begun and begun[-1].ended is None else None

    @property
    def manoeuvre(self) -> Deed | None:
        """The last deed that was more than driving on; else the last one.

        Where the question says when: the one at that time.
        """
        moves = tuple(deed for deed in self.deeds if deed.action != "continue")
        if self.past is None:
            return next(reversed(moves or self.deeds), None)
        return self.meant(moves) or self.meant(self.deeds)

    @property
    def past(self) -> Focus | None:
        """The part of the ride so far that the question is about; None where it does not say."""
        focus = self._record.focus
        return None if focus is None or focus.ahead else focus

    @property
    def ahead(self) -> Focus | None:
        """What is to come that the question is about; None where it does not say."""
        focus = self._record.focus
        return focus if focus is not None and focus.ahead else None

    def meant(self, deeds: Sequence[Deed]) -> Deed | None:
        """Of some deeds, oldest first, the one that the question is about, else the last."""
        return pick(self.past, deeds, lambda deed: deed.span)

    def back(self, time: float) -> "Ride":
        """The ride as it stood at an earlier time [s]."""
        return Ride(replace(self._record, now=time, ended=False, focus=None))

    @cached_property
    def vehicles(self) -> tuple[int, ...]:
        """All other vehicles seen so far."""
        return tuple(sorted({v for trace in self.traces for v in trace.scene} - {EGO}))

    def model(self, trace: PlanTrace) -> CausalModel:
        """The causal model of a trace."""
        if id(trace) not in self._models:
            self._models[id(trace)] = CausalModel(trace)
        return self._models[id(trace)]

    def motion(self, vehicle: int) -> Motion:
        """The recorded motion of a vehicle, joined over all traces."""
        return join([t.history[vehicle] for t in self.traces if vehicle in t.history])

    def at(self, time: float, vehicle: int = EGO) -> PlanTrace | None:
        """The last decision at or before a time [s] that knows a vehicle."""
        known = [t for t in self.traces if t.sim_time <= time + ROUNDING and vehicle in t.scene]
        return known[-1] if known else None

    def choice_of(self, deed: Deed) -> PlanTrace:
        """The last decision for a deed that still had alternatives.

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
            raise decline("trace-gap", time=deed.time)
        return found[0]

    def variants(self, trace: PlanTrace, removed: int | None = None) -> tuple[PlanTrace, ...]:
        """The plans made again from a decision, without a vehicle or with all of them.

        Those for which something was supposed of another vehicle are left out.
        """
        vehicles = set(trace.scene) - {removed}
        return tuple(
            extra
            for extra in self._extra
            if (extra.sim_time, extra.decision) == (trace.sim_time, trace.decision)
            and set(extra.scene) == vehicles
            and (extra.what_if is None or extra.what_if.vehicle is None)
        )

    def without(self, trace: PlanTrace, vehicle: int) -> PlanTrace | None:
        """The plan made again from a decision without a vehicle; None where that cannot be had.

        Raises:
            Unanswered: rollouts are needed.
        """
        again = self.variants(trace, removed=vehicle)
        need = NeedRollout(trace_id=trace.trace_id, removed=vehicle)
        if not again and need not in self._refused:
            raise Unanswered(need)
        return again[-1] if again else None

    def supposed(self, trace: PlanTrace, need: NeedRollout) -> PlanTrace | None:
        """The plan made again from a decision with what was supposed of a vehicle, if any."""
        moment = (trace.sim_time, trace.decision)
        wanted = (need.vehicle, need.goal or None, need.vehicle_actions or ())
        return next(
            (
                extra
                for extra in self._extra
                if extra.what_if is not None
                and (extra.sim_time, extra.decision) == moment
                and (extra.what_if.vehicle, extra.what_if.goal, extra.what_if.vehicle_actions)
                == wanted
            ),
            None,
        )

    def cannot_have(self, need: NeedRollout) -> bool:
        """Whether the planner was asked for something and could not give it."""
        return need in self._refused

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
        more = [need for need in needs if need not in self._refused]
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
                    asked, time = (entry.action,), trace.sim_time
                    raise decline("not-applicable", asked=asked, reason=entry.reason, time=time)

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


def enough(intervention: Intervention) -> bool:
    """Whether there is enough evidence to speak of an intervention."""
    return intervention.coverage >= MIN_COVERAGE or len(intervention.results) >= MIN_DISTINCT


def thin(actions: Sequence[str], found: Intervention | None) -> Unanswered:
    """The refusal where there is not enough evidence."""
    return decline(
        "too-little-evidence",
        asked=tuple(actions),
        rollouts=found.draws if found else 0,
        distinct=len(found.results) if found else 0,
        needed=MIN_DISTINCT,
        coverage=found.coverage if found else 0.0,
    )


def chose(trace: PlanTrace, action: Action) -> bool:
    """Whether a decision chose an action and had alternatives to it."""
    return trace.under_way is None and bool(trace.plan) and trace.plan[0].action == action


def planned(trace: PlanTrace) -> Actions:
    """The actions of a decision's plan."""
    return tuple(step.action for step in trace.plan)


def prediction(trace: PlanTrace, vehicle: int) -> VehiclePrediction | None:
    """What a decision expects of a vehicle."""
    return next((p for p in trace.predictions if p.vehicle == vehicle), None)


def _deeds(events: Sequence[Event]) -> list[Deed]:
    found: list[Deed] = []
    for event in events:
        last = found[-1] if found and found[-1].ended is None else None
        if event.kind == "action-started" and event.action is not None:
            if last is not None:
                found[-1] = replace(last, ended=event.sim_time)
            found.append(Deed(event.action, event.decision, event.sim_time))
        elif last is None or event.action not in (None, last.action):
            continue
        elif event.kind == "action-committed":
            chosen = last.decision if event.decision is None else event.decision
            found[-1] = replace(last, committed=event.sim_time, decision=chosen)
        elif event.kind in ("action-ended", "arrived", "collided", "ended"):
            found[-1] = replace(last, ended=event.sim_time)
    return found
