"""Generic verbs: "go in", "come out", "go first", by the place at which they are said.

Verbs such as go, come and get say little by themselves. Where the road settles what is meant, the
action that a person would name takes their place: who goes in at a roundabout enters it, who comes
out of it leaves it, and who goes out on a road of several lanes moves to the lane further left.
"""

from typing import Final, Literal, TypeAlias

from msgspec.structs import replace

from planner.record.places import RoadFacts
from sim.scene import EGO
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Is,
    Junction,
    Nobody,
    Not,
    Now,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Tense,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Grounder, Mode, Window
from xavi_dialogue.nlu.grounding.things.passing import to_pass

Site: TypeAlias = Literal["ring", "before-ring", "junction", "lanes", "road"]

RING_NEAR: Final = 80.0  # [m] from which on a roundabout in front is where "in" leads to
JUNCTION_NEAR: Final = 40.0  # [m] likewise of a junction
LEFT_LATELY: Final = 6.0  # [s] for which who has left a roundabout may have come out of it
NEAR: Final = 25.0  # [m] up to which who drives in another lane may come over to ours
BESIDE: Final = 2.0  # [m] sideways from which somebody is in another lane
ROLLING: Final = 1.0  # [m/s] from which somebody drives along
GAVE: Final = 6.0  # [s] since when who let somebody go first comes after him
_MOTION: Final = frozenset(("go", "come", "move", "head"))
_BEFORE_US: Final = frozenset(("come", "turn", "swerve"))
_TURNS: Final = frozenset(("turn", "exit-left", "exit-right", "exit-straight"))
_RING: Final = Junction("roundabout")


def specified(event: Event, window: Window, g: Grounder) -> Event:
    """Put the action that is meant in the place of a generic one; grounded, but for its time."""
    if event.action == "head" and event.object is None:
        return replace(event, action="go")  # "why are we going there?"
    if isinstance(event.object, Junction) and event.action in ("go", "move", "head"):
        return replace(event, action="enter")  # "are we going round the roundabout?"
    if event.object is not None and not isinstance(event.object, Ego | Vehicle):
        return event
    moment = min(window.end, g.context.now)
    if event.action == "enter" and event.object is None:
        return _inwards(event, moment, g)
    if event.action == "pull-out" and event.side is None:
        return _outwards(event, moment, g)
    if event.action in _TURNS and isinstance(event.actor, Ego) and event.where is None:
        before = isinstance(event.object, Vehicle)  # "you turned in front of the lorry"
        return replace(event, action="go", side=None, manner=("first",)) if before else event
    if event.action == "let-go" and event.modal is None:
        return _let_go(event, moment, g)
    if event.action == "go" and "first" in event.manner and isinstance(event.actor, Ego):
        return _in_lane(event, moment, g)
    if event.action == "pass" and isinstance(event.actor, Ego) and _leads(event, moment, g):
        return replace(event, action="overtake")  # "I'd have gone past it"
    if event.action == "continue-next-exit":
        number = _number(event.actor)
        ring = _site(moment, g) in ("ring", "before-ring")
        ring = ring or (number is not None and _on_ring(_road(moment, g), number))
        return event if ring else replace(event, action="move")
    if event.action in _BEFORE_US and event.where is None and event.side is None:
        over = _over(event, moment, g) if event.action == "come" else event
        return _before_us(over, moment, g)
    return event


def _over(event: Event, moment: float, g: Grounder) -> Event:
    """Read "come" of who drives along in another lane near us: to our lane."""
    number = _number(event.actor)
    look = g.context.look(number, moment) if number else None
    if look is None or not look.in_view or look.oncoming or look.speed < ROLLING:
        return event
    along = look.bearing.partition("-")[0] in ("ahead", "behind", "beside")
    near = look.distance <= NEAR and abs(look.left) >= BESIDE
    return replace(event, action="change-lane", object=None) if along and near else event


def _before_us(event: Event, moment: float, g: Grounder) -> Event:
    """Read "come in front of us", "turn into us" of who crosses our way as doing so before us.

    Who drives along swerves to our lane.
    """
    number = _number(event.actor)
    look = g.context.look(number, moment) if number else None
    along = look is not None and look.bearing.partition("-")[0] in ("ahead", "behind", "beside")
    if event.action == "swerve" and along and look is not None and not look.oncoming:
        event = replace(event, action="change-lane", object=None)
    ahead = event.tense in ("present", "future") and event.modal in (None, "will", "might")
    ours = isinstance(event.object, Ego) and isinstance(event.actor, Vehicle)
    crosses = look is not None and look.bearing.startswith("crossing")
    before = crosses or event.action != "come"
    return replace(event, action="cross") if ahead and ours and before else event


