"""Hastening: what if we had not slowed down or waited, or had gone before another vehicle."""

from msgspec import structs

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    DidNotHappen,
    MotionCause,
    MotionReason,
    SupposedOfUs,
    Unslowed,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import Ego, Event, Feature, Unsaid, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.measuring.durations import lost
from xavi_dialogue.explain.answers.reasons import motions
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window, window
from xavi_dialogue.explain.answers.reference.reading import manner_of, vehicle_in
from xavi_dialogue.explain.causes.driving.crossing import Crossing, crossing
from xavi_dialogue.explain.facts.episodes.light_waits import held_at
from xavi_dialogue.explain.facts.traffic_lights import shown_at
from xavi_dialogue.explain.history.nearing import speed_at

SLOW = 4.0  # [m/s] speed below which going now is setting off
JOINED = 0.5  # [s] maximum time between episodes that belong together
LATELY = 1.0  # [s] maximum age of an action that counts as now
QUEUING = 1.0  # [m/s] speed below which somebody stands in a queue
QUEUE = 15.0  # [m] maximum distance ahead of somebody in the same queue
BESIDE = 1.5  # [m] minimum sideways distance of somebody in another lane
NEAR = 25.0  # [s] before and after the slowing, in which letting somebody go counts


def hastened(
    event: Event, scene: Asked, form: Asking = "what-if", struck: int | None = None
) -> Answer:
    """Return who would have been in our way if we had not slowed or waited, and how close.

    Args:
        event: what we are supposed to do: go, enter, not brake.
        scene: the setting.
        form: the question about it.
        struck: the vehicle that is asked about, if any.

    Raises:
        Unanswered: rollouts are needed.
    """
    if event.action == "speed-up":
        return motions.slow(scene)
    named = struck or vehicle_in(event.object) or _ahead_of(event)
    now = _now(event, scene)
    letting = None if now is not None or named is None else _letting(scene, named)
    deed = now or letting
    causes: tuple[MotionCause, ...] = ()
    if deed is None:
        found = _cause(event, scene)
        if isinstance(found, ChoiceReason) and form != "what-if":
            return SupposedOfUs(found.contrast, past=found.past, form=form)
        if not isinstance(found, MotionReason):
            return found if found is not None else motions.slow(scene)
        deed, causes = found.deed, found.causes
    elif letting is not None and named is not None:
        causes = (MotionCause("right-of-way", vehicle=named),)
    stands = None if now is None else _leader(scene, now)
    if stands is not None and named in (None, stands):
        behind, red = MotionCause("leader", vehicle=stands), _at_red(scene)
        return Unslowed(deed, behind, vehicle=stands, past=False, form=form, red=red)
    met = _met(scene, deed, named, causes, setting_off=now is not None)
    first = next((c for c in causes if met is None or c.vehicle == met.vehicle), None)
    cost = None if now is not None else lost(scene, deed)
    saved = None if cost is None else cost.value
    due = scene.world.measure("arrival-time", Ego(), scene.now).value
    whom = _let_go(scene, deed) | {c.vehicle for c in causes if c.kind == "right-of-way"}
    return Unslowed(
        deed,
        first or next(iter(causes), None),
        ours=None if met is None else met.ours,
        theirs=None if met is None else met.theirs,
        going=manner_of(event, "fast", "slowly", "gently") is None,
        vehicle=None if met is None else met.vehicle,
        right=met is None or met.vehicle in whom,
        past=now is None,
        form=form,
        saved=saved,
        arrival=None if due is None or saved is None else due - saved,
        red=now is not None and _at_red(scene),
        through=now is None and any(_through(scene, deed, one) for one in causes),
    )


def as_it_was(scene: Asked, form: Asking, struck: int | None, *, past: bool) -> Answer:
    """Return how near to a crash we were, where what is supposed is what we did.

    "What if you had turned while he was there" is of somebody whom we let go first: then it is
    supposed that we had not.

    Raises:
        Unanswered: rollouts are needed.
    """
    if not past:
        return closeness(scene, struck, Window(scene.now, scene.now), "hit", past=False)
    if struck is not None and _letting(scene, struck) is not None:
        return hastened(Event("go", tense="past"), scene, form, struck)
    return closeness(scene, struck, window(scene, Unsaid(), "past"), "hit")


def _through(scene: Asked, deed: Episode, cause: MotionCause) -> bool:
    """Check whether the light that held us was still red when we would have come to it."""
    shown, speed = cause.shown, deed.speed_from or 0.0
    if cause.kind != "light" or shown is None or cause.vehicle is not None or speed <= 0.0:
        return False
    near = scene.world.episodes(Ego(), ("stand",), deed.begin, scene.now)
    there = deed.begin + (cause.value or 0.0) / speed
    alone = bool(near) and _leader(scene, near[-1]) is None
    return alone and shown.colour == "red" and (shown.end is None or there < shown.end)


