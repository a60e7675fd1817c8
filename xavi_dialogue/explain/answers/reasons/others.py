"""Others: why another vehicle does or did something, or did not.

What drivers think is not known. Answers state to whom a vehicle gave way, or who was in its way, as
far as its predicted ways show, and where we thought it was going.
"""

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, DidNotHappen, MotionCause, OtherReason, PlaceReason
from xavi_dialogue.domain.facts import Belief, Episode
from xavi_dialogue.domain.terms import Ego, Event, Proposition, Related, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.reading import check_seen, event_of, is_own, is_past
from xavi_dialogue.explain.answers.ride.priority import rule_between
from xavi_dialogue.explain.causes.driving.hindrance import (
    Hindrance,
    at_present,
    holds_up,
    lit_too,
    parked,
    slowed,
    stood,
)
from xavi_dialogue.explain.causes.driving.roadside import limit_at, setting_off
from xavi_dialogue.explain.causes.vehicles import conduct
from xavi_dialogue.explain.causes.vehicles.actions import YIELDS
from xavi_dialogue.explain.causes.vehicles.announced import announced, meeting
from xavi_dialogue.explain.causes.vehicles.grounds import grounds
from xavi_dialogue.explain.causes.vehicles.when import RECENT
from xavi_dialogue.explain.history.nearing import speed_at, tellable, with_speeds

CHANGES: tuple[ActionName, ...] = ("change-left", "change-right", "merge", "enter", "pull-out")
JUST = 4.0  # [s] for which we count as having just moved in ahead of somebody
EXPECTED = 0.3  # minimum probability of what may be called expected
CREEPING = 1.5  # [m/s]
LONG = 3.0  # [s] around a rule of priority, within which it may explain that somebody slowed
STILL = frozenset[ActionName](("stop", "stand", "wait", "give-way", "let-go", "block"))
SLOWING = frozenset[ActionName](("slow-down", "brake"))
GOING = frozenset[ActionName](("go", "move", "continue", "enter", "cross", "come", "pull-out"))
PASSING = frozenset[ActionName](("overtake", "pass"))
SAME = 1.0  # [m/s] up to which a vehicle counts as no faster than us
OPEN = frozenset[ActionName](("do", "happen", "signal", "see", "appear", "disappear", "block"))
#: By action that a vehicle did not take: those that answer why not.
INSTEAD: dict[ActionName, tuple[ActionName, ...]] = {
    "speed-up": ("slow-down", "brake", "stop", "stand"),
    "slow-down": ("speed-up", "go"),
    "brake": ("speed-up", "go"),
    "stop": ("go", "speed-up", "slow-down"),
    "exit-left": ("exit-right", "exit-straight"),
    "exit-right": ("exit-left", "exit-straight"),
    "turn": ("exit-straight", "exit-left", "exit-right"),
}


def why(event: Event, scene: Asked, *, negated: bool) -> Answer:
    """Explain why another vehicle did something, or did not.

    Raises:
        Unanswered: it did not, or did; or it was never seen.
    """
    vehicle = check_seen(scene, event.actor)
    assert vehicle is not None
    if negated and event.action in GOING | {"speed-up"}:
        return _standing(event, scene, vehicle)
    if negated:
        return _why_not(event, scene, vehicle)
    if event.action in STILL | SLOWING:
        return _braking(event, scene, vehicle)
    if event.action in OPEN:
        return _at_present(event, scene, vehicle)
    return _deed(event, scene, vehicle)


def slows(scene: Asked, vehicle: int) -> bool:
    """Check whether a vehicle slows down or stands, rather than driving slowly all the time."""
    if setting_off(scene.ride, scene.now, vehicle):
        return False
    begin = scene.now - RECENT
    return bool(scene.world.episodes(Vehicle(vehicle), STILL | SLOWING, begin, scene.now))


