"""Ellipsis: fragments take their frame from the question under discussion.

What a fragment says replaces the part of the same sort in that question: "and the bus?",
"and before that?", "why not the first one?", "and if he hadn't?".
"""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Changed,
    Claim,
    Doing,
    Elliptic,
    HowMuch,
    Identify,
    Listing,
    Peak,
    Question,
    Request,
    Summarise,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Back,
    Between,
    Described,
    Ego,
    Event,
    Exit,
    Happens,
    Is,
    Junction,
    Not,
    Pronoun,
    Related,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.grounding.completion.asking import FOR_WHOM, asked
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    interval,
    main_event,
    of_others,
    proposition_of,
    questioned,
    wished,
)
from xavi_dialogue.nlu.grounding.completion.listed import one_of_listed
from xavi_dialogue.nlu.grounding.completion.moving import at_another_time, counted_from
from xavi_dialogue.nlu.grounding.completion.ranking import ranked
from xavi_dialogue.nlu.grounding.completion.replacing import with_event, with_thing, with_time
from xavi_dialogue.nlu.grounding.completion.showing import anew, showing
from xavi_dialogue.nlu.grounding.completion.sides import at_place, lane_or_turn, on_a_side
from xavi_dialogue.nlu.grounding.completion.supposing import PLACES, through, what_if
from xavi_dialogue.nlu.grounding.context import Grounder

FRAMELESS: Final = 0.6  # cost of a fragment that has nothing to complete


def complete(spoken: Elliptic, g: Grounder) -> Act | None:
    """Complete a fragment to the act that it is short for; None where nothing completes it."""
    question = under_discussion(g)
    time = Back("before") if spoken.time == Back("earlier") else spoken.time  # "and earlier?"
    spoken = ranked(replace(spoken, time=time), g)
    spoken = replace(spoken, thing=_typed(spoken.thing, question))
    if (one := one_of_listed(spoken, g)) is not None and one.event is not None:
        done = Happens(one.event)
        return Ask(Why(done) if spoken.form == "why" else When(done))
    match spoken.form:
        case "why" | "why-not":
            return anew(spoken, g) or _why(spoken, question, g)
        case "what-if":
            return what_if(spoken, question, g)
        case "same":
            return showing(spoken, question, g) or _same(spoken, question, g)
    return asked(spoken, question, g)


def under_discussion(g: Grounder) -> Question | None:
    """Give the question under discussion; else that of a claim or request just made."""
    discourse = g.context.discourse
    if discourse.question is not None:
        return discourse.question
    for act in discourse.last_acts:
        match act:
            case Ask(question=question):
                return question
            case Claim(that=that):
                return Whether(that)
            case Request(event=event):
                return Whether(Happens(event))
    return None


def _typed(thing: Thing | None, question: Question | None) -> Thing | None:
    """Read "the first one" as an exit, junction or lane where that is what was spoken of."""
    if not isinstance(thing, Described) or thing.rank is None:
        return thing
    if thing != Described(kind=thing.kind, rank=thing.rank, definite=thing.definite):
        return thing
    place = first(question, PLACES)
    if isinstance(place, Exit) or _about_exits(question):
        return Exit(rank=thing.rank)
    if isinstance(place, Junction):
        return Junction(form=place.form, rank=thing.rank)
    return thing


def _about_exits(question: Question | None) -> bool:
    return isinstance(question, HowMuch) and question.of.attribute == "exit-number"


def _why(spoken: Elliptic, question: Question | None, g: Grounder) -> Act | None:
    if _bare(spoken) and (option := wished(g.context.discourse)) is not None:
        return Ask(Why(Not(Happens(option))))  # "overtake him!" "why not?"
    of = asserted(g.context) if _bare(spoken) else questioned(g.context)
    if isinstance(spoken.thing, Ego) and (theirs := of_others(g.context)) is not None:
        of = theirs
    if _bare(spoken) and spoken.negated and _is_suspicion(question):
        return Ask(question)  # type: ignore[arg-type]
    if isinstance(spoken.thing, PLACES):
        of = through(spoken.thing, of)
    elif spoken.thing is not None and of is not None:
        of = with_thing(of, spoken.thing, g.context)
    if spoken.event is not None:
        of = with_event(of, spoken.event)
    if of is None and _bare(spoken) and spoken.form == "why" and not spoken.negated:
        return Ask(Why(Happens(Event("do", tense="present"))))  # nothing has come about as yet
    if of is None:
        return None
    if not isinstance(spoken.time, Unsaid):
        of = with_time(of, spoken.time)
    if spoken.form == "why-not" or spoken.negated:
        return Ask(Why(Not(affirmed(of))))
    if isinstance(question, Why) and question.of == of:
        g.notes.cost += 0.05
    return Ask(Why(of))


def _is_suspicion(question: Question | None) -> bool:
    """Tell whether somebody was taken for the cause, so that "why not" means why not because."""
    return isinstance(question, Why) and question.suspect is not None


def _bare(spoken: Elliptic) -> bool:
    return spoken.thing is None and spoken.event is None and spoken.time == Unsaid()


