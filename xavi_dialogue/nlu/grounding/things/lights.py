"""Lights: "it", "the red one" and what is done at a light, where a traffic light is meant.

A light is a place, and stays in the term; which of them it is, is known to who answers. What only
lights do, or show, is said of one; what others may be or do as well, of whichever was spoken of.
"""

from typing import Any, Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.meaning import Act, Doing, HowKnow, HowLong, Identify, When, Where, Why
from xavi_dialogue.domain.rewriting import rewrite
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Not,
    Pronoun,
    Related,
    Relative,
    Thing,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.salience import vehicles_of

LIGHT: Final = Feature("light")
LIT: Final = frozenset(("red", "green", "amber", "yellow", "orange"))
SHOWING: Final = frozenset[ActionName](("show", "turn-colour"))
HELD: Final = frozenset[ActionName](("wait", "stop", "stand", "brake", "slow-down"))
GOING: Final = frozenset[ActionName](
    ("go", "move", "continue", "enter", "cross", "pass", "overtake", "arrive", "exit-straight")
)
CROSSING: Final = frozenset[ActionName](("cross", "pass", "enter"))
MEETING: Final = frozenset[ActionName](("arrive", "approach", "cross", "enter", "pass", "come"))
BY: Final = frozenset(("during", "before", "until"))
AT: Final = frozenset(("near", "on", "ahead-of", "to", "with"))
_OPEN: Final = frozenset(("it", "that", "this", "one"))
_MEASURED: Final = frozenset(("distance", "place", "colour", "kind", "duration"))
NONE_SEEN: Final = 0.5  # cost of speaking of a light where none has been seen
RATHER_IT: Final = 0.1  # cost of asking for evidence where a light was spoken of
NOBODY: Final = 0.2  # salience below which no vehicle is spoken of


def lit(spoken: Act, g: Grounder) -> Act:
    """Put traffic lights where words that may mean one do mean one."""
    return rewrite(spoken, lambda part: _meant(part, g))


def _meant(part: Any, g: Grounder) -> Any:
    match part:
        case Event():
            return _event(part, g)
        case Has(attribute="colour", value=value, thing=thing) if value in LIT:
            time: Any = rewrite(part.time, lambda inner: _meant(inner, g))
            return _lit_then(replace(part, thing=_shown(thing, value, g), time=time), g)
        case Related(relation="can-see", thing=Ego(), to=to):
            return replace(part, to=_spoken(to, g))
        case Doing(actor=None, time=Relative(anchor=Event(action=action) as anchor)) if (
            action in SHOWING and anchor.tense in ("present", "future")
        ):  # "what happens when it turns green?"
            return Doing(Ego(), rewrite(part.time, lambda inner: _meant(inner, g)), "future")
        case HowLong(
            of=Event(action=action, actor=Pronoun() | Feature() as thing, object=None) as event
        ) if (
            action in HELD and (light := _light(_spoken(thing, g))) is not None
        ):  # "how long will it stay like that?"
            return HowLong(Happens(replace(event, action="show", actor=light)))
        case (
            HowLong(of=Has("colour", "red" | "green" | "amber", Pronoun()) as of)
            | When(of=Has("colour", "red" | "green" | "amber", Pronoun()) as of)
        ):  # a vehicle has its colour for good
            return replace(part, of=_lit_then(replace(of, thing=LIGHT), g))
        case Why(suspect=thing) if _is_colour_alone(thing, g):  # "why do we stand, is it red?"
            return replace(part, suspect=LIGHT)
        case Is(state="faulty", thing=thing) if _is_colour_alone(thing, g):
            return replace(part, thing=LIGHT)
        case Is(state="faulty", thing=Pronoun() as thing):
            return replace(part, thing=_spoken(thing, g))
        case Doing(actor=Pronoun() as thing):
            return replace(part, actor=_spoken(thing, g))
        case HowKnow(of=None) if _leads(g, unsaid=g.context.discourse.question is None):
            g.notes.cost += RATHER_IT  # "what does it show?"
        case Where(of=Pronoun() as thing):
            return replace(part, of=_spoken(thing, g))
        case Identify(thing=thing) | Exists(thing=thing):
            return replace(part, thing=_spoken(thing, g))
        case Measured(attribute="duration", thing=Described() as thing):
            return replace(part, thing=_phase(thing, g))
        case Measured(attribute="distance", to=Feature(kind="line")) if _known(g):
            return replace(part, to=LIGHT)
        case Measured(attribute="distance", thing=Feature(kind="line")) if _known(g):
            return replace(part, thing=LIGHT)
        case Measured(attribute="colour", thing=Pronoun("it"), to=None) if _in_view(g) and _leads(
            g, unsaid=True
        ):
            return replace(part, thing=LIGHT)
        case Measured(attribute="colour", thing=Pronoun("they")) if _leads(g, unsaid=False):
            return replace(part, thing=LIGHT)  # "how many lights? - what colour were they?"
        case Measured(attribute=attribute) if attribute in _MEASURED:
            beside = None if part.to is None else _spoken(part.to, g)
            return replace(part, thing=_spoken(part.thing, g), to=beside)
    return part


