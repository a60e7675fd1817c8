"""Premises: which decision of the ego a question is about ("what" before "why")."""

from collections.abc import Sequence
from dataclasses import dataclass

from planner.record.trace import Action as MacroAction
from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import DidNotHappen, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.actions import STRAIGHT, TURNS, means, same, to_macros
from xavi_dialogue.explain.causes.vehicles.when import LEEWAY, RECENT, moment_of, past, pick
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, Unanswered, chose, planned

OPEN = frozenset[ActionName](("do", "happen", "change-plan", "avoid", "signal", "head", "go"))


@dataclass(frozen=True, slots=True)
class Premise:
    """The decision that a question is about."""

    trace: PlanTrace
    deed: Deed | None  # the action that it led to; None for what is planned
    node: Actions = ()  # the actions of its plan that come before the one asked about


@dataclass(frozen=True, slots=True)
class Subject:
    """The action of the ego that a question is about, as far as the question names one."""

    event: Event | None
    names: tuple[ActionName, ...]  # any of them may be meant; () none is named
    is_past: bool
    span: Span | None
    coming: bool = False  # the question is about what is yet to be done


def episode_of(deed: Deed) -> Episode:
    """Return an action of the ego as an episode."""
    return Episode(Ego(), deed.action, deed.time, deed.ended)


def deeds_called(ride: Ride, names: Sequence[ActionName]) -> list[Deed]:
    """List the actions that the ego carried out and that names may refer to, oldest first."""
    exact = [deed for deed in ride.deeds if deed.action in names]
    if exact:
        return exact
    return [deed for deed in ride.deeds if any(same(name, deed.action) for name in names)]


def happened(ride: Ride, names: Sequence[ActionName], span: Span | None) -> Deed | None:
    """Find the action that names refer to at a time."""
    return pick(span, deeds_called(ride, names), lambda deed: deed.span)


def manoeuvre(ride: Ride, span: Span | None) -> Deed | None:
    """Find the action that a span points at, preferably one that is more than driving on."""
    moves = [deed for deed in ride.deeds if deed.action != "continue"]
    if past(span) is None:
        return next(reversed(moves or ride.deeds), None)
    inside = [d for d in moves if pick(_said(span), [d], lambda deed: deed.span) is not None]
    if inside:
        return pick(span, inside, lambda deed: deed.span)
    return pick(span, ride.deeds, lambda deed: deed.span)


def _said(span: Span | None) -> Span | None:
    return None if span is None else Span(span.begin, span.end, said=True)


def premise(ride: Ride, subject: Subject) -> Premise:
    """Find the decision that led to what the question says happened, or says is planned.

    If the question names no action, it is that of the last manoeuvre for a question about the
    past, else the latest decision.

    Raises:
        Unanswered: it did not happen, or is not in the record.
    """
    if not subject.names or set(subject.names) <= OPEN:
        return _unnamed(ride, subject)
    deed = happened(ride, subject.names, subject.span)
    if deed is None and subject.event is not None and subject.event.action == "overtake":
        deed = happened(ride, subject.names, _loose(subject.span))  # we moved over before
    over = deed is not None and deed.ended is not None and deed.ended < ride.now - RECENT
    if deed is None or (over and not subject.is_past):
        ahead = None if past(subject.span) else _ahead(ride, subject.names)
        if ahead is not None and (not subject.is_past or deed is None):
            return ahead
    if deed is None or (subject.coming and deed.ended is not None):
        raise did_not_happen(ride, subject)
    return Premise(ride.choice_of(deed), deed)


def did_not_happen(ride: Ride, subject: Subject) -> Unanswered:
    """Return the refusal that the ego did not do so, with what it did instead."""
    event = subject.event or Event(subject.names[0] if subject.names else "do")
    others = deeds_called(ride, subject.names)
    if others and past(subject.span) is not None:
        nearest = pick(_loose(subject.span), others, lambda deed: deed.span) or others[-1]
        return Unanswered(DidNotHappen(event, (episode_of(nearest),), elsewhen=nearest.time))
    ahead = _ahead(ride, subject.names) if ride.traces else None
    deed = manoeuvre(ride, subject.span)
    instead = () if deed is None else (episode_of(deed),)
    planned_at = None if ahead is None else ahead.trace.sim_time
    return Unanswered(DidNotHappen(event, instead, planned=planned_at))


def _loose(span: Span | None) -> Span | None:
    return None if span is None else Span(span.begin, span.end)