def _same(spoken: Elliptic, question: Question | None, g: Grounder) -> Act | None:
    if spoken.besides:
        return Ask(_besides(question, g))
    if spoken.thing == SOMEBODY_ELSE:
        return Ask(_somebody_else(question))
    if question is None:
        return _frameless(spoken, g)
    new: Question = question
    if (earlier := _time_before(spoken, question, g)) is not None:
        return Ask(earlier)
    spoken = on_a_side(spoken, question, g)
    if spoken.event is not None and first(question, Event) is None and spoken.thing is None:
        return _frameless(spoken, g)
    if spoken.thing is None and spoken.event is None:
        moved = at_another_time(spoken.time, question)
        if moved is not None:
            return Ask(moved)
    if spoken.event is not None:
        new = with_event(new, spoken.event)
    if spoken.thing is not None:
        new = _about_thing(new, spoken.thing, g)
    if not isinstance(spoken.time, Unsaid):
        new = with_time(new, counted_from(spoken.time, question))
    if spoken.negated:
        new = _negated(new)
    return Ask(new)


def _time_before(spoken: Elliptic, question: Question, g: Grounder) -> Question | None:
    """Ask the same of the time before that we did so: "and the one before?"."""
    event, thing = main_event(question), spoken.thing
    when = None if event is None else interval(event)
    if event is None or when is None or event.actor != Ego() or spoken.time != Back("before"):
        return None
    if not isinstance(thing, Described) or thing != Described(definite=thing.definite):
        return None
    earlier = Between(g.context.begin, max(when[0] - 0.1, g.context.begin))
    found: Question = with_event(with_time(question, Unsaid()), replace(event, time=earlier))
    return found


def _somebody_else(question: Question | None) -> Question:
    """Ask whether others are why we did what was asked about; else list who is there."""
    match question:
        case Why(of=of) if first(of, Vehicle) is None:
            return replace(question, suspect=SOMEBODY_ELSE, rival=None, alone=False)
        case Whether(that=Happens(event=Event(actor=Ego(), object=Vehicle()) as event)) if (
            event.action in FOR_WHOM
        ):
            return Why(Happens(replace(event, object=None)), suspect=SOMEBODY_ELSE)
        case Which(such=Happens()):
            return question
    return Listing("vehicles")


def _about_thing(question: Question, thing: Thing, g: Grounder) -> Question:
    """Ask the same of another thing; of what we did, ask whether that is why.

    Where it cannot be asked of that thing, it is asked what that is doing.
    """
    if isinstance(thing, Described) and thing.bearing is not None and _is_of_room(question):
        return Listing(
            "vehicles", thing
        )  # "is there room on the left?", "what about oncoming cars?"
    if (there := at_place(thing, question)) is not None:
        return there
    event = main_event(question)
    whom = isinstance(question, Which) and event is not None and isinstance(event.object, Wanted)
    if isinstance(thing, Ego) and whom and event is not None:
        return Whether(Happens(replace(event, object=thing)))  # "for us?"
    if isinstance(question, Listing | Which) and getattr(thing, "extreme", None) is not None:
        return Identify(thing)  # "and the closest one?"
    judged = isinstance(question, Whether) and event is not None and event.modal in _JUDGING
    if (judged or isinstance(question, _OF_RIDE)) and isinstance(thing, _USERS):
        return Doing(thing)
    if isinstance(question, Why) and not isinstance(thing, PLACES):
        event = main_event(question)
        if event is not None and event.actor == Ego() and not isinstance(thing, Ego):
            found = g.thing(thing, g.window(Unsaid(), "present"))
            did = isinstance(found, Vehicle) and g.context.holds(
                replace(event, actor=found), g.context.begin, g.context.now
            )
            if event.object is None and not did:
                return replace(question, suspect=found)
            if event.object is None:
                return with_thing(question, found, g.context)
            same = replace(event, object=found)
            if not g.context.holds(same, g.context.begin, g.context.now):
                return Doing(found)
            return replace(question, of=with_event(question.of, same))
    return with_thing(question, thing, g.context)


def _is_of_room(question: Question) -> bool:
    """Tell whether it was asked if there is room, or if a lane or the road is free."""
    that = question.that if isinstance(question, Whether) else None
    return isinstance(that, Is) and that.state in ("free", "roomy") and that.event is None


_JUDGING: Final = ("should", "could", "would")
#: Questions about us and the ride, which are not asked of another vehicle.
_OF_RIDE: Final = (Summarise, Peak, Changed)
_USERS: Final = (Vehicle, Vehicles, Described, Pronoun)


def _negated(question: Question) -> Question:
    match question:
        case WhatIf(supposed=Not(content=content)):
            return replace(question, supposed=content)
        case WhatIf(supposed=supposed):
            return replace(question, supposed=Not(supposed))
        case Why(of=of):
            return replace(question, of=Not(affirmed(of)))
        case Whether(that=that):
            return replace(question, that=Not(affirmed(that)))
    return question


def _besides(question: Question | None, g: Grounder) -> Question:
    match question:
        case Why():
            return Listing(of="reasons")
        case Listing():
            return question
        case Which(such=Related(relation="can-see")):
            return Listing(of="vehicles")
        case Doing():
            return replace(question, besides=asserted(g.context))
    return Doing(besides=proposition_of(question))


def _frameless(spoken: Elliptic, g: Grounder) -> Act | None:
    """Read a fragment that follows on nothing: what is it, or what does it do."""
    g.notes.cost += FRAMELESS
    if spoken.event is not None:
        return Ask(Whether(Happens(lane_or_turn(spoken.event, g))))
    if spoken.thing is None:
        return None
    if isinstance(spoken.thing, Described | Pronoun | Vehicle):
        return Ask(Identify(spoken.thing))
    return Ask(Where(spoken.thing))
