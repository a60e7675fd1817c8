"""Going: why we went when we did."""

from msgspec import structs

from xavi_dialogue.domain.answers import Answer, Contrast, GoReason
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.domain.terms import Ego, Event, Exit, Junction, Now
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reference.asked import LEEWAY, Asked
from xavi_dialogue.explain.answers.reference.occasions import did_not_happen
from xavi_dialogue.explain.answers.reference.reading import is_past, vehicle_in
from xavi_dialogue.explain.causes.driving.freed import freed
from xavi_dialogue.explain.causes.driving.going import bystanders
from xavi_dialogue.explain.causes.plans.contrast import contrast
from xavi_dialogue.explain.causes.plans.premise import Premise, Subject, is_open, premise
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import ROUNDING, planned

CROSSING = frozenset[ActionName](("exit-left", "exit-right", "exit-straight", "continue-next-exit"))
MOVING = frozenset[ActionName](("go", "move", "continue"))
AS_CHANGE: dict[ActionName, ActionName] = {
    "exit-left": "change-left",
    "exit-right": "change-right",
}
BEGUN = 0.5  # [s] after which what has begun is stated in the past tense
LATELY = 10.0  # [s] after a junction in which it may be meant
JUST = 4.0  # [s] after a change of lanes in which "going" means it
STANDING = 0.1  # [m/s]
SOON = 4.0  # [s] before we went in which waiting was the other choice


def check_moving(event: Event, scene: Asked) -> None:
    """Check that we move, if the question is why we do.

    Raises:
        Unanswered: we stand.
    """
    if event.action not in MOVING or event.manner or event.side or event.tense != "present":
        return
    speed = scene.world.measure("speed", Ego(), scene.now).value
    if event.where is None and speed is not None and speed < STANDING:
        raise did_not_happen(scene, structs.replace(event, time=Now()))


def went(event: Event, scene: Asked) -> Answer:
    """Explain why we went when we did: who had right of way, and what waiting would have cost.

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    past = is_past(scene, event)
    found = premise(scene.ride, Subject(event, (), past, scene.span))
    changed = found.deed is not None and found.deed.action in CHANGES
    if found.deed is not None and changed and _lately(scene, found.deed):
        return choices.why(structs.replace(event, action=found.deed.action), scene)
    if found.deed is None or found.deed.action not in CROSSING:
        found = Premise(found.trace, crossed(scene))
    open_ = found.deed is None or found.deed.committed is None
    begun = scene.moment if found.deed is None or open_ else found.deed.time
    against = _waiting(scene, begun)
    others = bystanders(scene.ride, scene.world, begun)
    asked = vehicle_in(event.object)
    others = tuple(one for one in others if one.vehicle == asked) or others
    held = None if asked is not None else freed(scene.ride, scene.world, begun)
    trace = scene.ride.at(begun)
    unknown = trace is None or trace.road is None  # no right of way is on record
    if held is None and not others and (found.deed is None or unknown):
        return choices.why(None, scene)
    past = past or (found.deed is not None and begun < scene.now - BEGUN)
    deed = choices.deed_of(scene, found)
    if deed is not None and open_:
        deed = structs.replace(deed, begin=begun)
    rests_on = Evidence(traces=() if trace is None else (trace.trace_id,))
    return GoReason(deed, others, against, past=past, evidence=rests_on, freed=held)


def sideways(event: Event, scene: Asked) -> Event:
    """Read going left or right as the change of lanes that is under way, if one is."""
    change = AS_CHANGE.get(event.action)
    if change is None or isinstance(event.object, Junction | Exit):
        return event
    made = [d for d in scene.ride.deeds if d.time <= scene.moment]
    under = [d for d in made if scene.moment <= (d.ended or scene.now) + BEGUN]
    aside = bool(under) and under[-1].action == change
    return structs.replace(event, action=change) if aside else event


def crossed(scene: Asked) -> Deed | None:
    """Return our action at the last junction up to the moment asked about, else at the next."""
    before = [
        deed
        for deed in scene.ride.deeds
        if deed.action in CROSSING and deed.time <= scene.moment + LEEWAY
    ]
    inside = [deed for deed in before if deed.ended is None or deed.ended >= scene.moment - LATELY]
    after = [d for d in scene.ride.deeds if d.action in CROSSING and d not in before]
    return inside[-1] if inside else next(iter(after), None)


def _lately(scene: Asked, deed: Deed) -> bool:
    """Check whether an action goes on at the moment asked about, or ended shortly before."""
    return deed.ended is None or deed.ended >= scene.moment - JUST


def _waiting(scene: Asked, time: float) -> Contrast | None:
    """Compare stopping with the last decision before a time [s] that could have chosen it."""
    open_ = [
        trace
        for trace in scene.ride.traces
        if time - SOON <= trace.sim_time <= time + ROUNDING
        and is_open(scene.ride, trace, ("stop",))
        and planned(trace)[:1] != ("stop",)
    ]
    return contrast(scene.ride, open_[-1], ("stop",)) if open_ else None