def _event(event: Event, g: Grounder) -> Event:
    """Return an event at a light as what is done with the light; "it changed" as said of one."""
    time: Any = rewrite(event.time, lambda part: _meant(part, g))
    event = event if time is event.time else replace(event, time=time)
    if event.action in SHOWING and isinstance(event.actor, Pronoun):
        g.notes.cost += 0.0 if _known(g) else NONE_SEEN
        return replace(event, actor=LIGHT)
    if (shown := _shown_meanwhile(event)) is not None:
        return replace(event, action="pass", object=shown, time=Unsaid(), where=None)
    where = event.where
    place = None if where is None or where.relation not in AT else where.to
    light = _light(place) or _light(event.object)
    if light is None:
        return event
    if event.action in HELD and light.colour == "green" and place is not None:
        return replace(event, where=None)  # "on green" is not what we stop for
    if event.action in HELD:
        return replace(event, object=light, where=None)
    through = light.colour is not None or _light(event.object) is not None
    if event.action in GOING and (through or event.action != "go"):
        return replace(event, action="pass", object=light, where=None)
    return event


def _shown_meanwhile(event: Event) -> Feature | None:
    """Return what the light is said to have shown as we passed it, or its line."""
    placed = event.object is None or isinstance(event.object, Feature)
    if not placed or event.actor != Ego() or event.action not in GOING:
        return None
    match event.time:
        case Relative("during", Event("show", object=Feature(kind="light", colour=colour))):
            kept = colour is not None and event.tense in ("past", "perfect")
            return Feature("light", colour=colour) if kept else None
    return None


def _lit_then(of: Has, g: Grounder) -> Has | Happens | Not:
    """A colour at the time at which we passed the light; where we have passed none, that we did.

    Its colour when we are to come to it is whether we stop for it.
    """
    if (met := _met(of)) is not None:
        return met
    time = _passing(of.time) if _light(of.thing) else of.time
    if time is of.time:
        return of
    passed = Event("pass", Ego(), Feature("light", colour=of.value))
    if not g.context.holds(replace(passed, object=LIGHT), g.context.begin, g.context.now):
        return Happens(passed)
    return replace(of, time=time)


def _met(of: Has) -> Happens | Not | None:
    """Take the colour of a light at which we are to arrive for whether we have to stop for it."""
    match of.time:
        case Relative(relation=relation, anchor=Event(action=action, actor=Ego()) as anchor) if (
            _light(of.thing) and action in MEETING and relation in BY and anchor.tense == "present"
        ):
            stops = Happens(Event("stop", Ego(), LIGHT, tense="future", modal="must"))
            return Not(stops, lexical=True) if of.value == "green" else stops
    return None


def _passing(time: Any) -> Any:
    """Take "when we crossed", said of a light, for when we passed it."""
    match time:
        case Relative(anchor=Event(action=action, actor=Ego(), object=to) as anchor) if (
            action in CROSSING and not isinstance(to, Vehicle | Described | Pronoun)
        ):
            return replace(time, anchor=replace(anchor, action="pass", object=LIGHT))
    return time


def _light(thing: Thing | None) -> Feature | None:
    return thing if isinstance(thing, Feature) and thing.kind == "light" else None


