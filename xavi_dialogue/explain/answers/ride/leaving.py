"""Leaving: who is behind us by now, is still there or took an exit; how far others are apart."""

from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode, Fact
from xavi_dialogue.domain.terms import Ego, Event, Related, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import sided
from xavi_dialogue.explain.answers.expectations.taken import on_road
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import was_said, window
from xavi_dialogue.explain.answers.reference.naming import first_look, is_us, look_of, number
from xavi_dialogue.explain.answers.reference.occasions import occasion, overlaps

#: Actions that lead into another road.
ROADS = frozenset[ActionName](("exit-left", "exit-right", "exit-straight", "leave"))


def left_behind(asked: Asked, event: Event) -> Finding | None:
    """Return that somebody is behind us who was not at first, though no overtaking is recorded."""
    if event.action not in ("overtake", "pass") or not is_us(event.actor):
        return None
    vehicle = number(event.object)
    look = None if vehicle is None else look_of(asked, event.object, asked.now)
    first = None if vehicle is None else first_look(asked, vehicle, asked.world.begin)
    seen = None if vehicle is None else asked.world.states.offset(EGO, vehicle, asked.now)
    if look is None or first is None or look.oncoming or not look.in_view:
        return None
    if seen is not None and not seen.same_way:  # it came towards us
        return None
    behind = look.ahead < -look.length and first.ahead > -look.length
    that = Related("behind", Vehicle(look.vehicle), Ego(), tense="present")
    return Finding(True, (look,), answer=Finding(True, (look,)).verdict(that)) if behind else None


def still_there(asked: Asked, event: Event) -> tuple[Fact, ...]:
    """Return where somebody is that we have not passed, or that has not passed us."""
    if event.action not in ("overtake", "pass") or event.tense == "present":
        return ()
    other = event.object if is_us(event.actor) else event.actor
    look = None if number(other) is None else look_of(asked, other, asked.now)
    return () if look is None or not look.in_view else (look,)


def apart(asked: Asked, event: Event) -> Finding:
    """Return how far two others are apart, for a question whether they hit each other.

    Risks are only computed for our own collisions.
    """
    at = min(window(asked, event.time, event.tense).end, asked.now)
    crash = occasion(asked, Event("collide", event.actor, event.object, time=event.time))
    if crash is not None:
        return Finding(True, (crash,))
    gap = asked.world.measure("distance", event.actor, at, event.object)
    return unknown("not-recorded", *known(gap))


def by_road(asked: Asked, event: Event) -> Episode | None:
    """Return that a vehicle took a road, known by where it was seen later; None if unknown.

    Exits of motorways, and some turns, bend too little to be seen as such.
    """
    vehicle, meant = number(event.actor), sided(event)
    if vehicle is None or event.tense not in ("past", "perfect"):
        return None
    names = ("exit-left", "exit-right") if meant == "turn" else (meant,)
    if not ROADS.issuperset(names):
        return None
    for belief in reversed(asked.world.beliefs(vehicle, asked.world.begin, asked.now)):
        for expected in belief.expectations:
            since = on_road(asked, belief, expected)
            done = next((action for action in expected.actions if action in names), None)
            if since is None or done is None:
                continue
            found = Episode(Vehicle(vehicle), done, belief.time, since, event.object)
            about = window(asked, event.time, event.tense).widened()
            if not was_said(asked, event.time) or overlaps(asked, found, about):
                return found
    return None
