"""Afoot: what people on foot do, where it is put in words for vehicles."""

from typing import Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Is,
    Junction,
    Lane,
    Pronoun,
    Related,
    Road,
    Tense,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.things import scene

#: What leads a vehicle onto or across a road leads people over it.
ACROSS: Final = frozenset[ActionName](
    ("change-lane", "change-left", "change-right", "leave", "pull-out", "enter", "cut-in", "merge")
)
#: What is crossed where our way is: there is one crossing in view that matters, the one before us.
_OURS: Final = (Junction, Lane, Road, Feature)


def afoot(event: Event, g: Grounder) -> Event:
    """Read "get across", "step out", "be over" of people on foot as crossing our way."""
    event = _crossed(replace(event, actor=_walker(event, g)))
    if not on_foot(event.actor, g):
        return event
    over = event.action == "pass" and isinstance(event.object, _OURS)  # "cleared the road"
    action: ActionName = "cross" if over or event.action in ACROSS else event.action
    if action != "cross":
        return event
    ours = event.object is None or isinstance(event.object, _OURS)
    return replace(event, action=action, object=Ego() if ours else event.object, side=None)


def _crossed(event: Event) -> Event:
    """Read "our path" as us, and "did you cross anybody's path?" as whether he crossed ours."""
    if event.action != "cross":
        return event
    if event.object == Feature("way") and not isinstance(event.actor, Ego):
        return replace(event, object=Ego())
    others = isinstance(event.object, Described | Pronoun | Vehicle | Vehicles | Wanted | Everyone)
    done = event.tense in ("past", "perfect") and event.modal is None
    if isinstance(event.actor, Ego) and others and done and event.object is not None:
        return replace(event, actor=event.object, object=Ego())
    return event


def _walker(event: Event, g: Grounder) -> Thing:
    """Take somebody who crosses, of no kind that is said, for those on foot who are in view."""
    actor = event.actor
    ours = event.object is None or isinstance(event.object, Road | Junction)
    plain = event.action == "cross" and ours
    if not plain or not any(on_foot(Vehicle(n), g) for n in g.context.in_view(g.context.now)):
        return actor
    match actor:
        case Described(kind="vehicle", doing=None, such=None):
            return replace(actor, kind="pedestrian")
        case Pronoun(form="they") if not g.context.discourse.mentions:
            return Described(kind="pedestrian", plural=True)
    return actor


def on_foot(thing: Thing | None, g: Grounder) -> bool:
    """Tell whether a thing, grounded or described, is one or several people on foot."""
    match thing:
        case Vehicle(number=number):
            look = g.context.look(number, g.context.now)
            return look is not None and look.kind in ON_FOOT
        case Vehicles(numbers=numbers):
            return bool(numbers) and all(on_foot(Vehicle(n), g) for n in numbers)
        case Described(kind=kind) | Wanted(kind=kind):
            return kind in ON_FOOT
    return False


def walked(of: Is | Related, g: Grounder) -> Is | Happens | Related:
    """Read "they are over", "he is on the crossing" of people on foot as crossing our way."""
    met = scene.on_foot(g.context, g.context.now) if isinstance(of.thing, Everyone) else ()
    if len(met) > 1 and (isinstance(of, Is) or of.relation == "from"):  # "is everybody across?"
        of = replace(of, thing=Vehicles(met))
    if not on_foot(of.thing, g):
        return of
    tense: Tense = "present" if of.tense == "future" else of.tense
    match of:
        case Is(state="over"):
            tense = "perfect" if tense == "present" else tense
        case Related(relation="on", to=Junction() | Road("own")):
            pass
        case Related(relation="from", to=Junction() | Road("own")):  # "are they off the road?"
            tense = "perfect" if tense == "present" else tense
        case _:
            return of
    return Happens(Event("cross", of.thing or Ego(), Ego(), tense=tense))
