"""Acts: one act of a turn, completed where it is a fragment, and grounded."""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Beyond,
    Claim,
    Doing,
    Elliptic,
    Fault,
    Feel,
    Repair,
    Request,
    Social,
)
from xavi_dialogue.domain.rewriting import first, rewrite
from xavi_dialogue.domain.terms import (
    Described,
    Event,
    Is,
    Nobody,
    Pronoun,
    Proposition,
    That,
    Thing,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.acts.ahead import in_lane, to_come
from xavi_dialogue.nlu.grounding.acts.dangers import spoken_of
from xavi_dialogue.nlu.grounding.acts.own_car import own_car
from xavi_dialogue.nlu.grounding.acts.questions import question
from xavi_dialogue.nlu.grounding.acts.trips import right_way
from xavi_dialogue.nlu.grounding.completion import ellipsis, repairs
from xavi_dialogue.nlu.grounding.completion.binding import bound
from xavi_dialogue.nlu.grounding.completion.discussion import PROPOSITIONS
from xavi_dialogue.nlu.grounding.completion.supposing import subordinate
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.things.lights import lit

LATELY: Final = 6.0  # [s] that a feeling is about where it does not say
_ANYBODY: Final = (Described(definite=False),)
_FOLLOWED: Final = ("follow", "keep-distance")  # who is ahead of us in our lane
INCOMPLETE: Final = 1.0  # cost of a fragment that nothing completes


def completed(spoken: Act, g: Grounder) -> Act | None:
    """Complete a fragment or repair; others are complete. None: there is nothing to complete it."""
    match spoken:
        case Elliptic():
            found = repairs.answers_clarification(spoken, g) or ellipsis.complete(spoken, g)
            g.notes.leaned = True
            if found is None:
                g.notes.cost += INCOMPLETE
            return found
        case Repair():
            repaired = repairs.complete(spoken, g)
            g.notes.leaned = g.notes.leaned or repaired is not spoken
            return repaired
    return spoken


def act(spoken: Act, g: Grounder) -> Act:
    """Ground an act that is complete."""
    spoken = to_come(in_lane(own_car(lit(spoken, g), g), g), g)
    match spoken:
        case Ask(question=Doing(actor=actor)) if actor in _ANYBODY:
            return Beyond("opinion")  # "what would a human have done?"
        case Ask():
            return Ask(question(subordinate(bound(spoken, g).question, g), g))
        case Claim(that=Is(state="at-fault", thing=thing, event=None)):
            return Ask(question(Fault(suspect=thing), g))
        case Claim():
            claimed = _claimed(bound(spoken, g).that, g)
            return replace(spoken, that=right_way(claimed) or claimed)
        case Request(event=event, negated=negated):
            return Request(_requested(event, g), negated)
        case Feel(about=about):
            return replace(spoken, about=_about(about, g))
        case Social(about=That()):
            _about(None, g)
            return replace(spoken, about=spoken_of(g) or That())
        case Social(about=about) if about is not None:
            return replace(spoken, about=_about(about, g))
    return spoken


def _claimed(that: Proposition, g: Grounder) -> Proposition:
    """Ground a claim; who is said to be there is taken for whom the noun phrase fits."""
    found = g.proposition(that, "asked")
    if first(found, Nobody) is None or first(that, Described) is None:
        return found
    known = len(g.notes.missing), g.notes.cost
    meant = g.proposition(rewrite(that, _specific), "asked")
    if len(g.notes.missing) == known[0]:
        return meant
    del g.notes.missing[known[0] :]
    g.notes.cost = known[1]
    return found


def _specific(part: Any) -> Any:
    """Take "some green car that came in" for one that is in view, whatever it is said to do."""
    if not isinstance(part, Described) or part.definite or part.plural:
        return part
    if part.colour is None and part.kind == "vehicle" and part.bearing is None:
        return part
    return replace(part, definite=True, doing=None, such=None)


def _requested(event: Event, g: Grounder) -> Event:
    """Ground what is asked for; that nobody does it yet is no objection."""
    target = event.object
    if isinstance(target, Described) and not target.definite:
        event = replace(event, object=replace(target, definite=True))
    found = g.event(event, "supposed")
    if isinstance(target, Pronoun) and event.action in _FOLLOWED:
        found = replace(found, object=_in_front(found.object, g))
    there = event.action == "head" and event.object is None  # "go there" is more than to go
    return replace(found, action="head") if there else found


def _in_front(meant: Thing | None, g: Grounder) -> Thing | None:
    """Give who is in front of us instead of somebody whom we cannot follow."""
    now = g.context.now
    look = g.context.look(meant.number, now) if isinstance(meant, Vehicle) else None
    if look is None or (look.in_view and look.ahead > 0.0 and look.kind != "pedestrian"):
        return meant
    seen = (g.context.look(v, now) for v in g.context.in_view(now))
    ahead = [x for x in seen if x is not None and x.bearing == "ahead" and not x.oncoming]
    driven = [one for one in ahead if one.kind != "pedestrian"]
    nearest = min(driven, key=lambda one: one.distance, default=None)
    return meant if nearest is None else Vehicle(nearest.vehicle)


def _about(about: Proposition | Thing | None, g: Grounder) -> Proposition | Thing | None:
    now = g.context.now
    if about is None:
        focus = g.context.discourse.episode
        asked = g.context.discourse.asked_at
        if focus is not None and asked is not None and now - asked <= LATELY:
            g.notes.spans(Span(begin=focus[0], end=focus[1]))
        else:
            g.notes.spans(Span(begin=max(g.context.begin, now - LATELY), end=now))
        return None
    if isinstance(about, PROPOSITIONS):
        return g.proposition(about, "asked")
    g.notes.spans(Span(begin=max(g.context.begin, now - LATELY), end=now))
    return g.thing(about, g.window(Unsaid(), "present"))
