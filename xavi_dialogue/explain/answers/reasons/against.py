"""Against: what was decided compared with what a question asks about, at one decision.

The questions why we did not do something, and what it would have led to, are about the same
decision. `foils.foil_at` finds it by the tense of the question and by the action that it names.
"""

from dataclasses import dataclass
from typing import Literal

from planner.record.trace import Action as MacroAction
from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import CannotSay, Contrast, NotApplicable
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import Ego, Event, Exit
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.foils import MANOEUVRES, Did, foil_at, settled
from xavi_dialogue.explain.answers.reference.reading import foil_subject, is_past, manner_of
from xavi_dialogue.explain.causes.plans.contrast import SameAsPlan, contrast
from xavi_dialogue.explain.causes.plans.natural import on_way
from xavi_dialogue.explain.causes.plans.options import free
from xavi_dialogue.explain.causes.plans.premise import Premise, episode_of
from xavi_dialogue.explain.causes.vehicles.actions import STRAIGHT, same, to_macros
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import ROUNDING, planned

EARLIER = 8.0  # [s] before a decision in which something may have been possible
BEGUN = 1.0  # [s] before a decision in which what it chose may have begun


@dataclass(frozen=True, slots=True)
class Against:
    """What was decided, and what is asked about instead."""

    found: Premise
    foil: Actions
    contrast: Contrast
    earlier: bool = False  # the decision is before the one asked about, when it was too late
    later: Performed | None = None  # it was done after that decision, or is planned
    open_at: float | None = None  # [s] when it could last be done; None: not asked


def against(
    event: Event, scene: Asked, deed: Event | None = None, *, before: bool = True
) -> Against:
    """Compare what was decided with what is asked about.

    Args:
        event: what was not done.
        scene: the setting.
        deed: what was done instead, if the question says so.
        before: whether a decision shortly before may be used if it is too late now.

    Raises:
        Did: the event is what we did, are doing or plan to do.
        Unanswered: it could not be done; or rollouts are needed.
    """
    found, foil = foil_at(event, scene, deed)
    earlier = False
    try:
        compared = _compared(scene, found, foil)
    except SameAsPlan as same_:
        if manner_of(event, "early", "late") is not None:
            found, compared = _sooner(event, scene, found, foil)
            earlier = True
        else:
            found, foil = _given_up(event, scene, found, foil, same_)
            compared = contrast(scene.ride, found.trace, foil, found.node)
    except Unanswered as unanswered:
        if not isinstance(unanswered.result, NotApplicable):
            raise
        fixed = bool(found.node) or deed is not None or not before
        last = None if fixed else _open_before(scene, found.trace, foil)
        if last is None:
            raise
        found, earlier = Premise(last, found.deed), True
        compared = _compared(scene, found, foil)
    later = _later(event, scene, compared.decided, found.node)
    open_at = found.trace.sim_time if earlier else _open_at(event, scene, found)
    return Against(found, foil, compared, earlier, later, open_at)


def _open_at(event: Event, scene: Asked, found: Premise) -> float | None:
    """Return when [s] something could last be done, if the question names no time and no action."""
    in_force = scene.ride.at(scene.now)
    about = foil_subject(scene, event)
    if found.deed is not None or about.span is not None or not about.is_past:
        return None
    return None if in_force is None or found.trace is in_force else found.trace.sim_time


def _compared(scene: Asked, found: Premise, foil: Actions) -> Contrast:
    compared = contrast(scene.ride, found.trace, foil, found.node)
    return on_way(found.trace, compared, found.node)


def _open_before(scene: Asked, trace: PlanTrace, foil: Actions) -> PlanTrace | None:
    """Find the last decision shortly before another at which a foil was open, and not chosen."""
    ride, last = scene.ride, trace.sim_time
    open_ = [
        t
        for t in ride.traces
        if last - EARLIER <= t.sim_time < last - ROUNDING
        and t.under_way is None
        and foil[0] in ride.model(t).options()
        and planned(t)[: len(foil)] != foil
    ]
    return open_[-1] if open_ else None


def _sooner(event: Event, scene: Asked, found: Premise, foil: Actions) -> tuple[Premise, Contrast]:
    """Compare what was done with doing it earlier.

    Raises:
        Unanswered: it was not open before; or the question is about doing it later.
    """
    before = None if found.node else _open_before(scene, found.trace, foil)
    if before is None or manner_of(event, "early") is None:
        raise Unanswered(CannotSay("unsupported-condition"))
    sooner = Premise(before, None)
    return sooner, _compared(scene, sooner, foil)


def _given_up(
    event: Event, scene: Asked, found: Premise, foil: Actions, same_: SameAsPlan
) -> tuple[Premise, Actions]:
    """Find the decision and foil for what one decision chose and a later one gave up.

    Raises:
        Did: it was done, or is still what is planned.
    """
    past = is_past(scene, event)
    carried = _carried_out(scene, found, foil[-1], same_.trace.sim_time) if past else None
    if carried is not None:
        when: Literal["did", "doing"] = "doing" if carried.ended is None else "did"
        performed = Performed(event.action, when, carried.time)
        raise Did(event, performed, found, (episode_of(carried),))
    latest = free(scene.ride, Premise(scene.ride.latest, None))
    node = found.node if found.trace is latest.trace else ()
    plan = planned(latest.trace)
    if plan[len(node) : len(node) + len(foil)] != foil:
        dropped = latest.trace if scene.past is None else _dropped(scene, found.trace, foil)
        wanted = settled(scene, event)[:1]
        return Premise(dropped, None), to_macros(scene.ride.model(dropped), wanted)
    if not node and foil[0] in STRAIGHT:
        going = Episode(Ego(), event.action, latest.trace.sim_time)
        raise Did(event, Performed(event.action, "doing", going.begin), latest, (going,))
    raise Did(event, Performed(event.action, "will"), Premise(latest.trace, None, node))


def _dropped(scene: Asked, trace: PlanTrace, foil: Actions) -> PlanTrace:
    """Find the decision that gave up what an earlier one had chosen."""
    later = [t for t in scene.ride.traces if t.sim_time > trace.sim_time and t.under_way is None]
    return next((t for t in later if planned(t)[: len(foil)] != foil), scene.ride.latest)


def _carried_out(scene: Asked, found: Premise, action: MacroAction, decided: float) -> Deed | None:
    """Find the action that a decision led to, if what it chose was carried out."""
    if found.node:
        return None
    done = [d for d in scene.ride.deeds if d.action == action]
    here = [d for d in done if d.time - BEGUN <= decided <= d.span[1]]
    after = [d for d in done if d.time >= decided - BEGUN]
    return next(iter(here or after), None)


def _later(event: Event, scene: Asked, decided: float, node: Actions) -> Performed | None:
    """Return how what is asked about was done after a decision or is planned; None: neither."""
    names: tuple[ActionName, ...] = tuple(n for n in settled(scene, event) if n in MANOEUVRES)
    if not names or any(name in STRAIGHT for name in names):
        return None
    if isinstance(event.object, Exit) or event.where is not None:
        return None  # at another place it would be another action
    done = [d for d in scene.ride.deeds if d.action in names and d.time > decided + ROUNDING]
    if done:
        over = done[0].ended is not None
        return Performed(done[0].action, "did" if over else "doing", done[0].time)
    ahead = planned(scene.ride.latest)[len(node) :]
    coming = next((a for a in ahead if any(same(name, a) for name in names)), None)
    return None if coming is None else Performed(coming, "will")
