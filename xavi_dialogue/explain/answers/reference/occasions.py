"""Occasions: the episodes that an event of a question stands for, and what happened instead."""

import math
from collections.abc import Iterable, Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, DidNotHappen, NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Junction,
    Nobody,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.letting import let_across
from xavi_dialogue.explain.answers.reference.moments import Window, was_said, window
from xavi_dialogue.explain.answers.reference.naming import first_look, is_us, known, number
from xavi_dialogue.explain.causes.vehicles.when import LEEWAY
from xavi_dialogue.explain.history.restraints import slowed_for
from xavi_dialogue.explain.history.ride import Ride

PAUSE = 0.5  # [s] between two episodes of one kind, from which they are different ones
CHANGED: frozenset[ActionName] = frozenset(("change-left", "change-right"))
INSIDE = 1.0  # [s] of overlap from which an episode belongs to a stretch of the ride
GOING = 0.5  # [s] after its end in which something still counts as going on
TOLD = 2  # episodes that are stated in place of what did not happen
#: Actions that go on most of the time, and are stated only if there is nothing else.
PLAIN: frozenset[ActionName] = frozenset(
    ("continue", "move", "follow", "keep-lane", "keep-distance", "approach", "head", "see", "come",
     "appear", "disappear", "signal", "go")
)  # fmt: skip
#: Actions that concern our seeing a vehicle rather than its driving.
SIGHT: tuple[ActionName, ...] = ("see", "appear", "disappear", "signal")
#: Actions that we take for somebody who crosses our way.
SLOWED: tuple[ActionName, ...] = ("slow-down", "brake", "stop")
#: By action: those that may stand for it if there is no episode of its own name.
OTHERWISE: dict[ActionName, tuple[ActionName, ...]] = {
    "let-go": ("give-way", "wait"),
    "exit-right": ("leave",),
    "turn": ("leave",),
    "pass": ("cross",),
    "overtake": ("pass",),
    "cross": ("exit-straight", "turn"),
}
#: Actions of ours that are known from the macro actions that we carried out.
OURS: frozenset[ActionName] = frozenset(
    ("change-left", "change-right", "change-lane", "exit-left", "exit-right", "exit-straight",
     "continue-next-exit", "turn", "merge")
)  # fmt: skip
#: Actions of one family: what was done instead is looked for there first.
FAMILIES: tuple[frozenset[ActionName], ...] = (
    frozenset(("stop", "stand", "wait", "brake", "slow-down", "give-way", "let-go")),
    frozenset(("speed-up", "go", "move")),
    frozenset(
        ("change-left", "change-right", "change-lane", "overtake", "cut-in", "merge", "pass",
         "swerve", "keep-lane", "follow")
    ),
    frozenset(
        ("exit-left", "exit-right", "exit-straight", "continue-next-exit", "turn", "u-turn",
         "enter", "leave", "cross")
    ),
)  # fmt: skip


def occasions(asked: Asked, event: Event) -> tuple[Episode, ...]:
    """Find the episodes of the ride so far that an event describes, oldest first.

    Raises:
        Unanswered: the event is about a vehicle that was never seen.
    """
    for action in (event.action, *_otherwise(event)):
        found = _held(asked, replace(event, action=action))
        if found:
            return tuple(sorted(found, key=lambda e: (e.begin, _end(asked, e))))
    return _let_first(asked, event) or _while_let_go(asked, event)


def with_let_first(asked: Asked, event: Event, found: Sequence[Episode]) -> tuple[Episode, ...]:
    """Add when we let others first, as our driving recorded, where nobody is named."""
    if event.action != "give-way" or event.object is not None:
        return tuple(found)
    known = {e.object for e in found}
    besides = (e for e in _let_first(asked, event) if e.object not in known)
    return tuple(sorted((*found, *besides), key=lambda e: (e.begin, _end(asked, e))))


def _let_first(asked: Asked, event: Event) -> tuple[Episode, ...]:
    """Find when we let those first of whom an event says so, as our driving recorded."""
    if event.action not in ("give-way", "let-go") or not is_us(event.actor):
        return ()
    if event.object is None:
        return let_across(asked, asked.world.vehicles)
    others = _each(asked, event.object)
    return let_across(asked, [v.number for v in others if isinstance(v, Vehicle)])


def _while_let_go(asked: Asked, event: Event) -> tuple[Episode, ...]:
    """Find our slowing for vehicles that crossed our way meanwhile, or that were in our way."""
    if event.action not in SLOWED or not is_us(event.actor) or event.object is None:
        return ()
    others = [v for v in _each(asked, event.object) if isinstance(v, Vehicle)]
    crossed = [e for v in others for e in asked.world.episodes(v, ("cross",), object=Ego())]
    for other in others:
        crossed += asked.world.episodes(Ego(), ("give-way", "wait"), object=other)
    named = {other.number for other in others}
    return tuple(
        e for e in _held(asked, replace(event, object=None))
        if any(overlaps(asked, x, Window(e.begin, _end(asked, e))) for x in crossed)
        or named & slowed_for(asked.ride, e.begin, _end(asked, e)).keys()
    )  # fmt: skip


