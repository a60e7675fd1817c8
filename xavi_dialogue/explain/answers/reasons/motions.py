"""Motions: why we slowed, stood, waited, gave way, drove slowly or fast, or stayed behind."""

import dataclasses

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Contrast,
    DidNotHappen,
    MotionCause,
    MotionReason,
    NeedRollout,
    NotRecorded,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Compares, Ego, Event, Measured
from xavi_dialogue.domain.vocabulary import ActionName, Manner
from xavi_dialogue.explain.answers.expectations.plans import is_halting
from xavi_dialogue.explain.answers.reasons.kept import (
    beginning,
    coming_to,
    going_on,
    peak,
    with_yielding,
    without_passed,
    yielding_first,
)
from xavi_dialogue.explain.answers.reasons.premises import (
    BEGUN,
    CREEPING,
    SLOWING,
    STILL,
    asked_moment,
    halted_at,
    is_before,
    is_for,
    is_left,
    is_over,
    is_stopping,
    was_given_up,
)
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import is_own, is_past, numbers_in
from xavi_dialogue.explain.causes.driving.freed import driven_for
from xavi_dialogue.explain.causes.driving.roadside import limit_at, setting_off
from xavi_dialogue.explain.causes.driving.slowness import AT_LIMIT, Slowness, slowness, with_nearest
from xavi_dialogue.explain.causes.driving.stated_reasons import as_of
from xavi_dialogue.explain.causes.plans.natural import stopping
from xavi_dialogue.explain.causes.plans.premise import episode_of
from xavi_dialogue.explain.causes.plans.terms import RISK
from xavi_dialogue.explain.causes.vehicles import when
from xavi_dialogue.explain.history.nearing import speed_at, tellable
from xavi_dialogue.explain.history.ride import chose

#: By action that a question names: rows of actions that it may mean. The first row that has an
#: episode counts; from the second one on, the question's name is not right.
KINDS: dict[ActionName, tuple[tuple[ActionName, ...], ...]] = {
    "slow-down": (SLOWING, ("stop", "stand")),
    "brake": (SLOWING, ("stop", "stand")),
    "stop": (("stop", "stand"), SLOWING),
    "stand": (("stop", "stand"), SLOWING),
    "wait": (("wait", "give-way", "stop", "stand"), SLOWING),
    "give-way": (("give-way",), ("wait", "stop"), SLOWING),
    "let-go": (("give-way",), ("wait", "stop"), SLOWING),
    "speed-up": (("speed-up", "go"),),
    "block": (("stop", "stand"), SLOWING),
    "avoid": (SLOWING, ("stop", "stand")),
}
FREE = frozenset(("limit", "plan", "starting"))  # kinds of reasons for which nothing is in our way
STANDING = 0.3  # [m/s]
RISKY = 0.05  # minimum extra risk of driving on that counts if somebody is in the way
WIDER = 4.0  # [s] within which episodes that begin belong to one moment


def motion(event: Event, scene: Asked, *, asked: ActionName | None = None) -> Answer:
    """Explain why we drove as an event says.

    Raises:
        Unanswered: we did not; or the record lacks it; or rollouts are needed.
    """
    named = asked or event.action
    rows = KINDS.get(named, (SLOWING,))
    present = not is_past(scene, event)
    whom = frozenset(numbers_in(event.object))
    for who in (whom, frozenset[int]()) if whom else (whom,):
        for rank, kinds in enumerate(rows):
            deed = _episode(scene, kinds, who, present=present)
            if deed is not None:
                deed = going_on(scene, deed, rows) if present else coming_to(scene, deed, rows)
                deed = beginning(scene, event, deed)
                return _told(scene, event, deed, named, premise=rank == 0)
    if present and named != "speed-up":
        return _state(scene, event, named)
    raise _denied(scene, event, rows)


def along_lane(event: Event, scene: Asked) -> MotionReason | None:
    """Return that our lane runs to a side, if the question is why we bore to it; else None."""
    if event.action != "swerve":
        return None
    made = scene.world.episodes(Ego(), ("swerve", "change-left", "change-right"))
    meant = [e for e in made if event.side in (None, e.side)]
    deed = scene.pick(sorted(meant, key=lambda e: e.begin), lambda e: (e.begin, e.end))
    if deed is None or deed.action != "swerve":
        return None
    return MotionReason(deed, (MotionCause("lane"),), asked="swerve", past=is_past(scene, event))


def is_our_speed(of: Compares) -> bool:
    """Check whether our own speed is compared."""
    right = isinstance(of.right, Measured) and is_own(of.right.thing)
    return of.left.attribute == "speed" and (is_own(of.left.thing) or right)


