"""What an answer would say of the foils of a decision."""

import msgspec

from planner.trace import Action, Outcome, PlanTrace, WhatIf
from planner.whatif import replan
from sim.network import Network
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.dialogue.standing import reason_of
from xavi_dialogue.domain.answers import NeedRollout, Reason
from xavi_dialogue.explain.causes.actions import same
from xavi_dialogue.explain.causes.contrast import factual
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride, Unanswered


class Foreseen(msgspec.Struct, frozen=True):
    """What would be said of one foil."""

    outcomes: dict[Outcome, float]  # empty where it was declined
    time: float | None = None  # [s] by which the foil is said to arrive later
    low: float | None = None
    high: float | None = None
    declined: Reason | None = None

    @property
    def likeliest(self) -> Outcome | None:
        """The outcome that is named; None where the foil was declined."""
        return max(self.outcomes, key=lambda o: self.outcomes[o], default=None)


def foresee(trace: PlanTrace, network: Network) -> dict[Action, Foreseen]:
    """What would be said of every foil that applies, by foil."""
    ride = Ride(Record(trace.sim_time, (trace,)))
    fact = trace.plan[0].action
    return {
        foil: _foreseen(trace, network, foil)
        for foil in ride.model(trace).options()
        if not same(foil, fact)
    }


def _foreseen(
    trace: PlanTrace, network: Network, foil: Action, extra: tuple[PlanTrace, ...] = ()
) -> Foreseen:
    ride = Ride(Record(trace.sim_time, (trace,), extra=extra))
    try:
        model, there = ride.evidence(trace, (foil,))
        here = factual(model, trace)
    except Unanswered as unanswered:
        need = unanswered.result
        if isinstance(need, NeedRollout):
            again = replan(trace, network, WhatIf(actions=need.actions, rollouts=need.rollouts))
            return _foreseen(trace, network, foil, (*extra, again))
        return Foreseen({}, declined=reason_of(need))
    later = next((e for e in effects(there, here) if e.component == "time"), None)
    if later is None:
        return Foreseen(there.outcomes)
    return Foreseen(there.outcomes, later.delta, later.low, later.high)
