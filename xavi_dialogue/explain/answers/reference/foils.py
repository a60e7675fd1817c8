"""Foils: what the ego did not do, as a question names it, and when it could have done it."""

from typing import Literal

from planner.record.trace import Action as MacroAction
from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import Ego, Event, Exit
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import (
    check_able,
    foil_subject,
    is_past,
    manner_of,
    subject,
)
from xavi_dialogue.explain.causes.plans.premise import (
    Premise,
    about_foil,
    episode_of,
    happened,
    is_open,
    led_to,
    options_known,
    premise,
)
from xavi_dialogue.explain.causes.vehicles.actions import (
    CHANGES,
    DRIVING,
    EXITS,
    STRAIGHT,
    TURNS,
    means,
    names_of,
    same,
    sequence,
    to_macros,
)
from xavi_dialogue.explain.causes.vehicles.when import pick
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import planned

#: Ways to leave a roundabout at an exit, the usual one first.
LEAVING: tuple[MacroAction, ...] = ("exit-right", "exit-straight", "exit-left")
MANOEUVRES = frozenset[ActionName]((*CHANGES, *TURNS, "stop", "overtake", "exit-straight"))


class Did(Unanswered):
    """The refusal that what is asked about is what we did, are doing or plan to do."""

    def __init__(
        self,
        event: Event,
        performed: Performed,
        found: Premise | None,
        told: tuple[Episode, ...] = (),
    ) -> None:
        ahead = found is not None and performed.when == "will"
        planned_at = found.trace.sim_time if found is not None and ahead else None
        super().__init__(DidNotHappen(event, told, planned=planned_at))
        self.performed, self.found = performed, found  # None: its decision is not recorded


def foil_at(
    event: Event, scene: Asked, deed: Event | None = None
) -> tuple[Premise, tuple[MacroAction, ...]]:
    """Find the decision at which something could have been done, and its macro actions.

    Raises:
        Did: it is what was done, or is being done.
        Unanswered: it cannot be done at all.
    """
    check_able(event)
    if deed is None:
        check_kept(scene, event)
    names = settled(scene, event)
    names = tuple("stop" if name in DRIVING - {"speed-up"} else name for name in names)
    if deed is None:
        check_undone(scene, event, names)
    past = is_past(scene, event)
    ring = earlier_exit(event, scene)
    if ring is not None:
        return ring
    about = subject(scene, deed) if deed is not None else foil_subject(scene, event)
    meant = None
    if deed is None:
        meant = at_turn(scene, names, past=past) or _at_deed(scene, event, names, past=past)
    if meant is not None:
        found = meant
    elif len(names) > 1 or deed is None:
        found = about_foil(scene.ride, about, names[:1])
    else:
        found = premise(scene.ride, about)
        found = led_to(scene.ride, found, names[:1]) or found
    steps = (name for step in sequence(event)[1:] for name in settled(scene, step)[:1])
    later = tuple(name for name in steps if means(name))
    foil = to_macros(scene.ride.model(found.trace), (names[0], *later), found.node)
    return found, foil


def at_turn(scene: Asked, names: tuple[ActionName, ...], *, past: bool) -> Premise | None:
    """Find the choice of a turn for a question about another way.

    For the past it is the last turn made. If there was none, and for what is to come, it is the
    next one planned. None if the question is not about a way, or there is no such turn.
    """
    if not set(names) <= set(EXITS):
        return None
    if past:
        made = [deed for deed in scene.ride.deeds if deed.action in TURNS]
        deed = pick(scene.span, made, lambda deed: deed.span)
        if deed is not None and not _open_since(scene, deed, names):
            return Premise(scene.ride.choice_of(deed), deed)
        if deed is None and scene.past is not None:
            return None
    trace = scene.ride.latest
    plan = planned(trace)
    at = next((k for k, step in enumerate(plan) if step in TURNS), None)
    if at is None or trace.under_way is not None:
        return None
    halts = plan[0] == "stop"
    here = [name for name in names if halts or name not in STRAIGHT]
    if plan[halts] in STRAIGHT and any(is_open(scene.ride, trace, (name,)) for name in here):
        return Premise(trace, None)  # the next junction, which the plan goes straight over
    return Premise(trace, None, _before_stop(scene, trace, names, plan[:at]))


def _open_since(scene: Asked, deed: Deed, names: tuple[ActionName, ...]) -> bool:
    """Check whether a question without a time is about a decision after an action.

    It is, if what it names was possible after the action, and is the action itself, or was not
    possible in its place.
    """
    if scene.past is not None and scene.past.said:
        return False
    chosen = _chosen(scene, deed)
    apart = all(not same(name, deed.action) for name in names)
    if apart and chosen is not None and _is_open(scene, chosen.trace, names):
        return False
    over = deed.span[1]
    later = (trace for trace in reversed(scene.ride.traces) if trace.sim_time > over)
    return any(_is_open(scene, trace, names) for trace in later)


def _is_open(scene: Asked, trace: PlanTrace, names: tuple[ActionName, ...]) -> bool:
    return any(is_open(scene.ride, trace, (name,)) for name in names)