def is_slowing(scene: Asked) -> bool:
    """Check whether we are slowing down, and still drive."""
    found = scene.world.episodes(Ego(), SLOWING)
    speed = speed_at(scene.ride, scene.now)
    return any(e.end is None for e in found) and speed is not None and speed >= STANDING


def standing_or_slow(scene: Asked, event: Event | None = None) -> Answer:
    """Explain why we stand, if we do; else why we drive no faster.

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    time = _time(scene, event)
    speed = speed_at(scene.ride, time)
    if speed is not None and speed < STANDING:
        return motion(Event("stand", tense="present"), scene, asked="stand")
    return slow(scene, event=event)


def _time(scene: Asked, event: Event | None) -> float:
    """Return when [s] the state holds that is asked about: now, if it is present or goes on."""
    if event is not None and event.tense == "present":
        return scene.now
    past = scene.past
    perfect = event is not None and event.tense == "perfect"
    if past is not None and perfect and (not past.said or past.end >= scene.now - when.RECENT):
        return scene.now
    return scene.moment


def slow(scene: Asked, manner: Manner = "slowly", event: Event | None = None) -> Answer:
    """Explain why we drive, or drove, no faster: the state, not slowing down.

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    found = slowness(scene.ride, scene.world, _time(scene, event))
    speed = found.deed.speed_to
    found = _picking_up(scene, found)
    if speed is not None and speed < CREEPING:
        time = found.deed.begin
        kept = with_yielding(scene, found.reasons, time - when.RECENT, time)
        found = dataclasses.replace(found, reasons=kept)
    rising = found.reasons.causes[:1] == (MotionCause("picking-up"),)
    if (
        not rising
        and found.is_slow is not False
        and not any(cause.vehicle for cause in found.reasons.causes)
    ):
        found = _slowed_for(scene, found)
    if speed is not None and speed < STANDING and manner == "slowly":
        return standing_or_slow(scene)
    return MotionReason(
        deed=found.deed,
        causes=with_nearest(scene.ride, scene.world, found.reasons, found.deed.begin),
        premise=manner != "slowly" or found.is_slow is not False,
        asked="move",
        evidence=found.reasons.evidence,
        manner=manner,
        limit=found.limit,
        cleared=found.reasons.cleared,
        causation=found.reasons.causation,
    )


def _picking_up(scene: Asked, found: Slowness) -> Slowness:
    """Replace the limit as the only reason by picking up speed, if we are well below the limit."""
    causes = found.reasons.causes
    alone = all(cause.kind in ("limit", "plan") for cause in causes)
    motion = scene.ride.motion(EGO).until(found.deed.begin)
    if not found.is_slow or not alone or motion.trend != "speeding-up":
        return found
    reasons = dataclasses.replace(found.reasons, causes=(MotionCause("picking-up"),))
    return dataclasses.replace(found, reasons=reasons)


def _slowed_for(scene: Asked, found: Slowness) -> Slowness:
    """Replace the reasons by those for our last slowing down, if a vehicle is among them."""
    time = found.deed.begin
    slowing = scene.world.episodes(Ego(), (*SLOWING, "give-way"), time - when.RECENT, time)
    slowing = tuple(e for e in slowing if e.action in (*SLOWING, "give-way"))
    if not slowing:
        return found
    reasons = driven_for(scene.ride, scene.world, slowing[-1])
    if not any(c.vehicle is not None and c.kind != "give-way-line" for c in reasons.causes):
        return found
    causes = as_of(scene.ride, reasons.causes, time)
    if not any(cause.vehicle for cause in causes):
        return found
    return dataclasses.replace(found, reasons=dataclasses.replace(reasons, causes=causes))


