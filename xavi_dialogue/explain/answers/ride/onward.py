"""Onward: our way ahead as recorded: junctions, exits, turns that are left, the road."""

import math

from msgspec.structs import replace

from planner.record.places import RouteStep
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, Course, Measures, NotRecorded
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.journeys import WayStep
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Junction,
    Measured,
    Next,
    Not,
    Now,
    Proposition,
    Related,
    Road,
    Thing,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.precedence import on_ring
from xavi_dialogue.explain.answers.expectations.steering import as_planned, goes_onward
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import SHORT, instant, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasion, overlaps
from xavi_dialogue.explain.history.nearing import junctions_ahead, still_to
from xavi_dialogue.explain.history.traffic_lights import SAME_PLACE

WAYS: tuple[ActionName, ...] = ("turn", "exit-left", "exit-right", "exit-straight")
STRAIGHT: frozenset[ActionName] = frozenset(("exit-straight", "continue"))
MODALS = (None, "will", "must", "want", "should")


def steps_ahead(asked: Asked) -> tuple[WayStep, ...]:
    """List the junctions on our way from now on, nearest first.

    Raises:
        Unanswered: the record does not hold our way.
    """
    road = asked.world.road(asked.now)
    if road is None:
        raise Unanswered(NotRecorded("not-recorded", about="route"))
    place = road.places.get(EGO)
    inside = place is not None and place.roundabout
    route = as_planned(asked, junctions_ahead(asked.ride, asked.now))
    return tuple(
        _step(step, rank, inside and rank == 1 and step.kind == "roundabout")
        for rank, step in enumerate(route, start=1)
    )


def _step(step: RouteStep, rank: int, inside: bool) -> WayStep:
    return WayStep(step.kind, step.turn, round(step.distance, 1), rank, step.exit, inside)


def course(asked: Asked, form: str, steps: tuple[WayStep, ...], **more: object) -> Course:
    """Return our way ahead, with the distance to the destination."""
    left = asked.world.measure("distance-to-go", Ego(), asked.now, Destination())
    arrived = asked.ride.arrived
    return Course(form, steps, left=left.value, arrived=arrived, **more)  # type: ignore[arg-type]


def which_way(of: Measured, asked: Asked) -> Answer:
    """Return which way we take at a junction; for the past, which way we took."""
    past = is_past(asked, of.time, of.tense) and not _to_come(of)
    at = instant(asked, of.time, of.tense)
    still_on = of.attribute == "exit-number" and on_ring(asked.world.road(asked.now))
    if not still_on and (past or at < asked.now - SHORT):  # until then the exit is still to come
        return _way_taken(of, asked, at)
    steps = steps_ahead(asked)
    if of.event is not None:  # "after how many metres do we turn?"
        return course(asked, "way", _turning(steps, of.event)[:1])
    round_ = isinstance(of.to, Junction) and of.to.form == "roundabout"
    if round_ or of.attribute == "exit-number":
        steps = tuple(s for s in steps if s.kind == "roundabout")
    rank = of.to.rank if isinstance(of.to, Junction) and of.to.rank is not None else 1
    found = steps[-1:] if rank < 0 else steps[rank - 1 : rank]
    if of.attribute == "exit-number" and not found:
        turning = tuple(s for s in steps_ahead(asked) if s.turn != "exit-straight")[:1]
        return course(asked, "way" if turning else "road", turning)
    return course(asked, "way", found, then=rank > 1)


def next_halt(asked: Asked) -> Course:
    """Return the next junction at which we may have to stop: for a light, or to give way."""
    road = asked.world.road(asked.now)
    trace = asked.ride.at(asked.now)
    lights = () if road is None or trace is None else road.lights
    red = [still_to(asked.ride, light.distance, asked.now) for light in lights]
    for way, step in zip(steps_ahead(asked), junctions_ahead(asked.ride, asked.now), strict=False):
        light = any(abs(far - step.distance) < SAME_PLACE for far in red)
        if light or (step.rule != "priority" and not way.inside):
            return course(asked, "halt", (replace(way, rule=step.rule, light=light),))
    return course(asked, "halt", ())


def next_turning(asked: Asked) -> Course | None:
    """Return where we turn off next; None if we do not turn any more."""
    turning = [s for s in steps_ahead(asked) if _turned(s) and s.kind == "junction"]
    return course(asked, "way", tuple(turning[:1])) if turning else None


def _to_come(of: Measured) -> bool:
    return isinstance(of.time, Next) or of.tense == "future"


def _way_taken(of: Measured, asked: Asked, at: float) -> Answer:
    """Return the turn of ours at a time, as it was; else our way according to the record then."""
    about = window(asked, of.time, of.tense)
    found = asked.world.episodes(Ego(), ("exit-left", "exit-right", "exit-straight", "leave"))
    near = [e for e in found if overlaps(asked, e, about.widened())] or list(found[-1:])
    then = near[-1].begin - SHORT if near else at
    return Measures((asked.world.measure(of.attribute, Ego(), then),))


