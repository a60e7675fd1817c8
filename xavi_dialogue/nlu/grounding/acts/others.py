"""Others: questions about other road users whose words leave open what is asked."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Doing,
    HowLong,
    HowSure,
    Identify,
    Listing,
    Question,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Pronoun,
    Related,
    Wanted,
)
from xavi_dialogue.nlu.grounding.context import Context, Grounder
from xavi_dialogue.nlu.grounding.rewriting import first

_VAGUE: Final = ("it", "that", "this")
_CHANGING: Final = ("change-plan", "change-lane", "change-left", "change-right")


def of_others(spoken: Question, g: Grounder) -> Question | None:
    """Put the question that is meant in the place of one about others; None: it is another one."""
    match spoken:
        case Whether(that=Happens(event=Event("go", actor, Feature(kind="way")) as event)):
            ours = isinstance(actor, Ego)
            return Whither() if ours else Whether(Related("with", actor, Ego(), event.time))
        case (
            Whether(that=Happens(event=Event(action=action, actor=Pronoun(form=form), object=None)))
            | Why(of=Happens(event=Event(action=action, actor=Pronoun(form=form), object=None)))
        ) if action in _CHANGING and form in _VAGUE and _about_belief(g.context):
            g.notes.leaned = True
            return HowSure(changed=True)  # "has that changed since?"
        case Identify(thing=Described("vehicle", doing=Event("do", actor, Wanted()))):
            return Doing(actor, tense="past")  # "what was the last thing it did?"
        case HowLong(of=Event("stand", actor, where=Related() as where) as event):
            beside = replace(where, thing=actor, time=event.time, tense=event.tense)
            return HowLong(beside)  # "how long has he been sitting beside us?"
    return None


def _about_belief(context: Context) -> bool:
    """Tell whether it was asked just now what is expected of somebody."""
    asked = context.discourse.question
    beliefs = isinstance(asked, Listing) and asked.of == "beliefs"
    return beliefs or isinstance(asked, HowSure)


def asked_who(context: Context) -> bool:
    """Tell whether it was asked just now who or where somebody is, so that no cause is sought."""
    asked = context.discourse.question
    placed = isinstance(asked, Which | Whether) and first(asked, (Related, Exists)) is not None
    return placed or isinstance(asked, Identify | Where | Whither | Doing)
