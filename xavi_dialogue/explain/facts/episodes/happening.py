"""What happened: the episodes of all kinds, and those that a given event describes."""

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias, TypeGuard

from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exit,
    Feature,
    Junction,
    Lane,
    Road,
    Thing,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.actions import SIDES, somebody
from xavi_dialogue.explain.facts.episodes.meetings import (
    crossings,
    followings,
    movings_in,
    passings,
)
from xavi_dialogue.explain.facts.episodes.misses import misses
from xavi_dialogue.explain.facts.episodes.own import (
    bearing,
    changed_plans,
    driving_on,
    struck,
    told,
)
from xavi_dialogue.explain.facts.episodes.seeing import sights, signals
from xavi_dialogue.explain.facts.episodes.speeds import moves, speeds
from xavi_dialogue.explain.facts.episodes.waiting import waits
from xavi_dialogue.explain.facts.episodes.ways import ways
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.thresholds import HARD

Names: TypeAlias = frozenset[ActionName]
Reader: TypeAlias = Callable[[States, int], list[Episode]]

#: Which reader finds which actions of any one road user.
READERS: dict[str, tuple[Reader, Names]] = {
    "speeds": (speeds, frozenset(("slow-down", "brake", "speed-up", "stop", "stand", "go"))),
    "ways": (
        ways,
        frozenset(
            (
                *("change-left", "change-right", "exit-left", "exit-right", "exit-straight"),
                *("continue-next-exit", "enter", "leave"),
            )
        ),
    ),
    "waits": (waits, frozenset(("wait", "give-way"))),
    "sights": (sights, frozenset(("appear", "disappear"))),
    "signals": (signals, frozenset(("signal",))),
    "moves": (moves, frozenset(("move",))),
}
#: Likewise for the meetings of another vehicle and the ego, either of which may be the actor.
MEETINGS: dict[str, tuple[Reader, Names]] = {
    "passings": (passings, frozenset(("overtake", "pass"))),
    "crossings": (crossings, frozenset(("cross",))),
    "followings": (followings, frozenset(("follow",))),
    "movings-in": (movings_in, frozenset(("cut-in", "pull-out"))),
    "misses": (misses, frozenset(("nearly-collide",))),
    "struck": (struck, frozenset(("collide",))),
}
#: Likewise for the actions that only the ego has.
OWN: dict[str, tuple[Callable[[States], Iterator[Episode]], Names]] = {
    "told": (told, frozenset(("arrive", "collide"))),
    "changed-plans": (changed_plans, frozenset(("change-plan",))),
    "driving-on": (driving_on, frozenset(("continue",))),
    "bearing": (bearing, frozenset(("swerve",))),
}
ON_REQUEST: Names = frozenset(("move", "nearly-collide", "continue", "swerve"))  # left out of "all"
#: Actions that an account of a ride mentions: of the ego, and of others that concern it.
OF_OURS: Names = frozenset(
    (
        *("stop", "stand", "wait", "give-way", "change-left", "change-right", "exit-left"),
        *("exit-right", "exit-straight", "enter", "leave", "overtake", "pull-out"),
        *("collide", "nearly-collide", "arrive"),
    )
)
OF_OTHERS: Names = frozenset(("overtake", "cut-in", "pull-out", "give-way", "cross"))
FIRM = 1.5  # [m/s2] minimum deceleration of braking that an account mentions
#: By action: those that, at the same time and of the same actor, make it needless to mention it.
TOLD_BY: dict[ActionName, Names] = {
    "go": frozenset(("give-way", "wait", "stop", "stand")),
    "stop": frozenset(("give-way", "wait")),
    "stand": frozenset(("give-way", "wait")),
    "slow-down": frozenset(("give-way", "exit-left", "exit-right", "enter")),
    "signal": frozenset(("change-left", "change-right", "exit-left", "exit-right", "leave")),
    "exit-left": frozenset(("leave",)),
    "exit-right": frozenset(("leave",)),
    "exit-straight": frozenset(("leave",)),
    "continue-next-exit": frozenset(("leave", "enter")),
    "cut-in": frozenset(("pull-out",)),
    "change-left": frozenset(("cut-in",)),
    "change-right": frozenset(("cut-in",)),
}