def fast(scene: Asked) -> Answer:
    """Explain why we drive as fast as we do: what keeps us below the limit, else the limit.

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    time = scene.moment
    speed = speed_at(scene.ride, time)
    if speed is None:
        raise Unanswered(NotRecorded("before-record", since=time))
    limit = limit_at(scene.ride, time)
    starts = setting_off(scene.ride, time)
    held = None if limit is None or starts or speed >= AT_LIMIT * limit else _held(scene)
    if held is not None:
        return held
    causes: list[MotionCause] = []
    if starts:
        causes.append(MotionCause("starting"))
    if limit is not None:
        causes.append(MotionCause("limit", value=limit))
    end = None if time >= scene.now - 0.5 else time
    return MotionReason(
        deed=Episode(Ego(), "move", time, end, speed_from=speed, speed_to=speed),
        causes=tuple(causes) or (MotionCause("plan"),),
        premise=limit is None or speed > limit,
        asked="move",
        manner="fast",
        limit=limit,
    )


def _held(scene: Asked) -> MotionReason | None:
    """Explain why we do not drive at the limit; None if nothing is known to keep us from it."""
    try:
        found = slow(scene)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    if not isinstance(found, MotionReason) or all(c.kind in FREE for c in found.causes):
        return None
    return replace(found, premise=True)


def _episode(
    scene: Asked, kinds: tuple[ActionName, ...], whom: frozenset[int], *, present: bool
) -> Episode | None:
    """Return the episode of some kinds that is asked about; of those for somebody, if any."""
    found = [e for e in scene.world.episodes(Ego(), kinds) if e.action in kinds]
    if whom:
        found = [e for e in found if is_for(scene, e, whom)]
    if present and scene.past is None:
        found = [e for e in found if not is_left(scene, e)]
    return scene.pick(_preferring(found, kinds), lambda e: (e.begin, e.end))


def _preferring(found: list[Episode], kinds: tuple[ActionName, ...]) -> list[Episode]:
    """Return episodes by their begin; of several close together, the kind named first is last."""
    rank = {kind: -k for k, kind in enumerate(kinds)}
    return sorted(found, key=lambda e: (round(e.begin / WIDER), rank[e.action], e.begin))


def _told(scene: Asked, event: Event, deed: Episode, named: ActionName, *, premise: bool) -> Answer:
    deed = replace(deed, action="speed-up") if named == "speed-up" else deed  # or setting off
    moment = asked_moment(scene, event, deed)
    reasons = without_passed(scene, event, driven_for(scene.ride, scene.world, deed, moment))
    if deed.action in (*STILL, "give-way"):
        end = moment if deed.end is None else deed.end
        reasons = yielding_first(deed, with_yielding(scene, reasons, deed.begin, end))
    ours = [cause for cause in reasons.causes if cause.vehicle is not None]
    stops = is_stopping(scene, deed, named)
    lit = any(cause.kind == "light" for cause in reasons.causes) and not stops
    decided = scene.ride.latest if stops else reasons.trace
    if not lit and deed.action in (*STILL, *SLOWING) and chose(decided, "stop"):
        still = deed.end is None and moment >= scene.now - BEGUN
        contrast = stopping(scene.ride, decided, going_on=still)
        if _speaks(contrast, somebody=bool(ours)):
            return ChoiceReason("why", deed, contrast, past=is_past(scene, event))
        if not ours and was_given_up(scene, deed):
            reasons = dataclasses.replace(reasons, causes=(MotionCause("given-up"),))
    return MotionReason(
        deed=deed,
        causes=with_nearest(scene.ride, scene.world, reasons, tellable(deed, scene.now)),
        premise=premise or stops or (named in STILL and is_halting(scene)),
        asked=named,
        evidence=reasons.evidence,
        manner=next(iter(event.manner), None),
        limit=limit_at(scene.ride, deed.begin),
        cleared=reasons.cleared,
        causation=reasons.causation,
        past=(event.tense == "past" and deed.end is not None) or is_before(scene),
        over=is_over(scene, event, deed),
        halted=halted_at(scene, deed, reasons),
        peak=peak(scene, event, deed),
    )


def _speaks(contrast: Contrast, *, somebody: bool) -> bool:
    """Check whether the reason for a stop is what driving on leads to, not who is in our way."""
    risk = contrast.collision - contrast.fact_collision
    if contrast.decisive == "collision" or contrast.close:
        return risk >= (RISKY if somebody else RISK)
    if somebody:
        return False
    slower = contrast.decisive in ("late", "time") and bool(contrast.causes)
    return slower or contrast.decisive == "dead"


def _state(scene: Asked, event: Event, named: ActionName) -> Answer:
    """Explain driving slowly, if what is asked about does not go on; else refuse."""
    speed = speed_at(scene.ride, scene.now)
    found = slowness(scene.ride, scene.world, scene.now)
    if found.is_slow and speed is not None and speed >= STANDING:
        reason = slow(scene)
        if isinstance(reason, MotionReason):
            return replace(reason, premise=False, asked=named)
    raise _denied(scene, event, KINDS.get(named, (SLOWING,)))


def _denied(scene: Asked, event: Event, rows: tuple[tuple[ActionName, ...], ...]) -> Unanswered:
    """Return the refusal that we did not drive so, with when we did, or what we did instead."""
    for kinds in rows:
        others = scene.world.episodes(Ego(), kinds)
        near = when.pick(_loose(scene), others, lambda e: (e.begin, e.end))
        if near is not None:
            return Unanswered(DidNotHappen(event, (near,), elsewhen=near.begin))
    moves = [deed for deed in scene.ride.deeds if deed.action != "continue"]
    deed = scene.pick(moves, lambda d: d.span)
    return Unanswered(DidNotHappen(event, () if deed is None else (episode_of(deed),)))


def _loose(scene: Asked) -> Span | None:
    """Return the span as one that was only inferred, so that the nearest is found."""
    return None if scene.span is None else replace(scene.span, said=False)