def slowly(scene: Asked, vehicle: int) -> Answer:
    """Explain why a vehicle drives slowly without slowing down: who is in its way, if anybody."""
    speed = scene.world.measure("speed", Vehicle(vehicle), scene.now).value
    deed = Episode(Vehicle(vehicle), "move", scene.now, speed_to=speed)
    if setting_off(scene.ride, scene.now, vehicle):
        return OtherReason(vehicle, deed, None, (MotionCause("starting"),))
    hindered = at_present(scene.ride, vehicle, scene.now)
    causes = with_speeds(scene.ride, hindered.causes, scene.now)
    return OtherReason(vehicle, deed, None, causes, None, hindered.evidence)


def believed(content: Proposition, scene: Asked) -> Answer:
    """Return what made us expect something of another vehicle; for us, why we chose so.

    Raises:
        Unanswered: nothing was expected of the vehicle.
    """
    event = event_of(content)
    vehicle = None if event is None else check_seen(scene, event.actor)
    if event is None or vehicle is None:
        return choices.why(event if event is not None and is_own(event.actor) else None, scene)
    return grounds(scene.ride, vehicle, conduct.conduct_names(event), scene.moment)


def _standing(event: Event, scene: Asked, vehicle: int) -> Answer:
    """Explain why a vehicle does not go: why it stands or slows; else why not at all."""
    still = Event("stand", event.actor, tense=event.tense, time=event.time)
    try:
        return _asked(_braking(still, scene, vehicle), event)
    except Unanswered as unanswered:
        if not isinstance(unanswered.result, DidNotHappen):
            raise
    return _why_not(event, scene, vehicle)


def _asked(found: Answer, event: Event) -> Answer:
    return replace(found, asked=event) if isinstance(found, OtherReason) else found


def _braking(event: Event, scene: Asked, vehicle: int) -> Answer:
    """Explain why a vehicle brakes, stands or waits: who is in its way."""
    yielded = _yielded(event, scene, vehicle)
    if yielded is not None:
        return yielded
    order: tuple[tuple[ActionName, ...], ...] = (
        (("stop", "stand"), ("slow-down", "brake"))
        if event.action in STILL
        else (("slow-down", "brake"), ("stop", "stand"))
    )
    for rank, kinds in enumerate(order):
        found = _last(scene, vehicle, kinds, event)
        if found is None:
            continue
        end = scene.now if found.end is None else found.end
        if found.action in ("stop", "stand"):
            hindered = stood(scene.ride, vehicle, found.begin)
            now = found.end is None or scene.moment <= end
            if not hindered.causes and now:
                hindered = at_present(scene.ride, vehicle, scene.moment, EXPECTED)
            if not hindered.causes and parked(scene.ride, vehicle, found, scene.moment, scene.now):
                return OtherReason(vehicle, found, None, (MotionCause("parked"),))
        else:
            hindered = slowed(scene.ride, vehicle, found.begin, end)
            if not hindered.causes and scene.moment <= end:
                hindered = at_present(scene.ride, vehicle, scene.moment, EXPECTED)
        hindered = lit_too(scene.ride, vehicle, hindered, (found.begin, scene.moment, end))
        if not hindered.causes and _owes_us(scene, vehicle, found.begin, end):
            hindered = Hindrance((MotionCause("right-of-way", EGO),))
        said = rank == 0 or _hardly_moves(scene, vehicle)
        return _told(scene, vehicle, found, None if said else event, hindered, found.begin)
    raise _denied(scene, vehicle, event)


def _owes_us(scene: Asked, vehicle: int, begin: float, end: float) -> bool:
    """Check whether a vehicle had to let us go first while it slowed down or stood."""
    rule = rule_between(scene, vehicle, Window(begin, end))
    return rule is not None and rule[1] == "priority" and begin - LONG <= rule[0] <= end + LONG