def happening(
    states: States, actors: frozenset[int] | None, wanted: Names | None
) -> tuple[Episode, ...]:
    """Return the episodes of some actors and actions, in order of their beginnings."""
    everybody = (EGO, *states.ride.vehicles)
    found: list[Episode] = []
    for vehicle in everybody:
        if actors is None or vehicle in actors:
            for name, (reader, actions) in READERS.items():
                if _asked(actions, wanted):
                    found += _kept(states, name, reader, vehicle)
        if vehicle != EGO and (actors is None or actors & {vehicle, EGO}):
            for name, (reader, actions) in MEETINGS.items():
                if _asked(actions, wanted):
                    found += _kept(states, name, reader, vehicle)
    for name, (of_ours, actions) in OWN.items():
        if (actors is None or EGO in actors) and _asked(actions, wanted):
            found += _own(states, name, of_ours)
    fits = [e for e in found if _fits(e, actors, wanted)]
    return tuple(sorted(fits, key=lambda e: (e.begin, e.action, str(e.actor), str(e.object))))


def _asked(actions: Names, wanted: Names | None) -> bool:
    return not actions <= ON_REQUEST if wanted is None else bool(actions & wanted)


def _kept(states: States, name: str, reader: Reader, vehicle: int) -> list[Episode]:
    return states.memo(("episodes", name, vehicle), lambda: reader(states, vehicle))


def _own(states: States, name: str, reader: Callable[[States], Iterator[Episode]]) -> list[Episode]:
    return states.memo(("episodes", name), lambda: list(reader(states)))


def _fits(episode: Episode, actors: frozenset[int] | None, wanted: Names | None) -> bool:
    if wanted is None and episode.action in ON_REQUEST:
        return False
    if wanted is not None and episode.action not in wanted:
        return False
    who = somebody(episode.actor)
    return actors is None or (who is not None and bool(who & actors))


def actors_of(states: States, event: Event) -> frozenset[int] | None:
    """Return who may be the actor of an event: who is named, else all other vehicles.

    None: anybody, including the ego.
    """
    actors = somebody(event.actor)
    if actors is not None or isinstance(event.actor, Wanted):
        return actors
    return frozenset(states.ride.vehicles)


def such(found: Sequence[Episode], event: Event, begin: float) -> tuple[Episode, ...]:
    """Return those of some episodes, in an interval from `begin` on, that an event describes."""
    return tuple(episode for episode in found if _is(episode, event, begin))


def _is(episode: Episode, event: Event, begin: float) -> bool:
    """Check whether an episode of the right actor and action fits the rest of an event."""
    if event.side is not None and (episode.side or SIDES.get(episode.action)) != event.side:
        return False
    if "hard" in event.manner and (episode.peak or 0.0) < HARD:
        return False
    if not _concerns(episode, event.object):
        return False
    momentary = event.action in ("go", "appear", "disappear", "arrive", "collide", "enter", "leave")
    return not momentary or episode.begin >= begin - 1.0


def _concerns(episode: Episode, thing: Thing | None) -> bool:
    """Check whether an episode concerns the object of an event."""
    if thing is None or isinstance(thing, Wanted):
        return True
    wanted = somebody(thing)
    if wanted is not None:
        have = somebody(episode.object)
        return have is not None and bool(have & wanted)
    if isinstance(thing, Feature) and thing.kind == "light":
        return isinstance(episode.object, Feature) and episode.object.kind == "light"
    if isinstance(thing, Junction):
        return episode.place is None or episode.place.form == thing.form
    if isinstance(thing, Exit):
        return thing.rank is None or episode.exit == thing.rank
    return _is_place(thing) or episode.object == thing or episode.object is None


def _is_place(thing: Thing) -> TypeGuard[Lane | Road]:
    return isinstance(thing, (Lane, Road))


def account(episodes: Sequence[Episode]) -> tuple[Episode, ...]:
    """Return the episodes that are worth mentioning, and that no other one implies."""
    worth = [e for e in episodes if _worth(e)]
    return tuple(e for e in worth if not any(_tells(other, e) for other in worth))


def _worth(episode: Episode) -> bool:
    if episode.actor == Ego():
        firm = (episode.peak or 0.0) >= FIRM
        return episode.action in OF_OURS or (episode.action == "brake" and firm)
    return episode.object == Ego() and episode.action in OF_OTHERS


def _tells(other: Episode, episode: Episode) -> bool:
    names = TOLD_BY.get(episode.action, frozenset())
    if other is episode or other.actor != episode.actor or other.action not in names:
        return False
    first, last = sorted((other, episode), key=lambda e: e.begin)
    return first.end is None or last.begin <= first.end + 1.0
