"""Counting: how many there are, and how often something happened."""

from msgspec.structs import replace

from sim.roads.network import angle_between
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, Counted, Measures, NotRecorded
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import HowMany
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Exit,
    Feature,
    Junction,
    Lane,
    Nobody,
    Related,
    Road,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.expectations.plans import plan_ahead
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, window
from xavi_dialogue.explain.answers.reference.naming import (
    ANY,
    check_sense,
    first_look,
    is_us,
    of_kind,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import merged, within
from xavi_dialogue.explain.answers.ride.onward import WAYS, junctions_left, turns_left
from xavi_dialogue.explain.answers.ride.passages import exits_passed
from xavi_dialogue.explain.answers.ride.places import told
from xavi_dialogue.explain.history.thresholds import TURNED

APART = 15.0  # [m] maximum distance between two in a queue
SLOW = 3.0  # [m/s] maximum speed of somebody in it
CHANGES: frozenset[str] = frozenset(("change-left", "change-right", "change-lane"))


def how_many(question: HowMany, asked: Asked) -> Answer:
    """Return how many there are or were, or how often something happened.

    Raises:
        Unanswered: the record does not hold what is asked about.
    """
    if isinstance(question.of, Event):
        event = question.of
        if isinstance(event.object, Exit) and event.action == "pass":
            return exits_passed(event, asked)
        if event.tense == "future" and event.action in WAYS and is_us(event.actor):
            return turns_left(asked, event)
        if event.tense == "future" and event.action in CHANGES and is_us(event.actor):
            return _changes_left(asked, event)
        return _events(asked, event)
    check_sense(question.of)
    found = _things(asked, _queued(question, asked))
    return replace(found, such=question.such) if isinstance(found, Counted) else found


def _queued(question: HowMany, asked: Asked) -> Thing:
    """Return who is counted; of those in a queue, only who stands close to another who does."""
    such = question.such.such if isinstance(question.such, Described) else None
    match such, question.of:
        case Related(to=Feature("queue")), Vehicles(numbers=numbers):
            looks = (asked.world.look(v, asked.moment) for v in numbers)
            still = [x.vehicle for x in looks if x is not None and x.speed < SLOW]
            row = tuple(v for v in still if any(_close(asked, v, w) for w in still if w != v))
            return Vehicles(row) if row else Nobody()
    assert not isinstance(question.of, Event)
    return question.of


def _close(asked: Asked, one: int, other: int) -> bool:
    """Check whether two vehicles are as close as in a queue."""
    gap = asked.world.measure("distance", Vehicle(one), asked.moment, Vehicle(other)).value
    return gap is not None and gap <= APART


def _events(asked: Asked, event: Event) -> Counted:
    """Return how often an event happened, in the stretch asked about or the whole ride."""
    about = window(asked, event.time)
    event = replace(event, object=_named(event.object))
    if event.tense != "present" and about.instant:
        about = Window(asked.world.begin, asked.now)
    found = merged(asked, within(asked, event, about))
    if event.action == "turn":
        found = tuple(e for e in found if not _straight_over(asked, e)) or found
    times = merged(asked, (replace(e, object=None) for e in found))
    lost = any(b <= about.end and e >= about.begin for b, e in asked.ride.gaps)
    begun = tuple(e.begin for e in times)
    return Counted(event, len(times), found, lost, about.begin, about.end, times=begun)


def _straight_over(asked: Asked, episode: Episode) -> bool:
    """Check whether we went straight over a roundabout, which passengers do not count as a turn."""
    place = episode.place
    if not isinstance(place, Junction) or place.form != "roundabout" or place.time is None:
        return False
    if not is_us(episode.actor):
        return False
    way = asked.ride.motion(EGO)
    before, after = way.until(place.time), way.until(episode.end or asked.now)
    if not before.heading or not after.heading:
        return False
    return abs(angle_between(after.heading[-1], before.heading[-1])) < TURNED


def _changes_left(asked: Asked, event: Event) -> Answer:
    """Return the lane changes that our plan still has, or that it has none."""
    ahead = plan_ahead(asked, measures=False)
    if any(action in CHANGES for action, _ in ahead.steps):
        return ahead
    done = asked.world.episodes(Ego(), ("change-left", "change-right"))
    return Counted(replace(event, manner=("again",)) if done else event, 0)


def _named(thing: Thing | None) -> Thing | None:
    """Return an object, or None if it stands for anybody, so that all occasions count."""
    return None if isinstance(thing, Nobody | Everyone) else thing


def _things(asked: Asked, of: Thing) -> Answer:
    match of:
        case Lane() | Road():
            found = asked.world.measure("lane-count", Ego(), asked.moment)
            return Measures(told((found,)))
        case Exit() | Junction():
            return _junctions(asked, of)
        case Nobody():
            return Counted(of, 0)
        case Vehicles(numbers=numbers):
            seen = (first_look(asked, v, asked.moment) for v in numbers)
            return Counted(of, len(numbers), tuple(x for x in seen if x is not None))
        case Vehicle() | Ego():
            return Counted(of, len(somebodies(asked, of, asked.moment)))
        case Everyone(kind=kind) | Described(kind=kind):
            return _users(asked, Everyone("vehicle" if kind in ANY else kind))
    raise Unanswered(NotRecorded("not-recorded", of, about="count"))


def _users(asked: Asked, of: Everyone) -> Counted:
    """Return how many road users are in view, or were over a stretch of the ride."""
    past = asked.past
    long = past is not None and past.end - past.begin > SHORT
    if past is None or not long:
        at = asked.moment
        numbers = of_kind(asked, asked.world.in_view(at), of.kind, at)
        since = until = at
    else:
        since, until = past.begin, min(past.end, asked.now)
        times = [t.sim_time for t in asked.ride.traces if since <= t.sim_time <= until]
        every = tuple(sorted({v for t in times for v in asked.world.in_view(t)}))
        numbers = of_kind(asked, every, of.kind, until)
    seen = (first_look(asked, v, until) for v in numbers)
    looks = tuple(x for x in seen if x is not None)
    return Counted(of, len(numbers), looks, False, since, until)


def _junctions(asked: Asked, of: Exit | Junction) -> Answer:
    """Return how many junctions are ahead, or which exit of how many we take."""
    road = asked.world.road(asked.moment)
    if road is None:
        raise Unanswered(NotRecorded("not-recorded", of, about="count"))
    if isinstance(of, Exit):
        ring = next((step for step in road.route if step.exits is not None), None)
        if ring is None or ring.exits is None:
            return Measures((Measure("exit-number", Ego(), asked.moment, gap="not-applicable"),))
        return Measures((asked.world.measure("exit-number", Ego(), asked.moment),))
    return junctions_left(asked, of)