def _before_stop(
    scene: Asked, trace: PlanTrace, names: tuple[ActionName, ...], node: Actions
) -> Actions:
    """Return the node before a stop, for a question about the turn that is planned after it.

    The plan itself is no contrast. For another way, or a turn that is not possible yet, it is
    `node`.
    """
    turn = planned(trace)[len(node)]
    if "stop" not in node or not any(same(name, turn) for name in names):
        return node
    before = node[: node.index("stop")]
    return before if turn in scene.ride.model(trace).options(before) else node


def _at_deed(
    scene: Asked, event: Event, names: tuple[ActionName, ...], *, past: bool
) -> Premise | None:
    """Find the choice of the action that a question means by what was not done.

    Keeping the lane means the last change of lanes. Doing something earlier or later means what
    was done.
    """
    if event.action == "keep-lane":
        names = CHANGES
    elif manner_of(event, "early", "late") is None:
        return None
    made = [deed for deed in scene.ride.deeds if past and deed.action in names]
    deed = pick(foil_subject(scene, event).span, made, lambda deed: deed.span)
    return None if deed is None else _chosen(scene, deed)


def earlier_exit(event: Event, scene: Asked) -> tuple[Premise, tuple[MacroAction, ...]] | None:
    """Find the decision to go past an exit of a roundabout, if the question is about that exit."""
    if event.action == "continue-next-exit":  # the exit named is the one that it goes on to
        return None
    named = isinstance(event.object, Exit) and event.object.rank is not None
    if not named and not (event.action == "leave" and event.side is None):
        return None
    passed = [d for d in scene.ride.deeds if d.action == "continue-next-exit"]
    if not passed:
        return None
    rank = event.object.rank if isinstance(event.object, Exit) else None
    last = scene.pick(passed, lambda d: d.span) or passed[-1]
    deed = passed[rank - 1] if rank is not None and 0 < rank <= len(passed) else last
    trace = scene.ride.choice_of(deed)
    here = [exit_ for exit_ in LEAVING if is_open(scene.ride, trace, (exit_,))]
    return (Premise(trace, deed), (here[0],)) if here else None


def settled(scene: Asked, event: Event) -> tuple[ActionName, ...]:
    """Return the names of what is asked about; without a side, the record settles it.

    A turn is the one planned. Sooner or later is what was done. A foil is to the side that was
    possible, or to both.
    """
    names = names_of(event)
    if names == ("overtake",):
        return options_known(scene.ride, CHANGES) or CHANGES
    if len(names) == 1:
        return names
    made = [deed.action for deed in scene.ride.deeds if deed.action in names]
    if made and manner_of(event, "early", "late") is not None:
        return (made[-1],)
    macros = tuple(m for name in names for m in means(name))
    trace = scene.ride.at(scene.moment)
    steps = () if trace is None else planned(trace)
    coming = next((step for step in steps if step in macros), None)
    if coming in TURNS:
        return (coming,)
    here = [] if trace is None else [m for m in macros if is_open(scene.ride, trace, (m,))]
    return tuple(here) or options_known(scene.ride, macros) or names


def check_undone(scene: Asked, event: Event, names: tuple[ActionName, ...]) -> None:
    """Refuse a question why we did not do what we did; driving on does not count.

    Raises:
        Did: we did it, or are doing it.
    """
    apart = event.then, event.object, event.where
    if any(part is not None for part in apart) or event.manner or not set(names) <= MANOEUVRES:
        return
    past = is_past(scene, event)
    if past:
        deed = happened(scene.ride, names, scene.span)
        if deed is not None and deed.action in TURNS and _open_since(scene, deed, names):
            return  # a turn at another junction is another turn
    else:
        last = scene.ride.deeds[-1:]
        deed = next((d for d in last if d.action in names and d.ended is None), None)
    if deed is not None and deed.action not in STRAIGHT:
        when: Literal["did", "doing"] = "doing" if deed.ended is None else "did"
        performed = Performed(deed.action, when, deed.time)
        raise Did(event, performed, _chosen(scene, deed), (episode_of(deed),))


def check_kept(scene: Asked, event: Event) -> None:
    """Refuse a question why we did not keep our lane, if we did not change lanes.

    Raises:
        Did: we keep the lane, or kept it then.
    """
    if event.action != "keep-lane" or event.object is not None or event.then is not None:
        return
    moves = [deed for deed in scene.ride.deeds if deed.action in CHANGES and deed.carried_out]
    trace = scene.ride.at(scene.moment)
    if trace is None or pick(scene.span, moves, lambda deed: deed.span) is not None:
        return
    if not set(planned(trace)[:1]) & set(CHANGES):
        over = scene.past is not None and trace is not scene.ride.latest
        when: Literal["did", "doing"] = "did" if over else "doing"
        done = Performed("keep-lane", when, trace.sim_time if over else None)
        kept = Episode(Ego(), "keep-lane", trace.sim_time)
        raise Did(event, done, Premise(trace, None), (kept,))


def _chosen(scene: Asked, deed: Deed) -> Premise | None:
    """Find the decision for an action; None if it is not recorded."""
    try:
        return Premise(scene.ride.choice_of(deed), deed)
    except Unanswered:
        return None


def named_foil(
    scene: Asked, instead: Event | None, found: Premise
) -> tuple[MacroAction, ...] | None:
    """Return the foil that a question names, in macro actions; None if it names none."""
    if instead is None:
        return None
    names = tuple(name for step in sequence(instead) for name in settled(scene, step)[:1])
    return to_macros(scene.ride.model(found.trace), names, found.node)
