"""Necessity: whether the vehicles that are suspected matter, by planning again without them.

A vehicle that holds the ego up in the rollouts of a foil may be one of many: without it, the next
one would. So the decision is taken again without the vehicle. If that shows nothing, it is taken
without two, and last without all others (`actual`). A choice depends on vehicles without which it
is made differently, or most of its advantage is gone. A way of driving depends on those without
which most of the speed is regained that others cost on the next stretch of road. A vehicle that
makes no difference is no cause.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from msgspec.structs import replace

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.domain.answers import Cause
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES
from xavi_dialogue.explain.causes.vehicles.actual import SINGLES, Trial, actual_causes
from xavi_dialogue.explain.causes.vehicles.hindsight import in_hindsight
from xavi_dialogue.explain.causes.vehicles.involved import against, holding_up, slowing
from xavi_dialogue.explain.causes.vehicles.mediated import holders, leaves
from xavi_dialogue.explain.causes.vehicles.profile import driven, speeds
from xavi_dialogue.explain.history.ride import Ride, enough, planned

LEAST = 0.5  # [s] minimum reward that must depend on vehicles ...
SHARE = 0.5  # ... and this share of the plan's advantage over the foil
EXPECTED = 0.5  # minimum probability of what a vehicle is expected to do
NEARLY = 1.0  # [m/s] above the lowest speed, up to which the ego counts as slowest
LOST = 1.0  # [m/s] that others must cost the ego there, if a way of driving is explained ...
PART = 0.25  # ... and share of what it is slower there than its highest speed without others ...
CREEPING = 1.0  # [m/s] below which the ego stands, and loses time instead of speed
SOMETIMES = 0.25  # [s] of hold-up, expected, from which somebody may be at work
LEFT = 0.5  # ... and maximum share that may remain without the vehicles that matter


@dataclass(frozen=True, slots=True)
class Proven:
    """The causes that matter, and what was found of those tried."""

    causes: tuple[Cause, ...] = ()
    causation: Causation | None = None  # None: nobody was suspected
    replaced: tuple[int, ...] = ()  # vehicles without which others are at work instead

    @property
    def cleared(self) -> tuple[int, ...]:
        """The vehicles that turned out not to matter."""
        return () if self.causation is None else self.causation.cleared


def proven(
    ride: Ride,
    model: CausalModel,
    causes: Sequence[Cause],
    fact: Intervention,
    foil: Intervention | None = None,
) -> Proven:
    """Keep the causes that matter; if that cannot be tried, all, with `necessary` left open.

    Args:
        ride: the record.
        model: the causal model of the decision.
        causes: most important first.
        fact: what was decided.
        foil: what was not decided; None if a way of driving is explained.

    Raises:
        Unanswered: rollouts are needed.
    """
    if not causes:
        return Proven()
    tests = _Tests(ride, model, fact, foil)
    suspects = [cause.vehicle for cause in causes]
    reserve = () if foil is not None else _in_the_way_around(model)
    found = actual_causes(suspects, reserve, tests.trial, tests.behind, tests.everybody)
    if found.kind == "open":
        kept = tuple(cause for cause in causes if cause.vehicle not in found.cleared)
        return Proven(kept, found)
    known = {cause.vehicle: cause for cause in causes}
    blamed = found.vehicles[:1] if found.kind == "pre-empted" else found.vehicles
    if found.kind == "several":  # those at work are stated, as far as each was tried
        at_work = tuple(v for v in suspects[:SINGLES] if v in found.vehicles)
        blamed = at_work or (found.vehicles if found.minimal else ())
    told = [
        known.get(vehicle) or tests.instead(vehicle, suspects) or against(model, vehicle)
        for vehicle in blamed
        if found.kind != "both" or vehicle in (*suspects, *reserve)  # else not in our own way
    ]
    if found.kind in ("both", "either"):  # equal, so what is expected comes first
        told.sort(key=lambda cause: cause.probability < EXPECTED)
    needed = found.kind in ("one", "both")
    causes = tuple(
        replace(cause, decision_changes=tests.changes(cause.vehicle), necessary=needed)
        for cause in told
    )
    decides = tests.decides(found, causes)
    alters = tuple(cause.vehicle for cause in causes if foil is not None and cause.decision_changes)
    found = replace(found, decides=decides, alters=alters if found.kind == "both" else ())
    return Proven(causes, found, tests.replaced(found))


def trial_of(
    ride: Ride, model: CausalModel, fact: Intervention, vehicles: tuple[int, ...]
) -> Trial:
    """Test whether the ego drives so without vehicles, as is done for suspects.

    Raises:
        Unanswered: rollouts are needed.
    """
    return _Tests(ride, model, fact, None).trial(vehicles)


@dataclass(frozen=True, slots=True)
class _Tests:
    """Plans a decision again without some vehicles."""

    ride: Ride
    model: CausalModel
    fact: Intervention
    foil: Intervention | None

    @property
    def decision(self) -> PlanTrace:
        """The decision as it was taken."""
        return self.ride.original(self.model.trace)

    @property
    def everybody(self) -> tuple[int, ...]:
        """All vehicles of the decision except for the ego, nearest first."""
        scene = self.decision.scene
        ours = scene[EGO].position
        away = {v: math.dist(ours, other.position) for v, other in scene.items() if v != EGO}
        return tuple(sorted(away, key=lambda vehicle: (away[vehicle], vehicle)))

    def changes(self, *vehicles: int) -> bool | None:
        """Check whether another action is chosen without vehicles; None if that is not known."""
        again = self.ride.without(self.decision, *vehicles)
        return None if again is None else planned(again)[:1] != planned(self.decision)[:1]

    def decides(self, found: Causation, causes: Sequence[Cause]) -> bool:
        """Check whether another action is chosen without the causes: without each, or without all.

        Args:
            found: the vehicles that it depends on.
            causes: those of them that are stated.
        """
        if self.foil is None or not found.vehicles:
            return True
        if found.kind in ("one", "both"):
            return all(cause.decision_changes is not False for cause in causes)
        return self.changes(*found.vehicles) is not False

    def instead(self, vehicle: int, suspects: Sequence[int]) -> Cause | None:
        """Find how a vehicle holds the ego up if one of the suspects is not there."""
        for suspect in suspects[:SINGLES]:
            again = None if suspect == vehicle else self.ride.without(self.decision, suspect)
            plan = None if again is None else self._chosen(again)
            if again is not None and plan is not None:
                for cause in holding_up(self.ride.model(again), plan):
                    if cause.vehicle == vehicle:
                        return cause
        return None

    def replaced(self, found: Causation) -> tuple[int, ...]:
        """List the vehicles that others would replace, if no vehicle is a cause."""
        alone = found.cleared if found.kind == "none" else ()
        return tuple(vehicle for vehicle in alone if self.trial((vehicle,)).instead)

    def behind(self, vehicle: int) -> tuple[int, ...]:
        """List the vehicles without which another would not have got in our way.

        Raises:
            Unanswered: rollouts are needed.
        """
        found = holders(self.ride, self.decision, vehicle)
        return tuple(one for one, since in found.items() if self._makes(vehicle, one, since))

    def _makes(self, vehicle: int, holder: int, since: PlanTrace) -> bool:
        """Check whether without a holder a vehicle had kept its lane, or not mattered."""
        again, before = self.ride.without(since, holder), leaves(since, vehicle)
        stays = again is not None and leaves(again, vehicle) <= LEFT * before
        return (before >= EXPECTED and stays) or self._matters_since(holder, since)

    def _matters_since(self, holder: int, since: PlanTrace) -> bool:
        """Check whether most of what others cost an earlier plan is due to one vehicle."""
        model, again = self.ride.model(since), self.ride.without(since, holder)
        then = _again(model, planned(since))
        plan = None if again is None else self._chosen(again)
        if again is None or then is None or plan is None:
            return False
        before = _Tests(self.ride, model, in_hindsight(self.ride, model, then), None)
        alone = before._free(plan, again)
        gain = plan.value - before.fact.value
        most = gain if alone is None else alone[0].value - before.fact.value
        return gain >= max(LEAST, LEFT * most)

    def trial(self, vehicles: tuple[int, ...]) -> Trial:
        """Plan again without some vehicles, and compare.

        Raises:
            Unanswered: rollouts are needed.
        """
        again = self.ride.without(self.decision, *vehicles)
        if again is None:
            return Trial(None)
        if self.foil is not None:
            return self._of_choice(again, self.foil)
        return self._of_driving(again)

    def _of_choice(self, again: PlanTrace, foil: Intervention) -> Trial:
        other = self.ride.model(again)
        here, there = _again(other, self.fact), _again(other, foil)
        instead = () if here is None or there is None else slowing(other, there, here)
        if planned(again)[:1] == foil.plan[:1] != planned(self.decision)[:1]:
            return Trial(gone=True, instead=instead)
        if here is None or there is None:
            return Trial(None)
        merit = self.fact.value - foil.value
        lost = merit - (here.value - there.value)
        return Trial(lost >= max(LEAST, SHARE * abs(merit)), instead)

    def _of_driving(self, again: PlanTrace) -> Trial:
        plan = self._chosen(again)
        ours = speeds(self.model.trace, self.fact)
        theirs = None if plan is None else speeds(again, plan)
        if plan is None:
            return Trial(None)
        instead = _at_work(plan)
        alone = self._free(plan, again) if instead else (plan, again)
        free = None if alone is None else speeds(alone[1], alone[0])
        stands = self.decision.scene[EGO].speed < CREEPING
        if ours is None or theirs is None or free is None or stands:
            best = plan if alone is None else alone[0]
            gain, most = (one.value - self.fact.value for one in (plan, best))
            return Trial(gain >= max(LEAST, LEFT * most), instead)
        done = driven(self.ride, self.decision)
        ours = ours if done is None else done
        low = float(np.nanmin(ours))
        lost = float(np.max((free - ours)[ours <= low + NEARLY]))
        matters = lost >= max(LOST, PART * (float(np.max(free)) - low))
        return Trial(matters and float(np.max(free - theirs)) <= LEFT * lost, instead)

    def _chosen(self, again: PlanTrace) -> Intervention | None:
        """Return the plan that a new decision chooses, weighted by what the others did since."""
        other = self.ride.model(again)
        found = _again(other, planned(again))
        return None if found is None else in_hindsight(self.ride, other, found)

    def _free(self, plan: Intervention, again: PlanTrace) -> tuple[Intervention, PlanTrace] | None:
        """Return the plan and the decision with nobody else there; None if they are not known."""
        if set(self.everybody).isdisjoint(again.scene):
            return plan, again
        empty = self.ride.without(self.decision, *self.everybody)
        found = None if empty is None else self._chosen(empty)
        return None if empty is None or found is None else (found, empty)


def _again(other: CausalModel, wanted: Intervention | Actions) -> Intervention | None:
    """Return the same plan, or at least its first action, in a model; None: too little evidence."""
    plan = wanted.plan if isinstance(wanted, Intervention) else wanted
    for length in dict.fromkeys((len(plan), 1)):
        found = other.intervene(plan[:length])
        if found is not None and enough(found):
            return found
    return None


def _at_work(plan: Intervention) -> tuple[int, ...]:
    """List who may hold the ego up under a plan, longest first."""
    found = [held for held in hold_ups(plan).values() if held.expected >= SOMETIMES]
    return tuple(held.vehicle for held in sorted(found, key=lambda h: (-h.expected, h.vehicle)))


def _in_the_way_around(model: CausalModel) -> tuple[int, ...]:
    """Return the vehicles that the ego would hit, or be held up by, on changing lanes."""
    found: dict[int, float] = {}
    for action in CHANGES:
        there = model.intervene((action,))
        if there is None or action not in model.options():
            continue
        for vehicle, share in there.collisions().items():
            found[vehicle] = max(found.get(vehicle, 0.0), 1.0 + share)
        for cause in holding_up(model, there):
            found.setdefault(cause.vehicle, cause.probability)
    return tuple(sorted((v for v in found if v != EGO), key=lambda v: (-found[v], v)))