def _otherwise(event: Event) -> tuple[ActionName, ...]:
    """Return other actions that an event may mean: leaving a roundabout is turning right."""
    if event.action == "turn" and event.side == "left":
        return ()
    if event.action == "overtake" and Nobody in map(type, (event.actor, event.object)):
        return ()  # an oncoming vehicle overtakes nobody
    if event.action == "leave" and event.object == Junction("roundabout"):
        return ("exit-right", "exit-straight", "exit-left")
    if event.action == "leave" and event.object is None and not is_us(event.actor):
        return ("turn", "disappear")
    if event == Event("go", Ego(), time=event.time):
        return ("enter", "turn", "exit-straight")  # "when did you go?" at a junction
    if event.action == "pass" and event.object is None:
        return ("cross", "exit-straight", "exit-left", "exit-right")  # "has he got through"
    return OTHERWISE.get(event.action, ())


def _held(asked: Asked, event: Event) -> list[Episode]:
    world = asked.world
    found: list[Episode] = []
    for single in _singles(asked, event):
        if single.action == "see" and is_us(single.actor):
            found += _seen(asked, single)
        else:
            found += world.holds(single, world.begin, asked.now)
    return found


def _seen(asked: Asked, event: Event) -> list[Episode]:
    """Return our seeing of a vehicle, from when it came into view to when it was seen last."""
    vehicle = number(event.object)
    first = None if vehicle is None else first_look(asked, vehicle, asked.world.begin)
    if vehicle is None or first is None:
        return []
    look = asked.world.look(vehicle, asked.now)
    end = look.seen if look is not None and not look.in_view else None
    return [Episode(Ego(), "see", first.time, end, Vehicle(vehicle))]


def within(asked: Asked, event: Event, stretch: Window) -> tuple[Episode, ...]:
    """Return the occasions of an event that overlap a stretch of the ride."""
    near = stretch.widened() if stretch.instant else stretch
    return tuple(e for e in occasions(asked, event) if overlaps(asked, e, near))


def occasion(asked: Asked, event: Event) -> Episode | None:
    """Choose the occasion asked about: the last in its time; if no time was said, the nearest."""
    every = occasions(asked, event)
    about = window(asked, event.time, event.tense)
    if event.tense in ("present", "future") and about.end >= asked.now:
        about = Window(asked.now, asked.now)
    by = GOING if event.tense == "present" else LEEWAY
    near = about.widened(by) if about.instant else about
    inside = [e for e in every if overlaps(asked, e, near)]
    if inside:
        return nearest(asked, inside, about) if about.instant else inside[-1]
    if was_said(asked, event.time) or not every or event.tense == "present":
        return None
    return nearest(asked, every, about)


def taken_place(asked: Asked, event: Event) -> Episode:
    """Return the occasion that is asked about.

    Raises:
        Unanswered: the event did not take place; with what did.
    """
    found = occasion(asked, event)
    if found is None:
        raise did_not_happen(asked, event)
    return found


def did_not_happen(
    asked: Asked, event: Event, answer: Answer | None = None, planned: float | None = None
) -> Unanswered:
    """Return the refusal of a question about what did not happen, with what did."""
    about = window(asked, event.time, event.tense)
    lost = next((g for g in asked.ride.gaps if g[0] <= about.end and g[1] >= about.begin), None)
    others = instead(asked, event, about)
    every = occasions(asked, event)
    if lost is not None and not others and not every:
        return Unanswered(NotRecorded("gap-in-record", since=lost[0], until=lost[1]))
    elsewhen = nearest(asked, every, about).begin if every else None
    return Unanswered(
        DidNotHappen(event, others, planned=planned, elsewhen=elsewhen, answer=answer)
    )


def lacks_deeds(ride: Ride, event: Event) -> bool:
    """Check whether an event is an action of ours, and the record shows only what was planned."""
    shown = ride.events or not ride.traces or any(trace.shows_deeds for trace in ride.traces)
    return event.action in OURS and is_us(event.actor) and not shown