def _shown(thing: Thing, colour: object, g: Grounder) -> Thing:
    """Return what is said to be red: a light, where one leads, or where no vehicle is red.

    A lane or side is as red as its light.
    """
    if isinstance(thing, Lane):
        return Feature("light", of=thing)
    if isinstance(thing, Pronoun) and thing.form in _OPEN and _leads(g, unsaid=True):
        return LIGHT
    if thing == Pronoun("it") and _in_view(g) and not _is_coloured(colour, g):
        return LIGHT  # vehicles have their colour for good
    if thing == Pronoun("it") and _loudest(g) < NOBODY:
        return LIGHT  # nothing else is known to be meant, even if there is none
    return _one(thing, g)


def _spoken(thing: Thing, g: Grounder) -> Thing:
    if isinstance(thing, Pronoun) and thing.form in _OPEN and _leads(g, unsaid=False):
        return LIGHT
    return _one(thing, g)


def _one(thing: Thing, g: Grounder) -> Thing:
    """Take "the red one" for a light, where one was spoken of and no vehicle in view is red."""
    if not isinstance(thing, Described) or thing.colour not in LIT:
        return thing
    plain = thing == Described(colour=thing.colour, rank=thing.rank, other=thing.other)
    if not plain or not _leads(g, unsaid=False):
        return thing
    now = g.context.now
    looks = (g.context.look(v, now) for v in g.context.in_view(now))
    if any(look is not None and look.colour == thing.colour for look in looks):
        return thing
    return Feature("light", colour=thing.colour)


def _phase(thing: Described, g: Grounder) -> Thing:
    """Take "the red" that lasts for a light, where one has been seen: no vehicle lasts."""
    if thing != Described(colour=thing.colour) or thing.colour not in LIT or not _known(g):
        return _one(thing, g)
    return Feature("light", colour=thing.colour)


def among(of: Described, g: Grounder) -> Feature | None:
    """Take "how many of them were red?" for lights, where these were spoken of last."""
    plain = Described(colour=of.colour, among=of.among, plural=of.plural, definite=of.definite)
    if of.colour not in LIT or of != plain or not _leads(g, unsaid=False):
        return None
    return Feature("light", colour=of.colour)


def _leads(g: Grounder, *, unsaid: bool) -> bool:
    """Tell whether a light was spoken of rather than a vehicle; nobody on foot is "it".

    Args:
        g: the grounder.
        unsaid: whether it also does where neither was, and there is a light on our way.
    """
    mentions = g.context.discourse.mentions
    lights = [m.salience for m in mentions if isinstance(m.thing, Feature)]
    best = _loudest(g)
    if max(lights, default=0.0) > best:
        return True
    return unsaid and best < NOBODY and _known(g)


def _loudest(g: Grounder) -> float:
    """Return the salience of the vehicle that was spoken of most; nobody on foot is "it"."""
    known = vehicles_of(g.context.discourse.mentions)
    return max((salience for one, salience in known if not _walks(one, g)), default=0.0)


def _walks(vehicle: int, g: Grounder) -> bool:
    look = g.context.look(vehicle, g.context.now)
    return look is not None and look.kind in ON_FOOT


def _known(g: Grounder) -> bool:
    """Tell whether a traffic light has been seen."""
    event = Event("show", LIGHT)
    return bool(g.context.holds(event, g.context.begin, g.context.now))


def _in_view(g: Grounder) -> bool:
    now = g.context.now
    shown = g.context.holds(Event("show", LIGHT), now, now)
    return any(one.end is None or one.end >= now for one in shown)


def _is_colour_alone(thing: Thing | None, g: Grounder) -> bool:
    """Tell whether only a colour is named, a light is in view, and no vehicle spoken of has it."""
    if not isinstance(thing, Described) or thing.colour not in LIT:
        return False
    plain = thing == Described(colour=thing.colour)
    return plain and _in_view(g) and not _is_coloured(thing.colour, g)


def _is_coloured(colour: object, g: Grounder) -> bool:
    """Tell whether a vehicle that was spoken of, and is not behind us, has a colour."""
    spoken = (v for v, salience in vehicles_of(g.context.discourse.mentions) if salience > NOBODY)
    looks = (g.context.look(v, g.context.now) for v in spoken)
    return any(look is None or (look.colour == colour and look.ahead >= 0.0) for look in looks)