def past_red(event: Event, scene: Asked) -> Unslowed | None:
    """Return that we would have passed a red light without our stop; None if none held us."""
    if event.action != "stop" or event.tense == "present":
        return None
    stands = scene.world.episodes(Ego(), ("stand",))
    last = scene.pick(stands, lambda e: (e.begin, e.end))
    if last is None:
        return None
    end = scene.now if last.end is None else last.end
    waits = scene.world.episodes(Ego(), ("wait",), last.begin, end)
    held = [e for e in waits if isinstance(e.object, Feature) and e.object.kind == "light"]
    return Unslowed(last, None, vehicle=_leader(scene, last), through=True) if held else None


def _leader(scene: Asked, stand: Episode) -> int | None:
    """Find the vehicle right ahead of us in our lane when we came to stand, if any."""
    at = stand.begin
    looks = (scene.world.look(v, at) for v in scene.world.in_view(at))
    ahead = [
        x for x in looks
        if x is not None and x.kind not in ON_FOOT and x.speed < QUEUING
        and 0.0 < x.ahead <= QUEUE and abs(x.left) < BESIDE
    ]  # fmt: skip
    nearest = min(ahead, key=lambda look: look.ahead, default=None)
    return None if nearest is None else nearest.vehicle


def _at_red(scene: Asked) -> bool:
    """Check whether a red light holds us now."""
    trace = scene.ride.at(scene.now)
    if trace is None or held_at(trace, EGO) is None:
        return False
    light = shown_at(scene.ride, Feature("light"), scene.now)
    return light is not None and light.colour in ("red", "red-amber")


def _ahead_of(event: Event) -> int | None:
    """Return the vehicle before which we are supposed to go."""
    place = event.where
    return vehicle_in(place.to) if place is not None and place.relation == "ahead-of" else None


def _letting(scene: Asked, vehicle: int) -> Episode | None:
    """Return the slowing or waiting for a vehicle that we let go first."""
    gave = scene.world.episodes(Ego(), ("give-way", "wait"), object=Vehicle(vehicle))
    if not gave:
        return None
    begin = gave[-1].begin
    slowed = scene.world.episodes(Ego(), ("slow-down", "brake"), begin - JOINED, begin + JOINED)
    known = [e for e in (*slowed, gave[-1]) if e.speed_from is not None]
    return known[0] if known else gave[-1]


def _now(event: Event, scene: Asked) -> Episode | None:
    """Return the waiting that would end now; None if the question is about the past."""
    speed = speed_at(scene.ride, scene.now)
    said = scene.past is not None and scene.past.said and scene.past.end < scene.now - LATELY
    present = event.tense in ("present", "future") and not said
    early = event.tense == "past" and event.modal is None and scene.past is None
    if speed is None or not (present or (early and speed < SLOW)):
        return None
    action: ActionName = "wait" if speed < SLOW else "slow-down"
    return Episode(Ego(), action, scene.now, speed_from=speed)


def _cause(event: Event, scene: Asked) -> Answer | None:
    """Return why we slowed or waited then; None where we did not."""
    name: ActionName = event.action if event.action in motions.KINDS else "slow-down"
    asked = structs.replace(
        event, action=name, object=None, manner=(), where=None, tense="past", modal=None
    )
    try:
        return motions.motion(asked, scene)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, DidNotHappen):
            return None
        raise


def _met(
    scene: Asked,
    deed: Episode,
    named: int | None,
    causes: tuple[MotionCause, ...],
    *,
    setting_off: bool,
) -> Crossing | None:
    """Return the one whose way we would have crossed: as asked, else the closest in time."""
    ride, speed = scene.ride, deed.speed_from or 0.0
    others = {c.vehicle for c in causes if c.vehicle} | _let_go(scene, deed)
    if setting_off:
        others |= set(scene.world.in_view(scene.now))
    asked = [named] if named is not None else sorted(v for v in others if v is not None)
    starting = setting_off and speed < SLOW
    found = [crossing(ride, v, deed.begin, speed, setting_off=starting) for v in asked]
    met = [one for one in found if one is not None and one.theirs >= deed.begin - 1.0]
    return min(met, key=lambda one: abs(one.ahead), default=None)


def _let_go(scene: Asked, deed: Episode) -> set[int | None]:
    """Return the vehicles that we gave way to about then."""
    end = scene.now if deed.end is None else deed.end
    gave = scene.world.episodes(Ego(), ("give-way", "wait"), deed.begin - 1.0, end)
    near = [e for e in gave if e.begin <= deed.begin + NEAR]
    found: set[int | None] = {e.object.number for e in near if isinstance(e.object, Vehicle)}
    return found - {EGO}