def _yielded(event: Event, scene: Asked, vehicle: int) -> Answer | None:
    """Return whom a vehicle waited for or let go first, if it was seen to do so then."""
    if event.action not in YIELDS | STILL:
        return None
    found = _last(scene, vehicle, ("give-way", "wait"), event)
    whom = None if found is None else found.object
    if found is None or not isinstance(whom, Ego | Vehicle):
        return None
    other = whom.number if isinstance(whom, Vehicle) else EGO
    if event.action in STILL and not holds_up(scene.ride, other, vehicle, scene.moment, EXPECTED):
        return None
    how = (found.how if found.action == "wait" else None) or "right-of-way"
    first = Hindrance((MotionCause(how, other),))
    return _told(scene, vehicle, found, None, first, found.begin)


def _hardly_moves(scene: Asked, vehicle: int) -> bool:
    """Check whether a vehicle is so slow that people may say that it stands."""
    speeds = scene.ride.motion(vehicle).until(scene.moment).speed
    return bool(speeds) and speeds[-1] < CREEPING


def _deed(event: Event, scene: Asked, vehicle: int) -> Answer:
    """Explain why a vehicle did something other than braking: where it was going."""
    past = is_past(scene, event)
    begin, end = (0.0, scene.now) if scene.past is None else (scene.past.begin, scene.past.end)
    done = scene.world.holds(event, begin, end)
    if not past and scene.past is None:
        done = tuple(e for e in done if e.end is None or e.end >= scene.now - RECENT)
    found = scene.pick(done, lambda e: (e.begin, e.end))
    if found is not None:
        return _told(scene, vehicle, found, None, Hindrance(), found.begin)
    chance = _chance(scene, vehicle, event)
    if not past and chance >= EXPECTED:
        return _told(scene, vehicle, None, event, Hindrance(), scene.moment)
    raise _denied(scene, vehicle, event)


def _at_present(event: Event, scene: Asked, vehicle: int) -> Answer:
    """Explain what a vehicle is doing at a time: what that is, who is in its way, where it goes."""
    time = scene.moment
    under_way = scene.world.episodes(Vehicle(vehicle), begin=time - RECENT, end=time)
    wanted = [e for e in under_way if e.action == event.action]
    doing = wanted or [e for e in under_way if e.action not in ("appear", "move", "follow")]
    hindered = at_present(scene.ride, vehicle, time)
    deed = doing[-1] if doing else None
    if event.action == "signal":
        return _signalled(scene, vehicle, event)
    return _told(scene, vehicle, deed, None if wanted else event, hindered, time)


def _signalled(scene: Asked, vehicle: int, event: Event) -> Answer:
    """Return what a vehicle's indicator means.

    Raises:
        Unanswered: it does not indicate.
    """
    deed = _last(scene, vehicle, ("signal",), event)
    found = (
        None if deed is None else announced(scene.ride, scene.world, vehicle, deed, scene.moment)
    )
    if found is None:
        raise _denied(scene, vehicle, event)
    return found


def placed(of: Related, scene: Asked) -> Answer:
    """Return how another vehicle got where it is: who let the other go first, or passed it.

    Raises:
        Unanswered: it was never seen.
    """
    vehicle = check_seen(scene, of.thing)
    assert vehicle is not None
    return PlaceReason(
        vehicle, of.relation, meeting(scene.world, vehicle, of.relation, scene.moment)
    )


def _why_not(event: Event, scene: Asked, vehicle: int) -> Answer:
    """Explain why a vehicle did not do something: what it did instead, and what we expected."""
    begin = scene.past.begin if scene.past is not None else 0.0
    end = scene.past.end if scene.past is not None else scene.now
    did = scene.world.holds(event, begin, end)
    others = INSTEAD.get(event.action)
    after = did[-1].begin if did else begin
    instead = scene.world.episodes(Vehicle(vehicle), others, after, end)
    instead = tuple(e for e in instead if e.action not in ("appear", "follow", "move"))
    if did and not (instead and instead[-1].begin > did[-1].begin):
        raise Unanswered(DidNotHappen(event, did[-1:]))
    deed = instead[-1] if instead else None
    pace = _pace(event, scene, vehicle)
    if pace is not None:
        return OtherReason(vehicle, None, event, (pace,))
    if deed is not None and deed.action in STILL | SLOWING:
        found = _braking(Event(deed.action, event.actor, tense=event.tense), scene, vehicle)
        return _asked(found, event)
    return _told(scene, vehicle, deed, event, Hindrance(), end)


