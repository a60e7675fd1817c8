"""Signalling: why our own indicator is or was on, by what it announces and whether that came."""

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.answers import Answer, DidNotHappen, OwnSignal
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.history.ride import ROUNDING, planned

#: By side: the actions that an indicator announces, the likeliest first.
ANNOUNCES: dict[Side, tuple[MacroAction, ...]] = {
    "left": ("change-left", "exit-left"),
    "right": ("change-right", "exit-right"),
}
ON = 1.0  # [s] after an indicator went out in which questions may still call it on


def why_signal(side: Side | None, scene: Asked, *, past: bool) -> Answer:
    """Return what our indicator announces or announced, and whether we then did that.

    Raises:
        Unanswered: it was not on.
    """
    shown = [e for e in scene.world.episodes(Ego(), ("signal",)) if e.action == "signal"]
    shown = [e for e in shown if side is None or e.side == side]
    if not past:
        shown = [e for e in shown if e.end is None or e.end >= scene.now - ON]
    found = scene.pick(shown, lambda e: (e.begin, e.end))
    if found is None or found.side is None:
        asked = Event("signal", side=side, tense="past" if past else "present")
        raise Unanswered(DidNotHappen(asked))
    aim = _aim(scene, found)
    return OwnSignal(found, aim, came=_came(scene, found, aim), past=past)


def _aim(scene: Asked, shown: Episode) -> MacroAction | None:
    """Return the first action to that side that was planned while the indicator was on."""
    assert shown.side is not None
    end = scene.now if shown.end is None else shown.end
    aims = ANNOUNCES.get(shown.side, ())
    traces = [t for t in scene.ride.traces if shown.begin - ON <= t.sim_time <= end + ROUNDING]
    for trace in traces:
        under_way = trace.under_way
        first = (() if under_way is None else (under_way.action,)) + planned(trace)
        step = next((action for action in first if action in aims), None)
        if step is not None:
            return step
    return None


def _came(scene: Asked, shown: Episode, aim: MacroAction | None) -> bool | None:
    """Check whether we did what the indicator announced; None if we still may."""
    if aim is None:
        return None
    end = scene.now if shown.end is None else shown.end
    for deed in scene.ride.deeds:
        if deed.action == aim and deed.started <= end + ON and (deed.ended or end) >= shown.begin:
            return True
    if shown.end is None or scene.now - shown.end < ON:
        return None
    return False
