"""Passages: our way through a junction or roundabout, its duration, and the exits we passed."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Counted, Lasted
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Event, Junction, Proposition, Related
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import is_us
from xavi_dialogue.explain.answers.reference.occasions import did_not_happen
from xavi_dialogue.explain.facts.episodes.lead_in import held_since
from xavi_dialogue.explain.history.nearing import junctions_ahead

THROUGH: tuple[ActionName, ...] = ("exit-left", "exit-right", "exit-straight")
NOTED = 1.5  # [s] minimum slowing before it that is stated
BEFORE = 0.2  # [s] before we enter


def passage(asked: Asked, place: Junction) -> tuple[float, float | None] | None:
    """Return from when to when [s] we were on a junction; the end is None while we are on it."""
    entered = [e for e in asked.world.episodes(Ego(), "enter") if _is_ring(e.object)]
    if place.form == "roundabout":
        near = _nearest(entered, place.time)
        if near is None:
            return None
        left = asked.world.episodes(Ego(), "leave", begin=near.begin)
        ends = [e.begin for e in left if _is_ring(e.object)]
        return near.begin, min(ends, default=None)
    ways = [e for e in asked.world.episodes(Ego(), THROUGH) if not _is_ring(e.place)]
    near = _nearest(ways, place.time)
    return None if near is None else (near.begin, near.end)


def _nearest(found: list[Episode], time: float | None) -> Episode | None:
    """Return the episode that begins closest to a time [s]; without a time, the last one."""
    if time is None:
        return found[-1] if found else None
    return min(found, key=lambda e: (abs(e.begin - time), -e.begin), default=None)


def _is_ring(place: object) -> bool:
    return isinstance(place, Junction) and place.form == "roundabout"


def taken(of: Proposition, asked: Asked) -> Lasted | None:
    """Return how long we were on a junction; None for other questions, or if we were on none."""
    match of:
        case Related(relation="on", thing=Ego(), to=Junction() as place, tense=tense) if (
            tense != "future"
        ):
            found = passage(asked, place)
        case _:
            return None
    if found is None:
        return None
    begin, end = found
    held = _held_since(asked, begin)
    return Lasted(of, begin, end, asked.now, held=held if begin - held > NOTED else None)


def cost_of_passage(asked: Asked, place: Junction) -> Measure | None:
    """Return the time that a junction cost us, slowing and waiting before it included."""
    found = passage(asked, place)
    if found is None:
        return None
    return asked.world.delay(Episode(Ego(), "slow-down", _held_since(asked, found[0]), found[1]))


def _held_since(asked: Asked, begin: float) -> float:
    """Return since when [s] we had slowed down and waited before a junction."""
    return held_since(asked.world.episodes(Ego(), end=begin), begin)


def exits_passed(event: Event, asked: Asked) -> Counted:
    """Count the exits that we passed on the roundabout where we are, or were last.

    Raises:
        Unanswered: we were on none, and there is none ahead.
    """
    entered = [e for e in asked.world.episodes(Ego(), "enter") if _is_ring(e.object)]
    if not entered and is_us(event.actor) and _exit_at(asked, asked.now) is not None:
        return Counted(replace(event, tense="perfect"), 0)
    if not entered or not is_us(event.actor):
        raise did_not_happen(asked, Event("enter", object=Junction("roundabout")))
    begin = entered[-1].begin
    left = [e for e in asked.world.episodes(Ego(), "leave", begin=begin) if _is_ring(e.object)]
    ours = _exit_at(asked, begin - BEFORE)
    if ours is None:
        raise did_not_happen(asked, event)
    if left:
        return Counted(replace(event, tense="past"), ours - 1, since=begin, until=left[0].begin)
    rest = _exit_at(asked, asked.now)
    passed = 0 if rest is None else max(ours - rest, 0)
    return Counted(replace(event, tense="perfect"), passed, since=begin)


def _exit_at(asked: Asked, time: float) -> int | None:
    """Return which exit we take, counted from where we are at a time [s]."""
    steps = junctions_ahead(asked.ride, time)
    return next((step.exit for step in steps if step.kind == "roundabout"), None)