def _pace(event: Event, scene: Asked, vehicle: int) -> MotionCause | None:
    """Return as the reason for not passing us that a vehicle is no faster; None: it is faster."""
    if event.action not in PASSING or not is_own(event.object or Ego()):
        return None
    time = scene.moment
    ours, its = speed_at(scene.ride, time), scene.world.measure("speed", Vehicle(vehicle), time)
    if ours is None or its.value is None or its.value > ours + SAME:
        return None
    return MotionCause("limit", EGO, speed=its.value, value=limit_at(scene.ride, time))


def _last(
    scene: Asked, vehicle: int, kinds: tuple[ActionName, ...], event: Event
) -> Episode | None:
    found = [e for e in scene.world.episodes(Vehicle(vehicle), kinds) if e.action in kinds]
    if not is_past(scene, event) and scene.past is None:
        found = [e for e in found if e.end is None or e.end >= scene.now - RECENT]
    return scene.pick(found, lambda e: (e.begin, e.end))


def _told(
    scene: Asked,
    vehicle: int,
    deed: Episode | None,
    asked: Event | None,
    hindered: Hindrance,
    time: float,
) -> OtherReason:
    hindering = with_speeds(scene.ride, hindered.causes, tellable(deed, scene.moment))
    causes = tuple(_came_in(scene, cause, time) for cause in hindering)
    goal = _goal(scene, vehicle, time)
    if deed is not None and deed.action in STILL | SLOWING and not _turns(goal):
        goal = None  # nobody stops or slows for going straight on
    return OtherReason(vehicle, deed, asked, causes, goal, hindered.evidence)


def _came_in(scene: Asked, cause: MotionCause, time: float) -> MotionCause:
    """Turn us as a leader into a cut-in, if we have only just moved in ahead of the vehicle."""
    if cause.vehicle != EGO or cause.kind != "leader":
        return cause
    moved = scene.world.episodes(Ego(), CHANGES, time - JUST, scene.now)
    begun = any(time - JUST <= episode.begin <= time + 1.0 for episode in moved)
    return replace(cause, kind="cut-in") if begun else cause


def _turns(goal: Belief | None) -> bool:
    """Check whether a vehicle was expected to turn off or stop."""
    steps = goal.expectations[0].actions if goal is not None and goal.expectations else ()
    return any(step in ("exit-left", "exit-right", "stop") for step in steps)


def _goal(scene: Asked, vehicle: int, time: float) -> Belief | None:
    try:
        trace = conduct.last_with(scene.ride, vehicle, time)
    except Unanswered:
        try:
            trace = conduct.last_with(scene.ride, vehicle, scene.now)
        except Unanswered:
            return None
    return conduct.belief_of(scene.ride, trace, vehicle)


def _chance(scene: Asked, vehicle: int, event: Event) -> float:
    try:
        trace = conduct.last_with(scene.ride, vehicle, scene.moment)
    except Unanswered:
        return 0.0
    return conduct.probability(scene.ride, trace, vehicle, conduct.conduct_names(event))


def _denied(scene: Asked, vehicle: int, event: Event) -> Unanswered:
    """Return the refusal that a vehicle did not do so, with when it did, or what it did then."""
    ever = scene.world.holds(event, 0.0, scene.now)
    if ever and scene.past is not None:
        return Unanswered(DidNotHappen(event, ever[-1:], elsewhen=ever[-1].begin))
    actor = Vehicle(vehicle)
    at = scene.moment
    near = scene.world.episodes(actor, begin=at - 5.0, end=at) or scene.world.episodes(actor)
    told = [e for e in near if e.action not in ("appear", "disappear", "approach")]
    return Unanswered(DidNotHappen(event, tuple(told[-1:])))