def instead(asked: Asked, event: Event, about: Window) -> tuple[Episode, ...]:
    """Return what the actor of an event did then: what is most like it, in order of time."""
    seen = () if event.action in SIGHT else SIGHT
    mine = [
        e
        for e in asked.world.episodes(actor=_actor(event.actor))
        if e.action != event.action and e.action not in seen
    ]
    alike = [e for e in mine if _akin(e.action, event.action) and e.action not in PLAIN]
    other = [e for e in mine if e.action not in PLAIN and e not in alike]
    plain = [e for e in mine if e.action in PLAIN]
    for group in (alike, other, plain):
        near = [e for e in group if overlaps(asked, e, about.widened(3.0))] or (
            [] if was_said(asked, event.time) else group
        )
        if near:
            ranked = sorted(near, key=lambda e: (away(asked, e, about), -e.begin))
            return tuple(sorted(_apart(asked, ranked)[:TOLD], key=lambda e: e.begin))
    return ()


def nearest(asked: Asked, episodes: Sequence[Episode], about: Window) -> Episode:
    """Return the episode closest to a stretch of the ride; of several, the last."""
    return min(episodes, key=lambda e: (away(asked, e, about), -e.begin))


def away(asked: Asked, episode: Episode, about: Window) -> float:
    """Return how far [s] an episode lies from a stretch of the ride."""
    return max(about.begin - _end(asked, episode), episode.begin - about.end, 0.0)


def overlaps(asked: Asked, episode: Episode, about: Window) -> bool:
    """Check whether an episode overlaps a stretch of the ride."""
    return episode.begin <= about.end + 1e-6 and _end(asked, episode) >= about.begin - 1e-6


def belongs(asked: Asked, episode: Episode, about: Window) -> bool:
    """Check whether an episode belongs to a stretch, and does not only begin or end in it."""
    if about.instant:
        return overlaps(asked, episode, about)
    inside = min(_end(asked, episode), about.end) - max(episode.begin, about.begin)
    return inside >= min(INSIDE, duration(asked, episode) / 2.0) - 1e-6


def merged(asked: Asked, episodes: Iterable[Episode]) -> tuple[Episode, ...]:
    """Return the episodes without those that continue or lie within another one."""
    found: list[Episode] = []
    for episode in sorted(episodes, key=lambda e: (e.begin, -_end(asked, e))):
        last = next((e for e in reversed(found) if e.actor == episode.actor), None)
        if last is None or _parted(last, episode) or _is_after(asked, last, episode):
            found.append(episode)
    return tuple(found)


def _is_after(asked: Asked, one: Episode, other: Episode) -> bool:
    """Check whether one episode ended before another begins; lane changes may follow at once.

    A lane change to the other side is never part of the first one, even if they overlap.
    """
    if {one.action, other.action} == CHANGED:
        return True
    pause = 0.0 if one.action in CHANGED and other.action in CHANGED else PAUSE
    return other.begin >= _end(asked, one) + pause


def duration(asked: Asked, episode: Episode) -> float:
    """Return how long [s] an episode lasted, or has lasted so far."""
    return max(_end(asked, episode) - episode.begin, 0.0)


def _parted(one: Episode, other: Episode) -> bool:
    """Check whether two episodes concern different vehicles."""
    return one.object is not None and other.object is not None and one.object != other.object


def _apart(asked: Asked, episodes: Iterable[Episode]) -> list[Episode]:
    """Return episodes without those that repeat an earlier one: braking within slowing down."""
    found: list[Episode] = []
    for one in episodes:
        same = (
            e
            for e in found
            if _akin(e.action, one.action) and overlaps(asked, one, Window(e.begin, _end(asked, e)))
        )
        if next(same, None) is None:
            found.append(one)
    return found


def _family(action: ActionName) -> frozenset[ActionName] | None:
    return next((family for family in FAMILIES if action in family), None)


def _akin(one: ActionName, other: ActionName) -> bool:
    family = _family(one)
    return family is not None and other in family


def _actor(thing: Thing) -> Ego | Vehicle | None:
    if is_us(thing):
        return Ego()
    return thing if isinstance(thing, Vehicle) else None


def _singles(asked: Asked, event: Event) -> list[Event]:
    """Return the event for each of its actors and objects."""
    actors = _each(asked, event.actor)
    objects = [event.object] if event.object is None else _each(asked, event.object)
    return [replace(event, actor=a, object=o) for a in actors for o in objects if a != o]


def _each(asked: Asked, thing: Thing) -> list[Thing]:
    match thing:
        case Vehicles(numbers=names):
            return [known(asked, Vehicle(name), asked.now) for name in names]
        case Everyone():
            return [Vehicle(name) for name in asked.world.vehicles]
        case Vehicle():
            return [Ego()] if thing.number == 0 else [known(asked, thing, asked.now)]
    return [Ego()] if is_us(thing) else [thing]


def _end(asked: Asked, episode: Episode) -> float:
    return (
        math.inf
        if episode.end is None and episode.begin > asked.now
        else (asked.now if episode.end is None else episode.end)
    )