def route_ahead(asked: Asked) -> Course | None:
    """Return the turns on our way in their order; None if there are fewer than two."""
    turning = _turning(steps_ahead(asked), Event("turn"))
    return course(asked, "route", turning) if len(turning) > 1 else None


def way_chosen(asked: Asked) -> Course:
    """Return why we take our way, with the turns on it in their order.

    Raises:
        Unanswered: the record does not hold our way.
    """
    return course(asked, "choice", _turning(steps_ahead(asked), Event("turn")))


def turns_left(asked: Asked, event: Event) -> Course:
    """Return how many turns are left, and which; roundabouts count."""
    turning = _turning(steps_ahead(asked), event)
    return course(asked, "turns", turning, onward=goes_onward(asked))


def _turning(steps: tuple[WayStep, ...], event: Event) -> tuple[WayStep, ...]:
    """List where we turn in the way asked about; roundabouts count."""
    wanted = None if event.action == "turn" else event.action
    return tuple(
        s for s in steps
        if s.kind == "roundabout" or (s.turn == wanted if wanted else s.turn != "exit-straight")
    )  # fmt: skip


def turning_ahead(asked: Asked, event: Event) -> WayStep | None:
    """Return the junction where our way turns as asked about; None if there is none on record."""
    if event.action not in WAYS or not is_us(event.actor) or asked.world.road(asked.now) is None:
        return None
    found = next((step for step in steps_ahead(asked) if _turns_so(step, event)), None)
    return found if found is not None and found.kind == "junction" else None


def _turns_so(step: WayStep, event: Event) -> bool:
    return step.turn != "exit-straight" if event.action == "turn" else step.turn == event.action


def junctions_left(asked: Asked, of: Junction) -> Course:
    """Return how many junctions or roundabouts are left, and what we do there."""
    steps = [s for s in steps_ahead(asked) if of.form == "junction" or s.kind == "roundabout"]
    form = "junctions" if of.form == "junction" else "roundabouts"
    return course(asked, form, tuple(steps), onward=goes_onward(asked))


def leaves_when(asked: Asked, event: Event) -> Course | None:
    """Return at which exit we leave the road; if there is none, that we stay on it."""
    to_come = event.tense in ("present", "future") and is_us(event.actor)
    if event.action != "leave" or not to_come or number(event.object) is not None:
        return None
    steps = steps_ahead(asked)
    ring = tuple(s for s in steps if s.kind == "roundabout")[:1]
    if ring:
        return course(asked, "way", ring)
    turning = tuple(s for s in steps if s.turn != "exit-straight")[:1]
    return course(asked, "way" if turning else "road", turning)


def stays_on(asked: Asked, event: Event) -> Course | None:
    """Return that we stay on the road, for a question why we do not leave it; None: else."""
    over = asked.past is not None and asked.past.end < asked.now - SHORT
    found = None if over else leaves_when(asked, event)
    return found if found is not None and found.form == "road" else None


def whether_ours(question: Whether, asked: Asked) -> Course | None:
    """Answer whether we turn, go straight on, take an exit or stay on the road; None: else."""
    place = _ahead_of_us(question.that)
    if place is not None and asked.past is None:
        found = junctions_left(asked, place)
        if found.steps and not isinstance(question.that, Exists):  # "are we going round it?"
            return course(asked, "way", found.steps[:1], holds=True)
        return replace(found, holds=bool(found.steps))
    if _is_turning(question.that) and asked.past is None and (next_ := steps_ahead(asked)[:1]):
        turned = next_[0].exit == 1 if next_[0].inside else _turned(next_[0])
        return course(asked, "way", next_, holds=turned)
    missed = _missed(question.that, asked)
    if missed is not None:
        left = _by_exit(asked, steps_ahead(asked), missed)
        return None if left is None else replace(left, holds=False)
    event = _own_way(question.that)
    if event is None or (asked.past is not None and not isinstance(event.time, WholeRide)):
        return None
    steps = steps_ahead(asked)
    if isinstance(event.object, Road):
        turning = tuple(s for s in steps if s.turn != "exit-straight" or s.kind == "roundabout")
        if event.action == "leave" and turning:
            return course(asked, "way", turning[:1], holds=True)
        return course(asked, "road", turning[:1], holds=not turning)
    if event.tense == "present" and (occasion(asked, event) is not None or _turning_now(asked)):
        return None
    if event.action == "circle":
        ring = tuple(s for s in steps if s.kind == "roundabout")[:1]
        return course(asked, "way", ring, holds=False) if ring else None
    if event.action == "enter":
        ring = tuple(s for s in steps if s.kind == "roundabout")[:1]
        return course(asked, "way", ring) if ring else None
    if isinstance(event.object, Exit) or event.action == "leave":
        return _by_exit(asked, steps, event)
    rank = event.object.rank if isinstance(event.object, Junction) else None
    step = steps[(rank or 1) - 1] if len(steps) >= max(rank or 1, 1) else None
    if step is None:
        return course(asked, "way", (), holds=event.action in STRAIGHT)
    later = [] if rank else [s for s in steps[1:] if s.turn != "exit-straight"][:1]
    plain = step.turn == "exit-straight" and step.kind == "junction"
    shown = (step, *(later if plain and _turns(event) else ()))
    return course(asked, "way", shown, holds=_agrees(event, step))


