"""Durations: how long something lasted, how long somebody waited, and what a manoeuvre cost."""

from collections.abc import Sequence

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, Happenings, Measures
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import Which
from xavi_dialogue.domain.terms import (
    Between,
    Compares,
    Ego,
    Event,
    Feature,
    Measured,
    Thing,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import EXPECTED, HALTS
from xavi_dialogue.explain.answers.expectations.plans import foreseen, horizon, moving_on
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window, is_ahead, window
from xavi_dialogue.explain.answers.reference.naming import is_us, looks, number
from xavi_dialogue.explain.answers.reference.occasions import (
    did_not_happen,
    duration,
    merged,
    occasion,
    occasions,
    overlaps,
)
from xavi_dialogue.explain.answers.reference.reading import numbers_in
from xavi_dialogue.explain.answers.ride.places import time_to_go
from xavi_dialogue.explain.history.restraints import lasted
from xavi_dialogue.explain.history.thresholds import STANDING

LITTLE = 1.0  # [s] cost below which somebody costs us next to nothing
SOON = 3.0  # [s] maximum time to a stop that we are about to make
LATELY = 15.0  # [s] after a hold-up in which a question may be about it
CREEPING = 4.0  # [s] maximum time between two halts at one place
QUEUING = 15.0  # [s] the same where we drive slowly
SLOW = 4.0  # [m/s] speed up to which we move up in a queue
PAUSE = 3.0  # [s] maximum time between two slowings that count as one
TRAILED = 80.0  # [m] maximum distance of a vehicle ahead that slows us down
ASIDE = 2.5  # [m] maximum offset sideways of a vehicle in our lane
JOINED = 0.5  # [s] maximum time between episodes that belong together
#: Actions that cost time.
HELD: tuple[ActionName, ...] = ("slow-down", "brake", "wait", "stop", "stand", "give-way")
HALTED: tuple[ActionName, ...] = ("wait", "stand", "stop")
WAITS: tuple[ActionName, ...] = ("wait", "stand", "stop", "give-way")


def event_lasting(event: Event, asked: Asked) -> Answer:
    """Return how long something lasted, has lasted so far, or is expected to last.

    Raises:
        Unanswered: it did not happen.
    """
    if event.action == "arrive" or (
        event.action in ("do", "happen", "move") and is_us(event.actor)
    ):
        return _ride_time(asked, event)
    ahead = is_ahead(asked, event.time, event.tense) or (
        event.modal == "must" and event.tense == "present"
    )
    waits = event.action in HALTS if is_us(event.actor) else event.action == "cross"
    if ahead and waits and halted(asked):  # until those who cross are out of our way
        return Measures((remaining_wait(asked),))
    found = occasion(asked, event)
    if found is None and event.action in HALTS:
        found = _standing(asked, event)
    if found is None:
        raise did_not_happen(asked, event)
    halts = _halts(asked, event, found)
    if len(halts) < 2:
        return lasting(asked, found, event)
    stood = sum(duration(asked, halt) for halt in halts)
    total = Measure("waiting-time", Ego(), halts[0].begin, value=round(stood, 2),
                    until=asked.now, extreme="total")  # fmt: skip
    if halts[-1].end is not None:
        return Measures((total,))
    queue = lasting(asked, replace(found, begin=halts[0].begin, end=None), event)
    return replace(queue, measures=(*queue.measures, total))


def _halts(asked: Asked, event: Event, found: Episode) -> list[Episode]:
    """List our halts that belong to one, with a little creeping between; or all of the ride."""
    if not is_us(event.actor) or event.object is not None or event.action not in HALTS:
        return []
    every = asked.world.episodes(actor=Ego(), actions=HALTED)
    stood = merged(asked, [e for e in every if e.action in HALTED and duration(asked, e) > 0.0])
    if isinstance(event.time, WholeRide):
        return list(stood)
    rows: list[list[Episode]] = []
    for halt in stood:
        last = rows[-1][-1] if rows else None
        if last is None or not _creeps(asked, last.end or asked.now, halt.begin):
            rows.append([])
        rows[-1].append(halt)
    about = Window(found.begin, found.end or asked.now)
    return next((row for row in rows if any(overlaps(asked, e, about) for e in row)), [])


def _creeps(asked: Asked, begin: float, end: float) -> bool:
    """Check whether we only moved up between two halts."""
    if end - begin <= CREEPING:
        return True
    fastest = asked.world.extreme("speed", Ego(), "highest", begin, end).value
    return end - begin <= QUEUING and fastest is not None and fastest <= SLOW


def lasting(asked: Asked, episode: Episode, event: Event | None = None) -> Happenings:
    """Return how long an episode lasted; if we still stand, also how long that is to last."""
    value = Measure(
        "duration", episode.actor, episode.begin, value=round(duration(asked, episode), 2),
        until=episode.end, at_least=episode.end is None or episode.begin <= asked.world.begin,
    )  # fmt: skip
    known: tuple[Measure, ...] = (value,)
    on = episode.end is None or episode.end >= asked.now - 0.5
    if on and isinstance(episode.actor, Ego) and stands(asked):
        known += (remaining_wait(asked),)
    other = episode.actor if isinstance(episode.actor, Vehicle) else episode.object
    seen = looks(asked, (other.number,), episode.begin) if isinstance(other, Vehicle) else ()
    return Happenings(
        "how-long", (episode,), episode.actor, measures=known, looks=seen, asked=event
    )


def remaining_wait(asked: Asked) -> Measure:
    """Return how long our car still stands, by its plan; a lower bound if no end is in it."""
    now, found = asked.now, moving_on(asked)
    if found is not None and found.share >= 0.5:
        low, middle, high = (
            round(max(t - now, 0.0), 2) for t in (found.low, found.moment, found.high)
        )
        return Measure(
            "waiting-time", Ego(), now, value=middle, until=now + middle, low=low, high=high
        )
    end = horizon(asked)
    if end is None:
        return Measure("waiting-time", Ego(), now, gap="in-future")
    value = round(max(end - now, 0.0), 2)
    return Measure("waiting-time", Ego(), now, value=value, until=now + value, at_least=True)


def waited(asked: Asked, who: Thing, whom: Thing | None, about: Window) -> Measure:
    """Return how long somebody stood in a stretch of the ride, or for another vehicle."""
    if about.instant:
        about = Window(asked.world.begin, asked.now)
    actor: Thing = Ego() if is_us(who) else who
    event = Event("wait", actor, whom) if whom is not None else Event("stand", actor)
    found = [e for e in occasions(asked, event) if overlaps(asked, e, about)]
    if whom is not None and not found:
        found = list(occasions(asked, Event("give-way", actor, whom)))
    total = sum(duration(asked, e) for e in merged(asked, found))
    return Measure(
        "waiting-time", actor, about.begin, value=round(total, 2), to=whom, until=about.end,
        extreme="total", at_least=_lost(asked, about),
    )  # fmt: skip


def stands(asked: Asked) -> bool:
    """Check whether our car stands now."""
    motion = asked.ride.motion(EGO)
    return bool(motion.speed) and motion.speed[-1] < STANDING


def halted(asked: Asked) -> bool:
    """Check whether our car stands, waits, or is about to come to a halt."""
    if _waits(asked):
        return True
    found = foreseen(asked, Event("stop"))
    return found is not None and found.share >= EXPECTED and found.moment - asked.now < SOON


def _waits(asked: Asked) -> bool:
    """Check whether our car stands, waits or gives way."""
    on = asked.world.episodes(actor=Ego(), actions=WAITS)
    return stands(asked) or any(e.end is None for e in on)


def _standing(asked: Asked, event: Event) -> Episode | None:
    """Return a wait under another name: to passengers, giving way or stopping is standing, too."""
    for action in WAITS:
        if action != event.action:
            other = Event(action, event.actor, event.object, time=event.time, tense=event.tense)
            if (found := occasion(asked, other)) is not None and _halted(asked, found):
                return found
    return None


def _halted(asked: Asked, episode: Episode) -> bool:
    return episode.standing or episode.action == "stand" or duration(asked, episode) > 0.0


def _ride_time(asked: Asked, event: Event) -> Answer:
    """Return how long the ride still takes, or has taken."""
    if event.action == "arrive" or is_ahead(asked, event.time, event.tense):
        return Measures((time_to_go(asked, asked.now),))
    world, about = asked.world, window(asked, event.time)
    whole = Measure(
        "time", Ego(), world.begin, value=about.end - world.begin, until=about.end,
        extreme="total",
    )  # fmt: skip
    left = () if asked.ride.arrived else (time_to_go(asked, asked.now),)
    return Measures((whole, *left))


def _lost(asked: Asked, about: Window) -> bool:
    return any(b <= about.end and e >= about.begin for b, e in asked.ride.gaps)


def cost_of(asked: Asked, event: Event | None, about: Window) -> Measure:
    """Return what an episode of ours cost in time, with all the slowing and waiting around it.

    Raises:
        Unanswered: there was none.
    """
    behind = [] if event is None or event.object is None else _slowed_behind(asked, event.object)
    if event is not None and event.action == "block" and behind:
        found: Episode | None = max(behind, key=lambda e: duration(asked, e))
    elif event is not None and event.action != "block":
        found = occasion(asked, event)
    else:
        slow = list(asked.world.episodes(actor=Ego(), actions=HELD))
        near = [e for e in slow if overlaps(asked, e, about.widened())]
        late = [e for e in near if e.end is None or e.end >= asked.now - LATELY]
        found = max(late or near or slow[-1:], key=lambda e: duration(asked, e), default=None)
    if found is None:
        raise did_not_happen(asked, event or Event("slow-down"))
    return lost(asked, found) or asked.world.delay(found)


def held_for(asked: Asked, other: Thing) -> Event:
    """Return what we did last for another vehicle that held us up."""
    found = asked.world.episodes(Ego(), HELD, object=other)
    trailed = asked.world.episodes(Ego(), ("follow",), object=other)
    named = found or trailed
    if not named and _slowed_behind(asked, other):
        return Event("block", object=other)  # others were between it and us
    return Event(named[-1].action if named else "give-way", object=other)


def total_cost(asked: Asked, others: Vehicle | Vehicles, about: Window) -> Measure:
    """Return what all slowing and waiting for vehicles cost in a stretch of the ride."""
    each = [Vehicle(one) for one in numbers_in(others)]
    deeds = [
        *(e for one in each for e in asked.world.episodes(Ego(), HELD, object=one)),
        *(e for one in each for e in _slowed_behind(asked, one) if not _at_light(asked, e)),
    ] or [e for one in each for e in asked.world.episodes(Ego(), ("follow",), object=one)]
    near = about.widened() if about.instant else about
    costs = (lost(asked, e) for e in deeds if overlaps(asked, e, near))
    kept: list[Measure] = []
    for cost in sorted((c for c in costs if c is not None), key=lambda c: (c.time, c.value or 0.0)):
        last = kept[-1] if kept else None
        if last is None or cost.time >= (last.until or last.time):
            kept.append(cost)
        elif (cost.value or 0.0) > (last.value or 0.0):
            kept[-1] = cost
    total = round(sum(cost.value or 0.0 for cost in kept), 1)
    begin = kept[0].time if kept else near.begin
    if (held := _restrained(asked, each, near)) > 0.0:  # the rest of it was for others
        total = min(total, round(held, 1))
    return Measure("delay", Ego(), begin, value=total, to=others, extreme="total", count=len(kept))


def _restrained(asked: Asked, others: Sequence[Vehicle], about: Window) -> float:
    """Return for how long [s] one of some vehicles was what kept us from driving faster."""
    spans = lasted(asked.ride, about.begin, min(about.end, asked.now))
    known = {one.number for one in others}
    return sum(span for one, span in spans.items() if one.vehicle in known and one.light is None)


def compared_costs(question: Which, asked: Asked) -> Measures:
    """Return the time that each of several cost us, most first: in the time named, else in all."""
    numbers = dict.fromkeys(n for of in (question.thing, *question.among) for n in numbers_in(of))
    left = question.such.left if isinstance(question.such, Compares) else None
    about = Window(asked.world.begin, asked.now)
    if isinstance(left, Measured) and isinstance(left.time, Between):
        about = window(asked, left.time)
    costs = [total_cost(asked, Vehicle(n), about) for n in numbers]
    return Measures(tuple(sorted(costs, key=lambda cost: -(cost.value or 0.0))))


def _at_light(asked: Asked, deed: Episode) -> bool:
    """Check whether we slowed down or stood for a traffic light."""
    end = asked.now if deed.end is None else deed.end
    found = asked.world.episodes(Ego(), WAITS, deed.begin - JOINED, end + JOINED)
    return any(isinstance(e.object, Feature) for e in found)


def _slowed_behind(asked: Asked, other: Thing) -> list[Episode]:
    """List our slowing or standing behind others while a vehicle was ahead in our lane."""
    vehicle = number(other)
    if vehicle is None:
        return []
    found = []
    for one in asked.world.episodes(Ego(), HELD):
        end = asked.now if one.end is None else one.end
        seen = asked.world.look(vehicle, (one.begin + end) / 2.0)
        along = seen is not None and seen.in_view and not seen.oncoming
        along = along and bool(asked.world.episodes(Ego(), ("follow",), one.begin, end))
        if along and seen is not None and abs(seen.left) <= ASIDE and 0.0 < seen.ahead <= TRAILED:
            found.append(one)
    return found


def lost(asked: Asked, deed: Episode) -> Measure | None:
    """Return the time [s] that slowing and waiting cost, around an episode of ours."""
    deed = replace(deed, begin=_since(asked, deed))
    end = asked.now if deed.end is None else deed.end
    part = asked.world.episodes(Ego(), HELD, deed.begin - JOINED, end + JOINED)
    costs = [asked.world.delay(e) for e in (deed, *part)]
    told = [cost for cost in costs if cost.value is not None]
    return max(told, key=lambda cost: cost.value or 0.0, default=None)


def _since(asked: Asked, deed: Episode) -> float:
    """Return since when [s] we had slowed down again and again, with hardly a pause."""
    begin = deed.begin
    for one in sorted(asked.world.episodes(Ego(), HELD), key=lambda e: -e.begin):
        if one.end is not None and one.begin < begin <= one.end + PAUSE:
            begin = one.begin
    return begin
