"""Such: vehicles told by what holds of them: "that you cannot see", "the same one as before"."""

from dataclasses import dataclass
from typing import Final

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.rewriting import rewrite, substitute
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Not,
    Now,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Relation
from xavi_dialogue.nlu.grounding.context import Grounder, Window
from xavi_dialogue.nlu.grounding.salience import vehicles_of
from xavi_dialogue.nlu.grounding.things import looks
from xavi_dialogue.nlu.grounding.things.scene import nearest

STANDING: Final = 0.5  # [m/s]
LATELY: Final = 3.0  # [s] in which something counts as being done
UNTOLD: Final = 0.4  # cost where it cannot be known
CORNER: Final = 25.0  # [m] from the entry to a junction, up to which somebody is at its corner
ITSELF: Final = 0.3  # cost of asking of whom was spoken of whether it was he: rather why
GAP: Final = Vehicle(-1)


@dataclass(frozen=True, slots=True)
class Condition:
    """What is to hold of the vehicle looked for; `GAP` stands for it."""

    grounder: Grounder
    proposition: Proposition
    moment: float  # [s]

    def cost(self, vehicle: int) -> float:
        """Weigh whether it holds of a vehicle."""
        held = self._holds(substitute(self.proposition, GAP, Vehicle(vehicle)))
        return UNTOLD if held is None else 0.0 if held else 1.0

    def _holds(self, proposition: Proposition) -> bool | None:
        context, at = self.grounder.context, self.moment
        match proposition:
            case Not(content=content):
                held = self._holds(content)
                return None if held is None else not held
            case Both(contents=contents, join=join):
                each = [self._holds(one) for one in contents]
                decided = join == "or"
                if decided in each:
                    return decided
                return None if None in each else not decided
            case Related(relation="on", thing=Vehicle(number=number), to=Junction()) if self._walks(
                number
            ):
                return self._at_corner(number)
            case Related(relation=relation, thing=thing, to=to):
                return context.world.relation(relation, thing, to, at)
            case Happens(event=event):
                return bool(context.holds(event, *self._interval(event)))
            case Is(state=state, thing=Vehicle(number=number)):
                return self._is(state, number)
            case Has(attribute="colour" | "kind" as attribute, thing=Vehicle(number=number)):
                look = context.look(number, at)
                seen = None if look is None else getattr(look, attribute)
                return None if seen is None else bool(seen == proposition.value)
            case Exists(thing=Vehicle(number=number)):
                return number in context.in_view(at)
            case Compares(left=left, comparator="more" | "less" as comparator, right=right):
                return self._compared(left, right, comparator)
        return None

    def _walks(self, number: int) -> bool:
        look = self.grounder.context.look(number, self.moment)
        return look is not None and look.kind in ON_FOOT

    def _at_corner(self, number: int) -> bool | None:
        """Tell whether somebody on foot is near the junction where we are, or the next one."""
        context, at = self.grounder.context, self.moment
        look, road = context.look(number, at), context.world.road(at)
        if look is None or road is None or EGO not in road.places:
            return None
        if road.places[EGO].in_junction:
            return look.in_view and look.distance <= CORNER
        entry = next((step.distance for step in road.route), None)
        return look.in_view and entry is not None and abs(look.ahead - entry) <= CORNER

    def _interval(self, event: Event) -> tuple[float, float]:
        if event.tense == "present":
            return self.moment - LATELY, self.moment
        return self.grounder.context.begin, self.grounder.context.now

    def _is(self, state: str, number: int) -> bool | None:
        look = self.grounder.context.look(number, self.moment)
        if look is None:
            return None
        match state:
            case "stationary":
                return look.speed < STANDING
            case "moving":
                return look.speed >= STANDING
            case "visible" | "present":
                return look.in_view
            case "hidden" | "lost":
                return not look.in_view
            case "big":
                return looks.size_cost("big", look) < UNTOLD
            case "close":
                return look.distance < looks.HERE
            case "far":
                return look.distance > looks.FAR
        return None

    def _compared(self, left: Measured, right: object, comparator: str) -> bool | None:
        """Tell whether a speed or distance is more, or less, than another or than a value."""
        if left.attribute not in ("speed", "distance"):
            return None
        context, at = self.grounder.context, self.moment
        seen = (Ego(), *(Vehicle(number) for number in context.in_view(at)))
        named = [one.thing for one in (left, right) if isinstance(one, Measured)]
        if any(thing not in seen for thing in named):
            return False  # of nobody who is out of view
        if left.attribute == "speed" and isinstance(right, Measured):
            relation: Relation = "faster-than" if comparator == "more" else "slower-than"
            return context.world.relation(relation, left.thing, right.thing, at)
        one, other = self._value(left), self._value(right)
        if one is None or other is None:
            return None
        return one > other if comparator == "more" else one < other

    def _value(self, of: object) -> float | None:
        match of:
            case Quantity(value=value):
                return value
            case Measured(attribute=attribute, thing=Vehicle(number=number)):
                look = self.grounder.context.look(number, self.moment)
                if look is not None:
                    return look.speed if attribute == "speed" else look.distance
        return None


def condition_of(such: Proposition, g: Grounder, window: Window, moment: float) -> Condition:
    """Ground the things of a condition but for its gap."""

    def change(part: object) -> object:
        if isinstance(part, Wanted | Pronoun):
            is_gap = isinstance(part, Wanted) or part.form == "who"
            return GAP if is_gap else g.thing(part, window)
        return g.thing(part, window) if isinstance(part, _THINGS) else part

    return Condition(g, rewrite(such, change), moment)


_THINGS: Final = Thing.__args__


def says_nothing(spoken: Related, same: bool) -> bool:
    """Tell whether it is asked of what was spoken of whether it was itself."""
    return same and spoken.tense == "past" and spoken.thing == Pronoun("it")


def pointed_at(spoken: Related, g: Grounder) -> Thing | None:
    """Take "that" in "is that the same red car as before?" for a red car that is in view."""
    to = spoken.to
    if spoken.relation != "same-as" or not isinstance(spoken.thing, Pronoun):
        return None
    if not isinstance(to, Described) or (to.colour is None and to.kind in ("vehicle", "car")):
        return None
    alike = Described(kind=to.kind, colour=to.colour, size=to.size)
    found = g.thing(alike, g.window(Now(), "present"))
    look = g.context.look(found.number, g.context.now) if isinstance(found, Vehicle) else None
    return found if look is not None and look.in_view else None


def of_kind(spoken: Has, g: Grounder) -> Thing | None:
    """Take "that" in "was that a bus?" for a bus that is in view, if whom we spoke of is none."""
    if spoken.attribute != "kind" or spoken.thing not in (Pronoun("that"), Pronoun("this")):
        return None
    context = g.context
    looks_seen = [(v, context.look(v, context.now)) for v in context.in_view(context.now)]
    alike = [v for v, look in looks_seen if look is not None and look.kind == spoken.value]
    known = [v for v, _ in vehicles_of(context.discourse.mentions)[:1]]
    if not alike or not known or known[0] in alike:
        return None
    return Vehicle(nearest(context, alike, context.now)[0].vehicle)