def _inwards(event: Event, moment: float, g: Grounder) -> Event:
    """Read "go in": into the roundabout, or onto the lane in front of us."""
    site = _site(moment, g)
    if site in ("ring", "before-ring"):
        return replace(event, object=_RING)
    if site != "lanes":
        return event
    if isinstance(event.actor, Ego):
        road = _road(moment, g)
        place = None if road is None else road.places.get(EGO)
        outer = place is not None and place.lane == 0  # there is none to the right of ours
        return replace(event, action="change-left" if outer else "change-right")
    return replace(event, action="cut-in", object=Ego())


def _outwards(event: Event, moment: float, g: Grounder) -> Event:
    """Read "come out": off the roundabout, or to the lane further left."""
    number = _number(event.actor)
    lately = (moment, max(moment - LEFT_LATELY, g.context.begin))
    ring = number is not None and any(_on_ring(_road(t, g), number) for t in lately)
    if ring and event.object is None:
        return replace(event, action="leave", object=_RING)
    if not isinstance(event.actor, Ego):
        return replace(event, action="exit-right") if _turns_off(event, moment, g) else event
    event = _before_whom(event)
    before = event.object
    site = _site(moment, g)
    coming = before is None and event.tense in ("present", "future")
    if site in ("junction", "before-ring") and not coming:
        return replace(event, action="go", manner=() if before is None else ("first",))
    if site != "lanes":
        return replace(event, action="leave") if coming else event
    where = event.where if before is None else Related("ahead-of", event.actor, before)
    return replace(event, action="change-left", object=None, where=where)


def ahead_of(event: Event, g: Grounder) -> Event:
    """Read "you turned before the lorry" as that we went first, "overtake him" of who is ahead."""
    event = to_pass(event, g.context)
    match event.time:
        case Relative(relation="before", anchor=Described() | Pronoun() | Vehicle() as whom):
            ours = isinstance(event.actor, Ego) and event.action in (*_TURNS, "go", "enter")
            if ours and event.object is None and event.tense in ("past", "perfect"):
                return replace(
                    event, action="go", object=whom, side=None, manner=("first",), time=Unsaid()
                )
    return event


def _before_whom(event: Event) -> Event:
    """Read "pull out in front of it" as "pull out before it"."""
    match event.where:
        case Related(relation="ahead-of", to=Vehicle() as whom) if event.object is None:
            return replace(event, object=whom, where=None)
    return event


def _in_lane(event: Event, moment: float, g: Grounder) -> Event:
    """Read going ahead of somebody in another lane as a change to that lane, in front of him."""
    number = _number(event.object) if event.object is not None else None
    look = g.context.look(number, moment) if number else None
    if look is None or look.oncoming or abs(look.left) < BESIDE or _site(moment, g) != "lanes":
        return event
    action: ActionName = "change-left" if look.left > 0.0 else "change-right"
    ahead = Related("ahead-of", event.actor, event.object or Ego())
    return replace(event, action=action, object=None, manner=(), where=ahead)


def _leads(event: Event, moment: float, g: Grounder) -> bool:
    """Tell whether whom we did not pass as yet drives ahead of us in our lane."""
    number = _number(event.object) if event.object is not None else None
    look = g.context.look(number, moment) if number else None
    ahead = look is not None and look.bearing == "ahead" and look.speed >= ROLLING
    return ahead and look is not None and look.in_view and not look.oncoming


def _turns_off(event: Event, moment: float, g: Grounder) -> bool:
    """Tell whether who is said to go out drives along with its right indicator on."""
    number = _number(event.actor)
    look = g.context.look(number, moment) if number else None
    if look is None or look.speed < ROLLING or event.tense not in ("present", "future"):
        return False
    signal = Event("signal", event.actor, side="right")
    return event.object is None and bool(g.context.holds(signal, moment - 1.0, moment))


def _let_go(event: Event, moment: float, g: Grounder) -> Event:
    """Read "are we going after him" as having let him go first, where that is just over."""
    if event.tense != "present" or not isinstance(event.object, Ego | Vehicle):
        return event
    gave = g.context.holds(replace(event, action="give-way"), moment - GAVE, moment)
    over = bool(gave) and all(e.end is not None and e.end < moment for e in gave)
    return replace(event, tense="perfect") if over else event


