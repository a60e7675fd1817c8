"""Polar questions that ask something else: who is at fault, what a cause did, how safe it was."""

from typing import Final, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import Compare, Fault, Listing, Question, WhatIf, Whether, Why
from xavi_dialogue.domain.terms import (
    Caused,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Is,
    Pronoun,
    Proposition,
    That,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import as_of
from xavi_dialogue.nlu.compose.clauses.clause import Clause, wanted_pronoun
from xavi_dialogue.nlu.compose.clauses.sem import SideOf, as_thing, is_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of

_ANYTHING = Described(definite=False)


def about_whom(clause: Clause) -> Thing | None:
    """Find whom a judgement is about: "were you wrong about the blue one"."""
    found = (as_thing(p.sem) for p in clause.complements if p.key in ("about", "with", "on"))
    vehicles = (Described, Vehicle, Pronoun)
    return next((thing for thing in found if isinstance(thing, vehicles)), None)


#: How we do something well, or decide well.
_WELL: Final = frozenset({"right", "worth-it", "good", "safely"})
_RIGHT: Final = frozenset({"right", "correct", "good", "best", "proper"})
_WRONG: Final = frozenset({"wrong", "bad", "incorrect"})
_CHOOSING: Final = frozenset({"choose", "decide", "do", "act", "behave", "make", "take"})


def valued(clause: Clause) -> Is | None:
    """Read "you chose right", "that was right" as a judgement of what we did; None for the rest."""
    ours = isinstance(clause.subject, Ego)
    verb = None if clause.verb is None else clause.verb.key
    bare = verb is None and wanted_pronoun(clause.subject) and not clause.objects
    if not bare and not (ours and verb in _CHOOSING):
        return None
    keys = {key for key, _ in clause.adjectives} | set(clause.manner)
    named = {word for _, node in clause.objects for word in words_of(node).split()}
    apart = any(isinstance(sem, SideOf) for sem, _ in clause.objects)
    sided = clause.side == "right" or (apart and "right" in named)
    chosen = any(isinstance(sem, Event) for sem, _ in clause.objects)
    wrong = "wrong" in keys or (chosen and bool(named & _WRONG))
    right = sided or keys & (_WELL - {"safely"} if bare else _WELL) or (chosen and named & _RIGHT)
    if clause.complements or not (wrong or right):
        return None
    done = Event("do", Ego(), Pronoun("that"), tense="past")
    if wrong:
        return Is("wrong", None, done, tense="past")
    return Is("right", Pronoun("that"), done, tense="past")


def surely_valued(clause: Clause) -> Is | None:
    """Read "are you sure that was right" as whether it was."""
    sure = isinstance(clause.subject, Ego) and any(key == "sure" for key, _ in clause.adjectives)
    return valued(clause.that) if sure and clause.that is not None else None


def judged_so(clause: Clause, of: Proposition, *, tag: bool) -> Question | None:
    """Read a judgement of an action, or of whoever performed it; None for anything else."""
    about = about_whom(clause)
    match of:
        case Is(state="dangerous" | "safe" as state, thing=Pronoun("that" | "it"), event=None) if (
            clause.modal == "would"
        ):  # "would that have been risky?"
            return Compare((That(),), "safety", least=state == "dangerous")
        case Is(
            state="dangerous" | "safe" as state, event=Event(actor=Ego()) as deed, tense="past"
        ) if clause.modal == "would":  # "would going first have been dangerous?"
            supposed = structs.replace(deed, tense="perfect", modal=None)
            return WhatIf(Happens(supposed), Whether(Is(state, Ego(), tense="past")))
        case Happens(event=Event(action="do", actor=Ego(), modal="would", manner=("again",))):
            done = Event("do", Ego(), Pronoun("that"), tense="past")  # "would you do it again?"
            return Whether(Is("right", Pronoun("that"), done, tense="past"))
        case Happens(
            event=Event(action="do", actor=Ego(), modal=None, tense="past" | "perfect")
        ) if judged := valued(clause):
            return Whether(judged, tag)
        case Is(state="wrong", thing=Ego() | Described() as thing) if _of_any(clause, thing, about):
            return Listing("wrong-predictions", time=clause.time)
        case Exists(thing=Described(kind="vehicle", such=Is("wrong", Wanted()))) if clause.verb:
            return Listing("wrong-predictions", time=clause.time)  # "did you get anything wrong?"
        case Is(state="wrong" | "right", thing=Ego()) if about is not None:
            return Whether(structs.replace(of, thing=about), tag)
        case Happens(
            event=Event(
                action="do", actor=actor, object=Described(such=Is(state="wrong"), doing=None)
            )
        ):  # "did we do something wrong?"
            return Fault(That(), actor)
        case Happens(event=Event(action="go", actor=Ego(), object=Pronoun()) as of_us) if (
            of_us.side is not None
        ):  # "so for this we go to the left?"
            return Why(Happens(structs.replace(of_us, object=None)), suspect=Pronoun("that"))
        case Is(state="at-fault", thing=thing, event=event):
            return Fault(Happens(event) if event is not None else None, thing)
        case Happens(event=Event(action="do", object=Pronoun(form="this" | "that")) as done) if (
            _permits(clause, done)
        ):
            return Fault(That(), done.actor, legal=True)
    return None


def _of_any(clause: Clause, thing: Thing, about: Thing | None) -> bool:
    """Check whether any mistake is meant: "did you make one", "were you wrong about anyone"."""
    if isinstance(thing, Described):
        return thing == _ANYTHING and (clause.verb is not None or about == thing)
    return about == _ANYTHING or (clause.verb is not None and about is None)


def caused_by(clause: Clause, of: Proposition, *, tag: bool) -> Question | None:
    """Read a clause that picks out one thing: "was it the bus that braked"; None for the rest."""
    match of:
        case Caused(
            cause=Described(doing=Event(action="leave", actor=Ego()) as event, rank=rank)
        ):  # "is it the next one that we get off at?"
            deed = structs.replace(event, object=Exit(rank), tense="present")
            return Whether(Happens(deed), tag)
        case Caused(cause=Described(doing=Event(action="do", object=Wanted(), actor=doer))):
            return Why(That(), suspect=doer)  # "was that something we did?"
        case Caused(cause=Described(doing=Event(actor=Wanted()) as event) as who, effect=None) if (
            wanted_pronoun(clause.subject) and (event.tense, clause.tense) != ("present", "past")
        ):  # "was it the bus that braked?", and not "the one waiting there"
            whole = structs.replace(who, doing=None)
            return Whether(Happens(structs.replace(event, actor=whole)), tag)
        case Caused(cause=Described(doing=Event(object=Wanted()) as event) as who, effect=None) if (
            wanted_pronoun(clause.subject) and event.action != "do"
        ):  # "... you braked for?"
            whole = structs.replace(who, doing=None)
            return Whether(Happens(structs.replace(event, object=whole)), tag)
        case Caused(cause=Happens(event=deed), effect=Happens(event=effect)):
            happens = Happens(structs.replace(effect, modal="would"))
            return WhatIf(as_of(Happens(deed), clause.tense), Whether(happens, tag))
        case Caused(cause=cause, effect=effect) if is_thing(cause):
            return Why(effect or That(), suspect=cast(Thing, cause))
    return None


def _permits(clause: Clause, event: Event) -> bool:
    """Check whether a clause asks if others are allowed to do what they do: "may he do that?"."""
    allowed = "semi-allowed" in clause.aux or event.modal in ("might", "can")
    return allowed and not isinstance(event.actor, Ego)
