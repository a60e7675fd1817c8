"""Recasting: questions whose words leave open what is asked, by what goes on and was spoken of.

"How long is this going to take?" asks when we go on where we stand, else when we arrive. "Is that
allowed?" about a speed asks whether it is within the limit. "What happened?" asks of the latest
thing of note.
"""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Compare, Doing, HowLong, HowMuch, Question, When
from xavi_dialogue.domain.terms import (
    Back,
    Between,
    Compares,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Proposition,
    That,
    Thing,
    Unsaid,
)
from xavi_dialogue.nlu.grounding.acts.windows import notable
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    discussed,
    hindrance,
    proposition_of,
)
from xavi_dialogue.nlu.grounding.context import Context, Grounder

_LASTING: Final = frozenset(("duration", "waiting-time", "delay"))
_VAGUE: Final = ("it", "that", "this")
_HALTING: Final = frozenset(("stop", "stand", "wait", "give-way"))
_ANYTHING: Final = (Described(definite=False), Described(kind="car", definite=False))


def recast(spoken: Question, g: Grounder) -> Question:
    """Put the question that is meant in the place of one that its words leave open."""
    match spoken:
        case HowMuch(of=Measured(attribute=attribute, thing=thing, event=None) as of) if (
            attribute in _LASTING and is_vague(thing)
        ):
            return _lasting(spoken, of, g)
        case HowLong(of=Event(action="do" | "happen", actor=actor) as event) if is_vague(actor):
            of = Measured("duration", actor, time=event.time, tense=event.tense)
            return _lasting(HowMuch(of), of, g)
        case Doing(actor=None, tense="past", time=Unsaid() | Back(relation="during" | "after")):
            found = notable(g.context)
            return spoken if found is None else replace(spoken, time=Between(*found))
        case Compare(options=options):
            return replace(spoken, options=tuple(_option(one, g) for one in options))
    return spoken


def is_vague(thing: Thing | None) -> bool:
    """Tell whether a thing is a word that may stand for what goes on."""
    return isinstance(thing, Pronoun) and thing.form in _VAGUE


def _lasting(spoken: HowMuch, of: Measured, g: Grounder) -> Question:
    g.notes.leaned = True
    if of.attribute != "delay" and of.tense in ("present", "future"):
        if halting(g.context):
            return When(Happens(Event("go", tense="future")))
        return HowMuch(Measured("time-to-go"))
    denied = isinstance(proposition_of(g.context.discourse.question), Not)
    known = (hindrance(g.context) if denied else None) or discussed(g.context)
    if known is None:
        return spoken
    return replace(spoken, of=replace(of, thing=known.actor, event=known))


def halting(context: Context) -> bool:
    """Tell whether our car stands, or is about to."""
    since = max(context.begin, context.now - 0.5)
    lately = context.deeds(Ego(), since, context.now)
    return any(e.action in _HALTING and e.end is None for e in lately)


def _option(option: Any, g: Grounder) -> Any:
    """Take "that" among what is compared for what was spoken of, and never for its denial."""
    if not isinstance(option, That):
        return option
    known = proposition_of(g.context.discourse.question) or asserted(g.context)
    if known is None:
        return option
    g.notes.leaned = True
    return affirmed(known)


def within_limit(spoken: Is, g: Grounder) -> Proposition | None:
    """Give what "allowed" asks of a speed: that it is within the limit; None: of something else."""
    if spoken.state != "allowed":
        return None
    event = spoken.event
    if event is not None:
        fast = "fast" in event.manner
        return _limited(event.actor, spoken) if fast else None
    question = g.context.discourse.question
    if not is_vague(spoken.thing) and spoken.thing is not None:
        return None
    match question:
        case HowMuch(of=Measured(attribute="speed", thing=thing)):
            g.notes.leaned = True
            return _limited(thing, spoken)
    return None


def _limited(thing: Thing, spoken: Is) -> Proposition:
    speed = Measured("speed", thing, time=spoken.time, tense=spoken.tense)
    return Compares(speed, "at-most", replace(speed, attribute="limit"))


def something_wrong(spoken: Is, g: Grounder) -> Is | None:
    """Give what "was something wrong?" asks: whether it was dangerous; None: something else."""
    if spoken.state != "wrong" or spoken.thing not in _ANYTHING:
        return None
    g.notes.leaned = True
    event = discussed(g.context) if spoken.tense != "present" else None
    return replace(spoken, state="dangerous", thing=None, event=event)


def of_nobody(spoken: Happens) -> Proposition:
    """Take "nobody does so" for the denial that anybody does."""
    event = spoken.event
    if not isinstance(event.actor, Nobody) or event.actor.described is not None:
        return spoken
    return Not(Happens(replace(event, actor=Described(definite=False))))