def come_along(spoken: Related) -> Related:
    """Read "did he come with us" as whether he is with us now."""
    if spoken.relation != "with" or not isinstance(spoken.time, Unsaid):
        return spoken
    now = spoken.tense == "present"
    return replace(spoken, time=Now(), tense="present" if now else "perfect")


def across(of: Described) -> Described:
    """Read "people who crossed our way" as those who crossed in front of us."""
    doing = of.doing
    if doing is None or doing.action != "cross" or doing.object != Feature("way"):
        return of
    return replace(of, doing=replace(doing, object=Ego()))


def in_order(spoken: Happens, mode: Mode) -> Proposition:
    """Read "go first" as who goes first of two: by right of way, or as it came about.

    Anything else is returned as it is.
    """
    event = spoken.event
    if event.action == "cross" and event.object == Feature("way"):
        return Happens(replace(event, object=Ego()))
    if event.action == "leave" and event.object == Feature("way"):
        there = Related("in-the-way-of", event.actor, Ego(), event.time, event.tense)
        return Not(there, lexical=True)  # "did he get out of the way"
    if mode == "asked" and event.action == "approach" and isinstance(event.object, Vehicle):
        ours = isinstance(event.actor, Ego) and event.tense in ("past", "perfect")
        if ours and event.modal is None:  # "did we come close to him?"
            return Is("close", event.object, time=event.time, tense="past")
    if mode == "asked" and event.action in _MOTION and event.where is not None:
        return _beside(event, event.where) or spoken
    orders = event.action in ("go", "enter", "cross") and "first" in event.manner
    if mode != "asked" or not orders:
        return spoken
    before = event.actor == Ego() and isinstance(event.object, Vehicle)
    ours_now = before and event.modal == "could" and event.tense == "present"
    if event.modal in ("could", "would", "want", "might") and not ours_now:
        return spoken
    if event.object is not None and not isinstance(event.object, Ego | Vehicle):
        return spoken
    named = isinstance(event.actor, Vehicle | Vehicles) or isinstance(event.object, Vehicle)
    if not isinstance(event.actor, Ego | Vehicle | Vehicles):
        return spoken
    if event.tense in ("past", "perfect") and event.modal is None:
        gave = Event("give-way", event.actor, time=event.time, tense=event.tense)
        return spoken if named else Not(Happens(gave), lexical=True)
    ours = isinstance(event.actor, Vehicle | Vehicles)
    to: Thing = Ego() if ours else event.object if named and event.object else Everyone()
    tense: Tense = "past" if event.tense in ("past", "perfect") else "present"
    return Related("has-priority-over", event.actor, to, event.time, tense)


def _beside(event: Event, where: Related) -> Proposition | None:
    """Read "went close to him" as being close, and "went the other way" as not with us."""
    other = event.actor if isinstance(where.to, Ego) else where.to
    if where.relation == "oncoming-to" and event.tense != "present" and other != Ego():
        along = Related("with", other, Ego(), Now())
        return Not(along, lexical=True)
    ours = isinstance(event.actor, Ego) or (event.action == "come" and event.modal is None)
    if where.relation == "beside" and ours and event.tense != "present" and other != Ego():
        if isinstance(other, Nobody):  # "did anyone come near us?"
            return Is("close", None, time=WholeRide(), tense=event.tense)
        return Is("close", other, time=event.time, tense=event.tense)
    return None


def _site(moment: float, g: Grounder) -> Site:
    road = _road(moment, g)
    mine = None if road is None else road.places.get(EGO)
    if road is None or mine is None:
        return "road"
    if mine.roundabout:
        return "ring"
    step = road.route[0] if road.route else None
    if step is not None and step.kind == "roundabout" and step.distance <= RING_NEAR:
        return "before-ring"
    if mine.in_junction or (step is not None and step.distance <= JUNCTION_NEAR):
        return "junction"
    return "lanes" if mine.lanes > 1 else "road"


def _on_ring(road: RoadFacts | None, number: int) -> bool:
    place = None if road is None else road.places.get(number)
    return place is not None and place.roundabout


def _road(moment: float, g: Grounder) -> RoadFacts | None:
    return None if moment < g.context.begin else g.context.world.road(moment)


def _number(thing: Thing) -> int | None:
    if isinstance(thing, Ego):
        return EGO
    return thing.number if isinstance(thing, Vehicle) else None