def _unnamed(ride: Ride, subject: Subject) -> Premise:
    deed = manoeuvre(ride, subject.span)
    if past(subject.span) is not None:
        if deed is not None and deed.action != "continue":
            return Premise(ride.choice_of(deed), deed)
        moment = moment_of(subject.span, ride.now)
        trace = ride.at(moment)
        if trace is None and subject.span is not None and not subject.span.said:
            trace = ride.latest
        if trace is None:
            raise Unanswered(NotRecorded("before-record", since=moment))
        return Premise(trace, deed)
    if subject.is_past and deed is not None:
        return Premise(ride.choice_of(deed), deed)
    return Premise(ride.latest, deed if deed is not None and deed.ended is None else None)


def _ahead(ride: Ride, names: Sequence[ActionName]) -> Premise | None:
    """Find the last free decision that plans what the latest one does; None if that does not."""
    for trace in reversed(ride.traces):
        plan = planned(trace)
        depths = [k for k, step in enumerate(plan) if any(same(name, step) for name in names)]
        if not depths:
            break
        if trace.under_way is None:
            return Premise(trace, None, plan[: depths[0]])
    return None


def about_foil(ride: Ride, subject: Subject, foil: tuple[ActionName, ...]) -> Premise:
    """Find the decision at which a foil was an alternative.

    If the question names an action, it is the decision for that. If it says when, it is the one
    then. Otherwise it is the decision in force if the foil was open there and not chosen, else the
    last one at which that was so. Going on as a foil belongs to the last manoeuvre, which it would
    replace, and a direction to the last turn.
    """
    found = premise(ride, subject)
    if subject.names or not foil or not subject.is_past:
        return _free(ride, found, foil) if not subject.names else found
    turned = found.deed is not None and found.deed.action in TURNS
    if turned and any(m in (*TURNS, *STRAIGHT) for m in means(foil[0])):
        return found
    on = found.deed is None or found.deed.action == "continue"
    span = past(subject.span)
    lately = span is None or span.end >= ride.now - ROUNDING  # "just now": as late as it goes
    named = span is not None or any(m in STRAIGHT for m in means(foil[0]))
    if span is not None:
        led = led_to(ride, _before(ride, span) or found, foil)
        if led is not None:
            return led
    if named and is_open(ride, found.trace, foil) and not (on and lately):
        return found
    others = (
        trace
        for trace in reversed(ride.traces)
        if (span is None or span.begin <= trace.sim_time <= span.end)
        and is_open(ride, trace, foil)
        and not _begins(trace, foil)
    )
    last = next(others, found.trace)
    return found if last is found.trace else Premise(last, None)


def _before(ride: Ride, span: Span) -> Premise | None:
    """Find the decision for the action before which a stretch of time is; None: it is of itself."""
    if not span.said or span.end - span.begin < LEEWAY:
        return None
    deeds = (d for d in ride.deeds if d.action != "continue" and d.time >= span.end)
    deed = next(deeds, None)
    if deed is None or deed.time > span.end + LEEWAY:
        return None
    return Premise(ride.choice_of(deed), deed)


def led_to(ride: Ride, found: Premise, foil: Sequence[ActionName]) -> Premise | None:
    """Find the last decision for an action at which a foil could still be begun.

    None if the question is about no action, or the foil was never open while it was chosen.
    """
    deed = found.deed
    if deed is None or deed.action == "continue" or found.node or not foil:
        return None
    for trace in reversed(ride.traces):
        if trace.under_way is not None or trace.sim_time > found.trace.sim_time:
            continue
        if not chose(trace, deed.action):
            break
        if is_open(ride, trace, foil):
            return Premise(trace, deed)
    return None


def _free(ride: Ride, found: Premise, foil: tuple[ActionName, ...]) -> Premise:
    """Return, within a manoeuvre, the decision for it, since a foil is about that one."""
    if found.trace.under_way is None or not foil:
        return found
    deed = found.deed
    if deed is None:
        return found
    try:
        return Premise(ride.choice_of(deed), deed)
    except Unanswered:
        return found


def is_open(ride: Ride, trace: PlanTrace, foil: Sequence[ActionName]) -> bool:
    """Check whether a foil could be begun at a decision."""
    if trace.under_way is not None or not means(foil[0]):
        return False
    model = ride.model(trace)
    return to_macros(model, (foil[0],))[0] in model.options()


def options_known(ride: Ride, names: Sequence[MacroAction]) -> tuple[MacroAction, ...]:
    """List those of some actions that any decision of the ego could choose from."""
    free = [trace for trace in ride.traces if trace.under_way is None]
    known = {action for trace in free for action in ride.model(trace).options()}
    return tuple(name for name in names if name in known)


def _begins(trace: PlanTrace, foil: Sequence[ActionName]) -> bool:
    return any(chose(trace, action) for action in means(foil[0]))