def _turning_now(asked: Asked) -> bool:
    """Check whether a turn of ours is under way."""
    turns = asked.world.episodes(Ego(), ("exit-left", "exit-right"))
    return any(e.begin <= asked.now < (e.end or math.inf) for e in turns)


def _ahead_of_us(that: Proposition) -> Junction | None:
    """Find the kind of junction for a question whether there is one on our way."""
    while isinstance(that, Not):
        that = that.content
    if isinstance(that, Exists) and that.tense != "past" and isinstance(that.thing, Junction):
        return that.thing
    match that:  # "are we going on the roundabout?"
        case Happens(event=Event(action="enter", actor=Ego(), object=Junction() as place) as event):
            ahead = place.form == "roundabout" and event.tense in ("present", "future")
            return place if ahead and event.modal is None else None
    return None


def _is_turning(that: Proposition) -> bool:
    """Check whether the question is whether we turn at a place: "is this our turning?"."""
    return (
        isinstance(that, Related)
        and that.relation == "same-as"
        and isinstance(that.thing, Junction | Exit)
    )


def _missed(that: Proposition, asked: Asked) -> Event | None:
    """Read "did we go past our exit?" as whether we have left, unless we did pass one."""
    match that:
        case Happens(event=Event(action="pass" | "leave", object=Exit()) as event) if is_us(
            event.actor
        ) and event.tense in ("past", "perfect"):
            if occasion(asked, event) is None:
                return replace(event, action="leave", object=None, tense="present", time=Now())
    return None


def _own_way(that: Proposition) -> Event | None:
    """Find an event of ours at a junction ahead, if the question is about one."""
    while isinstance(that, Not):
        that = that.content
    if not isinstance(that, Happens) or not is_us(that.event.actor):
        return None
    event = that.event
    onward = Unsaid | Now | Next | WholeRide
    timely = isinstance(event.time, onward) and event.tense in ("present", "future")
    if not timely or event.modal not in MODALS or number(event.object) is not None:
        return None
    if event.action == "continue":
        return event if event.object is None or isinstance(event.object, Road) else None
    if event.action == "enter":
        return event if event.object == Junction("roundabout") else None
    if event.action == "circle":
        return event
    if event.action == "leave":
        placed = isinstance(event.object, Road) or _is_exit(event.object)
        return event if event.object is None or placed else None
    return event if event.action in WAYS and not isinstance(event.object, Road) else None


def _is_exit(thing: Thing | None) -> bool:
    return isinstance(thing, Exit) or (isinstance(thing, Junction) and thing.form == "roundabout")


def _by_exit(asked: Asked, steps: tuple[WayStep, ...], event: Event) -> Course | None:
    """Compare the exit that we take with the one in the question."""
    ring = next((s for s in steps if s.kind == "roundabout"), None)
    rank = event.object.rank if isinstance(event.object, Exit) else None
    if ring is None or ring.exit is None:
        turning = tuple(s for s in steps if _turned(s))[:1]
        if not turning:
            return course(asked, "road", ())
        if rank is not None and 0 < rank <= len(steps):
            step = steps[rank - 1]
            turned = _turned(step) if event.action == "leave" else _agrees(event, step)
            return course(asked, "way", (step,), holds=turned)
        return course(asked, "way", turning, holds=False)
    holds = ring.exit == (rank or 1) if rank is not None or ring.inside else None
    return course(asked, "way", (ring,), holds=holds)


def _turns(event: Event) -> bool:
    return event.action not in STRAIGHT


def _agrees(event: Event, step: WayStep) -> bool:
    """Check whether an event is what we do at a junction."""
    if event.action == "turn":
        return step.turn != "exit-straight"
    return event.action == step.turn or (event.action == "continue" and not _turned(step))


def _turned(step: WayStep) -> bool:
    return step.turn != "exit-straight"


def other_exit(asked: Asked, event: Event) -> Measure | None:
    """Return the exit that we take, if the question names another one."""
    if not isinstance(event.object, Exit) or event.object.rank is None:
        return None
    taken = asked.world.measure("exit-number", Ego(), asked.now)
    if taken.value is None or taken.count is None or taken.value == event.object.rank:
        return None
    return taken
