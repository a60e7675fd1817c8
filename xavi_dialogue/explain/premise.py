"""Premises: which decision of the ego a question is about ("what" before "why")."""

from dataclasses import dataclass

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.explain.actions import STRAIGHT, means, same, to_macros
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened, was_done
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import ROUNDING, Deed, Ride, chose, decline, planned
from xavi_dialogue.explain.slowing import decision_of
from xavi_dialogue.explain.when import Focus

TURNS: tuple[QueryAction, ...] = ("exit-left", "exit-right", "continue-next-exit")


@dataclass(frozen=True, slots=True)
class Premise:
    """The decision that a question is about."""

    trace: PlanTrace
    deed: Deed | None  # that it led to; None for what is planned, or only a way of driving
    node: Actions = ()  # the actions of its plan that come before the one asked about


def premise(ride: Ride, query: Query) -> Premise:
    """The decision that led to what the question says happened, or takes to be planned.

    Without such an action: about the past the last manoeuvre, else the latest decision.

    Raises:
        Unanswered: it did not happen, or is not in the record.
    """
    if not query.factual:
        if ride.past is not None:
            return _then(ride, ride.past)
        if query.tense == "past" and ride.manoeuvre is not None:
            return Premise(ride.choice_of(ride.manoeuvre), ride.manoeuvre)
        return Premise(ride.latest, None)
    found = [_premise_of(ride, action, query) for action in query.factual]
    return min(found, key=lambda one: (one.trace.sim_time, len(one.node)))


def about_foil(ride: Ride, query: Query) -> Premise:
    """The decision at which a foil was an alternative.

    That is the one of the premise; where the question names no deed, and the foil did not apply
    there or the ego has done nothing but drive on, the last one at which it did, of those that
    came to what they chose. Which way to go is asked of the last turn, though.

    Raises:
        Unanswered: as for the premise, or the foil is what was done or is yet to be done.
    """
    found = premise(ride, query)
    foil = query.counterfactual
    if query.factual or not foil or query.tense != "past":
        return found
    done = was_done(ride, foil)
    if done is not None:
        raise done
    turned = found.deed is not None and found.deed.action in TURNS
    if turned and foil[0] in (*TURNS, *STRAIGHT):
        return found
    on = found.deed is None or found.deed.action == "continue"
    if on and foil[0] in TURNS and len(foil) == 1 and foil[0] in planned(ride.latest):
        raise did_not_happen(ride, foil)
    if _open(ride, found.trace, foil) and not (on and ride.past is None):
        return found
    others = [
        trace
        for trace in ride.traces
        if _done(ride, trace)
        and _open(ride, trace, foil)
        and not _begins(trace, foil)
        and (ride.past is None or ride.past.meets(trace.sim_time, trace.sim_time))
    ]
    return Premise(others[-1], None) if others else found


def _then(ride: Ride, focus: Focus) -> Premise:
    """The decision for the manoeuvre at the time asked about; else the one that held then.

    Raises:
        Unanswered: it is not in the record.
    """
    deed = ride.manoeuvre
    if deed is not None and deed.action != "continue":
        return Premise(ride.choice_of(deed), deed)
    trace = ride.at(focus.moment)
    if trace is None:
        raise decline("trace-gap", time=focus.moment)
    return Premise(trace, deed)


def _premise_of(ride: Ride, action: QueryAction, query: Query) -> Premise:
    deed = happened(ride, action)
    if query.tense != "past" and (deed is None or deed.ended is not None):
        _check_straight(ride, action, query)
        ahead = _ahead(ride, action)
        if ahead is not None:
            return ahead
    if deed is None and action in DRIVING:
        return Premise(decision_of(ride, (action,), query.tense), None)
    if deed is None:
        raise did_not_happen(ride, query.factual or ())
    if query.tense == "future" and deed.ended is not None:
        raise did_not_happen(ride, query.factual or ())
    return Premise(ride.choice_of(deed), deed)


def _ahead(ride: Ride, action: QueryAction) -> Premise | None:
    """The last free decision for what the latest one plans; none is free within a manoeuvre."""
    for trace in reversed(ride.traces):
        depths = [k for k, step in enumerate(planned(trace)) if same(action, step)]
        if not depths:
            break
        if trace.under_way is None:
            return Premise(trace, None, planned(trace)[: depths[0]])
    return None


def _check_straight(ride: Ride, action: QueryAction, query: Query) -> None:
    """That who is said to go straight on now does not only drive up to the turn planned.

    Raises:
        Unanswered: the turn comes next.
    """
    plan = planned(ride.latest)
    if query.tense == "present" and action in STRAIGHT and plan[:1] and plan[0] in TURNS:
        raise decline("did-not-happen", vehicle=EGO, asked=(action,), did=False, coming=plan[:1])


def _open(ride: Ride, trace: PlanTrace, foil: tuple[QueryAction, ...]) -> bool:
    """Whether a foil could be begun at a decision."""
    if trace.under_way is not None or not means(foil[0]):
        return False
    model = ride.model(trace)
    return to_macros(model, foil[:1])[0] in model.options()


def _done(ride: Ride, trace: PlanTrace) -> bool:
    """Whether what a decision chose was carried out; plans may be given up."""
    first, time = planned(trace)[:1], trace.sim_time
    return any(
        (deed.action,) == first
        and deed.started - ROUNDING <= time <= (ride.now if deed.ended is None else deed.ended)
        for deed in ride.deeds
    )


def _begins(trace: PlanTrace, foil: tuple[QueryAction, ...]) -> bool:
    return any(chose(trace, action) for action in means(foil[0]))
